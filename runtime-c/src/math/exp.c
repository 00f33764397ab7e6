/* e^x */
#include "pcl2_exp_core.h"

pcl2_real pcl2_math_exp(pcl2_real x)
{
    if (!(x <= PCL2_EXP_LARGEST)) {
        return x > 0 ? pcl2_of_bits(PCL2_EXPONENT_MASK) : x + x;
    }
    if (x < PCL2_EXP_SMALLEST) {
        return PCL2_R(0.0);
    }
    const struct pcl2_exp_parts e = pcl2_exp_reduce(x);
    const pcl2_real sum = 1 + e.head;
    const pcl2_real rest = e.head - (sum - 1);
    return pcl2_exp_scale(sum + (rest + e.tail), e.k);
}
