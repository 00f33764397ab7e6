/* The return wire of a link: what the block downstream hands back to the one that drives it, two reals.
 * The first is the value that is really followed, in the units of the driving output; the second a state. */
#ifndef PCL2_RETURN_H
#define PCL2_RETURN_H

#include "pcl2.h"

/* The states, as they stand in the second real. */
#define PCL2_FOLLOWING 0 /* the value is followed; so is an open return wire */
#define PCL2_LIMITED_HIGH 1 /* a larger value would not be followed */
#define PCL2_LIMITED_LOW 2 /* a smaller value would not be followed */
#define PCL2_WAITING 3 /* not following yet: come to the value first */

/* The state of a return wire; PCL2_FOLLOWING for whatever is no state, and for a value that is no number. */
static inline int32_t pcl2_return_state(const pcl2_real *back)
{
    if (pcl2_is_bad(back[0]) || !(back[1] >= PCL2_R(0.5) && back[1] < PCL2_R(3.5))) {
        return PCL2_FOLLOWING;
    }
    return back[1] < PCL2_R(1.5) ? PCL2_LIMITED_HIGH : back[1] < PCL2_R(2.5) ? PCL2_LIMITED_LOW : PCL2_WAITING;
}

/* Hands a value and a state back; bk is NULL where nobody listens. */
static inline void pcl2_hand_back(pcl2_real *bk, pcl2_real value, int32_t state)
{
    if (bk != NULL) {
        bk[0] = value;
        bk[1] = (pcl2_real)state;
    }
}

/* Hands the followed value of a block on that changes nothing on the way: own is its own state, that of back goes on
 * where it has none, and where back is limited its value is what is followed. */
static inline void pcl2_hand_on(pcl2_real *bk, pcl2_real value, int32_t own, const pcl2_real *back)
{
    const int32_t told = pcl2_return_state(back);
    pcl2_hand_back(bk, told == PCL2_FOLLOWING ? value : back[0], own == PCL2_FOLLOWING ? told : own);
}

/* The state as a block with a falling characteristic hands it back: a high limit downstream is a low one upstream. */
static inline int32_t pcl2_return_reversed(int32_t state)
{
    return state == PCL2_LIMITED_HIGH ? PCL2_LIMITED_LOW : state == PCL2_LIMITED_LOW ? PCL2_LIMITED_HIGH : state;
}

/* 1 when a value has come to the one that a waiting block asked for: equal but for what a characteristic and its
 * inverse lose: 1e-5 of the value, and what rounding leaves of 0 on a scale of some hundreds. */
static inline int32_t pcl2_has_come(pcl2_real value, pcl2_real asked)
{
    const pcl2_real distance = value < asked ? asked - value : value - asked;
    const pcl2_real size = asked < PCL2_R(0.0) ? -asked : asked;
    return distance <= PCL2_R(1e-5) * size + PCL2_R(1024.0) * PCL2_REAL_EPSILON;
}

/* How many scans a waiting block gives its driver to come: a master may run in a much slower section. */
#define PCL2_PATIENCE 1000

/* Whether a block waits in this scan instead of following value: now, or since then until value has come to the one that
 * it asked for, at most PCL2_PATIENCE scans. Where nobody listens (bk is NULL) there is nobody to wait for. */
static inline int32_t pcl2_awaits(int32_t *patience, int32_t now, const pcl2_real *bk, pcl2_real value, pcl2_real asked)
{
    if (bk == NULL) {
        return now;
    }
    if (now) {
        *patience = PCL2_PATIENCE;
    } else if (*patience > 0) {
        *patience = pcl2_has_come(value, asked) ? 0 : *patience - 1;
        now = *patience > 0;
    }
    return now;
}

#endif
