/* HAND_LOOPS control loops by hand: a lag as plant, a PID controller, the feed-forward, the valve's signal.
 * HAND_COMPOSITE: what nobody outside looks at stays in registers, as in the composite of the generated program. */
#ifndef HAND_LOOPS_H
#define HAND_LOOPS_H
#include "pcl2.h"

struct hand_lag {
    pcl2_real e, g, y;
};

/* Mode and manual output are the operator's. */
struct hand_pid {
    pcl2_real kp, ki, kd, ad, kt, b, c, low, high, ufail;
    pcl2_real i, carry, d, y1, w1, u, um;
    int32_t automatic, started, failed;
};

struct hand_loop {
    struct hand_lag plant;
    struct hand_pid control;
#ifndef HAND_COMPOSITE
    pcl2_real forward;
#endif
    pcl2_real u;
};

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
    return self->loop[i].u;
}
#endif
