/* What exp, expm1, pow and tanh share: e^x = 2^k (1 + head + tail) with head + tail far more exact than one real.
 * Reduction by multiples of ln 2 in two parts after Cody and Waite, Software Manual for the Elementary
 * Functions, 1980, ch. 6. */
#ifndef PCL2_EXP_CORE_H
#define PCL2_EXP_CORE_H

#include "pcl2_pair.h"

struct pcl2_exp_parts {
    int32_t k;       /* power of 2 */
    pcl2_real head;  /* e^r - 1, |r| <= 0.3475, all but the tail */
    pcl2_real tail;  /* the rest of it, at most 2 % of the head */
};

/* ln 2 cut so that k times the high part is exact, and the polynomial of (e^r - 1 - r - r^2/2)/r^3 through the
 * Chebyshev points of |r| <= 0.3475; r^3 times its error is below 2^-60 (2^-35). Beyond the largest argument e^x has no finite value, below the smallest it is 0. */
#if PCL2_REAL_BITS == 64
#define PCL2_EXP_LN2_HIGH 0.6931471805598903
#define PCL2_EXP_LN2_LOW 5.497923018708371e-14
#define PCL2_EXP_LARGEST 710.0
#define PCL2_EXP_SMALLEST (-746.0)
#define PCL2_EXP_TERMS 10
static const pcl2_real pcl2_exp_term[PCL2_EXP_TERMS] = {
    0.16666666666666669, 0.041666666666666664, 0.008333333333329994, 0.0013888888888886504, 0.00019841269863392214,
    2.48015873173863e-05, 2.7557267935231926e-06, 2.755728259480407e-07, 2.5100634461878497e-08, 2.0911414421956654e-09};
#else
#define PCL2_EXP_LN2_HIGH 0.693145751953125f
#define PCL2_EXP_LN2_LOW 1.4286068e-06f
#define PCL2_EXP_LARGEST 89.0f
#define PCL2_EXP_SMALLEST (-105.0f)
#define PCL2_EXP_TERMS 6
static const pcl2_real pcl2_exp_term[PCL2_EXP_TERMS] = {
    0.16666667f, 0.041666668f, 0.0083333105f, 0.0013888866f, 0.00019891247f, 2.4851555e-05f};
#endif

/* x finite, from PCL2_EXP_SMALLEST to PCL2_EXP_LARGEST. */
static inline struct pcl2_exp_parts pcl2_exp_reduce(pcl2_real x)
{
    struct pcl2_exp_parts e;
    const pcl2_real turns = x * PCL2_R(1.4426950408889634);
    e.k = (int32_t)(turns + (x < 0 ? PCL2_R(-0.5) : PCL2_R(0.5)));
    /* r + c = x - k ln 2, c below half a digit of r */
    const pcl2_real high = x - (pcl2_real)e.k * PCL2_EXP_LN2_HIGH;
    const pcl2_real low = (pcl2_real)e.k * PCL2_EXP_LN2_LOW;
    const pcl2_real r = high - low;
    const pcl2_real c = (high - r) - low;
    const pcl2_real r2 = r * r;
    pcl2_real even = pcl2_exp_term[PCL2_EXP_TERMS - 2];
    pcl2_real odd = pcl2_exp_term[PCL2_EXP_TERMS - 1];
    PCL2_UNROLL
    for (int32_t i = PCL2_EXP_TERMS - 4; i >= 0; i -= 2) {
        even = even * r2 + pcl2_exp_term[i];
        odd = odd * r2 + pcl2_exp_term[i + 1];
    }
    /* r^2/2 in two parts, the first of them exact */
    const pcl2_real half = pcl2_pair_half(r);
    const pcl2_real square = PCL2_R(0.5) * half * half;
    const pcl2_real square_rest = PCL2_R(0.5) * (r - half) * (r + half);
    e.head = r + square;
    e.tail = (square - (e.head - r)) + ((square_rest + (c + r * c)) + r * r2 * (even + r * odd));
    return e;
}

/* x 2^k with one rounding, k from -1100 to 1100 (-160 to 160): half of it at a time. */
static inline pcl2_real pcl2_exp_scale(pcl2_real x, int32_t k)
{
    const int32_t half = k / 2;
    return x * pcl2_power_of_2(half) * pcl2_power_of_2(k - half);
}

#endif
