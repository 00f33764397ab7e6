#include "pcl2_glide.h"

PCL2_KERNEL void pcl2_glide_tune(struct pcl2_glide *self, pcl2_real rate, int64_t T)
{
    self->largest = rate * pcl2_seconds(T);
}

PCL2_KERNEL void pcl2_glide_init(struct pcl2_glide *self, pcl2_real rate, pcl2_real y0)
{
    (void)rate;
    self->y = y0;
}

PCL2_KERNEL void pcl2_glide(struct pcl2_glide *self, pcl2_real u)
{
    const pcl2_real step = u - self->y;
    if (pcl2_is_bad(step)) {
        return;
    }
    self->limited = step > self->largest || step < -self->largest;
    if (!self->limited) {
        self->y = u;
    } else {
        self->y += step > PCL2_R(0.0) ? self->largest : -self->largest;
    }
}
