/* The command for zone 12: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_12.h"

PCL2_KERNEL void pcl2_word_12(struct pcl2_word_12 *self, int32_t goal)
{
    const int32_t here = (goal > 44 && goal <= 48);
    self->word = 1200 + here*(goal - 44) + 4*(1 - here);
}
