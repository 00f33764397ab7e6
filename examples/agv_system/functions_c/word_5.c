/* The command for zone 5: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_5.h"

PCL2_KERNEL void pcl2_word_5(struct pcl2_word_5 *self, int32_t goal)
{
    const int32_t here = (goal > 16 && goal <= 20);
    self->word = 500 + here*(goal - 16) + 4*(1 - here);
}
