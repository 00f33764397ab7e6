/* Static characteristics with zones. */
#ifndef PCL2_ZONES_INLINE_H
#define PCL2_ZONES_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_dzone(pcl2_real x, pcl2_real w, pcl2_real c, int32_t mode)
{
    const pcl2_real distance = x - c;
    const pcl2_real less = mode == 0 ? w : PCL2_R(0.0);
    if (distance > w) {
        return distance - less;
    }
    if (distance < -w) {
        return distance + less;
    }
    return pcl2_is_bad(distance) ? distance : PCL2_R(0.0);
}

static inline pcl2_real pcl2_quant(pcl2_real x, pcl2_real q)
{
    const pcl2_real steps = q > PCL2_R(0.0) ? (x < PCL2_R(0.0) ? -x : x) / q : PCL2_R(0.0);
    /* From there on every real is whole; a bad x and a quotient beyond the reals end here too. */
    if (!(q > PCL2_R(0.0) && steps < PCL2_R(1.0) / PCL2_REAL_EPSILON)) {
        return x;
    }
    const pcl2_real y = (pcl2_real)(int64_t)(steps + PCL2_R(0.5)) * q;
    return x < PCL2_R(0.0) ? -y : y;
}

#endif
