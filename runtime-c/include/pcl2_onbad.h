/* What a truth value made of a real is while the real is bad: the parameter onbad {zero, one, hold}. */
#ifndef PCL2_ONBAD_H
#define PCL2_ONBAD_H

#include "pcl2.h"

/* The value of onbad that holds; 0 and 1 are what they say. */
#define PCL2_ON_BAD_HOLD 2

/* 0, 1, or the value held. */
static inline int32_t pcl2_on_bad(int32_t onbad, int32_t held)
{
    return onbad == PCL2_ON_BAD_HOLD ? held : onbad;
}

#endif
