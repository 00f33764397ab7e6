/* One of several signals, and back. */
#ifndef PCL2_MUX_INLINE_H
#define PCL2_MUX_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_mux(const pcl2_real *x, int32_t i, int32_t n)
{
    return x[i < 1 ? 0 : i > n ? n - 1 : i - 1];
}

static inline void pcl2_demux(pcl2_real x, int32_t i, int32_t n, pcl2_real off, pcl2_real *y)
{
    const int32_t chosen = i < 1 ? 0 : i > n ? n - 1 : i - 1;
    PCL2_UNROLL
    for (int32_t k = 0; k < n; k++) {
        y[k] = k == chosen ? x : off;
    }
}

#endif
