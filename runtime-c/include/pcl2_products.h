/* Sums of products of ints: exact on the way, saturated at the end. */
#ifndef PCL2_PRODUCTS_H
#define PCL2_PRODUCTS_H

#include "pcl2.h"

/* start + a[0] b[0] + a[1] b[stride] + .. with q products. A product has at most 62 bits and a sign; q of them
 * (q <= 2^24) go beyond 64. Each is made non-negative by 2^62 and added up in two halves of 32 bits; the offsets leave
 * the upper half at the end. */
static inline int32_t pcl2_products(int32_t start, const int32_t *a, const int32_t *b, int32_t stride, int32_t q)
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
    return pcl2_saturate_i(high * (INT64_C(1) << 32) + low + start);
}

#endif
