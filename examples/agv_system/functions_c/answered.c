/* Whether a command needs no more answer: answered, or sent three times in vain. */
#include "pcl2_answered.h"

PCL2_KERNEL void pcl2_answered(struct pcl2_answered *self, int32_t cause, int32_t tries)
{
    const int32_t done = (cause == 0 || tries >= 3);
    self->ready = done;
    self->sent = tries + 1 - done;
}
