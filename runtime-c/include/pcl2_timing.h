/* Times that blocks count in whole periods: nanoseconds, from 0 to 2^62. */
#ifndef PCL2_TIMING_H
#define PCL2_TIMING_H

#include "pcl2.h"

/* A set time. Where the reals cannot tell it from a whole number of periods T it is that number, so that a timer
 * in float ends in the same scan as one in double. */
static inline int64_t pcl2_set_time(pcl2_real seconds, int64_t T)
{
    const int64_t time = pcl2_nanoseconds(seconds);
    const int64_t slack = time >> (PCL2_FRACTION_BITS - 1);
    const int64_t over = time % T;
    return over <= slack ? time - over : T - over <= slack ? time + (T - over) : time;
}

/* A time one period T later; it stops at the limit. */
static inline int64_t pcl2_elapse(int64_t time, int64_t T, int64_t limit)
{
    return limit - time > T ? time + T : limit;
}

#endif
