/* The command for zone 2: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_2.h"

PCL2_KERNEL void pcl2_word_2(struct pcl2_word_2 *self, int32_t goal)
{
    const int32_t here = (goal > 4 && goal <= 8);
    self->word = 200 + here*(goal - 4) + 4*(1 - here);
}
