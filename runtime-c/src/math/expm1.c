/* e^x - 1 */
#include "pcl2_exp_core.h"

pcl2_real pcl2_math_expm1(pcl2_real x)
{
    if (!(x <= PCL2_EXP_LARGEST)) {
        return x > 0 ? pcl2_of_bits(PCL2_EXPONENT_MASK) : x + x;
    }
    if (x < PCL2_R(-40.0)) {
        return PCL2_R(-1.0);
    }
    if (pcl2_exponent(x) < -PCL2_FRACTION_BITS - 2) {
        return x;
    }
    /* 2^k (1 + head + tail) - 1 in units of 2^k; from some k on, 2^-k is lost beside 1 */
    const struct pcl2_exp_parts e = pcl2_exp_reduce(x);
    const pcl2_real unit = e.k > 2 * PCL2_FRACTION_BITS ? PCL2_R(0.0) : pcl2_power_of_2(-e.k);
    const pcl2_real whole = 1 - unit;
    const pcl2_real whole_rest = (1 - whole) - unit;
    const struct pcl2_pair sum = pcl2_pair_sum(whole, e.head);
    return pcl2_exp_scale(sum.head + (e.tail + (sum.tail + whole_rest)), e.k);
}
