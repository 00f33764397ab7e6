/* Digital input with debouncing; digital output with a fail state. */
#include "pcl2_din.h"
#include "pcl2_timing.h"

PCL2_KERNEL void pcl2_din_tune(struct pcl2_din *self, pcl2_real t, int64_t T)
{
    self->limit = pcl2_set_time(t, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_din_init(struct pcl2_din *self, pcl2_real t)
{
    (void)t;
    self->since = 0;
}

PCL2_KERNEL void pcl2_din(struct pcl2_din *self, int32_t word)
{
    const int32_t bit = word != 0;
    if (bit == self->q || self->started == 0) {
        self->q = bit;
        self->started = 1;
        self->since = 0;
        return;
    }
    /* since is the time to the next scan: in the scan of the change it has been 0. */
    if (self->since >= self->limit) {
        self->q = bit;
        self->since = 0;
    } else {
        self->since = pcl2_elapse(self->since, self->tick, self->limit);
    }
}

/* The value of fail that leaves the output as it stands; 0 and 1 are what they say. */
enum { DOUT_HOLD = 2 };

PCL2_KERNEL void pcl2_dout(struct pcl2_dout *self, int32_t x, int32_t ok, int32_t fail, int32_t *word)
{
    self->status = ok == 0;
    if (ok != 0) {
        *word = x != 0;
    } else if (fail != DOUT_HOLD) {
        *word = fail;
    }
    self->y = *word;
}
