/* Cosine */
#include "pcl2_trig.h"

pcl2_real pcl2_math_cos(pcl2_real x)
{
    struct pcl2_pair r;
    if (pcl2_is_bad(x)) {
        return x - x;
    }
    const int32_t quarters = pcl2_trig_reduce(x, &r) + 1;
    const pcl2_real y = (quarters & 1) == 0 ? pcl2_trig_sine(r) : pcl2_trig_cosine(r);
    return (quarters & 2) == 0 ? y : -y;
}
