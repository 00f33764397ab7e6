/* First order lag b/(s + a): the step-invariant model of a continuous plant behind a hold
 * (Astrom and Wittenmark, Computer-Controlled Systems, ch. 2). */
#include "pcl2_first.h"
#include "pcl2_math.h"

PCL2_KERNEL void pcl2_first_init(struct pcl2_first *self, pcl2_real a, pcl2_real b, pcl2_real x0)
{
    (void)a;
    (void)b;
    self->y = x0;
}

/* e = e^(-aT), g = (b/a)(1 - e^(-aT)). Where aT is lost beside 1, an integrator included, g is bT to the last digit. */
PCL2_KERNEL void pcl2_first_tune(struct pcl2_first *self, pcl2_real a, pcl2_real b, int64_t T)
{
    const pcl2_real h = pcl2_seconds(T);
    const pcl2_real x = a * h;
    const int32_t integrator = pcl2_math_fabs(x) < PCL2_REAL_EPSILON / 4;
    self->e = pcl2_math_exp(-x);
    self->g = integrator ? b * h : -(b / a) * pcl2_math_expm1(-x);
}

/* A bad u makes y bad, and so does an unstable plant that outgrows the reals: one test holds both. y is stored in
 * either case: who reads it next need not wait for the test. */
PCL2_KERNEL void pcl2_first(struct pcl2_first *self, pcl2_real u)
{
    const pcl2_real y = self->e * self->y + self->g * u;
    self->y = pcl2_is_bad(y) ? self->y : y;
}
