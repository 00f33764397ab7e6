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
 * y1:    y(t-1)
 * past:  Dy(t-1) .. Dy(t-na+1), Du(t-1) .. Du(t-nb+1-d)
 * gain:  kw, ky_0 .. ky_(na-1), ku_1 .. ku_(nb-1+d)
 * asked: the set-point that the master was asked for; patience: the scans that it still has to come to it
 */
#include "pcl2_gpc.h"
#include "pcl2_math.h"
#include "pcl2_return.h"

/* The loops of a horizon of up to 16 vanish where the sizes are literals.  Clang wants to be told, and
 * warns where they are not. */
#if defined(__OPTIMIZE_SIZE__) || !defined(__GNUC__)
#define GPC_UNROLL
#elif defined(__clang__)
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wpass-failed"
#define GPC_UNROLL _Pragma("clang loop unroll(full)")
#else
#define GPC_UNROLL _Pragma("GCC unroll 16")
#endif

enum { GPC_OK = 0, GPC_SIGNAL = 1, GPC_SINGULAR = 2 };

/* Orders of A (without its leading 1) and of B, dead time, horizon and number of moves. */
struct pcl2_gpc_size {
    int32_t na, nb, d, n2, nu;
};

/* Where one controller keeps what; model holds the p of the last design. */
struct pcl2_gpc_state {
    pcl2_real *designed;  /* lambda of the last design, -1 before the first */
    pcl2_real *y1;
    int32_t *started;     /* 1 once y1 is a measured y */
    int32_t *status;
    pcl2_real *u;         /* the output, u(t-1) until it is written */
    pcl2_real *model, *gain, *past, *work;
    pcl2_real *asked;
    int32_t *patience;
    const pcl2_real *back; /* from what u drives */
    pcl2_real *bk;         /* to what drives w; NULL where nobody listens */
};

/* A NaN ends at umin, an infinity at its own side. */
PCL2_INLINE pcl2_real pcl2_gpc_clamp(pcl2_real u, pcl2_real umin, pcl2_real umax)
{
    u = (u > umin) ? u : umin;
    return (u < umax) ? u : umax;
}

/* How far the model reaches back: steps at which something of the past still enters it. */
PCL2_INLINE int32_t pcl2_gpc_reach(struct pcl2_gpc_size z)
{
    return (z.na > z.nb - 1 + z.d) ? z.na : z.nb - 1 + z.d;
}

/* c_r: step response of 1/A from c_0 = 1, N2 values.  g_s = sum b_m c_(s-1-m): step
 * response of B/A without its dead time, N2 - d values from g_1 (the g_j of the paper, moved by d).
 * The newest term is added last: it is the one that the next turn waits for. */
PCL2_INLINE void pcl2_gpc_responses(struct pcl2_gpc_size z, const pcl2_real *p, pcl2_real *c, pcl2_real *g)
{
    GPC_UNROLL
    for (int32_t r = 0; r < z.n2; ++r) {
        pcl2_real sum = PCL2_R(1.0);
        GPC_UNROLL
        for (int32_t i = (z.na < r) ? z.na : r; i >= 1; --i) {
            sum += p[i - 1] * c[r - i];
        }
        c[r] = sum;
    }
    GPC_UNROLL
    for (int32_t s = 0; s < z.n2 - z.d; ++s) {
        const int32_t oldest = (z.nb - 1 < s) ? z.nb - 1 : s;
        pcl2_real sum = p[z.na + oldest] * c[s - oldest];
        GPC_UNROLL
        for (int32_t m = oldest - 1; m >= 0; --m) {
            sum += p[z.na + m] * c[s - m];
        }
        g[s] = sum;
    }
}

/* Upper triangle of G'G + lambda I.  G is Toeplitz, so the elements of one diagonal are partial sums
 * of one row: (G'G)[l-e][l] = sum over q = 1..n-l of g_q g_(q+e). */
PCL2_INLINE void pcl2_gpc_hessian(struct pcl2_gpc_size z, const pcl2_real *g, pcl2_real lambda, pcl2_real *h)
{
    GPC_UNROLL
    for (int32_t e = 0; e < z.nu; ++e) {
        pcl2_real sum = PCL2_R(0.0);
        int32_t q = 0;
        GPC_UNROLL
        for (int32_t l = z.nu - 1; l >= e; --l) {
            GPC_UNROLL
            for (; q < z.n2 - z.d - l; ++q) {
                sum += g[q] * g[q + e];
            }
            h[(l - e) * z.nu + l] = (e == 0) ? sum + lambda : sum;
        }
    }
}

