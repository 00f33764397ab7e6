/* Timers (IEC 61131-3, TON, TOF and TP), running time, blinker. Times are nanoseconds, counted in whole periods. */
#include "pcl2_timers.h"
#include "pcl2_timing.h"

/* One scan of an on-delay. done says whether it had ended; returns whether it has. */
static inline int32_t pcl2_timers_delay(int32_t in, int32_t done, int32_t *running, int64_t *elapsed, int64_t tick,
                                        int64_t limit)
{
    if (in == 0) {
        *running = 0;
        *elapsed = 0;
        return 0;
    }
    if (done == 0) {
        *elapsed = *running != 0 ? pcl2_elapse(*elapsed, tick, limit) : 0;
        *running = 1;
    }
    return done | (*elapsed >= limit);
}

/* What running says of a pulse. */
enum { TIMERS_IDLE = 0, TIMERS_PULSE = 1, TIMERS_OVER = 2 };

/* One scan of a pulse; returns whether it is on. */
static inline int32_t pcl2_timers_pulse(int32_t in, int32_t *running, int64_t *elapsed, int64_t tick, int64_t limit)
{
    if (*running == TIMERS_PULSE) {
        *elapsed = pcl2_elapse(*elapsed, tick, limit);
    } else if (*running == TIMERS_IDLE && in != 0) {
        *running = TIMERS_PULSE;
    }
    if (*running == TIMERS_PULSE && *elapsed >= limit) {
        *running = TIMERS_OVER;
    }
    if (*running == TIMERS_OVER && in == 0) {
        *running = TIMERS_IDLE;
        *elapsed = 0;
    }
    return *running == TIMERS_PULSE;
}

/* The time as it is shown: pt may have become smaller since. */
static inline pcl2_real pcl2_timers_shown(int64_t elapsed, int64_t limit)
{
    return pcl2_seconds(elapsed < limit ? elapsed : limit);
}

PCL2_KERNEL void pcl2_ton_tune(struct pcl2_ton *self, pcl2_real pt, int64_t T)
{
    self->limit = pcl2_set_time(pt, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_ton_init(struct pcl2_ton *self, pcl2_real pt)
{
    (void)self;
    (void)pt;
}

PCL2_KERNEL void pcl2_ton(struct pcl2_ton *self, int32_t in)
{
    self->q = pcl2_timers_delay(in, self->q, &self->running, &self->elapsed, self->tick, self->limit);
    self->et = pcl2_timers_shown(self->elapsed, self->limit);
}

PCL2_KERNEL void pcl2_tof_tune(struct pcl2_tof *self, pcl2_real pt, int64_t T)
{
    self->limit = pcl2_set_time(pt, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_tof_init(struct pcl2_tof *self, pcl2_real pt)
{
    (void)self;
    (void)pt;
}

/* An off-delay is an on-delay of the negations; it has ended as long as in has not been 1. */
PCL2_KERNEL void pcl2_tof(struct pcl2_tof *self, int32_t in)
{
    const int32_t done = self->q == 0;
    self->q = !pcl2_timers_delay(in == 0, done, &self->running, &self->elapsed, self->tick, self->limit);
    self->et = pcl2_timers_shown(self->elapsed, self->limit);
}

PCL2_KERNEL void pcl2_tp_tune(struct pcl2_tp *self, pcl2_real pt, int64_t T)
{
    self->limit = pcl2_set_time(pt, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_tp_init(struct pcl2_tp *self, pcl2_real pt)
{
    (void)self;
    (void)pt;
}

PCL2_KERNEL void pcl2_tp(struct pcl2_tp *self, int32_t in)
{
    self->q = pcl2_timers_pulse(in, &self->running, &self->elapsed, self->tick, self->limit);
    self->et = pcl2_timers_shown(self->elapsed, self->limit);
}

/* The values of mode. */
enum { TIMER_MODE_PULSE = 0, TIMER_MODE_DELAY = 1 };

PCL2_KERNEL void pcl2_timer_tune(struct pcl2_timer *self, int32_t mode, pcl2_real pt, int64_t T)
{
    if (mode != self->kind) {
        self->q = 0;
        self->running = 0;
        self->elapsed = 0;
    }
    self->kind = mode;
    self->limit = pcl2_set_time(pt, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_timer_init(struct pcl2_timer *self, int32_t mode, pcl2_real pt)
{
    (void)self;
    (void)mode;
    (void)pt;
}

PCL2_KERNEL void pcl2_timer(struct pcl2_timer *self, int32_t in)
{
    if (self->kind == TIMER_MODE_PULSE) {
        self->q = pcl2_timers_pulse(in, &self->running, &self->elapsed, self->tick, self->limit);
    } else {
        /* Hold is the delay of the negations. */
        const int32_t hold = self->kind != TIMER_MODE_DELAY;
        const int32_t done = pcl2_timers_delay((in != 0) ^ hold, self->q ^ hold, &self->running, &self->elapsed,
                                               self->tick, self->limit);
        self->q = done ^ hold;
    }
    self->et = pcl2_timers_shown(self->elapsed, self->limit);
}

PCL2_KERNEL void pcl2_etimer_tune(struct pcl2_etimer *self, pcl2_real alarm, int64_t T)
{
    self->limit = pcl2_set_time(alarm, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_etimer_init(struct pcl2_etimer *self, pcl2_real alarm)
{
    (void)self;
    (void)alarm;
}

PCL2_KERNEL void pcl2_etimer(struct pcl2_etimer *self, int32_t run, int32_t rst)
{
    const int64_t longest = INT64_C(1) << 62;
    if (rst != 0) {
        self->elapsed = 0;
    } else if (run != 0) {
        self->elapsed = pcl2_elapse(self->elapsed, self->tick, longest);
    }
    self->t = pcl2_seconds(self->elapsed);
    self->q = self->limit > 0 && self->elapsed >= self->limit;
}

PCL2_KERNEL void pcl2_blink_tune(struct pcl2_blink *self, pcl2_real t1, pcl2_real t0, int64_t T)
{
    const int64_t longest = INT64_C(1) << 62;
    const int64_t off = pcl2_set_time(t0, T);
    self->on = pcl2_set_time(t1, T);
    /* At least a nanosecond: a division by the cycle follows. At most 2^62, as a period: their sum is a time. */
    self->cycle = off < longest - self->on ? self->on + off : longest;
    self->cycle += self->cycle == 0;
    self->tick = T < longest ? T : longest - 1;
}

PCL2_KERNEL void pcl2_blink_init(struct pcl2_blink *self, pcl2_real t1, pcl2_real t0)
{
    (void)self;
    (void)t1;
    (void)t0;
}

PCL2_KERNEL void pcl2_blink(struct pcl2_blink *self, int32_t en)
{
    if (en == 0) {
        self->running = 0;
        self->phase = 0;
        self->q = 0;
        return;
    }
    self->phase += self->running != 0 ? self->tick : 0;
    self->running = 1;
    if (self->phase >= self->cycle) {
        self->phase -= self->cycle;
        if (PCL2_RARELY(self->phase >= self->cycle)) {
            self->phase %= self->cycle;
        }
    }
    self->q = self->phase < self->on;
}
