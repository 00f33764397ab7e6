/* The command for zone 7: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_7.h"

PCL2_KERNEL void pcl2_word_7(struct pcl2_word_7 *self, int32_t goal)
{
    const int32_t here = (goal > 24 && goal <= 28);
    self->word = 700 + here*(goal - 24) + 4*(1 - here);
}
