/* The command for zone 4: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_4.h"

PCL2_KERNEL void pcl2_word_4(struct pcl2_word_4 *self, int32_t goal)
{
    const int32_t here = (goal > 12 && goal <= 16);
    self->word = 400 + here*(goal - 12) + 4*(1 - here);
}
