/* Inverse tangent */
#include "pcl2_angle.h"

pcl2_real pcl2_math_atan(pcl2_real x)
{
    const pcl2_real size = pcl2_math_fabs(x);
    if (pcl2_exponent(x) < -PCL2_FRACTION_BITS / 2 - 2 || x != x) {
        return x;
    }
    const struct pcl2_pair y = {size, PCL2_R(0.0)};
    const struct pcl2_pair one = {PCL2_R(1.0), PCL2_R(0.0)};
    const pcl2_real angle = size < pcl2_power_of_2(55) ? pcl2_angle(y, one).head : pcl2_right_angle.head;
    return x < 0 ? -angle : angle;
}
