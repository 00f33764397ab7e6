/* casc: cascade station. */
#include "pcl2_casc.h"
#include "pcl2_station.h"

enum { CASC_HELD = 1, CASC_SHED = 2, CASC_WANTED = 3 };

PCL2_KERNEL void pcl2_casc_init(struct pcl2_casc *self, pcl2_real lo, pcl2_real hi, pcl2_real rate, int32_t sptrack,
                                pcl2_real tbad, pcl2_real *bk)
{
    (void)self;
    (void)lo;
    (void)hi;
    (void)rate;
    (void)sptrack;
    (void)tbad;
    (void)bk;
}

PCL2_KERNEL void pcl2_casc_tune(struct pcl2_casc *self, pcl2_real lo, pcl2_real hi, pcl2_real rate, int32_t sptrack,
                                pcl2_real tbad, int64_t T)
{
    self->low = lo;
    self->high = hi;
    self->way = pcl2_way(rate, T);
    self->scans = pcl2_scans(tbad, T);
    self->follow_y = sptrack != 0;
}

static void casc_obey(struct pcl2_casc *self, pcl2_real wanted)
{
    self->status = pcl2_is_bad(wanted) ? CASC_WANTED : self->status;
    self->w = pcl2_within_or(wanted, self->low, self->high, self->w);
}

static void casc_bad(struct pcl2_casc *self, pcl2_real wm)
{
    const int32_t sheds = pcl2_sheds(&self->blind, self->scans);
    self->status = sheds ? CASC_SHED : CASC_HELD;
    self->actual = sheds ? PCL2_AUTO : PCL2_CAS;
    if (sheds) {
        self->w = pcl2_within_or(wm, self->low, self->high, self->w);
    }
}

/* Without rate in the first scan. */
static int32_t casc_follow(struct pcl2_casc *self, pcl2_real wr)
{
    const pcl2_real target = pcl2_limited(wr, self->low, self->high);
    const pcl2_real way = self->started ? self->way : PCL2_REAL_MAX;
    self->w = pcl2_approach(self->w, target, way, way);
    return pcl2_stopped(wr, self->w);
}

PCL2_KERNEL void pcl2_casc(struct pcl2_casc *self, pcl2_real wr, pcl2_real y, int32_t mode, pcl2_real wm,
                           const pcl2_real *back, pcl2_real *bk)
{
    const int32_t init = pcl2_return_state(back) == PCL2_WAITING;
    const int32_t bad = pcl2_is_bad(wr);
    const int32_t remote = !init && mode != PCL2_MAN && mode != PCL2_AUTO;
    self->status = 0;
    self->blind = bad && remote ? self->blind : 0;
    if (init) {
        self->w = back[0];
        self->actual = PCL2_INIT;
    } else if (!remote) {
        self->actual = mode;
        casc_obey(self, mode == PCL2_MAN && self->follow_y ? y : wm);
    } else if (bad) {
        casc_bad(self, wm);
    } else {
        self->actual = PCL2_CAS;
    }
    if (pcl2_awaits(&self->patience, bad || !remote, bk, wr, self->w)) {
        self->actual = bad || !remote ? self->actual : PCL2_INIT;
        pcl2_hand_back(bk, self->w, PCL2_WAITING);
    } else {
        const int32_t own = casc_follow(self, wr);
        pcl2_hand_on(bk, self->w, own, back);
    }
    self->started = 1;
}
