/* gdc: general digital controller.
 *
 * past:   u - ff of the scans before, the latest first
 * errors: e(k), e(k-1) .. e(k-d-nb+1) */
#include "pcl2_gdc.h"
#include "pcl2_station.h"

enum { GDC_SIGNAL = 1, GDC_TRACKED = 2, GDC_FORWARD = 3 };

PCL2_KERNEL void pcl2_gdc_init(struct pcl2_gdc *self, int32_t na, int32_t nb, int32_t d, const pcl2_real *a,
                               const pcl2_real *b, pcl2_real lo, pcl2_real hi, pcl2_real *past, pcl2_real *errors,
                               pcl2_real *bk)
{
    (void)self;
    (void)na;
    (void)nb;
    (void)d;
    (void)a;
    (void)b;
    (void)lo;
    (void)hi;
    (void)past;
    (void)errors;
    (void)bk;
}

/* No memory of what left the reals. */
static pcl2_real gdc_finite(pcl2_real x)
{
    return pcl2_is_bad(x) ? PCL2_R(0.0) : x;
}

static void gdc_fill(int32_t n, pcl2_real value, pcl2_real *values)
{
    for (int32_t i = 0; i < n; ++i) {
        values[i] = value;
    }
}

/* Lets the newest in; nothing where there is no place. */
static void gdc_shift(int32_t n, pcl2_real newest, pcl2_real *values)
{
    for (int32_t i = n - 1; i > 0; --i) {
        values[i] = values[i - 1];
    }
    if (n > 0) {
        values[0] = newest;
    }
}

static pcl2_real gdc_sum(int32_t na, int32_t nb, const pcl2_real *a, const pcl2_real *b, const pcl2_real *past,
                         const pcl2_real *errors)
{
    pcl2_real sum = PCL2_R(0.0);
    for (int32_t j = 0; j < nb; ++j) {
        sum += b[j] * errors[j];
    }
    for (int32_t i = 0; i < na; ++i) {
        sum -= a[i] * past[i];
    }
    return sum;
}

/* The last good feed-forward. */
static pcl2_real gdc_forward(struct pcl2_gdc *self, pcl2_real ff)
{
    self->status = pcl2_is_bad(ff) ? GDC_FORWARD : 0;
    self->ff1 = pcl2_is_bad(ff) ? self->ff1 : ff;
    return self->ff1;
}

/* The master hears to which set-point it shall come. */
static void gdc_ask(struct pcl2_gdc *self, pcl2_real w, pcl2_real *bk)
{
    if (self->started == 0) {
        pcl2_hand_back(bk, w, PCL2_FOLLOWING);
        return;
    }
    self->asked = self->y1;
    self->patience = PCL2_PATIENCE;
    pcl2_hand_back(bk, self->asked, PCL2_WAITING);
}

/* The master hears what its w does; rises is 1 where a larger one asks for a larger u. */
static void gdc_answer(const struct pcl2_gdc *self, pcl2_real w, int32_t own, int32_t told, int32_t nb,
                       const pcl2_real *b, pcl2_real *bk)
{
    const int32_t state = own == PCL2_FOLLOWING ? told : own;
    pcl2_real gain = PCL2_R(0.0);
    for (int32_t j = 0; j < nb; ++j) {
        gain += b[j];
    }
    if (self->patience > 0) {
        pcl2_hand_back(bk, w, PCL2_WAITING);
    } else {
        pcl2_hand_back(bk, w, gain < PCL2_R(0.0) ? pcl2_return_reversed(state) : state);
    }
}

/* u comes from elsewhere. */
static void gdc_place(struct pcl2_gdc *self, pcl2_real u, pcl2_real ff, int32_t na, pcl2_real *past)
{
    self->u = u;
    gdc_fill(na, gdc_finite(u - ff), past);
}

PCL2_KERNEL void pcl2_gdc(struct pcl2_gdc *self, pcl2_real y, pcl2_real w, pcl2_real trk, int32_t rel, pcl2_real ff,
                          int32_t na, int32_t nb, int32_t d, const pcl2_real *back, const pcl2_real *a,
                          const pcl2_real *b, pcl2_real lo, pcl2_real hi, pcl2_real *past, pcl2_real *errors,
                          pcl2_real *bk)
{
    const int32_t told = pcl2_return_state(back);
    const pcl2_real forward = gdc_forward(self, ff);
    const int32_t bad = pcl2_is_bad(w - y);
    const int32_t free = told != PCL2_WAITING && rel != 0;
    if (!bad && self->started == 0) {
        gdc_fill(nb + d, w - y, errors);
        gdc_place(self, pcl2_within_or(trk, lo, hi, lo), forward, na, past);
    }
    self->started = self->started || !bad;
    self->y1 = bad ? self->y1 : y;
    self->status = bad ? GDC_SIGNAL : self->status;
    const int32_t waits = pcl2_awaits(&self->patience, bad || !free, bk, w, self->asked);
    const pcl2_real set = waits && free && !bad ? self->asked : w;
    if (!bad) {
        gdc_shift(nb + d, gdc_finite(set - y), errors);
    }
    if (!free) {
        self->status = told != PCL2_WAITING && pcl2_is_bad(trk) ? GDC_TRACKED : self->status;
        gdc_place(self, told == PCL2_WAITING ? back[0] : pcl2_within_or(trk, lo, hi, self->u), forward, na, past);
        self->actual = told == PCL2_WAITING ? PCL2_INIT : PCL2_TRACK;
    }
    if (bad || !free) {
        gdc_ask(self, w, bk);
        return;
    }
    self->actual = PCL2_AUTO;
    if (na > 0 && (told == PCL2_LIMITED_HIGH ? back[0] < self->u : told == PCL2_LIMITED_LOW && back[0] > self->u)) {
        past[0] = gdc_finite(past[0] + back[0] - self->u);
    }
    const pcl2_real v = gdc_sum(na, nb, a, b, past, errors + d) + forward;
    self->u = pcl2_within_or(v, lo, hi, self->u);
    gdc_shift(na, gdc_finite(self->u - forward), past);
    gdc_answer(self, set, pcl2_stopped(v, self->u), told, nb, b, bk);
}
