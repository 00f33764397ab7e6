/* errsq: squared error with a gap. */
#ifndef PCL2_ERRSQ_INLINE_H
#define PCL2_ERRSQ_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_errsq(pcl2_real e, pcl2_real span, pcl2_real gap, pcl2_real kgap)
{
    const pcl2_real size = e < PCL2_R(0.0) ? -e : e;
    return size <= gap ? kgap * e : e * (size / span);
}

#endif
