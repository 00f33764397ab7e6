#ifndef PCL2_RECIP_INLINE_H
#define PCL2_RECIP_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_recip(pcl2_real u)
{
    return u < PCL2_R(0.0) || u > PCL2_R(0.0) ? PCL2_R(1.0) / u : pcl2_bad();
}

#endif
