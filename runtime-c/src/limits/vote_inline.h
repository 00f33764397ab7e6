/* Whether signals are good. */
#ifndef PCL2_VOTE_INLINE_H
#define PCL2_VOTE_INLINE_H

#include "pcl2.h"

static inline int32_t pcl2_qtest(const pcl2_real *x, int32_t n)
{
    int32_t q = 0;
    PCL2_UNROLL
    for (int32_t i = 0; i < n; i++) {
        q |= pcl2_is_bad(x[i]);
    }
    return q;
}

#endif
