/* e^x - 1 */
#include "pcl2_exp_core.h"

pcl2_real pcl2_expm1(pcl2_real x)
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
    pcl2_real unit;
    const struct pcl2_exp_parts e = pcl2_exp_minus_1(x, &unit);
    return pcl2_exp_scale(e.head + e.tail, e.k);
}
