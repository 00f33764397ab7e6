/* Analogue input: hands the latched sample on, a bad one too. */
#include "pcl2_ain.h"

PCL2_KERNEL void pcl2_ain(struct pcl2_ain *self, pcl2_real word)
{
    self->status = pcl2_is_bad(word);
    self->y = word;
}
