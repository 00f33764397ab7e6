/* Flow measurements. */
#ifndef PCL2_FLOW_INLINE_H
#define PCL2_FLOW_INLINE_H

#include "pcl2_math.h"

static inline pcl2_real pcl2_dpflow(pcl2_real dp, pcl2_real k, pcl2_real lcut)
{
    return dp < lcut && !pcl2_is_bad(dp) ? PCL2_R(0.0) : k * pcl2_math_sqrt(dp);
}

static inline pcl2_real pcl2_ptcomp(
    pcl2_real q, pcl2_real p, pcl2_real t, pcl2_real p0, pcl2_real t0, int32_t mode)
{
    const pcl2_real density = (p / p0) * (t0 / t);
    if (!(p > 0 && t > 0) || pcl2_is_bad(p) || pcl2_is_bad(t)) {
        return pcl2_bad();
    }
    return mode == 2 ? q * density : mode == 1 ? q / pcl2_math_sqrt(density) : q * pcl2_math_sqrt(density);
}

#endif
