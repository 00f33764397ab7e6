/* Lead-lag, washout and filtered derivative (Astrom and Wittenmark, Computer-Controlled Systems, ch. 8;
 * Astrom and Hagglund, Advanced PID Control, 2006, ch. 13). */
#include "pcl2_leadlag.h"
#include "pcl2_sum.h"

PCL2_KERNEL void pcl2_leadlag_init(struct pcl2_leadlag *self, pcl2_real k, pcl2_real T1, pcl2_real T2)
{
    (void)k;
    (void)T1;
    (void)T2;
    self->started = 0;
}

/* Tustin's rule as increments: g = T/(T2 + T/2), b = k (T1 - T/2)/(T2 + T/2). */
PCL2_KERNEL void pcl2_leadlag_tune(struct pcl2_leadlag *self, pcl2_real k, pcl2_real T1, pcl2_real T2, int64_t T)
{
    const pcl2_real h = pcl2_seconds(T);
    const pcl2_real half = h / 2;
    const pcl2_real lag = (T2 > half ? T2 : half) + half;
    self->gain = k;
    self->g = h / lag;
    self->b = k * ((T1 - half) / lag);
}

PCL2_KERNEL void pcl2_leadlag(struct pcl2_leadlag *self, pcl2_real x, int32_t trk, pcl2_real xt)
{
    const pcl2_real x1 = self->seeded != 0 ? self->x1 : x;
    pcl2_real carry = trk != 0 || self->started == 0 ? PCL2_R(0.0) : self->carry;
    pcl2_real y = xt;
    if (trk == 0) {
        const pcl2_real rest = self->gain * x;
        y = self->started != 0 ? pcl2_sum(self->y, self->g * (rest - self->y) + self->b * (x - x1), &carry) : rest;
    }
    self->seeded = !pcl2_is_bad(x);
    self->x1 = self->seeded ? x : PCL2_R(0.0);
    if (!pcl2_is_bad(y)) {
        self->y = y;
        self->carry = carry;
        self->started = 1;
    }
}

PCL2_KERNEL void pcl2_washout_init(struct pcl2_washout *self, pcl2_real Tw)
{
    (void)Tw;
    self->seeded = 0;
}

PCL2_KERNEL void pcl2_washout_tune(struct pcl2_washout *self, pcl2_real Tw, int64_t T)
{
    const pcl2_real h = pcl2_seconds(T);
    self->g = h / (Tw + h);
}

PCL2_KERNEL void pcl2_washout(struct pcl2_washout *self, pcl2_real x)
{
    const pcl2_real rise = x - (self->seeded != 0 ? self->x1 : x);
    pcl2_real carry = self->carry;
    const pcl2_real y = pcl2_sum(self->y, rise - self->g * (self->y + rise), &carry);
    self->seeded = !pcl2_is_bad(x);
    self->x1 = self->seeded ? x : PCL2_R(0.0);
    if (!pcl2_is_bad(y)) {
        self->y = y;
        self->carry = carry;
    }
}

PCL2_KERNEL void pcl2_deriv_init(struct pcl2_deriv *self, pcl2_real Td, pcl2_real N)
{
    (void)Td;
    (void)N;
    self->seeded = 0;
}

PCL2_KERNEL void pcl2_deriv_tune(struct pcl2_deriv *self, pcl2_real Td, pcl2_real N, int64_t T)
{
    const pcl2_real lag = Td / N + pcl2_seconds(T);
    self->a = Td / N / lag;
    self->b = Td / lag;
}

PCL2_KERNEL void pcl2_deriv(struct pcl2_deriv *self, pcl2_real x)
{
    const int32_t good = !pcl2_is_bad(x);
    const pcl2_real y = self->a * self->y + self->b * (x - (self->seeded != 0 ? self->x1 : x));
    self->y = pcl2_is_bad(y) ? self->y : y;
    self->seeded = good;
    self->x1 = good ? x : PCL2_R(0.0);
}
