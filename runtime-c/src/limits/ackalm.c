/* Alarm sequences A, M and R of ISA-18.1. */
#include "pcl2_ackalm.h"

/* What state says; the lamp shows it: off, flashing, steady, flashing slowly. */
enum { ACKALM_NORMAL = 0, ACKALM_ALARM = 1, ACKALM_ACKNOWLEDGED = 2, ACKALM_RINGBACK = 3, ACKALM_LATCHED = 4 };

/* The values of latch. */
enum { ACKALM_AUTOMATIC = 0, ACKALM_MANUAL = 1 };

PCL2_KERNEL void pcl2_ackalm_init(struct pcl2_ackalm *self, int32_t latch)
{
    (void)self;
    (void)latch;
}

/* The state that an acknowledged alarm that has gone leaves. */
static inline int32_t pcl2_ackalm_gone(int32_t latch)
{
    return latch == ACKALM_AUTOMATIC ? ACKALM_NORMAL : latch == ACKALM_MANUAL ? ACKALM_LATCHED : ACKALM_RINGBACK;
}

PCL2_KERNEL void pcl2_ackalm(struct pcl2_ackalm *self, int32_t in, int32_t ack, int32_t rst, int32_t latch)
{
    const int32_t acknowledges = (ack != 0) & (self->lastack == 0) & self->started;
    const int32_t resets = (rst != 0) & (self->lastrst == 0) & self->started;
    int32_t state = self->state;
    if (state == ACKALM_ALARM && acknowledges) {
        state = ACKALM_ACKNOWLEDGED;
    }
    if (state == ACKALM_ACKNOWLEDGED && in == 0) {
        state = pcl2_ackalm_gone(latch);
    } else if ((state == ACKALM_RINGBACK || state == ACKALM_LATCHED) && resets) {
        state = ACKALM_NORMAL;
    }
    if (state != ACKALM_ALARM && state != ACKALM_ACKNOWLEDGED && in != 0) {
        state = ACKALM_ALARM;
    }
    self->state = state;
    self->unack = state == ACKALM_ALARM;
    self->lamp = state == ACKALM_LATCHED ? ACKALM_ACKNOWLEDGED : state;
    self->horn = state == ACKALM_ALARM;
    self->lastack = ack;
    self->lastrst = rst;
    self->started = 1;
}
