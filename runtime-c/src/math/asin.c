/* Inverse sine: the angle opposite to x in the triangle with hypotenuse 1. */
#include "pcl2_angle.h"

pcl2_real pcl2_math_asin(pcl2_real x)
{
    const pcl2_real size = pcl2_math_fabs(x);
    if (pcl2_exponent(x) < -PCL2_FRACTION_BITS / 2 - 2 || !(size <= 1)) {
        return size > 1 ? pcl2_bad() : x;
    }
    const struct pcl2_pair y = {size, PCL2_R(0.0)};
    const pcl2_real angle = pcl2_angle(y, pcl2_angle_side(x)).head;
    return x < 0 ? -angle : angle;
}
