/* The operators of expressions that compute: sums, differences, products, quotients, remainders. */
#ifndef PCL2_OPERATORS_INLINE_H
#define PCL2_OPERATORS_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_add(pcl2_real a, pcl2_real b)
{
    return a + b;
}

static inline pcl2_real pcl2_sub(pcl2_real a, pcl2_real b)
{
    return a - b;
}

static inline pcl2_real pcl2_mul(pcl2_real a, pcl2_real b)
{
    return a * b;
}

/* Without a limit (lim = 0) bad where |b| < 1e-12. */
static inline pcl2_real pcl2_div(pcl2_real a, pcl2_real b, pcl2_real lim)
{
    const pcl2_real y = b >= PCL2_R(1e-12) || b <= PCL2_R(-1e-12) ? a / b : pcl2_bad();
    if (lim > PCL2_R(0.0) && !(y >= -lim && y <= lim) && !pcl2_is_bad(a) && !pcl2_is_bad(b)) {
        return (a < PCL2_R(0.0)) != (b < PCL2_R(0.0)) ? -lim : lim;
    }
    return y;
}

static inline pcl2_real pcl2_neg(pcl2_real a)
{
    return -a;
}

static inline int32_t pcl2_addi(int32_t a, int32_t b)
{
    return pcl2_add_i(a, b);
}

static inline int32_t pcl2_subi(int32_t a, int32_t b)
{
    return pcl2_sub_i(a, b);
}

static inline int32_t pcl2_muli(int32_t a, int32_t b)
{
    return pcl2_mul_i(a, b);
}

/* C leaves a division by 0, and INT32_MIN / -1, undefined. */
static inline int32_t pcl2_divi(int32_t a, int32_t b)
{
    return b == 0 ? 0 : b == -1 ? pcl2_neg_i(a) : a / b;
}

static inline int32_t pcl2_modi(int32_t a, int32_t b)
{
    return b == 0 || b == -1 ? 0 : a % b;
}

static inline int32_t pcl2_negi(int32_t a)
{
    return pcl2_neg_i(a);
}

#endif
