/* Sequences by time or trigger, and by number. Times are nanoseconds. */
#include "pcl2_masks.h"
#include "pcl2_seqgen.h"
#include "pcl2_timing.h"

PCL2_KERNEL void pcl2_seqgen_tune(
    struct pcl2_seqgen *self, int32_t n, const int32_t *masks, const pcl2_real *times, int64_t T, int32_t *codes,
    pcl2_real *lengths)
{
    for (int32_t i = 0; i < n; i++) {
        codes[i] = masks[i];
        lengths[i] = times[i];
    }
    self->tick = T;
    self->limit = -1;
}

PCL2_KERNEL void pcl2_seqgen_init(
    struct pcl2_seqgen *self, int32_t n, const int32_t *masks, const pcl2_real *times, int32_t *codes,
    pcl2_real *lengths)
{
    (void)self;
    (void)n;
    (void)masks;
    (void)times;
    (void)codes;
    (void)lengths;
}

static void pcl2_seqgen_take(struct pcl2_seqgen *self, int32_t step)
{
    self->step = step;
    self->elapsed = 0;
    self->limit = -1;
    self->taken = 1;
}

/* Whether the time of the step is over. */
static inline int32_t pcl2_seqgen_over(const struct pcl2_seqgen *self)
{
    return self->limit > 0 && self->elapsed >= self->limit;
}

/* Finds the time of the step: 0 where it has none. */
static void pcl2_seqgen_find(struct pcl2_seqgen *self, int32_t n, const pcl2_real *lengths)
{
    if (PCL2_RARELY(self->step < 0 || self->step > n)) {
        self->step = 0;
    }
    if (self->limit < 0) {
        self->limit = self->step > 0 ? pcl2_set_time(lengths[self->step - 1], self->tick) : 0;
    }
}

/* The time of one scan. */
static void pcl2_seqgen_wait(struct pcl2_seqgen *self, int32_t thold)
{
    const int64_t longest = INT64_C(1) << 62;
    if (self->started != 0 && thold == 0) {
        self->elapsed = pcl2_elapse(self->elapsed, self->tick, longest);
    }
}

PCL2_KERNEL void pcl2_seqgen(
    struct pcl2_seqgen *self, int32_t trig, int32_t hold, int32_t thold, int32_t rst, int32_t jmp, int32_t jn,
    int32_t dis, int32_t n, int32_t cycle, const int32_t *codes, const pcl2_real *lengths)
{
    const int32_t triggers = (trig != 0) & (self->lasttrig == 0) & self->started;
    const int32_t jumps = (jmp != 0) & (self->lastjmp == 0) & self->started;
    const int32_t legal = jn >= 0 && jn <= n;
    self->taken = 0;
    self->status = jumps & (rst == 0) & !legal;
    pcl2_seqgen_find(self, n, lengths);
    pcl2_seqgen_wait(self, thold);
    if (rst != 0) {
        if (self->step != 0) {
            pcl2_seqgen_take(self, 0);
        }
    } else if (jumps & legal) {
        pcl2_seqgen_take(self, jn);
    } else if (hold == 0 && (triggers || pcl2_seqgen_over(self))) {
        pcl2_seqgen_take(self, self->step < n ? self->step + 1 : cycle != 0);
    }
    pcl2_seqgen_find(self, n, lengths);
    self->mask = self->step > 0 && dis == 0 ? codes[self->step - 1] : 0;
    self->tleft = self->limit > self->elapsed ? pcl2_seconds(self->limit - self->elapsed) : PCL2_R(0.0);
    self->lasttrig = trig;
    self->lastjmp = jmp;
    self->started = 1;
}

PCL2_KERNEL int32_t pcl2_seqmas_check(int32_t n, const int32_t *masks, pcl2_real *left)
{
    for (int32_t i = 0; i < n; i++) {
        if (!pcl2_mask_is_legal(masks[i], PCL2_MASK_EITHER)) {
            left[0] = (pcl2_real)(i + 1);
            left[1] = (pcl2_real)masks[i];
            return 2;
        }
    }
    return 0;
}

PCL2_KERNEL void pcl2_seqmas_init(struct pcl2_seqmas *self, int32_t n, const int32_t *masks, int32_t *q)
{
    (void)self;
    (void)n;
    (void)masks;
    (void)q;
}

PCL2_KERNEL void pcl2_seqmas(struct pcl2_seqmas *self, int32_t jmp, int32_t jn, int32_t n, const int32_t *masks, int32_t *q)
{
    const int32_t jumps = (jmp != 0) & (self->lastjmp == 0) & self->started;
    const int32_t legal = jn >= 0 && jn <= n;
    self->status = jumps & !legal;
    self->step = jumps & legal ? jn : self->step;
    if (PCL2_RARELY(self->step < 0 || self->step > n)) {
        self->step = 0;
    }
    int32_t mask = self->step > 0 ? masks[self->step - 1] : 0;
    for (int32_t i = 3; i >= 0; i--) {
        const int32_t digit = mask % 10;
        q[i] = digit == PCL2_MASK_EITHER ? q[i] : digit;
        mask /= 10;
    }
    self->lastjmp = jmp;
    self->started = 1;
}
