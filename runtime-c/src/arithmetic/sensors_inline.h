/* Temperature sensors in one expression. */
#ifndef PCL2_SENSORS_INLINE_H
#define PCL2_SENSORS_INLINE_H

#include "pcl2_math.h"

static inline pcl2_real pcl2_ntc(pcl2_real ohm, pcl2_real a, pcl2_real b, pcl2_real c)
{
    const pcl2_real logarithm = pcl2_math_log(ohm);
    const pcl2_real inverse = a + b * logarithm + c * logarithm * logarithm * logarithm;
    return inverse > 0 && !pcl2_is_bad(inverse) ? 1 / inverse - PCL2_R(273.15) : pcl2_bad();
}

#endif