/* First column of the inverse of h: h = U D U', U unit upper triangular, is eliminated from the last move
 * upwards, so that only the back substitution of one unit vector remains.  v is that column over its
 * first element, which is returned; 0 when h is singular.  A pivot that is rounding noise of its
 * diagonal element counts as zero. */
PCL2_INLINE pcl2_real pcl2_gpc_solve(int32_t n, pcl2_real *h, pcl2_real *v)
{
    const pcl2_real noise = PCL2_REAL_EPSILON * (pcl2_real)n;
    pcl2_real inverse = PCL2_R(0.0);
    GPC_UNROLL
    for (int32_t j = 0; j < n; ++j) {
        v[j] = h[j * n + j] * noise;
    }
    GPC_UNROLL
    for (int32_t j = n - 1; j >= 0; --j) {
        const pcl2_real pivot = h[j * n + j];
        if (!(pivot > v[j])) {
            return PCL2_R(0.0);
        }
        inverse = PCL2_R(1.0) / pivot;
        GPC_UNROLL
        for (int32_t i = j - 1; i >= 0; --i) {
            const pcl2_real factor = h[i * n + j] * inverse;
            GPC_UNROLL
            for (int32_t l = i; l >= 0; --l) {
                h[l * n + i] -= h[l * n + j] * factor;
            }
            h[i * n + j] = factor;
        }
    }
    v[0] = PCL2_R(1.0);
    GPC_UNROLL
    for (int32_t j = 1; j < n; ++j) {
        pcl2_real sum = h[j];
        GPC_UNROLL
        for (int32_t i = 1; i < j; ++i) {
            sum += h[i * n + j] * v[i];
        }
        v[j] = -sum;
    }
    return inverse;
}

/* Weights of what enters the model at step q = 1.. from the past: mu_q = sum over the horizon of
 * k_j c_(j-q), with the gains k_j = sum_i v_i g_(j-d-i) of w - f (over the scale of pcl2_gpc_solve).  Move i contributes the correlation of
 * g and c at the lag i + d - q up to n - i, so the moves of one lag share a running sum. */
PCL2_INLINE void pcl2_gpc_weights(struct pcl2_gpc_size z, const pcl2_real *c, const pcl2_real *g, const pcl2_real *v,
                             pcl2_real *mu)
{
    const int32_t nq = pcl2_gpc_reach(z);
    GPC_UNROLL
    for (int32_t q = 0; q < nq; ++q) {
        mu[q] = PCL2_R(0.0);
    }
    GPC_UNROLL
    for (int32_t lag = 1 - nq; lag < z.nu; ++lag) {
        const int32_t first = (lag > 0) ? lag : 0;
        const int32_t last = (lag - 1 + nq < z.nu - 1) ? lag - 1 + nq : z.nu - 1;
        pcl2_real sum = PCL2_R(0.0);
        int32_t s = (z.d + lag < 0) ? -(z.d + lag) : 0;
        GPC_UNROLL
        for (int32_t i = last; i >= first; --i) {
            GPC_UNROLL
            for (; s < z.n2 - z.d - i; ++s) {
                sum += g[s] * c[s + z.d + lag];
            }
            mu[i - lag] += v[i] * sum;
        }
    }
}

/* kw = sum of all k_j. */
PCL2_INLINE pcl2_real pcl2_gpc_setpoint_gain(struct pcl2_gpc_size z, const pcl2_real *g, const pcl2_real *v)
{
    pcl2_real gain = PCL2_R(0.0);
    pcl2_real sum = PCL2_R(0.0);
    int32_t s = 0;
    GPC_UNROLL
    for (int32_t i = z.nu - 1; i >= 0; --i) {
        GPC_UNROLL
        for (; s < z.n2 - z.d - i; ++s) {
            sum += g[s];
        }
        gain += v[i] * sum;
    }
    return gain;
}

