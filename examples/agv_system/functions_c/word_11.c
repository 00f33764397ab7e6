/* The command for zone 11: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_11.h"

PCL2_KERNEL void pcl2_word_11(struct pcl2_word_11 *self, int32_t goal)
{
    const int32_t here = (goal > 40 && goal <= 44);
    self->word = 1100 + here*(goal - 40) + 4*(1 - here);
}
