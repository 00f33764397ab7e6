/* Transfers between two signals. left is what is left of the ramp, offset what it began with. */
#include "pcl2_atrans.h"
#include "pcl2_timing.h"

enum { ATRANS_NOTHING = 0, ATRANS_A = 1, ATRANS_B = 2 };
enum { ATRANS_OTHER_TAKEN = 1, ATRANS_NONE_GOOD = 2 };

static inline int64_t pcl2_atrans_later(int64_t left, int64_t tick, int64_t total)
{
    const int64_t rest = left < total ? left : total;
    return rest > tick ? rest - tick : 0;
}

static inline pcl2_real pcl2_atrans_scale(int64_t total)
{
    return total > 0 ? PCL2_R(1.0) / (pcl2_real)total : PCL2_R(0.0);
}

/* What tune leaves for the ramp. */
struct pcl2_atrans_ramp {
    int64_t total;
    int64_t tick;
    pcl2_real scale;
};

/* The output one scan later, when the signal x of the source is taken; last is the source before. */
static inline pcl2_real pcl2_atrans_go(struct pcl2_atrans_ramp ramp, pcl2_real y, pcl2_real x, int32_t source,
                                       int32_t last, int64_t *left, pcl2_real *offset)
{
    if (source == last) {
        *left = pcl2_atrans_later(*left, ramp.tick, ramp.total);
        const pcl2_real between = x + *offset * ((pcl2_real)*left * ramp.scale);
        return *left > 0 && !pcl2_is_bad(between) ? between : x;
    }
    const pcl2_real distance = y - x;
    const int32_t goes = last != ATRANS_NOTHING && ramp.total > 0 && !pcl2_is_bad(distance);
    *left = goes ? ramp.total : 0;
    *offset = goes ? distance : PCL2_R(0.0);
    return goes ? y : x;
}

PCL2_KERNEL void pcl2_atrans_tune(struct pcl2_atrans *self, pcl2_real trate, int64_t T)
{
    self->total = pcl2_set_time(trate, T);
    self->tick = T;
    self->scale = pcl2_atrans_scale(self->total);
}

PCL2_KERNEL void pcl2_atrans_init(struct pcl2_atrans *self, pcl2_real trate)
{
    (void)self;
    (void)trate;
}

PCL2_KERNEL void pcl2_atrans(struct pcl2_atrans *self, pcl2_real a, pcl2_real b, int32_t s)
{
    const int32_t wanted = s != 0 ? ATRANS_B : ATRANS_A;
    const int32_t skipped = pcl2_is_bad(s != 0 ? b : a);
    const int32_t source = !skipped ? wanted : pcl2_is_bad(s != 0 ? a : b) ? ATRANS_NOTHING : 3 - wanted;
    self->status = source == wanted ? 0 : source == ATRANS_NOTHING ? ATRANS_NONE_GOOD : ATRANS_OTHER_TAKEN;
    if (source == ATRANS_NOTHING) {
        return;
    }
    const struct pcl2_atrans_ramp ramp = {self->total, self->tick, self->scale};
    self->y = pcl2_atrans_go(ramp, self->y, source == ATRANS_B ? b : a, source, self->source, &self->left, &self->offset);
    self->source = source;
}

enum { REDAI_SPARE = 1, REDAI_HELD = 2, REDAI_DEVIATION = 3 };

PCL2_KERNEL void pcl2_redai_tune(struct pcl2_redai *self, pcl2_real dev, int32_t autosw, pcl2_real trate, int64_t T)
{
    self->apart = dev;
    self->swaps = autosw;
    self->total = pcl2_set_time(trate, T);
    self->tick = T;
    self->scale = pcl2_atrans_scale(self->total);
}

PCL2_KERNEL void pcl2_redai_init(struct pcl2_redai *self, pcl2_real dev, int32_t autosw, pcl2_real trate)
{
    (void)self;
    (void)dev;
    (void)autosw;
    (void)trate;
}

/* The source to take: the chosen one, or the spare as long as it was taken for it; nothing when that is bad. */
static inline int32_t pcl2_redai_source(const struct pcl2_redai *self, int32_t chosen, int32_t good_a, int32_t good_b)
{
    const int32_t stays = self->swaps != 0 && chosen == self->choice && self->source != ATRANS_NOTHING;
    const int32_t source = stays ? self->source : chosen;
    if (source == ATRANS_B ? good_b : good_a) {
        return source;
    }
    const int32_t other_good = source == ATRANS_B ? good_a : good_b;
    return self->swaps != 0 && other_good ? 3 - source : ATRANS_NOTHING;
}

PCL2_KERNEL void pcl2_redai(struct pcl2_redai *self, pcl2_real a, pcl2_real b, int32_t sel)
{
    const int32_t good_a = !pcl2_is_bad(a);
    const int32_t good_b = !pcl2_is_bad(b);
    const int32_t chosen = sel != 0 ? ATRANS_B : ATRANS_A;
    const int32_t source = pcl2_redai_source(self, chosen, good_a, good_b);
    const pcl2_real distance = a < b ? b - a : a - b;
    self->choice = chosen;
    self->dv = good_a && good_b && self->apart > PCL2_R(0.0) && distance > self->apart;
    self->st = source == ATRANS_NOTHING ? 2 : source - 1;
    self->status = source == ATRANS_NOTHING ? REDAI_HELD : source != chosen ? REDAI_SPARE : self->dv ? REDAI_DEVIATION : 0;
    if (source != ATRANS_NOTHING) {
        const struct pcl2_atrans_ramp ramp = {self->total, self->tick, self->scale};
        self->y = pcl2_atrans_go(ramp, self->y, source == ATRANS_B ? b : a, source, self->source, &self->left,
                                 &self->offset);
        self->source = source;
    }
}

PCL2_KERNEL void pcl2_itrans_tune(struct pcl2_itrans *self, pcl2_real trate, int64_t T)
{
    self->total = pcl2_set_time(trate, T);
    self->tick = T;
    self->scale = pcl2_atrans_scale(self->total);
}

PCL2_KERNEL void pcl2_itrans_init(struct pcl2_itrans *self, pcl2_real trate)
{
    (void)self;
    (void)trate;
}

PCL2_KERNEL void pcl2_itrans(struct pcl2_itrans *self, int32_t a, int32_t b, int32_t s)
{
    const int32_t source = s != 0 ? ATRANS_B : ATRANS_A;
    const int32_t x = s != 0 ? b : a;
    if (source == self->source) {
        /* At most 2^32 on either side: an int64_t holds it and its sum with x. */
        self->left = pcl2_atrans_later(self->left, self->tick, self->total);
        const pcl2_real more = self->offset * ((pcl2_real)self->left * self->scale);
        const pcl2_real half = more < PCL2_R(0.0) ? PCL2_R(-0.5) : PCL2_R(0.5);
        self->y = pcl2_saturate_i((int64_t)x + (int64_t)(more + half));
        return;
    }
    const int32_t ramp = self->source != ATRANS_NOTHING && self->total > 0;
    self->source = source;
    self->left = ramp ? self->total : 0;
    self->offset = (pcl2_real)self->y - (pcl2_real)x;
    self->y = ramp ? self->y : x;
}
