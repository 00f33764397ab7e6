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
    const pcl2_real x = source == ATRANS_B ? b : a;
    if (source == self->source) {
        self->left = pcl2_atrans_later(self->left, self->tick, self->total);
        const pcl2_real y = x + self->offset * ((pcl2_real)self->left * self->scale);
        self->y = self->left > 0 && !pcl2_is_bad(y) ? y : x;
        return;
    }
    const pcl2_real offset = self->y - x;
    const int32_t ramp = self->source != ATRANS_NOTHING && self->total > 0 && !pcl2_is_bad(offset);
    self->source = source;
    self->left = ramp ? self->total : 0;
    self->offset = ramp ? offset : PCL2_R(0.0);
    self->y = ramp ? self->y : x;
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
