/* The operators of expressions that compare: 1 where it holds, else 0. */
#ifndef PCL2_COMPARISONS_INLINE_H
#define PCL2_COMPARISONS_INLINE_H

#include "pcl2.h"

static inline int32_t pcl2_isgt(pcl2_real a, pcl2_real b)
{
    return a > b;
}

static inline int32_t pcl2_isge(pcl2_real a, pcl2_real b)
{
    return a >= b;
}

static inline int32_t pcl2_islt(pcl2_real a, pcl2_real b)
{
    return a < b;
}

static inline int32_t pcl2_isle(pcl2_real a, pcl2_real b)
{
    return a <= b;
}

static inline int32_t pcl2_iseq(pcl2_real a, pcl2_real b)
{
    return a >= b && a <= b;
}

/* Not `a != b`, which holds where one is not a number. */
static inline int32_t pcl2_isne(pcl2_real a, pcl2_real b)
{
    return a < b || a > b;
}

static inline int32_t pcl2_gti(int32_t a, int32_t b)
{
    return a > b;
}

static inline int32_t pcl2_gei(int32_t a, int32_t b)
{
    return a >= b;
}

static inline int32_t pcl2_lti(int32_t a, int32_t b)
{
    return a < b;
}

static inline int32_t pcl2_lei(int32_t a, int32_t b)
{
    return a <= b;
}

static inline int32_t pcl2_eqi(int32_t a, int32_t b)
{
    return a == b;
}

static inline int32_t pcl2_nei(int32_t a, int32_t b)
{
    return a != b;
}

#endif
