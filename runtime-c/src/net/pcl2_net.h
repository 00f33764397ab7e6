/* The player of nets: what a scan of a net is. It walks a table that the compiler made of the net.
 *
 * A scan of a net and of the nets in it: pcl2_net_boxes for each, the outer ones first; pcl2_net_gates for each;
 * pcl2_net_commit for each; pcl2_net_levels for each, the inner ones first. */
#ifndef PCL2_NET_H
#define PCL2_NET_H

#include "pcl2.h"

/* Faults of a net, the first of a scan. */
#define PCL2_NET_LOST 1     /* a token was to be made while one was waiting for room: it is lost */
#define PCL2_NET_CONFLICT 2 /* two different values were written in one scan: the gate of higher priority wins */
#define PCL2_NET_TIMEOUT 3  /* a process box was not complete within its supervision time */

/* The words at the start of a table: counts, and where records begin. */
enum {
    PCL2_NET_N_BOXES,
    PCL2_NET_N_GATES,
    PCL2_NET_N_WORDS,
    PCL2_NET_BOXES,   /* by box: where its record begins */
    PCL2_NET_GATES,   /* by gate: where its record begins */
    PCL2_NET_SCRIPTS, /* by statement: where its record begins */
    PCL2_NET_CLASSES, /* by class: where its record begins */
    PCL2_NET_WORDS,   /* by word: 1 a real, 0 an int */
    PCL2_NET_LEVELS,  /* words that boxes drive */
    PCL2_NET_ACTIVES, /* words that tell the marked box */
    PCL2_NET_PARTS,   /* nets inside */
    PCL2_NET_HEAD
};

/* Kinds of boxes. */
enum {
    PCL2_NET_STATE,
    PCL2_NET_TIME,
    PCL2_NET_COUNT,
    PCL2_NET_ACTION,
    PCL2_NET_PROCESS,
    PCL2_NET_GENERATION,
    PCL2_NET_MACRO
};

/* A word of a table. */
typedef int32_t pcl2_net_word;

/* One net, or one instance of a net inside another, and what it keeps. */
struct pcl2_net {
    const pcl2_net_word *table;
    int32_t *box;                  /* by box: its tokens; in the gate phase those of the phase's start */
    int32_t *taken;                /* by box: tokens taken in this phase; else 0 */
    int32_t *filled;               /* by box: tokens put in this phase; else 0 */
    int32_t *used;                 /* by box: room used in this phase; else 0 */
    int32_t *phase;                /* by box: what it has done since the token came, and four times the gate that put it */
    int32_t *by;                   /* by box: the gate that put a token in this phase */
    int32_t *hold;                 /* by box: 0 no token in hand, k + 1 that of place k, -1 one on its way */
    int64_t *since;                /* by box: when its time began, nanoseconds */
    int32_t *ints;                 /* attributes of all tokens that are ints, place by place */
    pcl2_real *reals;              /* those that are reals */
    void *const *words;            /* by word: where it is */
    void *const *hands;            /* by attribute of each box: the token in hand */
    int32_t *wrote;                /* by word: 0 nobody wrote it in this scan, else the gate that did, from 1 */
    int32_t *active;               /* by ACTIVE line: what was marked in the last scan */
    int64_t *active_since;         /* by ACTIVE line: since when, nanoseconds */
    struct pcl2_net *const *parts; /* the nets inside */
    int64_t now;                   /* the time of the scan, nanoseconds */
    int32_t *status;               /* the first fault of the scan */
    int32_t *lost;                 /* tokens lost since the start; stops at 2^31 - 1 */
    int32_t *conflicts;            /* writes that lost since the start; stops at 2^31 - 1 */
    int32_t (*act)(void *host, int32_t script);     /* runs a statement; of a condition its truth */
    int64_t (*duration)(void *host, int32_t script); /* the value of a statement, seconds, as nanoseconds */
    void *host;
};

/* A time in seconds as nanoseconds, for those who run statements from outside. */
int64_t pcl2_net_nanoseconds(const pcl2_real *seconds);

/* The box phase. */
void pcl2_net_boxes(struct pcl2_net *net);

/* The gate phase: a greedy step on the marking at its start. */
void pcl2_net_gates(struct pcl2_net *net);

/* The end of the gate phase: tokens that were put are there. */
void pcl2_net_commit(struct pcl2_net *net);

/* Outputs that boxes drive. */
void pcl2_net_levels(struct pcl2_net *net);

#endif
