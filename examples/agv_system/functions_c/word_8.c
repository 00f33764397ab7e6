/* The command for zone 8: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_8.h"

PCL2_KERNEL void pcl2_word_8(struct pcl2_word_8 *self, int32_t goal)
{
    const int32_t here = (goal > 28 && goal <= 32);
    self->word = 800 + here*(goal - 28) + 4*(1 - here);
}
