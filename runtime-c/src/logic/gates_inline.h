/* Gates: truth values are 0 and not 0 at the inputs, 0 and 1 at the outputs. */
#ifndef PCL2_GATES_INLINE_H
#define PCL2_GATES_INLINE_H

#include "pcl2.h"

static inline int32_t pcl2_not(int32_t x)
{
    return x == 0;
}

static inline int32_t pcl2_and(int32_t x1, int32_t x2, int32_t x3, int32_t x4, int32_t x5, int32_t x6, int32_t x7,
                               int32_t x8)
{
    return (x1 != 0) & (x2 != 0) & (x3 != 0) & (x4 != 0) & (x5 != 0) & (x6 != 0) & (x7 != 0) & (x8 != 0);
}

static inline int32_t pcl2_or(int32_t x1, int32_t x2, int32_t x3, int32_t x4, int32_t x5, int32_t x6, int32_t x7,
                              int32_t x8)
{
    return (x1 | x2 | x3 | x4 | x5 | x6 | x7 | x8) != 0;
}

static inline int32_t pcl2_xor(int32_t x1, int32_t x2, int32_t x3, int32_t x4, int32_t x5, int32_t x6, int32_t x7,
                               int32_t x8)
{
    return (x1 != 0) ^ (x2 != 0) ^ (x3 != 0) ^ (x4 != 0) ^ (x5 != 0) ^ (x6 != 0) ^ (x7 != 0) ^ (x8 != 0);
}

static inline int32_t pcl2_qor(const int32_t *x, int32_t n, int32_t m, int32_t exact)
{
    int32_t count = 0;
    PCL2_UNROLL
    for (int32_t i = 0; i < n; i++) {
        count += x[i] != 0;
    }
    return exact != 0 ? count == m : count >= m;
}

static inline int32_t pcl2_dtrans(int32_t a, int32_t b, int32_t s)
{
    return s != 0 ? b : a;
}

#endif
