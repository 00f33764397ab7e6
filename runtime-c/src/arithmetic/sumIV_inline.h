/* Weighted sum of four signals. */
#ifndef PCL2_SUMIV_INLINE_H
#define PCL2_SUMIV_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_sumIV(
    pcl2_real x1, pcl2_real x2, pcl2_real x3, pcl2_real x4, pcl2_real k1, pcl2_real k2, pcl2_real k3, pcl2_real k4)
{
    return k1 * x1 + k2 * x2 + k3 * x3 + k4 * x4;
}

#endif
