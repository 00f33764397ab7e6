/* HAND_LOOPS control loops by hand: lag, error, lag, sum. HAND_COMPOSITE: weights are literals and the error is
 * nowhere to be seen, as in the composite of the generated program; otherwise every weight can be tuned and every
 * signal be watched, as in the straight list. */
#ifndef HAND_LOOPS_H
#define HAND_LOOPS_H
#include "pcl2.h"

struct hand_lag {
    pcl2_real e, g, y;
};

#ifdef HAND_COMPOSITE
struct hand_loop {
    struct hand_lag plant, memory;
    pcl2_real u;
};
#else
struct hand_sum {
    pcl2_real p1, p2, z;
};

struct hand_loop {
    struct hand_lag plant;
    struct hand_sum error;
    struct hand_lag memory;
    struct hand_sum control;
};
#endif

struct hand_loops {
    pcl2_real setpoint, w;
    struct hand_loop loop[HAND_LOOPS];
};

void hand_loops_init(struct hand_loops *self);
void hand_loops_step(struct hand_loops *self);

static inline pcl2_real hand_y(const struct hand_loops *self, int i)
{
    return self->loop[i].plant.y;
}

static inline pcl2_real hand_u(const struct hand_loops *self, int i)
{
#ifdef HAND_COMPOSITE
    return self->loop[i].u;
#else
    return self->loop[i].control.z;
#endif
}
#endif
