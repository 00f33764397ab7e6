/* What controllers share: modes, the start of a cascade, anti-windup by the return wire, a compensated integral. */
#ifndef PCL2_CONTROL_H
#define PCL2_CONTROL_H

#include "pcl2.h"
#include "pcl2_return.h"

/* mode, which the operator writes, and actual, which is in force. */
#define PCL2_MAN 0
#define PCL2_AUTO 1
#define PCL2_CAS 2
#define PCL2_TRACK 3
#define PCL2_INIT 4
#define PCL2_FAILED 5

/* phase of a controller: nothing known yet, in control, to take up control from where u is. */
#define PCL2_FRESH 0
#define PCL2_RUNNING 1
#define PCL2_RETURNING 2

/* wait counts the scans that a master was waited for; this when it is followed. */
#define PCL2_LINKED (-1)

/* u within lo..hi; lo for what is no number. */
static inline pcl2_real pcl2_limited(pcl2_real u, pcl2_real lo, pcl2_real hi)
{
    return u > hi ? hi : u >= lo ? u : lo;
}

/* 1 when the master's value is followed: it has come to the one in force, or was waited for too long, or nobody listens
 * (bk is NULL). */
static inline int32_t pcl2_follows(int32_t *wait, const pcl2_real *bk, pcl2_real master, pcl2_real own)
{
    if (bk != NULL && *wait != PCL2_LINKED && !pcl2_has_come(master, own) && *wait < PCL2_PATIENCE) {
        ++*wait;
        return 0;
    }
    *wait = PCL2_LINKED;
    return 1;
}

/* What is followed of u when the block downstream is limited at value; last is the u that it answers. Where it follows
 * last, a step of the integral that goes further into the limit becomes 0: it would go on for ever. Where something else
 * decides (value is not last), the step stays, and back-calculation bounds it: u comes to rest beside value, by P. */
static inline pcl2_real pcl2_held_back(int32_t state, pcl2_real value, pcl2_real last, pcl2_real *step, pcl2_real u)
{
    if (state == PCL2_LIMITED_HIGH) {
        *step = *step > PCL2_R(0.0) && (value > last || pcl2_has_come(last, value)) ? PCL2_R(0.0) : *step;
        return value < u ? value : u;
    }
    *step = *step < PCL2_R(0.0) && (value < last || pcl2_has_come(last, value)) ? PCL2_R(0.0) : *step;
    return value > u ? value : u;
}

/* sum += step with the digits that a plain sum loses kept in carry: a float integral moves by steps far below its last
 * digit (Neumaier). A sum that would leave the reals stays. */
static inline void pcl2_accumulate(pcl2_real *sum, pcl2_real *carry, pcl2_real step)
{
    const pcl2_real with_carry = step + *carry;
    const pcl2_real next = *sum + with_carry;
    if (!pcl2_is_bad(next)) {
        *carry = with_carry - (next - *sum);
        *sum = next;
    }
}

/* Scans in a time, rounded up. */
static inline int32_t pcl2_scans(pcl2_real seconds, int64_t T)
{
    return pcl2_saturate_i((pcl2_nanoseconds(seconds) + T - 1) / T);
}

/* What the master hears: the set-point in force, and whether a larger or smaller one would be followed. A controller
 * whose u falls when the set-point rises (direct) is limited low where u is limited high. */
static inline void pcl2_answer_master(pcl2_real *bk, int32_t actual, pcl2_real ws, int32_t state, int32_t direct,
                                      int32_t limit)
{
    const int32_t reason = state == PCL2_FOLLOWING ? limit : state;
    if (actual == PCL2_CAS) {
        pcl2_hand_back(bk, ws, direct ? pcl2_return_reversed(reason) : reason);
    } else {
        pcl2_hand_back(bk, pcl2_is_bad(ws) ? PCL2_R(0.0) : ws, PCL2_WAITING);
    }
}

/* The limit that u stands at. */
static inline int32_t pcl2_limit_state(pcl2_real u, pcl2_real lo, pcl2_real hi)
{
    return u >= hi ? PCL2_LIMITED_HIGH : u <= lo ? PCL2_LIMITED_LOW : PCL2_FOLLOWING;
}

#endif
