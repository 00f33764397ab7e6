/* pwm: time-proportional output.
 *
 * passed:  time in this cycle
 * given:   time on in this cycle
 * wanted:  time on asked of this cycle, what was carried included
 * carried: what the cycles before gave too little, negative for too much */
#include "pcl2_pwm.h"

enum { PWM_SIGNAL = 1 };

PCL2_KERNEL void pcl2_pwm_init(struct pcl2_pwm *self, pcl2_real tper, pcl2_real tmin, pcl2_real lo, pcl2_real hi)
{
    (void)self;
    (void)tper;
    (void)tmin;
    (void)lo;
    (void)hi;
}

static int64_t pwm_within(int64_t x, int64_t low, int64_t high)
{
    return x < low ? low : x > high ? high : x;
}

PCL2_KERNEL void pcl2_pwm_tune(struct pcl2_pwm *self, pcl2_real tper, pcl2_real tmin, pcl2_real lo, pcl2_real hi,
                               int64_t T)
{
    const int64_t cycle = pwm_within(pcl2_nanoseconds(tper), T, INT64_C(1000000000000000000));
    self->low = lo;
    self->span = hi - lo;
    self->seconds = tper;
    self->cycle = cycle;
    self->least = pcl2_nanoseconds(tmin);
    self->scan = T;
}

/* A cycle begins: what the last one gave too little is carried. */
static void pwm_begin(struct pcl2_pwm *self)
{
    const pcl2_real part = (self->duty - self->low) / self->span;
    const int64_t asked = part >= PCL2_R(1.0) ? self->cycle : pcl2_nanoseconds(part * self->seconds);
    self->passed = self->passed < 2 * self->cycle && self->started ? self->passed - self->cycle : 0;
    self->carried = self->started ? pwm_within(self->wanted - self->given, -self->cycle, self->cycle) : 0;
    self->wanted = (asked < self->cycle ? asked : self->cycle) + self->carried;
    self->given = 0;
    self->started = 1;
}

/* The time on that the cycle aims at: none or all of it where the rest would be too short. */
static int64_t pwm_aim(const struct pcl2_pwm *self)
{
    if (self->wanted < self->least) {
        return 0;
    }
    return self->cycle - self->wanted < self->least ? self->cycle : self->wanted;
}

PCL2_KERNEL void pcl2_pwm(struct pcl2_pwm *self, pcl2_real u)
{
    const int32_t bad = pcl2_is_bad(u);
    self->status = bad ? PWM_SIGNAL : 0;
    if (!bad || !self->started) {
        self->duty = bad ? self->low : u;
    }
    if (!self->started || self->passed >= self->cycle) {
        pwm_begin(self);
    }
    const int64_t aim = pwm_aim(self);
    self->q = aim >= self->cycle || self->given + self->scan / 2 < aim;
    self->given += self->q ? self->scan : 0;
    self->passed += self->scan;
}
