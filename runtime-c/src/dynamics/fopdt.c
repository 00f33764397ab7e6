/* First- and second-order plants with dead time (Astrom and Wittenmark, Computer-Controlled Systems, ch. 2). */
#include "pcl2_fopdt.h"
#include "pcl2_math.h"
#include "pcl2_sum.h"

/* Splits td into whole periods, at most nmax, and a fraction of one. */
static pcl2_real pcl2_fopdt_split(pcl2_real td, int64_t T, int32_t nmax, int32_t *whole)
{
    const pcl2_real periods = td / pcl2_seconds(T);
    if (!(periods < (pcl2_real)nmax)) {
        *whole = nmax;
        return PCL2_R(0.0);
    }
    *whole = (int32_t)periods;
    return periods - (pcl2_real)*whole;
}

static int32_t pcl2_fopdt_late(pcl2_real td, int64_t T, int32_t nmax, pcl2_real *left)
{
    const pcl2_real most = pcl2_seconds(T) * (pcl2_real)nmax;
    left[0] = td;
    left[1] = most;
    return td > most * (1 + 4 * PCL2_REAL_EPSILON);
}

/* u(k - i), i up to n; at is where the oldest sample, u(k - n), stands. */
static pcl2_real pcl2_fopdt_past(int32_t n, int32_t at, const pcl2_real *ring, pcl2_real u, int32_t i)
{
    const int32_t slot = at - i;
    return i == 0 ? u : ring[slot < 0 ? slot + n : slot];
}

/* Puts u in the place of the oldest sample. */
static int32_t pcl2_fopdt_push(int32_t n, int32_t at, pcl2_real *ring, pcl2_real u)
{
    ring[at] = u;
    return at + 1 < n ? at + 1 : 0;
}

static void pcl2_fopdt_fill(int32_t n, pcl2_real u, pcl2_real *ring)
{
    for (int32_t i = 0; i < n; i++) {
        ring[i] = u;
    }
}

PCL2_KERNEL int32_t pcl2_fopdt_check(
    int32_t nmax, pcl2_real k, pcl2_real tau, pcl2_real td, int64_t T, pcl2_real *left)
{
    (void)k;
    (void)tau;
    return pcl2_fopdt_late(td, T, nmax, left);
}

PCL2_KERNEL void pcl2_fopdt_init(
    struct pcl2_fopdt *self, int32_t nmax, pcl2_real k, pcl2_real tau, pcl2_real td, pcl2_real *ring)
{
    (void)nmax;
    (void)k;
    (void)tau;
    (void)td;
    (void)ring;
    self->started = 0;
}

/* T/tau, bounded so that no product of it is lost. */
static pcl2_real pcl2_fopdt_rate(pcl2_real tau, int64_t T)
{
    const pcl2_real most = PCL2_R(1e18);
    const pcl2_real h = pcl2_seconds(T);
    return h < most * tau ? h / tau : most;
}

PCL2_KERNEL void pcl2_fopdt_tune(
    struct pcl2_fopdt *self, int32_t nmax, pcl2_real k, pcl2_real tau, pcl2_real td, int64_t T)
{
    const pcl2_real rate = pcl2_fopdt_rate(tau, T);
    const pcl2_real f = pcl2_fopdt_split(td, T, nmax, &self->d);
    self->gain = k;
    self->g = -pcl2_math_expm1(-rate);
    self->w = self->g > PCL2_R(0.0) ? -pcl2_math_expm1(-(1 - f) * rate) / self->g : 1 - f;
}

PCL2_KERNEL void pcl2_fopdt(struct pcl2_fopdt *self, pcl2_real u, int32_t nmax, pcl2_real *ring)
{
    if (pcl2_is_bad(u)) {
        return;
    }
    if (PCL2_RARELY(self->started == 0)) {
        pcl2_fopdt_fill(nmax, u, ring);
        self->y = pcl2_is_bad(self->gain * u) ? PCL2_R(0.0) : self->gain * u;
        self->started = 1;
    }
    pcl2_real carry = self->carry;
    const int32_t before = self->d < nmax ? self->d + 1 : nmax;
    const pcl2_real late = pcl2_fopdt_past(nmax, self->at, ring, u, self->d);
    const pcl2_real later = pcl2_fopdt_past(nmax, self->at, ring, u, before);
    const pcl2_real v = self->gain * (self->w * late + (1 - self->w) * later);
    const pcl2_real y = pcl2_sum(self->y, self->g * (v - self->y), &carry);
    self->at = pcl2_fopdt_push(nmax, self->at, ring, u);
    if (!pcl2_is_bad(y)) {
        self->y = y;
        self->carry = carry;
    }
}

