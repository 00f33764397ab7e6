/* gpc1, gpc2, gpcn: generalised predictive control.
 *
 * D. W. Clarke, C. Mohtadi, P. S. Tuffs, "Generalized Predictive Control, Part I: The Basic Algorithm",
 * Automatica 23 (1987) 137-148.  Model  A y(t) = B u(t-1-d) + noise/(1 - z^-1)  with
 * A = 1 - a1 z^-1 - .. and p = (a1 .. a_na, b0 .. b_(nb-1)).  Cost over j = d+1..N2:
 * sum (w - y(t+j))^2 + lambda sum Du^2, Nu moves; the first move is applied (receding horizon).
 *
 * Without limits the first move is linear in what is known at t, so it is kept as a law
 *
 *     Du = kw (w - y) + sum_s ky_s Dy(t-s) + sum_s ku_s Du(t-s)
 *
 * and recomputed only when p or lambda differ from those of the last design.  Differences of y take the
 * place of y itself because A(1 - z^-1) annihilates constants: one product less, no steady error from
 * rounding, and less cancellation in float.
 *
 * past:  y(t-1), Dy(t-1) .. Dy(t-na+1), Du(t-1) .. Du(t-nb+1-d)
 * gain:  kw, ky_0 .. ky_(na-1), ku_1 .. ku_(nb-1+d)
 */
#include "pcl2_gpc.h"

enum { GPC_OK = 0, GPC_SIGNAL = 1, GPC_SINGULAR = 2 };

/* Orders of A (without its leading 1) and of B, dead time, horizon and number of moves. */
struct gpc_size {
    int32_t na, nb, d, n2, nu;
};

/* Where one controller keeps what; model holds the p of the last design. */
struct gpc_state {
    pcl2_real *designed;  /* lambda of the last design, -1 before the first */
    int32_t *started;     /* 1 once past holds a measured y */
    int32_t *status;
    pcl2_real *u;         /* the output, u(t-1) until it is written */
    pcl2_real *model, *gain, *past, *work;
};

/* A NaN ends at umin, an infinity at its own side. */
static inline pcl2_real gpc_clamp(pcl2_real u, pcl2_real umin, pcl2_real umax)
{
    u = (u > umin) ? u : umin;
    return (u < umax) ? u : umax;
}

/* c_r: step response of 1/A from c_0 = 1, N2 values.  g_s = sum b_m c_(s-1-m): step response of B/A
 * without its dead time, N2 - d values from g_1 (the g_j of the paper, moved by d). */
static inline void gpc_responses(struct gpc_size z, const pcl2_real *p, pcl2_real *c, pcl2_real *g)
{
    for (int32_t r = 0; r < z.n2; ++r) {
        pcl2_real sum = PCL2_R(1.0);
        for (int32_t i = (z.na < r) ? z.na : r; i >= 1; --i) {
            sum += p[i - 1] * c[r - i];
        }
        c[r] = sum;
    }
    for (int32_t s = 0; s < z.n2 - z.d; ++s) {
        pcl2_real sum = PCL2_R(0.0);
        for (int32_t m = (z.nb - 1 < s) ? z.nb - 1 : s; m >= 0; --m) {
            sum += p[z.na + m] * c[s - m];
        }
        g[s] = sum;
    }
}

/* Upper triangle of G'G + lambda I.  G is Toeplitz, so the elements of one diagonal are partial sums
 * of one row: (G'G)[l-e][l] = sum over q = 1..n-l of g_q g_(q+e). */
static inline void gpc_hessian(struct gpc_size z, const pcl2_real *g, pcl2_real lambda, pcl2_real *h)
{
    for (int32_t e = 0; e < z.nu; ++e) {
        pcl2_real sum = PCL2_R(0.0);
        int32_t q = 0;
        for (int32_t l = z.nu - 1; l >= e; --l) {
            for (; q < z.n2 - z.d - l; ++q) {
                sum += g[q] * g[q + e];
            }
            h[(l - e) * z.nu + l] = (e == 0) ? sum + lambda : sum;
        }
    }
}

