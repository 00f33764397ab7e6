/* Constants that the operator sets. */
#ifndef PCL2_MSC_INLINE_H
#define PCL2_MSC_INLINE_H

#include "pcl2.h"

static inline pcl2_real pcl2_msc(pcl2_real value)
{
    return value;
}

static inline int32_t pcl2_msi(int32_t value)
{
    return value;
}

static inline int32_t pcl2_mss(int32_t value)
{
    return value;
}

#endif
