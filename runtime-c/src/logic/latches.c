/* Latches (IEC 61131-3, SR and RS), a trip latch, a remote control memory. */
#include "pcl2_latches.h"

PCL2_KERNEL void pcl2_sr(struct pcl2_sr *self, int32_t s, int32_t r)
{
    self->q = (s != 0) | (self->q & (r == 0));
}

PCL2_KERNEL void pcl2_rs(struct pcl2_rs *self, int32_t s, int32_t r)
{
    self->q = (r == 0) & ((s != 0) | self->q);
}

PCL2_KERNEL void pcl2_trip_init(struct pcl2_trip *self)
{
    (void)self;
}

PCL2_KERNEL void pcl2_trip(struct pcl2_trip *self, int32_t x, int32_t rst, int32_t perm)
{
    const int32_t edge = (rst != 0) & (self->last == 0) & self->started;
    const int32_t reset = edge & (perm != 0);
    self->q = (x != 0) | (self->q & !reset);
    self->last = rst;
    self->started = 1;
}

PCL2_KERNEL void pcl2_rcm_init(struct pcl2_rcm *self, int32_t mode)
{
    (void)self;
    (void)mode;
}

PCL2_KERNEL void pcl2_rcm(struct pcl2_rcm *self, int32_t set, int32_t rst, int32_t fb, int32_t ovr, int32_t mode)
{
    const int32_t on = (set != 0) & (self->lastset == 0) & self->started;
    const int32_t off = (rst != 0) & (self->lastrst == 0) & self->started;
    const int32_t stays = self->q & !off;
    const int32_t remote = mode != 0 ? on | stays : (on & !off) | stays;
    self->q = ovr != 0 ? fb != 0 : remote;
    self->lastset = set;
    self->lastrst = rst;
    self->started = 1;
}
