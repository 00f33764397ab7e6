/* The command for zone 1: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_1.h"

PCL2_KERNEL void pcl2_word_1(struct pcl2_word_1 *self, int32_t goal)
{
    const int32_t here = (goal > 0 && goal <= 4);
    self->word = 100 + here*(goal - 0) + 4*(1 - here);
}
