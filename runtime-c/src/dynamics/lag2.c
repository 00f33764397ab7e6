/* Second-order lag: the step-invariant model (Astrom and Wittenmark, Computer-Controlled Systems, ch. 2). */
#include "pcl2_lag2.h"
#include "pcl2_expm.h"
#include "pcl2_math.h"
#include "pcl2_sum.h"

PCL2_KERNEL void pcl2_lag2_init(struct pcl2_lag2 *self, pcl2_real k, pcl2_real wn, pcl2_real z, pcl2_real *p)
{
    (void)k;
    (void)wn;
    (void)z;
    (void)p;
    self->started = 0;
}

/* p = exp(..) - 1. The slope is kept over wn, so it follows a change of wn. */
PCL2_KERNEL void pcl2_lag2_tune(struct pcl2_lag2 *self, pcl2_real k, pcl2_real wn, pcl2_real z, int64_t T, pcl2_real *p)
{
    const pcl2_real angle = wn * pcl2_seconds(T);
    const pcl2_real slope = self->slope * (self->speed / wn);
    pcl2_real m[4] = {PCL2_R(0.0), angle, -angle, PCL2_R(-2.0) * z * angle};
    pcl2_real work[4];
    self->gain = k;
    self->slope = pcl2_is_bad(slope) ? PCL2_R(0.0) : slope;
    self->speed = wn;
    pcl2_expm1m(2, m, p, work);
}

PCL2_KERNEL void pcl2_lag2(struct pcl2_lag2 *self, pcl2_real x, const pcl2_real *p)
{
    const pcl2_real rest = self->gain * x;
    const pcl2_real away = self->started != 0 ? self->y - rest : PCL2_R(0.0);
    pcl2_real carry = self->carry;
    const pcl2_real y = pcl2_sum(self->started != 0 ? self->y : rest, p[0] * away + p[1] * self->slope, &carry);
    const pcl2_real slope = self->slope + (p[2] * away + p[3] * self->slope);
    if (pcl2_is_bad(y) || pcl2_is_bad(slope)) {
        return;
    }
    self->y = y;
    self->carry = carry;
    self->slope = slope;
    self->started = 1;
}
