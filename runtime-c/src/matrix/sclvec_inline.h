/* Multiples and products of vectors and matrices, element by element. */
#ifndef PCL2_SCLVEC_INLINE_H
#define PCL2_SCLVEC_INLINE_H

#include "pcl2.h"

PCL2_INLINE void pcl2_sclvec(int32_t n, pcl2_real k, const pcl2_real *a, pcl2_real *restrict y)
{
    PCL2_UNROLL
    for (int32_t i = 0; i < n; i++) {
        y[i] = k * a[i];
    }
}

PCL2_INLINE void pcl2_sclmat(int32_t r, int32_t c, pcl2_real k, const pcl2_real *a, pcl2_real *restrict m)
{
    pcl2_sclvec(r * c, k, a, m);
}

PCL2_INLINE void pcl2_mulvec(int32_t n, const pcl2_real *a, const pcl2_real *b, pcl2_real *restrict y)
{
    PCL2_UNROLL
    for (int32_t i = 0; i < n; i++) {
        y[i] = a[i] * b[i];
    }
}

#endif
