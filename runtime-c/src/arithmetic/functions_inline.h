/* Elementary functions of one real, and the power. */
#ifndef PCL2_FUNCTIONS_INLINE_H
#define PCL2_FUNCTIONS_INLINE_H

#include "pcl2_math.h"

static inline pcl2_real pcl2_abs(pcl2_real x)
{
    return pcl2_math_fabs(x);
}

static inline pcl2_real pcl2_sqr(pcl2_real x)
{
    return x * x;
}

/* lcut is not negative: what reaches the root is not, or it is NaN. */
static inline pcl2_real pcl2_sqrt(pcl2_real x, pcl2_real lcut)
{
    return x < lcut && !pcl2_is_bad(x) ? PCL2_R(0.0) : pcl2_math_sqrt(x);
}

static inline pcl2_real pcl2_pow(pcl2_real x, pcl2_real y)
{
    const pcl2_real z = pcl2_math_pow(x, y);
    return pcl2_is_bad(x) || pcl2_is_bad(y) || pcl2_is_bad(z) ? pcl2_bad() : z;
}

/* e^700 and, of a float, e^88 are nearly the largest reals. */
static inline pcl2_real pcl2_exp(pcl2_real x)
{
    const pcl2_real largest = PCL2_REAL_BITS == 64 ? PCL2_R(700.0) : PCL2_R(88.0);
    return pcl2_is_bad(x) ? pcl2_bad() : pcl2_math_exp(x > largest ? largest : x);
}

static inline pcl2_real pcl2_ln(pcl2_real x)
{
    return x > 0 ? pcl2_math_log(x) : pcl2_bad();
}

static inline pcl2_real pcl2_log10(pcl2_real x)
{
    return x > 0 ? pcl2_math_log10(x) : pcl2_bad();
}

#endif
