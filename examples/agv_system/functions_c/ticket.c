/* The number of the next request, 1 to 999. */
#include "pcl2_ticket.h"

PCL2_KERNEL void pcl2_ticket(struct pcl2_ticket *self, int32_t last)
{
    self->number = last - last/999*999 + 1;
}
