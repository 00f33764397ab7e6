/* Logarithm to the base 10: ln x times 1/ln 10, so that powers of ten come out exactly. */
#include "pcl2_log_core.h"

/* 1/ln 10 */
#if PCL2_REAL_BITS == 64
static const struct pcl2_pair pcl2_log10_factor = {0.4342944819032518, 1.098319650216765e-17};
#else
static const struct pcl2_pair pcl2_log10_factor = {0.4342945f, -1.010305e-08f};
#endif

pcl2_real pcl2_math_log10(pcl2_real x)
{
    if (!(x > 0) || pcl2_is_bad(x)) {
        return x == 0 ? -pcl2_of_bits(PCL2_EXPONENT_MASK) : x < 0 ? pcl2_bad() : x + x;
    }
    return pcl2_pair_times(pcl2_log_pair(x, PCL2_R(0.0)), pcl2_log10_factor).head;
}
