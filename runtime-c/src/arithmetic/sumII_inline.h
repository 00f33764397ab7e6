/* Weighted sum of two signals. */
#ifndef PCL2_SUMII_INLINE_H
#define PCL2_SUMII_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_sumII(pcl2_real x, pcl2_real y, pcl2_real p1, pcl2_real p2)
{
    return p1 * x + p2 * y;
}

#endif
