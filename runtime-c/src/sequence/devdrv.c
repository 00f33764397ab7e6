/* Drivers of devices that report whether they followed. Times are nanoseconds. */
#include "pcl2_devdrv.h"
#include "pcl2_masks.h"
#include "pcl2_timing.h"

/* What st says. */
enum { DEVDRV_GOOD = 0, DEVDRV_BAD = 1, DEVDRV_WAITING = 2 };

PCL2_KERNEL int32_t pcl2_devdrv_check(int32_t mask0, int32_t mask1, pcl2_real twait, int64_t T, pcl2_real *left)
{
    (void)twait;
    (void)T;
    if (pcl2_mask_is_legal(mask0, PCL2_MASK_EITHER) && pcl2_mask_is_legal(mask1, PCL2_MASK_EITHER)) {
        return 0;
    }
    left[0] = (pcl2_real)(pcl2_mask_is_legal(mask0, PCL2_MASK_EITHER) ? mask1 : mask0);
    return 1;
}

PCL2_KERNEL void pcl2_devdrv_tune(struct pcl2_devdrv *self, int32_t mask0, int32_t mask1, pcl2_real twait, int64_t T)
{
    self->off = mask0;
    self->on = mask1;
    self->limit = pcl2_set_time(twait, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_devdrv_init(struct pcl2_devdrv *self, int32_t mask0, int32_t mask1, pcl2_real twait)
{
    (void)self;
    (void)mask0;
    (void)mask1;
    (void)twait;
}

PCL2_KERNEL void pcl2_devdrv(struct pcl2_devdrv *self, int32_t cmd, int32_t fb1, int32_t fb2, int32_t ovr)
{
    const int32_t fb[2] = {fb1, fb2};
    const int32_t out = cmd != 0;
    const int32_t changes = self->started == 0 || out != self->out;
    self->elapsed = changes ? 0 : pcl2_elapse(self->elapsed, self->tick, self->limit);
    self->waits = (self->waits | changes) & (self->elapsed < self->limit);
    if (ovr != 0 || pcl2_mask_agrees(out ? self->on : self->off, fb, 2)) {
        self->st = DEVDRV_GOOD;
        self->waits = 0;
    } else {
        self->st = self->waits ? DEVDRV_WAITING : DEVDRV_BAD;
    }
    self->out = out;
    self->started = 1;
}

/* The number of the first of three masks with a digit above the highest, from 1; 0: none. */
static int32_t pcl2_msdd_illegal(const int32_t *masks, int32_t highest)
{
    for (int32_t i = 0; i < 3; i++) {
        if (!pcl2_mask_is_legal(masks[i], highest)) {
            return i + 1;
        }
    }
    return 0;
}

PCL2_KERNEL int32_t pcl2_msdd_check(
    const int32_t *outs, const int32_t *fbs, pcl2_real twait, pcl2_real tfault, pcl2_real pulse, int64_t T,
    pcl2_real *left)
{
    (void)twait;
    (void)tfault;
    (void)pulse;
    (void)T;
    const int32_t output = pcl2_msdd_illegal(outs, 1);
    const int32_t feedback = pcl2_msdd_illegal(fbs, PCL2_MASK_EITHER);
    if (output == 0 && feedback == 0) {
        return 0;
    }
    left[0] = (pcl2_real)(output != 0 ? output : feedback);
    left[1] = (pcl2_real)(output != 0 ? outs[output - 1] : fbs[feedback - 1]);
    return output != 0 ? 1 : 2;
}

PCL2_KERNEL void pcl2_msdd_tune(
    struct pcl2_msdd *self, const int32_t *outs, const int32_t *fbs, pcl2_real twait, pcl2_real tfault, pcl2_real pulse,
    int64_t T, int32_t *drive, int32_t *want)
{
    for (int32_t i = 0; i < 3; i++) {
        drive[i] = outs[i];
        want[i] = fbs[i];
    }
    self->wait = pcl2_set_time(twait, T);
    self->fault = pcl2_set_time(tfault, T);
    self->length = pcl2_set_time(pulse, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_msdd_init(
    struct pcl2_msdd *self, const int32_t *outs, const int32_t *fbs, pcl2_real twait, pcl2_real tfault, pcl2_real pulse,
    int32_t *drive, int32_t *want, int32_t *o)
{
    (void)self;
    (void)outs;
    (void)fbs;
    (void)twait;
    (void)tfault;
    (void)pulse;
    (void)drive;
    (void)want;
    (void)o;
}

/* Judges the feedbacks. elapsed is the time since the new state, or since the feedbacks stopped agreeing. */
static void pcl2_msdd_judge(struct pcl2_msdd *self, int32_t agrees)
{
    if (agrees) {
        self->st = DEVDRV_GOOD;
        self->agreed = 1;
        return;
    }
    if (self->st == DEVDRV_GOOD && self->agreed != 0) {
        self->elapsed = 0;
    }
    const int64_t limit = self->agreed != 0 ? self->fault : self->wait;
    self->st = self->st != DEVDRV_BAD && self->elapsed < limit ? DEVDRV_WAITING : DEVDRV_BAD;
}

PCL2_KERNEL void pcl2_msdd(
    struct pcl2_msdd *self, int32_t c1, int32_t c2, int32_t fb1, int32_t fb2, int32_t fb3, int32_t fb4,
    const int32_t *drive, const int32_t *want, int32_t *o)
{
    const int64_t longest = INT64_C(1) << 62;
    const int32_t fb[4] = {fb1, fb2, fb3, fb4};
    const int32_t asked = (c1 != 0) + 2 * (c2 != 0);
    if (asked != 0 && asked != self->state) {
        self->state = asked;
        self->st = DEVDRV_WAITING;
        self->agreed = 0;
        self->elapsed = 0;
        self->driven = 0;
    } else {
        self->elapsed = pcl2_elapse(self->elapsed, self->tick, longest);
        self->driven = pcl2_elapse(self->driven, self->tick, longest);
    }
    if (self->state > 0) {
        pcl2_msdd_judge(self, pcl2_mask_agrees(want[self->state - 1], fb, 4));
    }
    const int32_t drives = self->state > 0 && (self->length == 0 || self->driven < self->length);
    int32_t mask = drives ? drive[self->state - 1] : 0;
    for (int32_t i = 2; i >= 0; i--) {
        o[i] = mask % 10;
        mask /= 10;
    }
}
