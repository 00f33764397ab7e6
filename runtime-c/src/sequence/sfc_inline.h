/* Transitions of a sequence. */
#ifndef PCL2_SFC_INLINE_H
#define PCL2_SFC_INLINE_H

#include "pcl2.h"

static inline void pcl2_trans(int32_t prev, int32_t cond, int32_t *fire, int32_t *rest)
{
    *fire = (prev != 0) & (cond != 0);
    *rest = (prev != 0) & (cond == 0);
}

#endif
