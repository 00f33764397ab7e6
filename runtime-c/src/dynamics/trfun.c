/* Transfer function by one classical Runge-Kutta step of order 4 a scan, u held at its present value
 * (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.1). */
#include "pcl2_trfun.h"
#include "pcl2_math.h"
#include "pcl2_polyroots.h"
#include "pcl2_transfer.h"

/* y = C x0: u is not known yet. */
PCL2_KERNEL void pcl2_trfun_init(
    struct pcl2_trfun *self, int32_t nden, int32_t nnum, int32_t nx, const pcl2_real *den, const pcl2_real *num,
    const pcl2_real *x0, pcl2_real *x, pcl2_real *a, pcl2_real *c)
{
    (void)nden;
    (void)nnum;
    (void)den;
    (void)num;
    (void)a;
    for (int32_t i = 0; i < nx; i++) {
        x[i] = x0[i];
    }
    self->y = pcl2_transfer_output(nx, c, x);
}

PCL2_KERNEL void pcl2_trfun_tune(
    struct pcl2_trfun *self, int32_t nden, int32_t nnum, int32_t nx, const pcl2_real *den, const pcl2_real *num,
    int64_t T, pcl2_real *a, pcl2_real *c)
{
    (void)nx;
    self->h = pcl2_seconds(T);
    self->d = pcl2_transfer(nden, nnum, den, num, a, c);
}

/* |1 + z + z^2/2 + z^3/6 + z^4/24|^2, the growth of a mode in one step, squared (Horner's rule). */
static pcl2_real pcl2_trfun_growth(pcl2_real re, pcl2_real im)
{
    pcl2_real p = PCL2_R(1.0);
    pcl2_real q = PCL2_R(0.0);
    for (int32_t k = 4; k > 0; k--) {
        const pcl2_real next = PCL2_R(1.0) + (p * re - q * im) / (pcl2_real)k;
        q = (p * im + q * re) / (pcl2_real)k;
        p = next;
    }
    return p * p + q * q;
}

/* Judges the poles: 1 with the worst one in left, when the plant does not grow by it and the step does.
 * A computed pole carries rounding errors, hence the margins; they vanish beside 1e-9 in double. */
PCL2_KERNEL int32_t pcl2_trfun_check(
    int32_t nden, int32_t nnum, int32_t nx, const pcl2_real *den, const pcl2_real *num, const pcl2_real *x0,
    int64_t T, pcl2_real *left)
{
    const pcl2_real h = pcl2_seconds(T);
    const pcl2_real margin = PCL2_R(1e-9) + 64 * PCL2_REAL_EPSILON;
    const pcl2_real limit = PCL2_R(1.0) + PCL2_R(1e-9) + 8 * PCL2_REAL_EPSILON;
    pcl2_real re[PCL2_POLYROOTS_MAX];
    pcl2_real im[PCL2_POLYROOTS_MAX];
    pcl2_real worst = limit * limit;
    int32_t fault = 0;
    (void)nnum;
    (void)nx;
    (void)num;
    (void)x0;
    pcl2_polyroots(nden, den, re, im);
    for (int32_t i = 0; i < nden; i++) {
        const pcl2_real growth = pcl2_trfun_growth(h * re[i], h * im[i]);
        const pcl2_real size = pcl2_math_fabs(re[i]) + pcl2_math_fabs(im[i]);
        if (re[i] <= margin * size && !(growth <= worst)) {
            worst = growth;
            left[0] = re[i];
            left[1] = pcl2_math_fabs(im[i]);
            fault = 1;
        }
    }
    return fault;
}

static void pcl2_trfun_slope(int32_t n, pcl2_real u, const pcl2_real *a, const pcl2_real *x, pcl2_real *slope)
{
    for (int32_t i = 0; i < n - 1; i++) {
        slope[i] = x[i + 1];
    }
    slope[n - 1] = u - pcl2_transfer_output(n, a, x);
}

PCL2_KERNEL void pcl2_trfun(
    struct pcl2_trfun *self, pcl2_real u, int32_t nden, int32_t nnum, int32_t nx, pcl2_real *x, const pcl2_real *a,
    const pcl2_real *c, pcl2_real *slope, pcl2_real *point, pcl2_real *next)
{
    static const pcl2_real weight[4] = {PCL2_R(1.0), PCL2_R(2.0), PCL2_R(2.0), PCL2_R(1.0)};
    static const pcl2_real advance[4] = {PCL2_R(0.5), PCL2_R(0.5), PCL2_R(1.0), PCL2_R(0.0)};
    (void)nden;
    (void)nnum;
    self->status = 0;
    if (pcl2_is_bad(u)) {
        return;
    }
    for (int32_t i = 0; i < nx; i++) {
        point[i] = x[i];
        next[i] = PCL2_R(0.0);
    }
    for (int32_t stage = 0; stage < 4; stage++) {
        pcl2_trfun_slope(nx, u, a, point, slope);
        for (int32_t i = 0; i < nx; i++) {
            next[i] += weight[stage] * slope[i];
            point[i] = x[i] + advance[stage] * self->h * slope[i];
        }
    }
    for (int32_t i = 0; i < nx; i++) {
        next[i] = x[i] + self->h / PCL2_R(6.0) * next[i];
    }
    const pcl2_real y = pcl2_transfer_output(nx, c, next) + self->d * u;
    if (pcl2_transfer_accept(nx, y, next, x)) {
        self->y = y;
    } else {
        self->status = 2;
    }
}
