/* The angle of the point (x, y), -pi to pi; special values after C99 F.9.1.4. */
#include "pcl2_angle.h"

static pcl2_real pcl2_atan2_signed(pcl2_real size, pcl2_real sign)
{
    return (pcl2_bits_of(sign) >> (PCL2_REAL_BITS - 1)) != 0 ? -size : size;
}

/* The angle without its sign where y or x is infinite. */
static pcl2_real pcl2_atan2_infinite(pcl2_real y, pcl2_real x)
{
    if (!pcl2_is_bad(x)) {
        return pcl2_right_angle.head;
    }
    if (!pcl2_is_bad(y)) {
        return x > 0 ? PCL2_R(0.0) : 2 * pcl2_right_angle.head;
    }
    const struct pcl2_pair eighth = {pcl2_right_angle.head / 2, pcl2_right_angle.tail / 2};
    return x > 0 ? eighth.head : pcl2_angle_from(PCL2_R(2.0), eighth).head;
}

/* The angle without its sign, y and x finite: scaled so that the larger one is about 1. */
static pcl2_real pcl2_atan2_finite(pcl2_real y, pcl2_real x)
{
    const pcl2_real lift = pcl2_power_of_2(PCL2_FRACTION_BITS + 2);
    const pcl2_real tiny = pcl2_power_of_2(PCL2_FRACTION_BITS + 4 - PCL2_EXPONENT_BIAS);
    const int32_t lifted = y < tiny && x < tiny && x > -tiny;
    const pcl2_real wide = pcl2_math_fabs(lifted ? x * lift : x);
    const pcl2_real high = lifted ? y * lift : y;
    const int32_t above = pcl2_exponent(high) - pcl2_exponent(wide);
    if (above > PCL2_FRACTION_BITS + 4) {
        return pcl2_right_angle.head;
    }
    if (above < -PCL2_FRACTION_BITS - 4) {
        return x > 0 ? y / x : 2 * pcl2_right_angle.head;
    }
    const pcl2_real scale = pcl2_power_of_2(-pcl2_exponent(high > wide ? high : wide) / 2);
    const struct pcl2_pair rise = {high * scale * scale, PCL2_R(0.0)};
    const struct pcl2_pair run = {wide * scale * scale, PCL2_R(0.0)};
    const struct pcl2_pair angle = pcl2_angle(rise, run);
    return x < 0 ? pcl2_angle_from(PCL2_R(2.0), angle).head : angle.head;
}

pcl2_real pcl2_math_atan2(pcl2_real y, pcl2_real x)
{
    if (x != x || y != y) {
        return x + y;
    }
    const pcl2_real size = pcl2_math_fabs(y);
    if (pcl2_is_bad(x) || pcl2_is_bad(y)) {
        return pcl2_atan2_signed(pcl2_atan2_infinite(size, x), y);
    }
    if (y == 0) {
        return pcl2_atan2_signed(pcl2_atan2_signed(PCL2_R(1.0), x) > 0 ? PCL2_R(0.0) : 2 * pcl2_right_angle.head, y);
    }
    return pcl2_atan2_signed(x == 0 ? pcl2_right_angle.head : pcl2_atan2_finite(size, x), y);
}
