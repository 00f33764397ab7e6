/* rat: ratio station. */
#include "pcl2_math.h"
#include "pcl2_rat.h"
#include "pcl2_station.h"

enum { RAT_HELD = 1, RAT_SHED = 2, RAT_WANTED = 3 };

PCL2_KERNEL void pcl2_rat_init(struct pcl2_rat *self, pcl2_real kmin, pcl2_real kmax, pcl2_real lo, pcl2_real hi,
                               pcl2_real rate, int32_t sptrack, pcl2_real tbad, pcl2_real eps, pcl2_real *bk)
{
    (void)self;
    (void)kmin;
    (void)kmax;
    (void)lo;
    (void)hi;
    (void)rate;
    (void)sptrack;
    (void)tbad;
    (void)eps;
    (void)bk;
}

PCL2_KERNEL void pcl2_rat_tune(struct pcl2_rat *self, pcl2_real kmin, pcl2_real kmax, pcl2_real lo, pcl2_real hi,
                               pcl2_real rate, int32_t sptrack, pcl2_real tbad, pcl2_real eps, int64_t T)
{
    self->least = kmin;
    self->most = kmax;
    self->low = lo;
    self->high = hi;
    self->way = pcl2_way(rate, T);
    self->tiny = eps;
    self->scans = pcl2_scans(tbad, T);
    self->follow_y = sptrack != 0;
}

/* 1 when wild tells a ratio. */
static int32_t rat_tells(const struct pcl2_rat *self, pcl2_real wild)
{
    return !pcl2_is_bad(wild) && pcl2_math_fabs(wild) >= self->tiny;
}

/* The ratio that there is. */
static void rat_measure(struct pcl2_rat *self, pcl2_real wild)
{
    if (rat_tells(self, wild)) {
        self->k = pcl2_within_or(self->w / wild, self->least, self->most, self->k);
    }
}

static void rat_manual(struct pcl2_rat *self, pcl2_real wanted)
{
    self->status = self->status == 0 && pcl2_is_bad(wanted) ? RAT_WANTED : self->status;
    self->w = pcl2_within_or(wanted, self->low, self->high, self->w);
}

/* w goes to k wild; the state for kr, the present k. */
static int32_t rat_follow(struct pcl2_rat *self, pcl2_real wild, pcl2_real wanted)
{
    const int32_t limited = pcl2_stopped(wanted, self->k);
    const pcl2_real target = self->k * wild;
    const pcl2_real way = self->started ? self->way : PCL2_REAL_MAX;
    self->w = pcl2_approach(self->w, pcl2_limited(target, self->low, self->high), way, way);
    const int32_t stopped = pcl2_stopped(target, self->w);
    if (limited != PCL2_FOLLOWING || !rat_tells(self, wild)) {
        return limited;
    }
    return wild < PCL2_R(0.0) ? pcl2_return_reversed(stopped) : stopped;
}

/* What back tells, as a ratio. */
static void rat_hand_on(const struct pcl2_rat *self, pcl2_real wild, int32_t own, const pcl2_real *back, pcl2_real *bk)
{
    const int32_t told = rat_tells(self, wild) ? pcl2_return_state(back) : PCL2_FOLLOWING;
    const pcl2_real ratio[2] = {told == PCL2_FOLLOWING ? self->k : back[0] / wild,
                                (pcl2_real)(wild < PCL2_R(0.0) ? pcl2_return_reversed(told) : told)};
    pcl2_hand_on(bk, self->k, own, ratio);
}

/* Where w is not k wild: as it is told, wanted or held. */
static void rat_stand(struct pcl2_rat *self, pcl2_real wild, const pcl2_real *told, int32_t manual, pcl2_real wanted)
{
    if (told != NULL) {
        self->w = told[0];
    } else if (manual) {
        rat_manual(self, wanted);
    }
    rat_measure(self, wild);
}

/* The ratio of an operator; not in the scan that begins with the ratio that there is. */
static void rat_local(struct pcl2_rat *self, pcl2_real wild, pcl2_real km)
{
    if (self->started && !self->runs) {
        rat_measure(self, wild);
    } else {
        self->status = self->status == 0 && pcl2_is_bad(km) ? RAT_WANTED : self->status;
        self->k = pcl2_within_or(km, self->least, self->most, self->k);
    }
}

PCL2_KERNEL void pcl2_rat(struct pcl2_rat *self, pcl2_real wild, pcl2_real y, int32_t mode, pcl2_real km, pcl2_real wm,
                          pcl2_real kr, const pcl2_real *back, pcl2_real *bk)
{
    const int32_t init = pcl2_return_state(back) == PCL2_WAITING;
    const int32_t wants = !init && mode != PCL2_MAN;
    const int32_t runs = wants && !pcl2_is_bad(wild);
    const int32_t remote = runs && mode == PCL2_CAS;
    const int32_t bad = (wants && !runs) || (remote && pcl2_is_bad(kr));
    self->blind = bad ? self->blind : 0;
    const int32_t sheds = bad && pcl2_sheds(&self->blind, self->scans);
    self->status = sheds ? RAT_SHED : bad ? RAT_HELD : 0;
    self->actual = init ? PCL2_INIT : !wants || (sheds && !runs) ? PCL2_MAN : mode == PCL2_CAS && !sheds ? PCL2_CAS : PCL2_AUTO;
    if (!runs) {
        rat_stand(self, wild, init ? back : NULL, !wants || sheds, self->follow_y && !wants ? y : wm);
    } else if (!remote || sheds || !self->runs) {
        rat_local(self, wild, km);
    }
    const int32_t waits = pcl2_awaits(&self->patience, bad || !remote, bk, kr, self->k);
    if (!waits) {
        self->k = pcl2_limited(kr, self->least, self->most);
    }
    const int32_t own = runs ? rat_follow(self, wild, waits ? self->k : kr) : PCL2_FOLLOWING;
    if (waits) {
        self->actual = bad || !remote ? self->actual : PCL2_INIT;
        pcl2_hand_back(bk, self->k, PCL2_WAITING);
    } else {
        rat_hand_on(self, wild, own, back, bk);
    }
    self->runs = runs;
    self->started = 1;
}