/* v = first column of the inverse of h, by h = U D U', U unit upper triangular: eliminated from the
 * last move upwards, so that only the back substitution of one unit vector remains.  A pivot that is
 * rounding noise of its diagonal element counts as zero. */
static inline int32_t gpc_solve(int32_t n, pcl2_real *h, pcl2_real *v)
{
    const pcl2_real noise = (PCL2_REAL_BITS == 32) ? PCL2_R(1.2e-7) : PCL2_R(2.3e-16);
    for (int32_t j = 0; j < n; ++j) {
        v[j] = h[j * n + j] * noise * (pcl2_real)n;
    }
    for (int32_t j = n - 1; j >= 0; --j) {
        const pcl2_real pivot = h[j * n + j];
        if (!(pivot > v[j])) {
            return GPC_SINGULAR;
        }
        const pcl2_real inverse = PCL2_R(1.0) / pivot;
        for (int32_t i = j - 1; i >= 0; --i) {
            const pcl2_real factor = h[i * n + j] * inverse;
            for (int32_t l = i; l >= 0; --l) {
                h[l * n + i] -= h[l * n + j] * factor;
            }
            h[i * n + j] = factor;
        }
        v[j] = inverse;
    }
    for (int32_t j = 1; j < n; ++j) {
        pcl2_real sum = h[j] * v[0];
        for (int32_t i = 1; i < j; ++i) {
            sum += h[i * n + j] * v[i];
        }
        v[j] = -sum;
    }
    return GPC_OK;
}

/* Weight of what enters the model at step q from the past, q = 1..: mu_q = sum over the horizon of
 * k_j c_(j-q), with the gains k_j = sum_i v_i g_(j-d-i).  By move i these are correlations of g and c
 * at the lag i + d - q, summed up to n - i. */
static inline pcl2_real gpc_weight(struct gpc_size z, const pcl2_real *c, const pcl2_real *g,
                                   const pcl2_real *v, int32_t q)
{
    pcl2_real weight = PCL2_R(0.0);
    for (int32_t i = 0; i < z.nu; ++i) {
        const int32_t lag = i + z.d - q;
        pcl2_real sum = PCL2_R(0.0);
        for (int32_t s = (lag < -1) ? -lag : 1; s <= z.n2 - z.d - i; ++s) {
            sum += g[s - 1] * c[s + lag];
        }
        weight += v[i] * sum;
    }
    return weight;
}

/* kw = sum of all k_j. */
static inline pcl2_real gpc_setpoint_gain(struct gpc_size z, const pcl2_real *g, const pcl2_real *v)
{
    pcl2_real gain = PCL2_R(0.0);
    pcl2_real sum = PCL2_R(0.0);
    int32_t s = 0;
    for (int32_t i = z.nu - 1; i >= 0; --i) {
        for (; s < z.n2 - z.d - i; ++s) {
            sum += g[s];
        }
        gain += v[i] * sum;
    }
    return gain;
}

/* The law of a new model: fills gain.  All gains are zero when there is none (the output is held). */
static int32_t gpc_design(struct gpc_size z, const pcl2_real *p, pcl2_real lambda, pcl2_real *gain,
                          pcl2_real *work)
{
    const int32_t nq = (z.na > z.nb - 1 + z.d) ? z.na : z.nb - 1 + z.d;
    pcl2_real *const c = work;
    pcl2_real *const g = c + z.n2;
    pcl2_real *const h = g + (z.n2 - z.d);
    pcl2_real *const v = h + z.nu * z.nu;
    pcl2_real *const mu = v + z.nu;
    gpc_responses(z, p, c, g);
    gpc_hessian(z, g, lambda, h);
    if (gpc_solve(z.nu, h, v) != GPC_OK) {
        for (int32_t i = 0; i < z.na + z.nb + z.d; ++i) {
            gain[i] = PCL2_R(0.0);
        }
        return GPC_SINGULAR;
    }
    gain[0] = gpc_setpoint_gain(z, g, v);
    for (int32_t q = 1; q <= nq; ++q) {
        mu[q - 1] = (q <= z.n2) ? gpc_weight(z, c, g, v, q) : PCL2_R(0.0);
    }
    for (int32_t s = 0; s < z.na; ++s) {
        pcl2_real sum = PCL2_R(0.0);
        for (int32_t q = 1; q <= z.na - s; ++q) {
            sum -= mu[q - 1] * p[q + s - 1];
        }
        gain[1 + s] = sum;
    }
    for (int32_t s = 1; s <= z.nb - 1 + z.d; ++s) {
        pcl2_real sum = PCL2_R(0.0);
        for (int32_t m = (s > z.d) ? s - z.d : 0; m < z.nb; ++m) {
            sum -= mu[m + z.d - s] * p[z.na + m];
        }
        gain[z.na + s] = sum;
    }
    return GPC_OK;
}

