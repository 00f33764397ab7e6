/* Sum, mean, extremes and length of a vector. */
#ifndef PCL2_SUMVEC_INLINE_H
#define PCL2_SUMVEC_INLINE_H

#include "pcl2_math.h"

PCL2_INLINE pcl2_real pcl2_sumvec(const pcl2_real *v, int32_t n)
{
    pcl2_real sum = v[0];
    PCL2_UNROLL
    for (int32_t i = 1; i < n; i++) {
        sum += v[i];
    }
    return sum;
}

PCL2_INLINE pcl2_real pcl2_avgvec(const pcl2_real *v, int32_t n)
{
    return pcl2_sumvec(v, n) / (pcl2_real)n;
}

/* sign 1: the largest element; -1: the smallest. */
static inline void pcl2_sumvec_extreme(const pcl2_real *v, int32_t n, pcl2_real sign, pcl2_real *y, int32_t *i)
{
    int32_t best = 0;
    int32_t bad = 0;
    for (int32_t k = 0; k < n; k++) {
        bad |= pcl2_is_bad(v[k]);
        best = sign * v[k] > sign * v[best] ? k : best;
    }
    *y = bad != 0 ? pcl2_bad() : v[best];
    *i = bad != 0 ? 0 : best + 1;
}

static inline void pcl2_maxvec(const pcl2_real *v, int32_t n, pcl2_real *y, int32_t *i)
{
    pcl2_sumvec_extreme(v, n, PCL2_R(1.0), y, i);
}

static inline void pcl2_minvec(const pcl2_real *v, int32_t n, pcl2_real *y, int32_t *i)
{
    pcl2_sumvec_extreme(v, n, PCL2_R(-1.0), y, i);
}

/* Squares of elements in units of a power of 2 near the largest one. A NaN passes the search and stays in the sum. */
static inline pcl2_real pcl2_normvec(const pcl2_real *v, int32_t n)
{
    pcl2_real largest = PCL2_R(0.0);
    for (int32_t i = 0; i < n; i++) {
        const pcl2_real size = pcl2_math_fabs(v[i]);
        largest = size > largest ? size : largest;
    }
    const int32_t exponent = pcl2_exponent(largest);
    const int32_t limit = PCL2_EXPONENT_BIAS - 3;
    const int32_t k = exponent > limit ? limit : exponent < -limit ? -limit : exponent;
    const pcl2_real unit = pcl2_power_of_2(-k);
    pcl2_real sum = PCL2_R(0.0);
    for (int32_t i = 0; i < n; i++) {
        const pcl2_real part = v[i] * unit;
        sum += part * part;
    }
    return pcl2_math_sqrt(sum) * pcl2_power_of_2(k);
}

#endif
