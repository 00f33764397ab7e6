/* What the code of a net calls: sets of boxes and gates, and writes to outputs. */
#ifndef PCL2_NET_STEP_H
#define PCL2_NET_STEP_H

#include "pcl2.h"

/* Faults of a net, the first of a scan. */
#define PCL2_NET_LOST 1     /* a token was to be made while one was waiting for room: it is lost */
#define PCL2_NET_CONFLICT 2 /* two different values were written in one scan: the gate of higher priority wins */
#define PCL2_NET_TIMEOUT 3  /* a process box was not complete within its supervision time */
#define PCL2_NET_FORCED 4   /* an operator forced a gate or a token */
#define PCL2_NET_REFUSED 5  /* a command of an operator was refused */

/* What a box has done since its token came. Of a generating box: bit 0 its condition, bit 1 an edge that waits. */
#define PCL2_NET_NEW 0
#define PCL2_NET_DONE 1 /* of a time or an action box: excited */
#define PCL2_NET_RUNNING 1
#define PCL2_NET_READY 2

/* Modes of a net: the values of its input. */
enum {
    PCL2_NET_AUTOMATIC,
    PCL2_NET_STEP,
    PCL2_NET_MANUAL,
    PCL2_NET_STOPPED
};

/* A time in whole seconds as nanoseconds; 0 for a negative one. */
static inline int64_t pcl2_net_seconds(int32_t seconds)
{
    return seconds > 0 ? seconds * INT64_C(1000000000) : 0;
}

/* A time in seconds as nanoseconds; a bad one never ends. */
static inline int64_t pcl2_net_time(pcl2_real seconds)
{
    return pcl2_is_bad(seconds) ? INT64_MAX : pcl2_nanoseconds(seconds);
}

/* Whether a time is over, nanoseconds. What the reals cannot tell from it is over too, so that a box in float is excited
 * in the same scan as one in double. */
static inline int32_t pcl2_net_over(int64_t passed, int64_t time)
{
    return passed >= time - (time >> (PCL2_FRACTION_BITS - 1));
}

/* The place of the lowest bit of a set that is not empty. */
static inline int32_t pcl2_net_lowest(uint32_t set)
{
#if defined(__GNUC__) && !defined(__TINYC__)
    return __builtin_ctz(set);
#else
    static const int8_t places[32] = {0,  1,  28, 2,  29, 14, 24, 3, 30, 22, 20, 15, 25, 17, 4,  8,
                                      31, 27, 13, 23, 21, 19, 16, 7, 26, 12, 18, 6,  11, 5,  10, 9};
    return places[((set & (0 - set)) * UINT32_C(0x077CB531)) >> 27];
#endif
}

static inline void pcl2_net_add(uint32_t *sets, int32_t member)
{
    sets[member >> 5] |= UINT32_C(1) << (member & 31);
}

static inline void pcl2_net_remove(uint32_t *sets, int32_t member)
{
    sets[member >> 5] &= ~(UINT32_C(1) << (member & 31));
}

static inline int32_t pcl2_net_in(const uint32_t *sets, int32_t member)
{
    return (int32_t)(sets[member >> 5] >> (member & 31) & 1);
}

/* The value by which tokens are ordered, the least first; a bad one goes last. */
static inline pcl2_real pcl2_net_key(pcl2_real value)
{
    return pcl2_is_bad(value) ? PCL2_REAL_MAX : value;
}

/* Closes the gap that a token leaves among n. */
static inline void pcl2_net_close_gap(void *tokens, size_t size, int32_t place, int32_t n)
{
    char *gap = (char *)tokens + size * (size_t)place;
    memmove(gap, gap + size, size * (size_t)(n - place - 1));
}

/* Counts up; stops at 2^31 - 1. */
static inline void pcl2_net_count(int32_t *counter)
{
    if (*counter != INT32_MAX) {
        ++*counter;
    }
}

/* A fault: the first of a scan stays. */
static inline void pcl2_net_fault(int32_t *status, int32_t fault)
{
    if (*status == 0) {
        *status = fault;
    }
}

/* What a command says; it is cleared, since it is obeyed or refused. */
static inline int32_t pcl2_net_command(int32_t *command)
{
    const int32_t says = *command;
    *command = 0;
    return says;
}

/* Whether two reals differ in a bit. */
static inline int32_t pcl2_net_differ(pcl2_real a, pcl2_real b)
{
    return memcmp(&a, &b, sizeof a) != 0;
}

/* Not 0 where ints that stand side by side differ; the C compiler makes vectors of them. */
static inline int32_t pcl2_net_differ_ints(const void *kept, const void *given, int32_t n)
{
    const int32_t *const a = kept;
    const int32_t *const b = given;
    int32_t differ = 0;
    PCL2_UNROLL
    for (int32_t i = 0; i < n; i++) {
        differ |= a[i] ^ b[i];
    }
    return differ;
}

/* Who wrote outputs of a net in a scan: 0 nobody, a gate from 1, -1 somebody who counted on. */
struct pcl2_net_writes {
    int32_t *wrote;
    int32_t *status;
    int32_t *conflicts;
};

/* A gate wrote an output. Returns whether the value before stays: of two different ones that of the gate with the
 * higher priority, which is the lower number. */
static inline int32_t pcl2_net_yields(struct pcl2_net_writes *writes, int32_t gate, int32_t differs)
{
    int32_t yields = 0;
    if (*writes->wrote > 0 && differs) {
        pcl2_net_fault(writes->status, PCL2_NET_CONFLICT);
        pcl2_net_count(writes->conflicts);
        yields = gate + 1 >= *writes->wrote;
    }
    if (!yields && (*writes->wrote <= 0 || gate + 1 < *writes->wrote)) {
        *writes->wrote = gate + 1;
    }
    return yields;
}

static inline void pcl2_net_wrote_int(struct pcl2_net_writes writes, int32_t gate, int32_t *output, int32_t before)
{
    if (pcl2_net_yields(&writes, gate, *output != before)) {
        *output = before;
    }
}

static inline void pcl2_net_wrote_real(struct pcl2_net_writes writes, int32_t gate, pcl2_real *output, pcl2_real before)
{
    if (pcl2_net_yields(&writes, gate, pcl2_net_differ(*output, before))) {
        *output = before;
    }
}

/* An output was counted on: that is in no conflict. */
static inline void pcl2_net_counted(int32_t *wrote)
{
    if (*wrote == 0) {
        *wrote = -1;
    }
}

#endif
