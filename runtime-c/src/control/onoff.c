/* onoff: relay with hysteresis and least times. */
#include "pcl2_onoff.h"

enum { ONOFF_SIGNAL = 1 };
enum { ONOFF_ZERO = 0, ONOFF_ONE = 1, ONOFF_HOLD = 2 };

PCL2_KERNEL void pcl2_onoff_init(struct pcl2_onoff *self, pcl2_real h, pcl2_real ton, pcl2_real toff, int32_t act,
                                 int32_t onbad)
{
    (void)self;
    (void)h;
    (void)ton;
    (void)toff;
    (void)act;
    (void)onbad;
}

PCL2_KERNEL void pcl2_onoff_tune(struct pcl2_onoff *self, pcl2_real h, pcl2_real ton, pcl2_real toff, int32_t act,
                                 int32_t onbad, int64_t T)
{
    self->width = h;
    self->on = pcl2_nanoseconds(ton);
    self->off = pcl2_nanoseconds(toff);
    self->scan = T;
    self->direct = act != 0;
    self->fallback = onbad;
}

/* passed stops where it is more than any least time. */
static void onoff_switch(struct pcl2_onoff *self, int32_t q)
{
    if (q != self->q) {
        self->q = q;
        self->passed = 0;
    }
    if (self->passed < INT64_C(4611686018427387904)) {
        self->passed += self->scan;
    }
}

PCL2_KERNEL void pcl2_onoff(struct pcl2_onoff *self, pcl2_real w, pcl2_real y)
{
    const pcl2_real e = self->direct ? y - w : w - y;
    const int32_t bad = pcl2_is_bad(w) || pcl2_is_bad(y);
    int32_t q = self->q;
    self->status = bad ? ONOFF_SIGNAL : 0;
    if (bad) {
        q = self->fallback == ONOFF_HOLD ? q : self->fallback == ONOFF_ONE;
    } else if (!self->started || self->passed >= (q != 0 ? self->on : self->off)) {
        q = e >= self->width ? 1 : e <= -self->width ? 0 : q;
    }
    self->started = 1;
    onoff_switch(self, q);
}
