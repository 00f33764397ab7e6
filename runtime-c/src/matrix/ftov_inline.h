/* One element of a vector, in place; i counts from 1. */
#ifndef PCL2_FTOV_INLINE_H
#define PCL2_FTOV_INLINE_H

#include "pcl2.h"

static inline void pcl2_ftov(int32_t n, pcl2_real x, int32_t i, pcl2_real *y)
{
    (void)n;
    y[i - 1] = x;
}

static inline void pcl2_itov(int32_t n, int32_t x, int32_t i, int32_t *y)
{
    (void)n;
    y[i - 1] = x;
}

#endif