/* The law of a new model. */
PCL2_INLINE int32_t pcl2_gpc_design(struct pcl2_gpc_size z, const pcl2_real *p, pcl2_real lambda, pcl2_real *gain,
                               pcl2_real *work)
{
    pcl2_real *const c = work;
    pcl2_real *const g = c + z.n2;
    pcl2_real *const h = g + (z.n2 - z.d);
    pcl2_real *const v = h + z.nu * z.nu;
    pcl2_real *const mu = v + z.nu;
    pcl2_gpc_responses(z, p, c, g);
    pcl2_gpc_hessian(z, g, lambda, h);
    const pcl2_real scale = pcl2_gpc_solve(z.nu, h, v);
    if (!(scale > PCL2_R(0.0))) {
        return GPC_SINGULAR;
    }
    pcl2_gpc_weights(z, c, g, v, mu);
    gain[0] = scale * pcl2_gpc_setpoint_gain(z, g, v);
    pcl2_real size = gain[0];
    GPC_UNROLL
    for (int32_t s = 0; s < z.na; ++s) {
        pcl2_real sum = PCL2_R(0.0);
        GPC_UNROLL
        for (int32_t q = 1; q <= z.na - s; ++q) {
            sum -= mu[q - 1] * p[q + s - 1];
        }
        gain[1 + s] = scale * sum;
        size += pcl2_math_fabs(gain[1 + s]);
    }
    GPC_UNROLL
    for (int32_t s = 1; s <= z.nb - 1 + z.d; ++s) {
        pcl2_real sum = PCL2_R(0.0);
        GPC_UNROLL
        for (int32_t m = (s > z.d) ? s - z.d : 0; m < z.nb; ++m) {
            sum -= mu[m + z.d - s] * p[z.na + m];
        }
        gain[z.na + s] = scale * sum;
        size += pcl2_math_fabs(gain[z.na + s]);
    }
    return pcl2_is_bad(size) ? GPC_SINGULAR : GPC_OK;
}

/* NaN differs from itself, so a bad model is designed anew each scan and never taken as unchanged. */
PCL2_INLINE int32_t pcl2_gpc_changed(int32_t n, const pcl2_real *p, const pcl2_real *model)
{
    PCL2_UNROLL
    for (int32_t i = 0; i < n; ++i) {
        if (p[i] != model[i]) {
            return 1;
        }
    }
    return 0;
}

/* Without a law all gains are zero, which holds the output, and the design is tried again each scan. */
PCL2_INLINE int32_t pcl2_gpc_redesign(struct pcl2_gpc_size z, const pcl2_real *p, pcl2_real lambda, struct pcl2_gpc_state at)
{
    const int32_t status = pcl2_gpc_design(z, p, lambda, at.gain, at.work);
    if (status != GPC_OK) {
        GPC_UNROLL
        for (int32_t i = 0; i < z.na + z.nb + z.d; ++i) {
            at.gain[i] = PCL2_R(0.0);
        }
    }
    GPC_UNROLL
    for (int32_t i = 0; i < z.na + z.nb; ++i) {
        at.model[i] = p[i];
    }
    *at.designed = (status == GPC_OK) ? lambda : PCL2_R(-1.0);
    return status;
}

/* Differences of y in the past. */
PCL2_INLINE int32_t pcl2_gpc_kept(struct pcl2_gpc_size z)
{
    return (z.na > 0) ? z.na - 1 : 0;
}

/* Lets a measured y into the history. */
PCL2_INLINE void pcl2_gpc_measured(struct pcl2_gpc_size z, struct pcl2_gpc_state at, pcl2_real y)
{
    const int32_t ny = pcl2_gpc_kept(z);
    PCL2_UNROLL
    for (int32_t i = ny - 1; i > 0; --i) {
        at.past[i] = at.past[i - 1];
    }
    if (ny > 0) {
        at.past[0] = y - *at.y1;
    }
    *at.y1 = y;
}

/* Applies u and lets its increment into the history. */
PCL2_INLINE void pcl2_gpc_apply(struct pcl2_gpc_size z, struct pcl2_gpc_state at, pcl2_real u)
{
    const int32_t ny = pcl2_gpc_kept(z);
    const int32_t nu = z.nb - 1 + z.d;
    PCL2_UNROLL
    for (int32_t i = ny + nu - 1; i > ny; --i) {
        at.past[i] = at.past[i - 1];
    }
    if (nu > 0) {
        at.past[ny] = u - *at.u;
    }
    *at.u = u;
}

/* The output of the law before its limits.  The newest increment of u enters last: it is what the scan before
 * finished with. */
PCL2_INLINE pcl2_real pcl2_gpc_law(struct pcl2_gpc_size z, struct pcl2_gpc_state at, pcl2_real w, pcl2_real y)
{
    const int32_t known = pcl2_gpc_kept(z) + z.nb - 1 + z.d;
    const pcl2_real *const gain = at.gain + ((z.na > 0) ? 2 : 1);
    const pcl2_real error = at.gain[0] * (w - y);
    pcl2_real sum = *at.u + ((z.na > 0) ? error + at.gain[1] * (y - *at.y1) : error);
    PCL2_UNROLL
    for (int32_t i = 0; i < known; ++i) {
        sum += gain[i] * at.past[i];
    }
    return sum;
}

