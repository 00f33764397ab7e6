/* Hyperbolic tangent: an odd polynomial up to 0.55, beyond it 1 - 2/(e^(2x) + 1). */
#include "pcl2_exp_core.h"

/* Polynomial of (tanh(x)/x - 1)/x^2 in x^2 through the Chebyshev points of x^2 <= 0.5625^2; x^2 times its error
 * is below 2^-57 (2^-28). */
#if PCL2_REAL_BITS == 64
#define TANH_TERMS 12
static const pcl2_real pcl2_tanh_term[TANH_TERMS] = {
    -0.3333333333333333, 0.133333333333333, -0.05396825396820291, 0.02186948853313033,
    -0.008863235437120377, 0.003592126352822234, -0.0014558149436249654, 0.0005898788187502341,
    -0.00023836459039376214, 9.427778828319503e-05, -3.333062013997152e-05, 7.634414185118713e-06};
#else
#define TANH_TERMS 6
static const pcl2_real pcl2_tanh_term[TANH_TERMS] = {
    -0.33333334f, 0.13333322f, -0.053964064f, 0.021811903f, -0.008499248f, 0.0024876148f};
#endif

static pcl2_real pcl2_tanh_small(pcl2_real x)
{
    const pcl2_real z = x * x;
    const pcl2_real z2 = z * z;
    pcl2_real even = pcl2_tanh_term[TANH_TERMS - 2];
    pcl2_real odd = pcl2_tanh_term[TANH_TERMS - 1];
    PCL2_UNROLL
    for (int32_t i = TANH_TERMS - 4; i >= 0; i -= 2) {
        even = even * z2 + pcl2_tanh_term[i];
        odd = odd * z2 + pcl2_tanh_term[i + 1];
    }
    return x + x * (z * (even + z * odd));
}

/* With e^(2x) = 2^k (1 + head + tail): 1 - 2 unit/(1 + unit + head + tail), unit = 2^-k. The quotient is at most a
 * half; the digits that rounding takes from its divisor and from the difference are put back. */
static pcl2_real pcl2_tanh_large(pcl2_real x)
{
    const struct pcl2_exp_parts e = pcl2_exp_reduce(2 * x);
    const pcl2_real unit = pcl2_power_of_2(-e.k);
    const pcl2_real one = 1 + unit;
    const pcl2_real sum = one + e.head;
    const pcl2_real tail = (e.head - (sum - one)) + e.tail;
    const pcl2_real divisor = sum + tail;
    const pcl2_real rest = (tail - (divisor - sum)) + (unit - (one - 1));
    const pcl2_real inverse = 1 / divisor;
    const pcl2_real quotient = 2 * unit * inverse;
    const pcl2_real y = 1 - quotient;
    return y + (((1 - y) - quotient) + quotient * (rest * inverse));
}

pcl2_real pcl2_math_tanh(pcl2_real x)
{
    const pcl2_real size = pcl2_math_fabs(x);
    if (pcl2_exponent(x) < -PCL2_FRACTION_BITS / 2 - 2 || size != size) {
        return x;
    }
    if (size < PCL2_R(0.55)) {
        return pcl2_tanh_small(x);
    }
    const pcl2_real y = size < PCL2_R(22.0) ? pcl2_tanh_large(size) : PCL2_R(1.0);
    return x < 0 ? -y : y;
}

#undef TANH_TERMS
