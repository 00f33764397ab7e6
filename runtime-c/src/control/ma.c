/* ma: manual/auto station. */
#include "pcl2_ma.h"
#include "pcl2_station.h"

enum { MA_HELD = 1, MA_SHED = 2, MA_WANTED = 3 };

PCL2_KERNEL void pcl2_ma_init(struct pcl2_ma *self, pcl2_real lo, pcl2_real hi, pcl2_real rate, pcl2_real tbad,
                              pcl2_real *bk)
{
    (void)self;
    (void)lo;
    (void)hi;
    (void)rate;
    (void)tbad;
    (void)bk;
}

PCL2_KERNEL void pcl2_ma_tune(struct pcl2_ma *self, pcl2_real lo, pcl2_real hi, pcl2_real rate, pcl2_real tbad, int64_t T)
{
    self->low = lo;
    self->high = hi;
    self->way = pcl2_way(rate, T);
    self->scans = pcl2_scans(tbad, T);
}

/* u as the operator or the tracked signal wants it. */
static void ma_obey(struct pcl2_ma *self, pcl2_real wanted)
{
    self->status = pcl2_is_bad(wanted) ? MA_WANTED : self->status;
    self->u = pcl2_within_or(wanted, self->low, self->high, self->u);
}

static void ma_bad(struct pcl2_ma *self, int32_t mode, pcl2_real um)
{
    const int32_t sheds = pcl2_sheds(&self->blind, self->scans);
    self->status = sheds ? MA_SHED : MA_HELD;
    self->actual = sheds ? PCL2_MAN : mode;
    if (sheds) {
        self->u = pcl2_within_or(um, self->low, self->high, self->u);
    }
}

/* Without rate in the first scan. */
static int32_t ma_follow(struct pcl2_ma *self, pcl2_real uin)
{
    const pcl2_real target = pcl2_limited(uin, self->low, self->high);
    const pcl2_real way = self->started ? self->way : PCL2_REAL_MAX;
    self->u = pcl2_approach(self->u, target, way, way);
    return pcl2_stopped(uin, self->u);
}

PCL2_KERNEL void pcl2_ma(struct pcl2_ma *self, pcl2_real uin, int32_t mode, pcl2_real um, int32_t trk, pcl2_real utr,
                         const pcl2_real *back, pcl2_real *bk)
{
    const int32_t init = pcl2_return_state(back) == PCL2_WAITING;
    const int32_t bad = pcl2_is_bad(uin);
    const int32_t follows = !init && trk == 0 && mode != PCL2_MAN;
    self->status = 0;
    self->blind = bad && follows ? self->blind : 0;
    if (init) {
        self->u = back[0];
        self->actual = PCL2_INIT;
    } else if (trk != 0) {
        self->actual = PCL2_TRACK;
        ma_obey(self, utr);
    } else if (mode == PCL2_MAN) {
        self->actual = PCL2_MAN;
        ma_obey(self, um);
    } else if (bad) {
        ma_bad(self, mode == PCL2_CAS ? PCL2_CAS : PCL2_AUTO, um);
    } else {
        self->actual = mode == PCL2_CAS ? PCL2_CAS : PCL2_AUTO;
    }
    if (pcl2_awaits(&self->patience, bad || !follows, bk, uin, self->u)) {
        self->actual = bad || !follows ? self->actual : PCL2_INIT;
        pcl2_hand_back(bk, self->u, PCL2_WAITING);
    } else {
        const int32_t own = ma_follow(self, uin);
        pcl2_hand_on(bk, self->u, own, back);
    }
    self->started = 1;
}
