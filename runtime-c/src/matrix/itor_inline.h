/* Integers to reals and to bits. */
#ifndef PCL2_ITOR_INLINE_H
#define PCL2_ITOR_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_itor(int32_t x)
{
    return (pcl2_real)x;
}

static inline void pcl2_itob(int32_t n, int32_t x, int32_t *restrict y)
{
    for (int32_t i = 0; i < n; i++) {
        y[i] = (int32_t)(((uint32_t)x >> i) & 1);
    }
}

#endif
