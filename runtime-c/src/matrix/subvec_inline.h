/* Differences of vectors and matrices, element by element. */
#ifndef PCL2_SUBVEC_INLINE_H
#define PCL2_SUBVEC_INLINE_H

#include "pcl2.h"

PCL2_INLINE void pcl2_subvec(int32_t n, const pcl2_real *a, const pcl2_real *b, pcl2_real *restrict y)
{
    PCL2_UNROLL
    for (int32_t i = 0; i < n; i++) {
        y[i] = a[i] - b[i];
    }
}

static inline void pcl2_subivec(int32_t n, const int32_t *a, const int32_t *b, int32_t *restrict y)
{
    for (int32_t i = 0; i < n; i++) {
        y[i] = pcl2_sub_i(a[i], b[i]);
    }
}

PCL2_INLINE void pcl2_submat(int32_t r, int32_t c, const pcl2_real *a, const pcl2_real *b, pcl2_real *restrict m)
{
    pcl2_subvec(r * c, a, b, m);
}

static inline void pcl2_subimat(int32_t r, int32_t c, const int32_t *a, const int32_t *b, int32_t *restrict m)
{
    pcl2_subivec(r * c, a, b, m);
}

#endif
