/* Bias and ratio. */
#ifndef PCL2_RATIO_INLINE_H
#define PCL2_RATIO_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_bias(pcl2_real x, pcl2_real b)
{
    return x + b;
}

static inline pcl2_real pcl2_ratio(pcl2_real x, pcl2_real w, pcl2_real k, pcl2_real b)
{
    return k * w * x + b;
}

#endif
