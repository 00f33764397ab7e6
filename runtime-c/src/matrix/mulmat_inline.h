/* Products of matrices. */
#ifndef PCL2_MULMAT_INLINE_H
#define PCL2_MULMAT_INLINE_H

#include "pcl2.h"
#include "pcl2_products.h"

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

static inline void pcl2_mulimat(int32_t r, int32_t c, const int32_t *a, const int32_t *b, int32_t q, int32_t *m)
{
    for (int32_t i = 0; i < r; i++) {
        for (int32_t j = 0; j < c; j++) {
            m[i * c + j] = pcl2_products(0, &a[i * q], &b[j], c, q);
        }
    }
}

#endif
