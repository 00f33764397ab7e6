/* Hyperbolic tangent: tanh x = v/(v + 2) with v = e^(2x) - 1. */
#include "pcl2_exp_core.h"

/* (head + tail)/(head + tail + two): the quotient of the heads, then once the remainder, whose product is taken
 * exactly by halves. head > 0 or head <= 0, but the sum is positive. */
static pcl2_real tanh_quotient(pcl2_real head, pcl2_real tail, pcl2_real two)
{
    pcl2_real sum_rest;
    const pcl2_real sum = pcl2_exp_sum(head, two, &sum_rest);
    const pcl2_real inverse = 1 / sum;
    const pcl2_real quotient = head * inverse;
    const pcl2_real q = pcl2_exp_half(quotient);
    const pcl2_real s = pcl2_exp_half(sum);
    const pcl2_real q_low = quotient - q;
    const pcl2_real s_low = sum - s;
    const pcl2_real remainder = ((head - q * s) - q * s_low) - q_low * s - q_low * s_low;
    return quotient + (remainder + (tail - quotient * (sum_rest + tail))) * inverse;
}

pcl2_real pcl2_tanh(pcl2_real x)
{
    const pcl2_real size = pcl2_fabs(x);
    if (pcl2_exponent(x) < -PCL2_FRACTION_BITS / 2 - 2 || size != size) {
        return x;
    }
    pcl2_real y = PCL2_R(1.0);
    if (size < PCL2_R(22.0)) {
        pcl2_real unit;
        const struct pcl2_exp_parts e = pcl2_exp_minus_1(2 * size, &unit);
        const pcl2_real head = e.head + e.tail;
        const pcl2_real tail = e.tail - (head - e.head);
        y = tanh_quotient(head, tail, 2 * unit);
    }
    return x < 0 ? -y : y;
}
