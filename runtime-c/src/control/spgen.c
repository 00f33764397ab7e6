/* spgen: limits, rates and tracking of a set-point. */
#include "pcl2_spgen.h"
#include "pcl2_station.h"

enum { SPGEN_HELD = 1 };

PCL2_KERNEL void pcl2_spgen_init(struct pcl2_spgen *self, pcl2_real lo, pcl2_real hi, pcl2_real up, pcl2_real dn,
                                 pcl2_real *bk)
{
    (void)self;
    (void)lo;
    (void)hi;
    (void)up;
    (void)dn;
    (void)bk;
}

PCL2_KERNEL void pcl2_spgen_tune(struct pcl2_spgen *self, pcl2_real lo, pcl2_real hi, pcl2_real up, pcl2_real dn,
                                 int64_t T)
{
    self->low = lo;
    self->high = hi;
    self->rise = pcl2_way(up, T);
    self->fall = pcl2_way(dn, T);
}

/* v jumps there and stays. */
static void spgen_take(struct pcl2_spgen *self, pcl2_real v)
{
    self->v = v;
    self->target = v;
    self->started = 1;
}

static void spgen_track(struct pcl2_spgen *self, pcl2_real y)
{
    if (pcl2_is_bad(y)) {
        self->status = SPGEN_HELD;
    } else {
        spgen_take(self, pcl2_limited(y, self->low, self->high));
    }
}

static int32_t spgen_follow(struct pcl2_spgen *self, pcl2_real w)
{
    self->target = pcl2_limited(w, self->low, self->high);
    self->v = self->started ? pcl2_approach(self->v, self->target, self->rise, self->fall) : self->target;
    self->started = 1;
    return pcl2_stopped(w, self->v);
}

PCL2_KERNEL void pcl2_spgen(struct pcl2_spgen *self, pcl2_real w, int32_t trk, pcl2_real y, const pcl2_real *back,
                            pcl2_real *bk)
{
    const int32_t init = pcl2_return_state(back) == PCL2_WAITING;
    const int32_t bad = pcl2_is_bad(w);
    self->status = 0;
    if (init) {
        spgen_take(self, back[0]);
    } else if (trk != 0 || (bad && !self->started)) {
        spgen_track(self, y);
    } else if (bad) {
        self->status = SPGEN_HELD;
    }
    if (pcl2_awaits(&self->patience, init || trk != 0 || bad, bk, w, self->v)) {
        pcl2_hand_back(bk, self->v, PCL2_WAITING);
    } else {
        const int32_t own = spgen_follow(self, w);
        pcl2_hand_on(bk, self->v, own, back);
    }
}
