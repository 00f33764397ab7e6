/* The command for zone 3: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_3.h"

PCL2_KERNEL void pcl2_word_3(struct pcl2_word_3 *self, int32_t goal)
{
    const int32_t zone = (goal + 3)/4;
    const int32_t here = (goal > 8 && goal <= 12);
    self->word = 300 + 10*(1 - here)*(zone == 1 || zone == 2 || zone == 3 || zone == 10 || zone == 11 || zone == 12) + here*(goal - 8) + 4*(1 - here);
}
