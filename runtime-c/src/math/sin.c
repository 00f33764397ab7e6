/* Sine */
#include "pcl2_trig.h"

pcl2_real pcl2_math_sin(pcl2_real x)
{
    struct pcl2_pair r;
    if (pcl2_is_bad(x)) {
        return x - x;
    }
    if (pcl2_exponent(x) < -PCL2_FRACTION_BITS / 2 - 2) {
        return x;
    }
    const int32_t quarters = pcl2_trig_reduce(x, &r);
    const pcl2_real y = (quarters & 1) == 0 ? pcl2_trig_sine(r) : pcl2_trig_cosine(r);
    return (quarters & 2) == 0 ? y : -y;
}
