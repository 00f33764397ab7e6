/* Inverse cosine: the angle beside x in the triangle with hypotenuse 1. */
#include "pcl2_angle.h"

pcl2_real pcl2_math_acos(pcl2_real x)
{
    const pcl2_real size = pcl2_math_fabs(x);
    if (!(size <= 1)) {
        return size > 1 ? pcl2_bad() : x;
    }
    if (pcl2_exponent(x) < -PCL2_FRACTION_BITS - 2) {
        return pcl2_right_angle.head;
    }
    const struct pcl2_pair beside = {size, PCL2_R(0.0)};
    const struct pcl2_pair angle = pcl2_angle(pcl2_angle_side(x), beside);
    return x < 0 ? pcl2_angle_from(PCL2_R(2.0), angle).head : angle.head;
}
