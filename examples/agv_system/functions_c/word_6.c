/* The command for zone 6: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_6.h"

PCL2_KERNEL void pcl2_word_6(struct pcl2_word_6 *self, int32_t goal)
{
    const int32_t here = (goal > 20 && goal <= 24);
    self->word = 600 + here*(goal - 20) + 4*(1 - here);
}
