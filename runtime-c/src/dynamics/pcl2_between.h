/* Linear interpolation. */
#ifndef PCL2_BETWEEN_H
#define PCL2_BETWEEN_H

#include "pcl2.h"

/* (1 - f) a + f b, f from 0 to 1: exact where a = b, never beyond the range of a real. */
static inline pcl2_real pcl2_between(pcl2_real a, pcl2_real b, pcl2_real f)
{
    return a == b ? a : (1 - f) * a + f * b;
}

#endif
