/* Supervises the optical link. */
#include "pcl2_answered.h"

enum { ANSWERED_MOST = 3 };

PCL2_KERNEL void pcl2_answered(struct pcl2_answered *self, int32_t cause, int32_t tried)
{
    self->ready = cause == 0 || tried >= ANSWERED_MOST;
    self->tries = self->ready ? tried : tried + 1;
}
