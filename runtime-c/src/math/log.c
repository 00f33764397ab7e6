/* Natural logarithm */
#include "pcl2_log_core.h"

pcl2_real pcl2_math_log(pcl2_real x)
{
    if (!(x > 0) || pcl2_is_bad(x)) {
        return x == 0 ? -pcl2_of_bits(PCL2_EXPONENT_MASK) : x < 0 ? pcl2_bad() : x + x;
    }
    return pcl2_log_pair(x, PCL2_R(0.0)).head;
}
