/* Products of a matrix and a vector, and of two vectors. */
#ifndef PCL2_MULMV_INLINE_H
#define PCL2_MULMV_INLINE_H

#include "pcl2.h"

PCL2_INLINE void pcl2_mulmv(
    int32_t p, const pcl2_real *restrict a, const pcl2_real *restrict x, int32_t q, pcl2_real *restrict y)
{
    PCL2_UNROLL_FEW
    for (int32_t i = 0; i < p; i++) {
        pcl2_real sum = a[i * q] * x[0];
        PCL2_UNROLL
        for (int32_t k = 1; k < q; k++) {
            sum += a[i * q + k] * x[k];
        }
        y[i] = sum;
    }
}

PCL2_INLINE pcl2_real pcl2_dotvec_row(int32_t n, const pcl2_real *a, const pcl2_real *b)
{
    pcl2_real sum = a[0] * b[0];
    PCL2_UNROLL
    for (int32_t i = 1; i < n; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* sums[d] is the sum of 2^d rows that waits for another one of its length: the bits of the number of rows. */
static inline pcl2_real pcl2_dotvec_long(const pcl2_real *a, const pcl2_real *b, int32_t n)
{
    pcl2_real sums[24];
    uint32_t rows = 0;
    for (int32_t i = 0; i < n; i += 8) {
        pcl2_real sum = pcl2_dotvec_row(n - i < 8 ? n - i : 8, &a[i], &b[i]);
        int32_t d = 0;
        for (; (rows >> d & 1) != 0; d++) {
            sum = sums[d] + sum;
        }
        sums[d] = sum;
        rows++;
    }
    pcl2_real total = PCL2_R(0.0);
    for (int32_t d = 0; rows >> d != 0; d++) {
        total = (rows >> d & 1) != 0 ? sums[d] + total : total;
    }
    return total;
}

PCL2_INLINE pcl2_real pcl2_dotvec(const pcl2_real *a, const pcl2_real *b, int32_t n)
{
    return n <= 8 ? pcl2_dotvec_row(n, a, b) : pcl2_dotvec_long(a, b, n);
}

#endif
