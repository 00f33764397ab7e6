/* Truth values of two integers, for expressions. */
#ifndef PCL2_TRUTH_INLINE_H
#define PCL2_TRUTH_INLINE_H

#include "pcl2.h"

static inline int32_t pcl2_and2(int32_t a, int32_t b)
{
    return a != 0 && b != 0;
}

static inline int32_t pcl2_or2(int32_t a, int32_t b)
{
    return a != 0 || b != 0;
}

static inline int32_t pcl2_xor2(int32_t a, int32_t b)
{
    return (a != 0) != (b != 0);
}

#endif
