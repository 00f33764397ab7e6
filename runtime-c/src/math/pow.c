/* x^y = e^(y ln x), ln x and its product with y as pairs; special values after C99 F.9.4.4. */
#include "pcl2_exp_core.h"
#include "pcl2_log_core.h"

/* Beyond 2^POW_LARGEST every power of a real other than 1 is 0 or infinite. */
#if PCL2_REAL_BITS == 64
#define POW_LARGEST 65
#else
#define POW_LARGEST 32
#endif

/* |x|^y for an x that is neither 0 nor 1 nor bad, and a y that is no NaN. */
static pcl2_real pcl2_pow_positive(pcl2_real x, pcl2_real y)
{
    const pcl2_real limit = pcl2_power_of_2(POW_LARGEST);
    const pcl2_real exponent = y > limit ? limit : y < -limit ? -limit : y;
    const struct pcl2_pair logarithm = pcl2_log_pair(pcl2_math_fabs(x), PCL2_R(0.0));
    struct pcl2_pair p = pcl2_pair_product(exponent, logarithm.head);
    p.tail += exponent * logarithm.tail;
    if (p.head > PCL2_EXP_LARGEST) {
        return pcl2_of_bits(PCL2_EXPONENT_MASK);
    }
    if (p.head < PCL2_EXP_SMALLEST) {
        return PCL2_R(0.0);
    }
    const struct pcl2_exp_parts e = pcl2_exp_reduce(p.head);
    const struct pcl2_pair sum = pcl2_pair_ordered_sum(PCL2_R(1.0), e.head);
    return pcl2_exp_scale(sum.head + (sum.tail + (e.tail + p.tail * (sum.head + e.tail))), e.k);
}

/* 0^y and infinite^y, without their sign: 0 or infinite. */
static pcl2_real pcl2_pow_limit(pcl2_real x, pcl2_real y)
{
    return (x == 0) == (y < 0) ? pcl2_of_bits(PCL2_EXPONENT_MASK) : PCL2_R(0.0);
}

pcl2_real pcl2_math_pow(pcl2_real x, pcl2_real y)
{
    if (x == 1 || y == 0) {
        return PCL2_R(1.0);
    }
    if (x != x || y != y) {
        return x + y;
    }
    const int32_t whole = pcl2_math_floor(y) == y;
    const pcl2_real half = PCL2_R(0.5) * y;
    const int32_t odd = whole && pcl2_math_floor(half) != half;
    const int32_t negative = (pcl2_bits_of(x) >> (PCL2_REAL_BITS - 1)) != 0;
    if (x == 0 || pcl2_is_bad(x)) {
        const pcl2_real size = pcl2_pow_limit(x, y);
        return negative && odd ? -size : size;
    }
    if (negative && !whole) {
        return pcl2_bad();
    }
    const pcl2_real size = x == -1 ? PCL2_R(1.0) : pcl2_pow_positive(x, y);
    return negative && odd ? -size : size;
}

#undef POW_LARGEST