/* NaN differs from itself, so a bad model is designed anew each scan and never taken as unchanged. */
static inline int gpc_changed(int32_t n, const pcl2_real *p, const pcl2_real *model)
{
    for (int32_t i = 0; i < n; ++i) {
        if (p[i] != model[i]) {
            return 1;
        }
    }
    return 0;
}

static int32_t gpc_redesign(struct gpc_size z, const pcl2_real *p, pcl2_real lambda, struct gpc_state at)
{
    const int32_t status = gpc_design(z, p, lambda, at.gain, at.work);
    for (int32_t i = 0; i < z.na + z.nb; ++i) {
        at.model[i] = p[i];
    }
    *at.designed = (status == GPC_OK) ? lambda : PCL2_R(-1.0);
    return status;
}

/* Applies u and lets it and the measured y into the history. */
static inline void gpc_apply(struct gpc_size z, struct gpc_state at, pcl2_real y, pcl2_real u)
{
    const int32_t ny = (z.na > 0) ? z.na - 1 : 0;
    const int32_t nu = z.nb - 1 + z.d;
    for (int32_t i = ny + nu; i > ny + 1; --i) {
        at.past[i] = at.past[i - 1];
    }
    if (nu > 0) {
        at.past[ny + 1] = u - *at.u;
    }
    for (int32_t i = ny; i > 1; --i) {
        at.past[i] = at.past[i - 1];
    }
    if (ny > 0) {
        at.past[1] = y - at.past[0];
    }
    at.past[0] = y;
    *at.u = u;
}

static inline pcl2_real gpc_move(struct gpc_size z, struct gpc_state at, pcl2_real w, pcl2_real y)
{
    const int32_t known = (z.na > 0) ? z.na + z.nb - 1 + z.d : z.nb + z.d;
    const int32_t shift = (z.na > 0) ? 1 : 0;
    pcl2_real move = at.gain[0] * (w - y);
    if (z.na > 0) {
        move += at.gain[1] * (y - at.past[0]);
    }
    for (int32_t i = 1; i < known; ++i) {
        move += at.gain[i + shift] * at.past[i];
    }
    return move;
}

/* One scan.  umin and umax bound the applied increment, which is what enters the history. */
static inline void gpc_scan(struct gpc_size z, struct gpc_state at, pcl2_real w, pcl2_real y,
                            const pcl2_real *p, pcl2_real sw, pcl2_real u0, pcl2_real umin,
                            pcl2_real umax, pcl2_real lambda)
{
    int32_t status = GPC_OK;
    if (*at.started == 0 && !pcl2_is_bad(y)) {
        at.past[0] = y;
        *at.started = 1;
    }
    if (sw != PCL2_R(0.0) && !pcl2_is_bad(sw)) {
        const int bad = pcl2_is_bad(y);
        *at.status = bad ? GPC_SIGNAL : GPC_OK;
        gpc_apply(z, at, bad ? at.past[0] : y, gpc_clamp(u0, umin, umax));
        return;
    }
    if (lambda != *at.designed || gpc_changed(z.na + z.nb, p, at.model)) {
        status = gpc_redesign(z, p, lambda, at);
    }
    const pcl2_real move = gpc_move(z, at, w, y);
    if (pcl2_is_bad(move)) {
        *at.status = GPC_SIGNAL;
        return;
    }
    *at.status = status;
    gpc_apply(z, at, y, gpc_clamp(*at.u + move, umin, umax));
}

