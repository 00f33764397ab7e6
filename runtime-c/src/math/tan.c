/* Tangent: the quotient of sine and cosine, both as pairs. */
#include "pcl2_trig.h"

/* Polynomial of ((sin(r)/r - 1)/z + 1/6)/z through the Chebyshev points of z = r^2 from 0 to (pi/4)^2, and 1/6. */
#if PCL2_REAL_BITS == 64
#define TAN_TERMS 6
static const pcl2_real pcl2_tan_term[TAN_TERMS] = {
    0.008333333333333333, -0.00019841269841268958, 2.7557319222318445e-06,
    -2.5052107232936746e-08, 1.605868368328571e-10, -7.595260169253886e-13};
static const struct pcl2_pair pcl2_tan_sixth = {0.16666666666666666, 9.25185853854297e-18};
#else
#define TAN_TERMS 3
static const pcl2_real pcl2_tan_term[TAN_TERMS] = {0.008333333f, -0.00019840736f, 2.7326316e-06f};
static const struct pcl2_pair pcl2_tan_sixth = {0.16666667f, -4.967054e-09f};
#endif

/* r (1 - z/6 + ..) */
static struct pcl2_pair pcl2_tan_sine(struct pcl2_pair r, struct pcl2_pair z)
{
    pcl2_real sum = pcl2_tan_term[TAN_TERMS - 1];
    PCL2_UNROLL
    for (int32_t i = TAN_TERMS - 2; i >= 0; i--) {
        sum = sum * z.head + pcl2_tan_term[i];
    }
    const struct pcl2_pair sixth = pcl2_pair_times(z, pcl2_tan_sixth);
    struct pcl2_pair curve = {-sixth.head, z.head * z.head * sum - sixth.tail};
    curve = pcl2_pair_times(r, curve);
    const struct pcl2_pair y = pcl2_pair_ordered_sum(r.head, curve.head);
    return pcl2_pair_ordered_sum(y.head, y.tail + (curve.tail + r.tail));
}

/* 1 - z/2 + .. */
static struct pcl2_pair pcl2_tan_cosine(struct pcl2_pair z)
{
    pcl2_real sum = pcl2_cosine_term[PCL2_COSINE_TERMS - 1];
    PCL2_UNROLL
    for (int32_t i = PCL2_COSINE_TERMS - 2; i >= 0; i--) {
        sum = sum * z.head + pcl2_cosine_term[i];
    }
    const struct pcl2_pair y = pcl2_pair_ordered_sum(PCL2_R(1.0), PCL2_R(-0.5) * z.head);
    return pcl2_pair_ordered_sum(y.head, y.tail + (z.head * z.head * sum - PCL2_R(0.5) * z.tail));
}

pcl2_real pcl2_math_tan(pcl2_real x)
{
    struct pcl2_pair r;
    if (pcl2_is_bad(x)) {
        return x - x;
    }
    if (pcl2_exponent(x) < -PCL2_FRACTION_BITS / 2 - 2) {
        return x;
    }
    const int32_t quarters = pcl2_trig_reduce(x, &r);
    const struct pcl2_pair z = pcl2_pair_times(r, r);
    const struct pcl2_pair sine = pcl2_tan_sine(r, z);
    const struct pcl2_pair cosine = pcl2_tan_cosine(z);
    const int32_t odd = (quarters & 1) != 0;
    const struct pcl2_pair y = odd ? pcl2_pair_quotient(cosine, sine) : pcl2_pair_quotient(sine, cosine);
    return odd ? -(y.head + y.tail) : y.head + y.tail;
}

#undef TAN_TERMS