/* The first good y stands for every y before it. */
PCL2_INLINE void pcl2_gpc_start(struct pcl2_gpc_state at, pcl2_real y)
{
    if (*at.started == 0 && !pcl2_is_bad(y)) {
        *at.y1 = y;
        *at.started = 1;
    }
}

/* u as it was followed, and its last increment. */
PCL2_INLINE void pcl2_gpc_followed(struct pcl2_gpc_size z, struct pcl2_gpc_state at, pcl2_real u)
{
    if (z.nb - 1 + z.d > 0) {
        at.past[pcl2_gpc_kept(z)] += u - *at.u;
    }
    *at.u = u;
}

/* The master hears that w is not followed, and to which set-point it shall come: y. */
PCL2_INLINE void pcl2_gpc_ask(struct pcl2_gpc_state at, pcl2_real w)
{
    if (at.bk != NULL && *at.started == 0) {
        pcl2_hand_back(at.bk, w, PCL2_FOLLOWING);
    } else if (at.bk != NULL) {
        *at.asked = *at.y1;
        *at.patience = PCL2_PATIENCE;
        pcl2_hand_back(at.bk, *at.asked, PCL2_WAITING);
    }
}

/* The master hears that w is in force, and whether a move to either side would be seen at u. */
PCL2_INLINE void pcl2_gpc_answer(struct pcl2_gpc_state at, pcl2_real w, pcl2_real wanted, int32_t told)
{
    const int32_t own = wanted > *at.u ? PCL2_LIMITED_HIGH : wanted < *at.u ? PCL2_LIMITED_LOW : PCL2_FOLLOWING;
    const int32_t state = own == PCL2_FOLLOWING ? told : own;
    pcl2_hand_back(at.bk, w, at.gain[0] < PCL2_R(0.0) ? pcl2_return_reversed(state) : state);
}

/* Manual: u follows u0, a bad y is taken as unchanged. */
PCL2_INLINE void pcl2_gpc_manual(struct pcl2_gpc_size z, struct pcl2_gpc_state at, pcl2_real y, pcl2_real u)
{
    pcl2_gpc_start(at, y);
    const int32_t bad = pcl2_is_bad(y - *at.y1);
    *at.status = bad ? GPC_SIGNAL : GPC_OK;
    pcl2_gpc_measured(z, at, bad ? *at.y1 : y);
    pcl2_gpc_apply(z, at, u);
}

/* What is driven waits: u goes there, and nothing has moved. */
PCL2_INLINE void pcl2_gpc_begin(struct pcl2_gpc_size z, struct pcl2_gpc_state at, pcl2_real y)
{
    pcl2_gpc_manual(z, at, y, at.back[0]);
    for (int32_t i = pcl2_gpc_kept(z); i < pcl2_gpc_kept(z) + z.nb - 1 + z.d; ++i) {
        at.past[i] = PCL2_R(0.0);
    }
}

/* One scan.  umin and umax bound the applied increment, which is what enters the history.  A bad w or y
 * shows in the differences that the law takes, and so does one that would overflow them.  y enters the
 * history before u is known: else gcc stores both at once and the next scan waits for that. */
PCL2_INLINE void pcl2_gpc_scan(struct pcl2_gpc_size z, struct pcl2_gpc_state at, pcl2_real w, pcl2_real y,
                          const pcl2_real *p, pcl2_real sw, pcl2_real u0, pcl2_real umin,
                          pcl2_real umax, pcl2_real lambda)
{
    const int32_t told = pcl2_return_state(at.back);
    *at.status = GPC_OK;
    if (PCL2_RARELY(told == PCL2_WAITING)) {
        pcl2_gpc_begin(z, at, y);
        pcl2_gpc_ask(at, w);
        return;
    }
    if (sw != PCL2_R(0.0) && !pcl2_is_bad(sw)) {
        pcl2_gpc_manual(z, at, y, pcl2_gpc_clamp(u0, umin, umax));
        pcl2_gpc_ask(at, w);
        return;
    }
    if (pcl2_is_bad((w - y) + (y - *at.y1))) {
        *at.status = GPC_SIGNAL;
        pcl2_gpc_ask(at, w);
        return;
    }
    const int32_t waits = pcl2_awaits(at.patience, 0, at.bk, w, *at.asked);
    w = waits ? *at.asked : w;
    if (PCL2_RARELY(told != PCL2_FOLLOWING) && (told == PCL2_LIMITED_HIGH ? at.back[0] < *at.u : at.back[0] > *at.u)) {
        pcl2_gpc_followed(z, at, at.back[0]);
    }
    if (PCL2_RARELY(lambda != *at.designed || pcl2_gpc_changed(z.na + z.nb, p, at.model))) {
        pcl2_gpc_start(at, y);
        *at.status = pcl2_gpc_redesign(z, p, lambda, at);
    }
    const pcl2_real u = pcl2_gpc_law(z, at, w, y);
    pcl2_gpc_measured(z, at, y);
    pcl2_gpc_apply(z, at, pcl2_gpc_clamp(u, umin, umax));
    if (waits) {
        pcl2_hand_back(at.bk, w, PCL2_WAITING);
    } else if (at.bk != NULL) {
        pcl2_gpc_answer(at, w, u, told);
    }
}

