/* Steps and actions of a sequence (IEC 61131-3, sequential function chart). Times are nanoseconds. */
#include "pcl2_sfc.h"
#include "pcl2_timing.h"

PCL2_KERNEL void pcl2_step_tune(struct pcl2_step *self, int64_t T)
{
    self->tick = T;
}

PCL2_KERNEL void pcl2_step_init(struct pcl2_step *self, int32_t init)
{
    self->initial = init;
}

PCL2_KERNEL void pcl2_step(struct pcl2_step *self, int32_t set, int32_t reset, int32_t clr)
{
    const int64_t longest = INT64_C(1) << 62;
    const int32_t begins = (self->started == 0) | (clr != 0);
    const int32_t active = begins ? self->initial : self->x & (reset == 0);
    const int32_t enters = (set != 0) & (clr == 0) & !active;
    if (enters | begins) {
        self->elapsed = 0;
    } else if (active) {
        self->elapsed = pcl2_elapse(self->elapsed, self->tick, longest);
    }
    self->x = active | enters;
    self->t = pcl2_seconds(self->elapsed);
    self->started = 1;
}

/* The values of qualifier. */
enum {
    ACTION_N = 0, ACTION_R = 1, ACTION_S = 2, ACTION_L = 3, ACTION_D = 4, ACTION_P = 5, ACTION_SD = 6, ACTION_DS = 7,
    ACTION_SL = 8, ACTION_P1 = 9, ACTION_P0 = 10
};

PCL2_KERNEL void pcl2_action_tune(struct pcl2_action *self, int32_t n, pcl2_real t, int64_t T)
{
    (void)n;
    self->limit = pcl2_set_time(t, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_action_init(
    struct pcl2_action *self, int32_t n, const int32_t *qualifier, pcl2_real t, int32_t *kind)
{
    (void)self;
    (void)t;
    memcpy(kind, qualifier, (size_t)n * sizeof *kind);
}

/* The qualifiers with an active step, a bit for each. */
static int32_t pcl2_action_active(const int32_t *x, int32_t n, const int32_t *kind)
{
    int32_t active = 0;
    for (int32_t i = 0; i < n; i++) {
        active |= (x[i] != 0) << kind[i];
    }
    return active;
}

static inline int32_t pcl2_action_is(int32_t bits, int32_t qualifier)
{
    return bits >> qualifier & 1;
}

/* One scan of the latch of a qualifier, reset dominant (RS of the standard). */
static int32_t pcl2_action_stored(struct pcl2_action *self, int32_t qualifier, int32_t set, int32_t reset)
{
    const int32_t bit = 1 << qualifier;
    self->stored = reset ? self->stored & ~bit : set ? self->stored | bit : self->stored;
    return pcl2_action_is(self->stored, qualifier);
}

/* One scan of the on-delay of a qualifier (TON of the standard): whether its time is over. */
static int32_t pcl2_action_over(struct pcl2_action *self, int32_t qualifier, int32_t in, int64_t *elapsed)
{
    const int64_t longest = INT64_C(1) << 62;
    const int32_t bit = 1 << qualifier;
    if (in == 0) {
        self->running &= ~bit;
        return 0;
    }
    *elapsed = (self->running & bit) != 0 ? pcl2_elapse(*elapsed, self->tick, longest) : 0;
    self->running |= bit;
    return *elapsed >= self->limit;
}

/* The parts with a time. Each latch and timer runs in every scan. */
static int32_t pcl2_action_timed(struct pcl2_action *self, int32_t active, int32_t reset)
{
    const int32_t l = pcl2_action_is(active, ACTION_L);
    const int32_t d = pcl2_action_is(active, ACTION_D);
    const int32_t sd = pcl2_action_stored(self, ACTION_SD, pcl2_action_is(active, ACTION_SD), reset);
    const int32_t sl = pcl2_action_stored(self, ACTION_SL, pcl2_action_is(active, ACTION_SL), reset);
    const int32_t ds = pcl2_action_over(self, ACTION_DS, pcl2_action_is(active, ACTION_DS), &self->tds);
    const int32_t limited = l & !pcl2_action_over(self, ACTION_L, l, &self->tl);
    const int32_t delayed = pcl2_action_over(self, ACTION_D, d, &self->td);
    const int32_t stored = pcl2_action_over(self, ACTION_SD, sd, &self->tsd);
    const int32_t once = sl & !pcl2_action_over(self, ACTION_SL, sl, &self->tsl);
    return limited | delayed | stored | once | pcl2_action_stored(self, ACTION_DS, ds, reset);
}

PCL2_KERNEL void pcl2_action(struct pcl2_action *self, const int32_t *x, int32_t n, int32_t *kind)
{
    const int32_t active = pcl2_action_active(x, n, kind);
    const int32_t reset = pcl2_action_is(active, ACTION_R);
    const int32_t rises = active & ~self->last;
    const int32_t falls = self->last & ~active;
    const int32_t pulse = pcl2_action_is(rises, ACTION_P) | pcl2_action_is(rises, ACTION_P1);
    const int32_t held = pcl2_action_is(active, ACTION_N)
        | pcl2_action_stored(self, ACTION_S, pcl2_action_is(active, ACTION_S), reset);
    const int32_t timed = pcl2_action_timed(self, active, reset);
    self->q = reset ? 0 : (held | pulse | pcl2_action_is(falls, ACTION_P0) | timed);
    self->last = active;
}
