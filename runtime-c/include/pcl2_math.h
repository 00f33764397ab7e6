/* Elementary functions, the same bits on every target: one source in src/math/ for both widths, IEEE
 * operations only. At most 1 ulp from the true value, special values as in C99 annex F. */
#ifndef PCL2_MATH_H
#define PCL2_MATH_H

#include <math.h>

#include "pcl2.h"

/* e^x; 0 below the smallest subnormal, infinite above the largest real. */
pcl2_real pcl2_math_exp(pcl2_real x);

/* e^x - 1, with full digits near 0. */
pcl2_real pcl2_math_expm1(pcl2_real x);

/* Hyperbolic tangent. */
pcl2_real pcl2_math_tanh(pcl2_real x);

/* Natural logarithm; minus infinity at 0, NaN below it. */
pcl2_real pcl2_math_log(pcl2_real x);

/* Logarithm to the base 10; exact at powers of ten. */
pcl2_real pcl2_math_log10(pcl2_real x);

/* ln(1 + x), with full digits near 0. */
pcl2_real pcl2_math_log1p(pcl2_real x);

/* x^y; NaN for a negative x with a y that is no whole number. */
pcl2_real pcl2_math_pow(pcl2_real x, pcl2_real y);

/* Sine, cosine and tangent of an angle in rad, of any size; NaN for an infinite one. */
pcl2_real pcl2_math_sin(pcl2_real x);
pcl2_real pcl2_math_cos(pcl2_real x);
pcl2_real pcl2_math_tan(pcl2_real x);

/* Inverse sine, -pi/2 to pi/2, and inverse cosine, 0 to pi; NaN beyond 1. */
pcl2_real pcl2_math_asin(pcl2_real x);
pcl2_real pcl2_math_acos(pcl2_real x);

/* Inverse tangent, -pi/2 to pi/2. */
pcl2_real pcl2_math_atan(pcl2_real x);

/* The angle of the point (x, y), -pi to pi. */
pcl2_real pcl2_math_atan2(pcl2_real y, pcl2_real x);

/* The functions of the C library whose results IEEE 754 fixes to the last bit. */
#if PCL2_REAL_BITS == 64
#define PCL2_MATH_EXACT(name) name
#else
#define PCL2_MATH_EXACT(name) name##f
#endif

static inline pcl2_real pcl2_math_sqrt(pcl2_real x)
{
    return PCL2_MATH_EXACT(sqrt)(x);
}

static inline pcl2_real pcl2_math_fabs(pcl2_real x)
{
    return PCL2_MATH_EXACT(fabs)(x);
}

static inline pcl2_real pcl2_math_floor(pcl2_real x)
{
    return PCL2_MATH_EXACT(floor)(x);
}

static inline pcl2_real pcl2_math_ceil(pcl2_real x)
{
    return PCL2_MATH_EXACT(ceil)(x);
}

static inline pcl2_real pcl2_math_trunc(pcl2_real x)
{
    return PCL2_MATH_EXACT(trunc)(x);
}

#undef PCL2_MATH_EXACT

/* 2^k for a k whose power is a normal real. */
static inline pcl2_real pcl2_power_of_2(int32_t k)
{
    return pcl2_of_bits((pcl2_bits)(k + PCL2_EXPONENT_BIAS) << PCL2_FRACTION_BITS);
}

/* The k with 2^k <= |x| < 2^(k + 1) of a normal real; less than that of every normal real for 0 and subnormals. */
static inline int32_t pcl2_exponent(pcl2_real x)
{
    return (int32_t)((pcl2_bits_of(x) & PCL2_EXPONENT_MASK) >> PCL2_FRACTION_BITS) - PCL2_EXPONENT_BIAS;
}

#endif
