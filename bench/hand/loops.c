/* The loops of the benchmarks as one would write them: an array of structs and a loop over it. */
#include "loops.h"
#include "pcl2_math.h"

#define PERIOD PCL2_R(0.1)

static void lag_init(struct hand_lag *self, pcl2_real a, pcl2_real b)
{
    self->e = pcl2_math_exp(-(a * PERIOD));
    self->g = -(b / a) * pcl2_math_expm1(-(a * PERIOD));
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

static void pid_init(struct hand_pid *self, pcl2_real K, pcl2_real Ti)
{
    memset(self, 0, sizeof *self);
    self->kp = K;
    self->ki = K * (PERIOD / Ti);
    self->kt = PERIOD / Ti;
    self->b = PCL2_R(1.0);
    self->high = PCL2_R(100.0);
    self->automatic = 1;
}

static inline pcl2_real clamp(const struct hand_pid *self, pcl2_real u)
{
    return u > self->high ? self->high : u >= self->low ? u : self->low;
}

/* Back-calculation, a compensated integral, bumpless transfers, a dead sensor holds the output. */
static inline pcl2_real pid(struct hand_pid *self, pcl2_real y, pcl2_real w)
{
    const pcl2_real p = self->kp * (self->b * w - y);
    const pcl2_real d = self->ad * self->d + self->kd * (self->c * (w - self->w1) - (y - self->y1));
    const pcl2_real v = p + self->i + d;
    self->failed = pcl2_is_bad(v);
    if (self->failed) {
        self->started = 0;
        return self->u;
    }
    if (!self->automatic || !self->started) {
        self->u = clamp(self, self->um);
        self->i = self->u - p;
        self->carry = PCL2_R(0.0);
        self->d = PCL2_R(0.0);
        self->started = 1;
    } else {
        const pcl2_real u = clamp(self, v);
        const pcl2_real step = self->ki * (w - y) + self->kt * (u - v) + self->carry;
        const pcl2_real sum = self->i + step;
        self->carry = step - (sum - self->i);
        self->i = sum;
        self->d = d;
        self->u = u;
    }
    self->y1 = y;
    self->w1 = w;
    self->um = self->u;
    return self->u;
}

static inline void loop_step(struct hand_loop *self, pcl2_real w)
{
    const pcl2_real y = lag(&self->plant, self->u);
    const pcl2_real v = pid(&self->control, y, w);
    const pcl2_real forward = PCL2_R(0.1) * (w - y);
#ifndef HAND_COMPOSITE
    self->forward = forward;
#endif
    self->u = v + forward;
}

void hand_loops_init(struct hand_loops *self)
{
    static const pcl2_real a[10] = {
        PCL2_R(0.10), PCL2_R(0.11), PCL2_R(0.12), PCL2_R(0.13), PCL2_R(0.14),
        PCL2_R(0.15), PCL2_R(0.16), PCL2_R(0.17), PCL2_R(0.18), PCL2_R(0.19),
    };
    self->setpoint = PCL2_R(50.0);
    for (int i = 0; i < HAND_LOOPS; i++) {
        lag_init(&self->loop[i].plant, a[i % 10], PCL2_R(0.2));
        pid_init(&self->loop[i].control, PCL2_R(0.8), PCL2_R(20.0));
        self->loop[i].u = PCL2_R(0.0);
    }
}

void hand_loops_step(struct hand_loops *self)
{
    self->w = self->setpoint;
    for (int i = 0; i < HAND_LOOPS; i++) {
        loop_step(&self->loop[i], self->w);
    }
}
