/* The loops of the benchmarks as one would write them: an array of structs and a loop over it. */
#include "loops.h"
#include "pcl2_math.h"

static void lag_init(struct hand_lag *self, pcl2_real a, pcl2_real b)
{
    self->e = pcl2_math_exp(-(a * PCL2_R(0.1)));
    self->g = -(b / a) * pcl2_math_expm1(-(a * PCL2_R(0.1)));
    self->y = PCL2_R(0.0);
}

/* The output stays in a register for whoever comes next. */
static inline pcl2_real lag(struct hand_lag *self, pcl2_real u)
{
    pcl2_real y = self->e * self->y + self->g * u;
    if (pcl2_is_bad(y)) {
        y = self->y;
    }
    self->y = y;
    return y;
}

#ifdef HAND_COMPOSITE

static void weights_init(struct hand_loop *self)
{
    self->u = PCL2_R(0.0);
}

static inline void loop_step(struct hand_loop *self, pcl2_real w)
{
    const pcl2_real e = w - lag(&self->plant, self->u);
    self->u = PCL2_R(0.8) * e + lag(&self->memory, e);
}

#else

static void weights_init(struct hand_loop *self)
{
    self->error = (struct hand_sum){PCL2_R(1.0), PCL2_R(-1.0), PCL2_R(0.0)};
    self->control = (struct hand_sum){PCL2_R(0.8), PCL2_R(1.0), PCL2_R(0.0)};
}

static inline void loop_step(struct hand_loop *self, pcl2_real w)
{
    const pcl2_real y = lag(&self->plant, self->control.z);
    const pcl2_real e = self->error.p1 * w + self->error.p2 * y;
    const pcl2_real i = lag(&self->memory, e);
    self->error.z = e;
    self->control.z = self->control.p1 * e + self->control.p2 * i;
}

#endif

void hand_loops_init(struct hand_loops *self)
{
    static const pcl2_real a[10] = {
        PCL2_R(0.10), PCL2_R(0.11), PCL2_R(0.12), PCL2_R(0.13), PCL2_R(0.14),
        PCL2_R(0.15), PCL2_R(0.16), PCL2_R(0.17), PCL2_R(0.18), PCL2_R(0.19),
    };
    self->setpoint = PCL2_R(50.0);
    for (int i = 0; i < HAND_LOOPS; i++) {
        lag_init(&self->loop[i].plant, a[i % 10], PCL2_R(0.2));
        lag_init(&self->loop[i].memory, PCL2_R(0.5), PCL2_R(0.05));
        weights_init(&self->loop[i]);
    }
}

void hand_loops_step(struct hand_loops *self)
{
    self->w = self->setpoint;
    for (int i = 0; i < HAND_LOOPS; i++) {
        loop_step(&self->loop[i], self->w);
    }
}
