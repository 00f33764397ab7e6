/* Transposes and diagonals. */
#ifndef PCL2_TRANMAT_INLINE_H
#define PCL2_TRANMAT_INLINE_H

#include "pcl2.h"

PCL2_INLINE void pcl2_tranmat(int32_t r, int32_t c, const pcl2_real *restrict a, pcl2_real *restrict m)
{
    PCL2_UNROLL_FEW
    for (int32_t i = 0; i < r; i++) {
        PCL2_UNROLL
        for (int32_t j = 0; j < c; j++) {
            m[i * c + j] = a[j * r + i];
        }
    }
}

static inline void pcl2_eyemat(int32_t n, pcl2_real *restrict m)
{
    for (int32_t i = 0; i < n; i++) {
        for (int32_t j = 0; j < n; j++) {
            m[i * n + j] = i == j ? PCL2_R(1.0) : PCL2_R(0.0);
        }
    }
}

static inline void pcl2_diagmat(int32_t n, const pcl2_real *restrict v, pcl2_real *restrict m)
{
    for (int32_t i = 0; i < n; i++) {
        for (int32_t j = 0; j < n; j++) {
            m[i * n + j] = i == j ? v[i] : PCL2_R(0.0);
        }
    }
}

#endif
