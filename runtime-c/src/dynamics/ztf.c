/* Transfer function in z, clamped (Astrom and Wittenmark, Computer-Controlled Systems, ch. 2). */
#include "pcl2_ztf.h"
#include "pcl2_math.h"

PCL2_KERNEL void pcl2_ztf_init(
    struct pcl2_ztf *self, int32_t na, int32_t nb, int32_t d, const pcl2_real *a, const pcl2_real *b, pcl2_real lo,
    pcl2_real hi, pcl2_real *ys, pcl2_real *xs)
{
    (void)na;
    (void)nb;
    (void)d;
    (void)a;
    (void)b;
    (void)lo;
    (void)hi;
    (void)ys;
    (void)xs;
    self->started = 0;
}

static pcl2_real pcl2_ztf_clamp(pcl2_real y, pcl2_real lo, pcl2_real hi)
{
    return y > hi ? hi : y < lo ? lo : y;
}

/* The output at rest at x; 0 where there is none. */
static pcl2_real pcl2_ztf_rest(pcl2_real x, int32_t na, int32_t nb, const pcl2_real *a, const pcl2_real *b)
{
    pcl2_real den = PCL2_R(1.0);
    pcl2_real size = PCL2_R(1.0);
    pcl2_real num = PCL2_R(0.0);
    for (int32_t i = 0; i < na; i++) {
        den += a[i];
        size += pcl2_math_fabs(a[i]);
    }
    for (int32_t j = 0; j < nb; j++) {
        num += b[j];
    }
    const pcl2_real y = x * num / den;
    return pcl2_math_fabs(den) <= 16 * PCL2_REAL_EPSILON * size || pcl2_is_bad(y) ? PCL2_R(0.0) : y;
}

static void pcl2_ztf_fill(int32_t n, pcl2_real value, pcl2_real *values)
{
    for (int32_t i = 0; i < n; i++) {
        values[i] = value;
    }
}

/* at is where x(k) goes in the ring xs; x(k - 1) stands one before. */
static pcl2_real pcl2_ztf_sum(
    int32_t at, int32_t na, int32_t nb, int32_t d, const pcl2_real *a, const pcl2_real *b, const pcl2_real *ys,
    const pcl2_real *xs)
{
    const int32_t length = nb + d;
    int32_t slot = at - d;
    pcl2_real sum = PCL2_R(0.0);
    for (int32_t j = 0; j < nb; j++) {
        slot += slot < 0 ? length : 0;
        sum += b[j] * xs[slot];
        slot--;
    }
    for (int32_t i = 0; i < na; i++) {
        sum -= a[i] * ys[i];
    }
    return sum;
}

PCL2_KERNEL void pcl2_ztf(
    struct pcl2_ztf *self, pcl2_real x, int32_t na, int32_t nb, int32_t d, const pcl2_real *a, const pcl2_real *b,
    pcl2_real lo, pcl2_real hi, pcl2_real *ys, pcl2_real *xs)
{
    if (pcl2_is_bad(x)) {
        return;
    }
    if (PCL2_RARELY(self->started == 0)) {
        pcl2_ztf_fill(na, pcl2_ztf_clamp(pcl2_ztf_rest(x, na, nb, a, b), lo, hi), ys);
        pcl2_ztf_fill(nb + d, x, xs);
        self->started = 1;
    }
    const pcl2_real oldest = xs[self->at];
    xs[self->at] = x;
    const pcl2_real y = pcl2_ztf_clamp(pcl2_ztf_sum(self->at, na, nb, d, a, b, ys, xs), lo, hi);
    if (pcl2_is_bad(y)) {
        xs[self->at] = oldest;
        return;
    }
    for (int32_t i = na - 1; i > 0; i--) {
        ys[i] = ys[i - 1];
    }
    if (na > 0) {
        ys[0] = y;
    }
    self->at = self->at + 1 < nb + d ? self->at + 1 : 0;
    self->y = y;
}