PCL2_KERNEL void pcl2_gpc1_init(struct pcl2_gpc1 *self, int32_t d, int32_t N2, int32_t Nu,
                                pcl2_real u0, pcl2_real umin, pcl2_real umax, pcl2_real lambda,
                                pcl2_real *model, pcl2_real *gain, pcl2_real *past,
                                pcl2_real *bk)
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
    (void)bk;
    self->designed = PCL2_R(-1.0);
    self->u = u0;
}

PCL2_KERNEL void pcl2_gpc1(struct pcl2_gpc1 *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw,
                           int32_t d, int32_t N2, int32_t Nu, const pcl2_real *back, pcl2_real u0,
                           pcl2_real umin, pcl2_real umax, pcl2_real lambda, pcl2_real *model,
                           pcl2_real *gain, pcl2_real *past, pcl2_real *work, pcl2_real *bk)
{
    const struct pcl2_gpc_size size = {1, 1, d, N2, Nu};
    const struct pcl2_gpc_state at = {&self->designed, &self->y1, &self->started, &self->status, &self->u,
                                 model, gain, past, work, &self->asked, &self->patience, back, bk};
    pcl2_gpc_scan(size, at, w, y, p, sw, u0, umin, umax, lambda);
}

PCL2_KERNEL void pcl2_gpc2_init(struct pcl2_gpc2 *self, int32_t d, int32_t N2, int32_t Nu,
                                pcl2_real u0, pcl2_real umin, pcl2_real umax, pcl2_real lambda,
                                pcl2_real *model, pcl2_real *gain, pcl2_real *past,
                                pcl2_real *bk)
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
    (void)bk;
    self->designed = PCL2_R(-1.0);
    self->u = u0;
}

PCL2_KERNEL void pcl2_gpc2(struct pcl2_gpc2 *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw,
                           int32_t d, int32_t N2, int32_t Nu, const pcl2_real *back, pcl2_real u0,
                           pcl2_real umin, pcl2_real umax, pcl2_real lambda, pcl2_real *model,
                           pcl2_real *gain, pcl2_real *past, pcl2_real *work, pcl2_real *bk)
{
    const struct pcl2_gpc_size size = {2, 2, d, N2, Nu};
    const struct pcl2_gpc_state at = {&self->designed, &self->y1, &self->started, &self->status, &self->u,
                                 model, gain, past, work, &self->asked, &self->patience, back, bk};
    pcl2_gpc_scan(size, at, w, y, p, sw, u0, umin, umax, lambda);
}

PCL2_KERNEL void pcl2_gpcn_init(struct pcl2_gpcn *self, int32_t d, int32_t nA, int32_t nB, int32_t N2, int32_t Nu,
                                pcl2_real u0, pcl2_real umin, pcl2_real umax, pcl2_real lambda,
                                pcl2_real *model, pcl2_real *gain, pcl2_real *past,
                                pcl2_real *bk)
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
    (void)bk;
    self->designed = PCL2_R(-1.0);
    self->u = u0;
}

PCL2_KERNEL void pcl2_gpcn(struct pcl2_gpcn *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw,
                           int32_t d, int32_t nA, int32_t nB, int32_t N2, int32_t Nu, const pcl2_real *back,
                           pcl2_real u0, pcl2_real umin, pcl2_real umax, pcl2_real lambda, pcl2_real *model,
                           pcl2_real *gain, pcl2_real *past, pcl2_real *work, pcl2_real *bk)
{
    const struct pcl2_gpc_size size = {nA - 1, nB, d, N2, Nu};
    const struct pcl2_gpc_state at = {&self->designed, &self->y1, &self->started, &self->status, &self->u,
                                 model, gain, past, work, &self->asked, &self->patience, back, bk};
    pcl2_gpc_scan(size, at, w, y, p, sw, u0, umin, umax, lambda);
}

#if defined(__clang__) && !defined(__OPTIMIZE_SIZE__)
#pragma clang diagnostic pop
#endif
#undef GPC_UNROLL
