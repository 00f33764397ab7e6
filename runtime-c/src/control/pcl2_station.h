/* What stations share: limits, rates, shedding. */
#ifndef PCL2_STATION_H
#define PCL2_STATION_H

#include "pcl2_control.h"

/* x within low..high and, where that is good, else what was. */
static inline pcl2_real pcl2_within_or(pcl2_real x, pcl2_real low, pcl2_real high, pcl2_real was)
{
    return pcl2_is_bad(x) ? was : pcl2_limited(x, low, high);
}

/* The state of a block that stopped at y on its way to x. */
static inline int32_t pcl2_stopped(pcl2_real x, pcl2_real y)
{
    return x > y ? PCL2_LIMITED_HIGH : x < y ? PCL2_LIMITED_LOW : PCL2_FOLLOWING;
}

/* One scan's way from y to x, at most up or down. */
static inline pcl2_real pcl2_approach(pcl2_real y, pcl2_real x, pcl2_real up, pcl2_real down)
{
    const pcl2_real way = x - y;
    return way > up ? y + up : -way > down ? y - down : x;
}

/* A rate per second as a way per scan; 0 is no limit. */
static inline pcl2_real pcl2_way(pcl2_real rate, int64_t T)
{
    return rate > PCL2_R(0.0) ? rate * pcl2_seconds(T) : PCL2_REAL_MAX;
}

/* Counts the scans with a bad input: 1 when the time given to it is over. */
static inline int32_t pcl2_sheds(int32_t *blind, int32_t scans)
{
    if (*blind >= scans) {
        return 1;
    }
    *blind += 1;
    return 0;
}

#endif
