/* Products of matrices. */
#ifndef PCL2_MULMAT_INLINE_H
#define PCL2_MULMAT_INLINE_H

#include "pcl2.h"

/* The sum of an element starts from its first product and runs over ascending k: one order for all targets.
 * Measured on x86-64 and Cortex-M4: few turns of i and j unrolled and all of k beat more and less of either. */
PCL2_INLINE void pcl2_mulmat(
    int32_t r, int32_t c, const pcl2_real *restrict a, const pcl2_real *restrict b, int32_t q, pcl2_real *restrict m)
{
    PCL2_UNROLL_FEW
    for (int32_t i = 0; i < r; i++) {
        PCL2_UNROLL_FEW
        for (int32_t j = 0; j < c; j++) {
            pcl2_real sum = a[i * q] * b[j];
            PCL2_UNROLL
            for (int32_t k = 1; k < q; k++) {
                sum += a[i * q + k] * b[k * c + j];
            }
            m[i * c + j] = sum;
        }
    }
}

/* A product has at most 62 bits and a sign; q of them (q <= 2^24) go beyond 64. Each is made non-negative by
 * 2^62 and added up in two halves of 32 bits; the offsets leave the upper half at the end. */
static inline int32_t pcl2_mulimat_element(const int32_t *a, const int32_t *b, int32_t stride, int32_t q)
{
    uint64_t upper = 0;
    uint64_t lower = 0;
    for (int32_t k = 0; k < q; k++) {
        const uint64_t product = (uint64_t)((int64_t)a[k] * b[k * stride]) + (UINT64_C(1) << 62);
        upper += product >> 32;
        lower += product & UINT32_MAX;
    }
    const int64_t high = (int64_t)(upper + (lower >> 32)) - ((int64_t)q << 30);
    const int64_t low = (int64_t)(lower & UINT32_MAX);
    if (high > 0) {
        return INT32_MAX;
    }
    if (high < -1) {
        return INT32_MIN;
    }
    return pcl2_saturate_i(high * (INT64_C(1) << 32) + low);
}

static inline void pcl2_mulimat(int32_t r, int32_t c, const int32_t *a, const int32_t *b, int32_t q, int32_t *m)
{
    for (int32_t i = 0; i < r; i++) {
        for (int32_t j = 0; j < c; j++) {
            m[i * c + j] = pcl2_mulimat_element(&a[i * q], &b[j], c, q);
        }
    }
}

#endif
