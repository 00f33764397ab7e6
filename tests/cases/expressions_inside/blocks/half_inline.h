#ifndef PCL2_HALF_INLINE_H
#define PCL2_HALF_INLINE_H

#include "pcl2_math.h"

static inline pcl2_real pcl2_half(pcl2_real x, pcl2_real share)
{
    return share * x;
}

static inline int32_t pcl2_halfi(int32_t x)
{
    return x / 2;
}

static inline pcl2_real pcl2_root(pcl2_real x)
{
    return x >= PCL2_R(0.0) ? pcl2_math_sqrt(x) : pcl2_bad();
}

#endif
