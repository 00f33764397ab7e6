/* Analogue output: never writes a bad value. y is what the image holds, also before the first good x. fail is bad
 * where no fail-safe value is bound. */
#include "pcl2_aout.h"
#include "pcl2_return.h"

PCL2_KERNEL void pcl2_aout_init(struct pcl2_aout *self, pcl2_real *bk)
{
    (void)self;
    (void)bk;
}

/* A waiting valve has the word: it is written back what it told. */
PCL2_KERNEL void pcl2_aout(struct pcl2_aout *self, pcl2_real x, const pcl2_real *back, pcl2_real *word, pcl2_real fail,
                           pcl2_real *bk)
{
    const int32_t told = pcl2_return_state(back);
    self->status = pcl2_is_bad(x);
    if (self->status != 0) {
        *word = pcl2_is_bad(fail) ? *word : fail;
    } else if (told == PCL2_WAITING) {
        *word = back[0];
    }
    if (pcl2_awaits(&self->patience, self->status != 0 || told == PCL2_WAITING, bk, x, *word)) {
        pcl2_hand_back(bk, *word, PCL2_WAITING);
    } else {
        *word = x;
        pcl2_hand_on(bk, x, PCL2_FOLLOWING, back);
    }
    self->y = *word;
}
