/* The player of nets: what a scan of a net is. It walks a table that the compiler made of the net. */
#ifndef PCL2_NET_H
#define PCL2_NET_H

#include "pcl2_net_step.h"

/* The words at the start of a table: counts, and where records begin. */
enum {
    PCL2_NET_N_BOXES,
    PCL2_NET_N_GATES,
    PCL2_NET_N_WORDS,
    PCL2_NET_BOXES,    /* by box: where its record begins */
    PCL2_NET_GATES,    /* by gate: where its record begins */
    PCL2_NET_SCRIPTS,  /* by statement: where its record begins */
    PCL2_NET_CLASSES,  /* by class: where its record begins */
    PCL2_NET_WORDS,    /* by word: bit 0 a real, bit 1 it has a value of its own while the net is stopped */
    PCL2_NET_LEVELS,   /* words that boxes drive */
    PCL2_NET_ACTIVES,  /* words that tell the marked box */
    PCL2_NET_PARTS,    /* nets inside */
    PCL2_NET_OPERATED, /* modes, commands, and who is told of permissives; 0: none of them */
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

/* The token in hand of a box: k + 1 that of place k, which a gate chose or a box made; PCL2_NET_LENT - k that of place k,
 * lent to a statement. */
#define PCL2_NET_NOT_HELD 0
#define PCL2_NET_ON_ITS_WAY (-1)
#define PCL2_NET_LENT (-2)

/* A word of a table: none is negative. */
#ifndef PCL2_NET_WORD
#define PCL2_NET_WORD int32_t
#endif
typedef PCL2_NET_WORD pcl2_net_word;

/* One net, or one instance of a net inside another, and what it keeps. A net and those inside it stand in an array, each
 * before those inside it. */
struct pcl2_net {
    const pcl2_net_word *table;
    char *base;                    /* what the places of words and attributes count from */
    int32_t *box;                  /* by box: its tokens; in the gate phase those of the phase's start */
    int32_t *taken;                /* by box: tokens taken in this phase; else 0 */
    int32_t *filled;               /* by box: tokens put in this phase; else 0 */
    int32_t *used;                 /* by box: room used in this phase; else 0 */
    int32_t *phase;                /* by box: what it has done since the token came, and four times the gate that put it */
    int32_t *by;                   /* by box: the gate that put a token in this phase */
    int32_t *hold;                 /* by box: the token in hand, see PCL2_NET_NOT_HELD */
    int64_t *since;                /* by box: when its time began, nanoseconds */
    int32_t *ints;                 /* attributes of all tokens that are ints, place by place */
    pcl2_real *reals;              /* those that are reals */
    const size_t *words;           /* by word: where it is */
    const size_t *hands;           /* by attribute of each box: where the token in hand is */
    int32_t *wrote;                /* by word: 0 as before the scan, the gate that wrote it, from 1, -1 counted on */
    int32_t *active;               /* by ACTIVE line: what was marked in the last scan */
    int64_t *active_since;         /* by ACTIVE line: since when, nanoseconds */
    struct pcl2_net *outer;        /* the net around it, or NULL */
    int32_t inputs;                /* the statement of the net around it that takes the inputs in */
    int64_t now;                   /* the time of the scan, nanoseconds; it stands while the net is stopped */
    int32_t mode;                  /* of the scan; a step that was commanded is automatic */
    int32_t blocked;               /* the first permissive term that held a gate back in this scan, from 1; 0: none */
    int32_t switched;              /* its words changed places with those of a stopped net in this scan */
    int32_t *status;               /* the first fault of the scan */
    int32_t *lost;                 /* tokens lost since the start; stops at 2^31 - 1 */
    int32_t *conflicts;            /* writes that lost since the start; stops at 2^31 - 1 */
    int64_t *stood;                /* of a net with modes: how long it was stopped, nanoseconds; else NULL */
    int32_t *halted;               /* of a net with modes: it was stopped in the last scan; else NULL */
    int32_t *forced;               /* of a net with modes: gates and tokens forced since the start; stops at 2^31 - 1 */
    int32_t *refused;              /* of a net with modes: commands refused since the start; stops at 2^31 - 1 */
    int32_t (*act)(const struct pcl2_net *net, int32_t statement); /* runs a statement; of a condition its truth */
    int64_t (*duration)(const struct pcl2_net *net, int32_t statement); /* the value of a statement, nanoseconds */
    void *host;                    /* of those who run statements */
};

/* A time in seconds as nanoseconds, for those who run statements from outside. */
int64_t pcl2_net_nanoseconds(const pcl2_real *seconds);

/* One scan of a net and of the n - 1 nets inside it. The inputs of the first are there already. */
void pcl2_net_scan(struct pcl2_net *nets, int32_t n, int64_t *now, int64_t period);

#endif