PCL2_KERNEL void pcl2_gpc1_init(struct pcl2_gpc1 *self, int32_t d, int32_t N2, int32_t Nu,
                                pcl2_real u0, pcl2_real umin, pcl2_real umax, pcl2_real lambda,
                                pcl2_real *model, pcl2_real *gain, pcl2_real *past)
{
    (void)d;
    (void)N2;
    (void)Nu;
    (void)umin;
    (void)umax;
    (void)lambda;
    (void)model;
    (void)gain;
    (void)past;
    self->designed = PCL2_R(-1.0);
    self->u = u0;
}

PCL2_KERNEL void pcl2_gpc1(struct pcl2_gpc1 *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw,
                           int32_t d, int32_t N2, int32_t Nu, pcl2_real u0,
                           pcl2_real umin, pcl2_real umax, pcl2_real lambda, pcl2_real *model,
                           pcl2_real *gain, pcl2_real *past, pcl2_real *work)
{
    const struct gpc_size size = {1, 1, d, N2, Nu};
    const struct gpc_state at = {&self->designed, &self->started, &self->status, &self->u,
                                 model, gain, past, work};
    gpc_scan(size, at, w, y, p, sw, u0, umin, umax, lambda);
}

PCL2_KERNEL void pcl2_gpc2_init(struct pcl2_gpc2 *self, int32_t d, int32_t N2, int32_t Nu,
                                pcl2_real u0, pcl2_real umin, pcl2_real umax, pcl2_real lambda,
                                pcl2_real *model, pcl2_real *gain, pcl2_real *past)
{
    (void)d;
    (void)N2;
    (void)Nu;
    (void)umin;
    (void)umax;
    (void)lambda;
    (void)model;
    (void)gain;
    (void)past;
    self->designed = PCL2_R(-1.0);
    self->u = u0;
}

PCL2_KERNEL void pcl2_gpc2(struct pcl2_gpc2 *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw,
                           int32_t d, int32_t N2, int32_t Nu, pcl2_real u0,
                           pcl2_real umin, pcl2_real umax, pcl2_real lambda, pcl2_real *model,
                           pcl2_real *gain, pcl2_real *past, pcl2_real *work)
{
    const struct gpc_size size = {2, 2, d, N2, Nu};
    const struct gpc_state at = {&self->designed, &self->started, &self->status, &self->u,
                                 model, gain, past, work};
    gpc_scan(size, at, w, y, p, sw, u0, umin, umax, lambda);
}

PCL2_KERNEL void pcl2_gpcn_init(struct pcl2_gpcn *self, int32_t d, int32_t nA, int32_t nB, int32_t N2, int32_t Nu,
                                pcl2_real u0, pcl2_real umin, pcl2_real umax, pcl2_real lambda,
                                pcl2_real *model, pcl2_real *gain, pcl2_real *past)
{
    (void)d;
    (void)nA;
    (void)nB;
    (void)N2;
    (void)Nu;
    (void)umin;
    (void)umax;
    (void)lambda;
    (void)model;
    (void)gain;
    (void)past;
    self->designed = PCL2_R(-1.0);
    self->u = u0;
}

PCL2_KERNEL void pcl2_gpcn(struct pcl2_gpcn *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw,
                           int32_t d, int32_t nA, int32_t nB, int32_t N2, int32_t Nu, pcl2_real u0,
                           pcl2_real umin, pcl2_real umax, pcl2_real lambda, pcl2_real *model,
                           pcl2_real *gain, pcl2_real *past, pcl2_real *work)
{
    const struct gpc_size size = {nA - 1, nB, d, N2, Nu};
    const struct gpc_state at = {&self->designed, &self->started, &self->status, &self->u,
                                 model, gain, past, work};
    gpc_scan(size, at, w, y, p, sw, u0, umin, umax, lambda);
}
