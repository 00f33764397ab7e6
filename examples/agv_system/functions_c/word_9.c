/* The command for zone 9: 100 zone + 10 if it turns off + stations to go. */
#include "pcl2_word_9.h"

PCL2_KERNEL void pcl2_word_9(struct pcl2_word_9 *self, int32_t goal)
{
    const int32_t zone = (goal + 3)/4;
    const int32_t here = (goal > 32 && goal <= 36);
    self->word = 900 + 10*(1 - here)*(zone == 4 || zone == 5 || zone == 6 || zone == 7 || zone == 8 || zone == 9) + here*(goal - 32) + 4*(1 - here);
}
