/* ln(1 + x) */
#include "pcl2_log_core.h"

pcl2_real pcl2_math_log1p(pcl2_real x)
{
    if (!(x > -1) || pcl2_is_bad(x)) {
        return x == -1 ? -pcl2_of_bits(PCL2_EXPONENT_MASK) : x < -1 ? pcl2_bad() : x + x;
    }
    if (pcl2_exponent(x) < -PCL2_FRACTION_BITS - 2) {
        return x;
    }
    const struct pcl2_pair sum = pcl2_pair_sum(PCL2_R(1.0), x);
    return pcl2_log_pair(sum.head, pcl2_exponent(x) > PCL2_FRACTION_BITS + 2 ? PCL2_R(0.0) : sum.tail).head;
}
