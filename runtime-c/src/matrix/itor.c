/* Reals to integers. */
#include "pcl2_itor.h"
#include "pcl2_math.h"

/* x is within half a unit of the range of an int32_t: the whole part fits 64 bits. */
static int32_t pcl2_rtoi_nearest(pcl2_real x)
{
    const pcl2_real below = pcl2_math_floor(x);
    const pcl2_real rest = x - below;
    const int64_t whole = (int64_t)below;
    const int32_t up = rest > PCL2_R(0.5) || (rest == PCL2_R(0.5) && (whole & 1) != 0);
    return pcl2_saturate_i(whole + up);
}

PCL2_KERNEL void pcl2_rtoi(struct pcl2_rtoi *self, pcl2_real x, int32_t onbad)
{
    if (pcl2_is_bad(x)) {
        self->y = onbad == 2 ? self->y : onbad;
        return;
    }
    const pcl2_real limit = PCL2_R(2147483648.0);
    self->y = x >= limit ? INT32_MAX : x <= -limit ? INT32_MIN : pcl2_rtoi_nearest(x);
}
