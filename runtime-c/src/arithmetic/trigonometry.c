/* Inverse sine and cosine: an argument beyond their domain counts as its end, and as a fault. */
#include "pcl2_trigonometry.h"
#include "pcl2_math.h"

/* Infinite ones too are bad signals, and stay so. */
static pcl2_real pcl2_trigonometry_clamped(pcl2_real x)
{
    return pcl2_is_bad(x) ? pcl2_bad() : x > 1 ? PCL2_R(1.0) : x < -1 ? PCL2_R(-1.0) : x;
}

PCL2_KERNEL void pcl2_asin(struct pcl2_asin *self, pcl2_real x)
{
    const pcl2_real clamped = pcl2_trigonometry_clamped(x);
    self->status = !pcl2_is_bad(x) && clamped != x;
    self->y = pcl2_math_asin(clamped);
}

PCL2_KERNEL void pcl2_acos(struct pcl2_acos *self, pcl2_real x)
{
    const pcl2_real clamped = pcl2_trigonometry_clamped(x);
    self->status = !pcl2_is_bad(x) && clamped != x;
    self->y = pcl2_math_acos(clamped);
}
