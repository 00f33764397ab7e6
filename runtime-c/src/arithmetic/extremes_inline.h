/* The smaller and the larger of two reals; a bad one wins. */
#ifndef PCL2_EXTREMES_INLINE_H
#define PCL2_EXTREMES_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_min(pcl2_real a, pcl2_real b)
{
    return pcl2_is_bad(a) || (a < b && !pcl2_is_bad(b)) ? a : b;
}

static inline pcl2_real pcl2_max(pcl2_real a, pcl2_real b)
{
    return pcl2_is_bad(a) || (a > b && !pcl2_is_bad(b)) ? a : b;
}

#endif
