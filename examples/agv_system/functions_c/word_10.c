/* The command for zone 10: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_10.h"

PCL2_KERNEL void pcl2_word_10(struct pcl2_word_10 *self, int32_t goal)
{
    const int32_t here = (goal > 36 && goal <= 40);
    self->word = 1000 + here*(goal - 36) + 4*(1 - here);
}
