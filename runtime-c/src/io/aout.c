/* Analogue output: never writes a bad value. y is what the image holds, also before the first good x. fail is bad
 * where no fail-safe value is bound. */
#include "pcl2_aout.h"

PCL2_KERNEL void pcl2_aout(struct pcl2_aout *self, pcl2_real x, pcl2_real *word, pcl2_real fail)
{
    self->status = pcl2_is_bad(x);
    if (self->status == 0) {
        *word = x;
    } else if (!pcl2_is_bad(fail)) {
        *word = fail;
    }
    self->y = *word;
}