PCL2_KERNEL int32_t pcl2_sopdt_check(
    int32_t nmax, pcl2_real k, pcl2_real tau1, pcl2_real tau2, pcl2_real td, int64_t T, pcl2_real *left)
{
    (void)k;
    (void)tau1;
    (void)tau2;
    return pcl2_fopdt_late(td, T, nmax, left);
}

PCL2_KERNEL void pcl2_sopdt_init(
    struct pcl2_sopdt *self, int32_t nmax, pcl2_real k, pcl2_real tau1, pcl2_real tau2, pcl2_real td, pcl2_real *ring,
    pcl2_real *early, pcl2_real *late)
{
    (void)nmax;
    (void)k;
    (void)tau1;
    (void)tau2;
    (void)td;
    (void)ring;
    (void)early;
    (void)late;
    self->started = 0;
}

/* 1 - e^-a, 1 - e^-b and c = b (e^-a - e^-b)/(b - a) of a step that is a times tau1 and b times tau2 long. */
static void pcl2_sopdt_step(pcl2_real a, pcl2_real b, pcl2_real *step)
{
    const pcl2_real less = a < b ? a : b;
    const pcl2_real gap = pcl2_math_fabs(b - a);
    const pcl2_real mean = gap > PCL2_R(0.0) ? -pcl2_math_expm1(-gap) / gap : PCL2_R(1.0);
    step[0] = -pcl2_math_expm1(-a);
    step[1] = -pcl2_math_expm1(-b);
    step[2] = b * mean * pcl2_math_exp(-less);
}

PCL2_KERNEL void pcl2_sopdt_tune(
    struct pcl2_sopdt *self, int32_t nmax, pcl2_real k, pcl2_real tau1, pcl2_real tau2, pcl2_real td, int64_t T,
    pcl2_real *early, pcl2_real *late)
{
    const pcl2_real a = pcl2_fopdt_rate(tau1, T);
    const pcl2_real b = pcl2_fopdt_rate(tau2, T);
    const pcl2_real f = pcl2_fopdt_split(td, T, nmax, &self->d);
    self->gain = k;
    pcl2_sopdt_step(f * a, f * b, early);
    pcl2_sopdt_step((1 - f) * a, (1 - f) * b, late);
}

/* One step of both lags towards v; keeps nothing and returns 0 when the range is left. */
static int32_t pcl2_sopdt_move(struct pcl2_sopdt *self, const pcl2_real *step, pcl2_real v)
{
    pcl2_real carry_x = self->carry_x;
    pcl2_real carry_y = self->carry_y;
    const pcl2_real x = pcl2_sum(self->x, step[0] * (v - self->x), &carry_x);
    const pcl2_real y = pcl2_sum(self->y, step[1] * (v - self->y) + step[2] * (self->x - v), &carry_y);
    if (pcl2_is_bad(x) || pcl2_is_bad(y)) {
        return 0;
    }
    self->x = x;
    self->y = y;
    self->carry_x = carry_x;
    self->carry_y = carry_y;
    return 1;
}

PCL2_KERNEL void pcl2_sopdt(
    struct pcl2_sopdt *self, pcl2_real u, int32_t nmax, pcl2_real *ring, const pcl2_real *early, const pcl2_real *late)
{
    if (pcl2_is_bad(u)) {
        return;
    }
    if (PCL2_RARELY(self->started == 0)) {
        pcl2_fopdt_fill(nmax, u, ring);
        self->x = self->y = pcl2_is_bad(self->gain * u) ? PCL2_R(0.0) : self->gain * u;
        self->started = 1;
    }
    const int32_t before = self->d < nmax ? self->d + 1 : nmax;
    const pcl2_real v = self->gain * pcl2_fopdt_past(nmax, self->at, ring, u, self->d);
    if (pcl2_sopdt_move(self, early, self->gain * pcl2_fopdt_past(nmax, self->at, ring, u, before))) {
        pcl2_sopdt_move(self, late, v);
    }
    self->at = pcl2_fopdt_push(nmax, self->at, ring, u);
}
