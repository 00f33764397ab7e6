/* Platinum resistance thermometers: the inverse of the Callendar-Van Dusen equation, IEC 60751. */
#include "pcl2_sensors.h"
#include "pcl2_math.h"

#define RTD_A PCL2_R(3.9083e-3)
#define RTD_B PCL2_R(-5.775e-7)
#define RTD_C PCL2_R(-4.183e-12)

/* The root of A t + B t^2 = ratio - 1 next to 0, in the form that loses no digits there. */
static pcl2_real pcl2_rtd_above_zero(pcl2_real ratio)
{
    return 2 * (ratio - 1) / (RTD_A + pcl2_math_sqrt(RTD_A * RTD_A + 4 * RTD_B * (ratio - 1)));
}

/* Newton's method from the quadratic's root, which is at most 2.5 degC away: three steps do, eight bound it. */
static pcl2_real pcl2_rtd_below_zero(pcl2_real ratio)
{
    pcl2_real t = pcl2_rtd_above_zero(ratio);
    for (int32_t i = 0; i < 8; i++) {
        const pcl2_real miss = t * (RTD_A + t * (RTD_B + t * RTD_C * (t - 100))) - (ratio - 1);
        const pcl2_real step = miss / (RTD_A + t * (2 * RTD_B + t * RTD_C * (4 * t - 300)));
        t -= step;
        if (pcl2_math_fabs(step) < PCL2_R(1e-5)) {
            break;
        }
    }
    return t;
}

/* Ratios of -200.05 and 850.05 degC: within them both roots exist. */
PCL2_KERNEL void pcl2_rtd(struct pcl2_rtd *self, pcl2_real ohm, pcl2_real r0)
{
    const pcl2_real ratio = ohm / r0;
    const int32_t known = ratio > PCL2_R(0.1849846) && ratio < PCL2_R(3.904958);
    const pcl2_real t = !known ? pcl2_bad() : ratio < 1 ? pcl2_rtd_below_zero(ratio) : pcl2_rtd_above_zero(ratio);
    self->t = t;
    self->status = !known && !pcl2_is_bad(ohm);
}

#undef RTD_A
#undef RTD_B
#undef RTD_C
