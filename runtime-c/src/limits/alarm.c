/* Alarms of a level, a deviation and a rate (ISA-18.2, IEC 62682). */
#include "pcl2_alarm.h"
#include "pcl2_math.h"
#include "pcl2_onbad.h"
#include "pcl2_timing.h"

/* A delay and the scan in which it begins. */
static inline int64_t pcl2_alarm_delay(pcl2_real seconds, int64_t T)
{
    return pcl2_elapse(pcl2_set_time(seconds, T), T, INT64_MAX);
}

/* One alarm: beyond has to last for its delay, on or off, before q follows. time counts the present scan too. */
static inline int32_t pcl2_alarm_follow(int32_t q, int32_t beyond, int64_t *time, int64_t tick, int64_t on, int64_t off)
{
    const int64_t limit = beyond ? on : off;
    if (beyond == q) {
        *time = 0;
        return q;
    }
    *time = pcl2_elapse(*time, tick, limit);
    if (*time < limit) {
        return q;
    }
    *time = 0;
    return beyond;
}

/* At or beyond a high limit; once the alarm stands, still within the band below it. */
static inline int32_t pcl2_alarm_above(pcl2_real x, pcl2_real limit, int32_t q, pcl2_real band)
{
    return x >= (q ? limit - band : limit);
}

PCL2_KERNEL void pcl2_alarm_tune(struct pcl2_alarm *self, pcl2_real hh, pcl2_real h, pcl2_real l, pcl2_real ll,
                                 pcl2_real db, pcl2_real ton, pcl2_real toff, int32_t onbad, int64_t T)
{
    self->vhh = hh;
    self->vh = h;
    self->vl = l;
    self->vll = ll;
    self->band = db;
    self->policy = onbad;
    self->on = pcl2_alarm_delay(ton, T);
    self->off = pcl2_alarm_delay(toff, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_alarm_init(struct pcl2_alarm *self, pcl2_real hh, pcl2_real h, pcl2_real l, pcl2_real ll,
                                 pcl2_real db, pcl2_real ton, pcl2_real toff, int32_t onbad)
{
    (void)self;
    (void)hh;
    (void)h;
    (void)l;
    (void)ll;
    (void)db;
    (void)ton;
    (void)toff;
    (void)onbad;
}

static void pcl2_alarm_bad(struct pcl2_alarm *self)
{
    self->bad = 1;
    self->any = 1;
    if (self->policy == PCL2_ON_BAD_HOLD) {
        return;
    }
    self->qhh = self->qh = self->ql = self->qll = self->policy;
    self->thh = self->th = self->tl = self->tll = 0;
}

PCL2_KERNEL void pcl2_alarm(struct pcl2_alarm *self, pcl2_real x)
{
    if (PCL2_RARELY(pcl2_is_bad(x))) {
        pcl2_alarm_bad(self);
        return;
    }
    const int32_t hh = pcl2_alarm_above(x, self->vhh, self->qhh, self->band);
    const int32_t h = pcl2_alarm_above(x, self->vh, self->qh, self->band);
    const int32_t l = pcl2_alarm_above(-x, -self->vl, self->ql, self->band);
    const int32_t ll = pcl2_alarm_above(-x, -self->vll, self->qll, self->band);
    self->qhh = pcl2_alarm_follow(self->qhh, hh, &self->thh, self->tick, self->on, self->off);
    self->qh = pcl2_alarm_follow(self->qh, h, &self->th, self->tick, self->on, self->off);
    self->ql = pcl2_alarm_follow(self->ql, l, &self->tl, self->tick, self->on, self->off);
    self->qll = pcl2_alarm_follow(self->qll, ll, &self->tll, self->tick, self->on, self->off);
    self->any = self->qhh | self->qh | self->ql | self->qll;
    self->bad = 0;
}

PCL2_KERNEL void pcl2_devalm_tune(struct pcl2_devalm *self, pcl2_real d, pcl2_real db, pcl2_real t, int32_t onbad,
                                  int64_t T)
{
    self->limit = d;
    self->band = db;
    self->policy = onbad;
    self->on = pcl2_alarm_delay(t, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_devalm_init(struct pcl2_devalm *self, pcl2_real d, pcl2_real db, pcl2_real t, int32_t onbad)
{
    (void)self;
    (void)d;
    (void)db;
    (void)t;
    (void)onbad;
}

PCL2_KERNEL void pcl2_devalm(struct pcl2_devalm *self, pcl2_real x, pcl2_real w)
{
    if (PCL2_RARELY(pcl2_is_bad(x) | pcl2_is_bad(w))) {
        self->q = pcl2_on_bad(self->policy, self->q);
        self->since = self->policy == PCL2_ON_BAD_HOLD ? self->since : 0;
        return;
    }
    const int32_t beyond = pcl2_alarm_above(x < w ? w - x : x - w, self->limit, self->q, self->band);
    self->q = pcl2_alarm_follow(self->q, beyond, &self->since, self->tick, self->on, self->tick);
}

PCL2_KERNEL void pcl2_rocalm_tune(struct pcl2_rocalm *self, pcl2_real up, pcl2_real dn, pcl2_real tf, int32_t onbad,
                                  int64_t T)
{
    const pcl2_real h = pcl2_seconds(T);
    self->rise = up;
    self->fall = -dn;
    self->gain = tf > PCL2_R(0.0) ? -pcl2_math_expm1(-h / tf) : PCL2_R(1.0);
    self->scale = PCL2_R(1.0) / h;
    self->policy = onbad;
}

PCL2_KERNEL void pcl2_rocalm_init(struct pcl2_rocalm *self, pcl2_real up, pcl2_real dn, pcl2_real tf, int32_t onbad)
{
    (void)self;
    (void)up;
    (void)dn;
    (void)tf;
    (void)onbad;
}

PCL2_KERNEL void pcl2_rocalm(struct pcl2_rocalm *self, pcl2_real x)
{
    const pcl2_real change = self->started != 0 ? self->gain * (x - self->f) : PCL2_R(0.0);
    const pcl2_real rate = change * self->scale;
    if (PCL2_RARELY(pcl2_is_bad(x) | pcl2_is_bad(rate))) {
        self->started = 0;
        self->rate = PCL2_R(0.0);
        self->qup = pcl2_on_bad(self->policy, self->qup);
        self->qdn = pcl2_on_bad(self->policy, self->qdn);
        return;
    }
    self->f = self->started != 0 ? self->f + change : x;
    self->started = 1;
    self->rate = rate;
    self->qup = rate >= self->rise;
    self->qdn = rate <= self->fall;
}
