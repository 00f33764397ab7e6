/* Reals to whole reals. */
#ifndef PCL2_ROUNDING_INLINE_H
#define PCL2_ROUNDING_INLINE_H

#include "pcl2_math.h"

/* Beside 2^52 (2^23) a real has no digits behind the point: adding it rounds, halves to even. */
static inline pcl2_real pcl2_round(pcl2_real x)
{
    const pcl2_real large = pcl2_power_of_2(PCL2_FRACTION_BITS);
    const pcl2_real size = pcl2_math_fabs(x);
    if (!(size < large)) {
        return x;
    }
    const pcl2_real whole = (size + large) - large;
    return x < 0 ? -whole : whole;
}

static inline pcl2_real pcl2_trunc(pcl2_real x)
{
    return pcl2_math_trunc(x);
}

static inline pcl2_real pcl2_floor(pcl2_real x)
{
    return pcl2_math_floor(x);
}

static inline pcl2_real pcl2_ceil(pcl2_real x)
{
    return pcl2_math_ceil(x);
}

#endif
