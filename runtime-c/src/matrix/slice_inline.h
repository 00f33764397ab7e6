/* Parts of vectors and matrices. */
#ifndef PCL2_SLICE_INLINE_H
#define PCL2_SLICE_INLINE_H

#include "pcl2.h"

static inline void pcl2_slice(int32_t n, const pcl2_real *a, int32_t i, int32_t m, pcl2_real *restrict y)
{
    const int32_t last = m > n ? m - n : 0;
    const int32_t first = i < 1 ? 0 : i > last ? last : i - 1;
    for (int32_t k = 0; k < n; k++) {
        y[k] = a[first + k < m ? first + k : m - 1];
    }
}

PCL2_INLINE void pcl2_catvec(int32_t n, const pcl2_real *a, const pcl2_real *b, int32_t m, pcl2_real *restrict y)
{
    PCL2_UNROLL
    for (int32_t i = 0; i < m; i++) {
        y[i] = a[i];
    }
    PCL2_UNROLL
    for (int32_t i = m; i < n; i++) {
        y[i] = b[i - m];
    }
}

static inline void pcl2_rowmat(int32_t n, const pcl2_real *m, int32_t i, int32_t r, pcl2_real *restrict y)
{
    const int32_t row = i < 1 ? 0 : i > r ? r - 1 : i - 1;
    for (int32_t j = 0; j < n; j++) {
        y[j] = m[row * n + j];
    }
}

static inline void pcl2_colmat(int32_t n, const pcl2_real *m, int32_t j, int32_t c, pcl2_real *restrict y)
{
    const int32_t column = j < 1 ? 0 : j > c ? c - 1 : j - 1;
    for (int32_t i = 0; i < n; i++) {
        y[i] = m[i * c + column];
    }
}

static inline void pcl2_setrow(int32_t r, int32_t c, const pcl2_real *v, int32_t i, pcl2_real *restrict m)
{
    (void)r;
    for (int32_t j = 0; j < c; j++) {
        m[(i - 1) * c + j] = v[j];
    }
}

#endif
