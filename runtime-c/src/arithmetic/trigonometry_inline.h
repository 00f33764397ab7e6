/* Trigonometric functions, angles in rad. */
#ifndef PCL2_TRIGONOMETRY_INLINE_H
#define PCL2_TRIGONOMETRY_INLINE_H

#include "pcl2_math.h"

static inline pcl2_real pcl2_sin(pcl2_real x)
{
    return pcl2_math_sin(x);
}

static inline pcl2_real pcl2_cos(pcl2_real x)
{
    return pcl2_math_cos(x);
}

static inline pcl2_real pcl2_tan(pcl2_real x)
{
    return pcl2_math_tan(x);
}

static inline pcl2_real pcl2_atan(pcl2_real x)
{
    return pcl2_is_bad(x) ? pcl2_bad() : pcl2_math_atan(x);
}

static inline pcl2_real pcl2_atan2(pcl2_real y, pcl2_real x)
{
    return pcl2_is_bad(x) || pcl2_is_bad(y) ? pcl2_bad() : pcl2_math_atan2(y, x);
}

#endif
