/* rls1, rls2, rlsn: recursive least squares with exponential forgetting.
 *
 * L. Ljung, T. Soderstrom, "Theory and Practice of Recursive Identification", MIT Press 1983, section 2.2:
 *     s = P phi,  k = s / (lambda + phi's),  theta += k (y - phi'theta),  P = (P - k s') / lambda
 * with phi = (y(t-1) .., u(t-1-d) ..), so that theta is the model vector p of gpc1, gpc2, gpcn.
 * Only the upper triangle of P is computed and copied down: P is symmetric to the last bit.
 * The division by lambda is left out while trace P > pmax, else P grows as lambda^-k without excitation.
 *
 * ys: y(t-1) .. y(t-nA+1)      us: u(t-1) .. u(t-nB-d)
 */
#include "pcl2_math.h"
#include "pcl2_rls.h"

/* The loops over up to 16 parameters vanish where the sizes are literals. */
#if defined(__GNUC__) && !defined(__clang__) && !defined(__OPTIMIZE_SIZE__)
#define RLS_UNROLL _Pragma("GCC unroll 16")
#else
#define RLS_UNROLL
#endif

enum { RLS_OK = 0, RLS_SIGNAL = 1, RLS_COVARIANCE = 2 };

/* Parameters, those of A, those of B, dead time. */
struct pcl2_rls_size {
    int32_t np, na, nb, d;
};

/* Where one estimator keeps what. */
struct pcl2_rls_state {
    int32_t *blind;  /* scans for which phi still holds a stand-in for a bad sample */
    int32_t *status;
    pcl2_real *p, *ys, *us, *phi, *s, *th;
};

PCL2_INLINE void pcl2_rls_covariance(int32_t np, pcl2_real p0, pcl2_real *p)
{
    for (int32_t i = 0; i < np * np; ++i) {
        p[i] = PCL2_R(0.0);
    }
    for (int32_t i = 0; i < np; ++i) {
        p[i * np + i] = p0;
    }
}

PCL2_INLINE void pcl2_rls_start(int32_t np, pcl2_real p0, const pcl2_real *theta0, pcl2_real *p, pcl2_real *th)
{
    pcl2_rls_covariance(np, p0, p);
    for (int32_t i = 0; i < np; ++i) {
        th[i] = theta0[i];
    }
}

PCL2_INLINE void pcl2_rls_push(int32_t n, pcl2_real *past, pcl2_real x)
{
    RLS_UNROLL
    for (int32_t i = n - 1; i > 0; --i) {
        past[i] = past[i - 1];
    }
    if (n > 0) {
        past[0] = x;
    }
}

/* phi, s = P phi; returns phi's. */
PCL2_INLINE pcl2_real pcl2_rls_regressor(struct pcl2_rls_size z, struct pcl2_rls_state at)
{
    pcl2_real power = PCL2_R(0.0);
    RLS_UNROLL
    for (int32_t i = 0; i < z.na; ++i) {
        at.phi[i] = at.ys[i];
    }
    RLS_UNROLL
    for (int32_t i = 0; i < z.nb; ++i) {
        at.phi[z.na + i] = at.us[z.d + i];
    }
    RLS_UNROLL
    for (int32_t i = 0; i < z.np; ++i) {
        pcl2_real sum = at.p[i * z.np] * at.phi[0];
        RLS_UNROLL
        for (int32_t j = 1; j < z.np; ++j) {
            sum += at.p[i * z.np + j] * at.phi[j];
        }
        at.s[i] = sum;
        power += at.phi[i] * sum;
    }
    return power;
}

/* P = (P - s s' / gain) * growth, theta += s error / gain. */
PCL2_INLINE void pcl2_rls_update(struct pcl2_rls_size z, struct pcl2_rls_state at, pcl2_real error, pcl2_real inverse,
                            pcl2_real growth)
{
    RLS_UNROLL
    for (int32_t i = 0; i < z.np; ++i) {
        const pcl2_real k = at.s[i] * inverse;
        at.th[i] += k * error;
        RLS_UNROLL
        for (int32_t j = i; j < z.np; ++j) {
            const pcl2_real x = (at.p[i * z.np + j] - k * at.s[j]) * growth;
            at.p[i * z.np + j] = x;
            at.p[j * z.np + i] = x;
        }
    }
}

/* One step on good samples.  Rounding may cost P its positive definiteness (phi's < 0); it then starts
 * again from P0, theta stays. */
PCL2_INLINE int32_t pcl2_rls_adapt(struct pcl2_rls_size z, struct pcl2_rls_state at, pcl2_real y, pcl2_real lambda,
                              pcl2_real p0, pcl2_real pmax)
{
    /* A larger error is no measurement; far below the largest real, so that no parameter overflows. */
    const pcl2_real limit = (PCL2_REAL_BITS == 32) ? PCL2_R(1e12) : PCL2_R(1e30);
    const pcl2_real power = pcl2_rls_regressor(z, at);
    const pcl2_real inverse = PCL2_R(1.0) / (lambda + power);
    pcl2_real error = at.phi[0] * at.th[0];
    pcl2_real trace = at.p[0];
    RLS_UNROLL
    for (int32_t i = 1; i < z.np; ++i) {
        error += at.phi[i] * at.th[i];
        trace += at.p[i * z.np + i];
    }
    error = y - error;
    if (pcl2_is_bad(power) || !(pcl2_math_fabs(error) < limit)) {
        return RLS_SIGNAL;
    }
    if (power < PCL2_R(0.0)) {
        pcl2_rls_covariance(z.np, p0, at.p);
        return RLS_COVARIANCE;
    }
    pcl2_rls_update(z, at, error, inverse, (trace > pmax) ? PCL2_R(1.0) : PCL2_R(1.0) / lambda);
    return RLS_OK;
}

/* One scan.  A bad sample enters the history as its predecessor, and nothing is learnt until it has left
 * phi again. */
PCL2_INLINE void pcl2_rls_scan(struct pcl2_rls_size z, struct pcl2_rls_state at, pcl2_real y, pcl2_real u, pcl2_real en,
                          pcl2_real lambda, pcl2_real p0, pcl2_real pmax)
{
    const int32_t bad_y = pcl2_is_bad(y);
    const int32_t bad_u = pcl2_is_bad(u);
    pcl2_rls_push(z.nb + z.d, at.us, bad_u ? at.us[0] : u);
    *at.status = RLS_OK;
    if (bad_y || bad_u) {
        *at.status = RLS_SIGNAL;
        *at.blind = (z.na > z.nb + z.d) ? z.na : z.nb + z.d;
    } else if (*at.blind > 0) {
        *at.blind -= 1;
    } else if (en != PCL2_R(0.0) && !pcl2_is_bad(en)) {
        *at.status = pcl2_rls_adapt(z, at, y, lambda, p0, pmax);
    }
    pcl2_rls_push(z.na, at.ys, !bad_y ? y : (z.na > 0) ? at.ys[0] : PCL2_R(0.0));
}

PCL2_KERNEL void pcl2_rls1_init(struct pcl2_rls1 *self, int32_t np, pcl2_real lambda, pcl2_real P0,
                                pcl2_real pmax, const pcl2_real *theta0, pcl2_real *P, pcl2_real *ys,
                                pcl2_real *us, pcl2_real *th)
{
    (void)self;
    (void)lambda;
    (void)pmax;
    (void)ys;
    (void)us;
    pcl2_rls_start(np, P0, theta0, P, th);
}

PCL2_KERNEL void pcl2_rls1(struct pcl2_rls1 *self, int32_t np, pcl2_real y, pcl2_real u, pcl2_real en,
                           pcl2_real lambda, pcl2_real P0, pcl2_real pmax, pcl2_real *P, pcl2_real *ys,
                           pcl2_real *us, pcl2_real *phi, pcl2_real *s, pcl2_real *th)
{
    (void)np;
    const struct pcl2_rls_size size = {2, 1, 1, 0};
    const struct pcl2_rls_state at = {&self->blind, &self->status, P, ys, us, phi, s, th};
    pcl2_rls_scan(size, at, y, u, en, lambda, P0, pmax);
}

PCL2_KERNEL void pcl2_rls2_init(struct pcl2_rls2 *self, int32_t np, pcl2_real lambda, pcl2_real P0,
                                pcl2_real pmax, const pcl2_real *theta0, pcl2_real *P, pcl2_real *ys,
                                pcl2_real *us, pcl2_real *th)
{
    (void)self;
    (void)lambda;
    (void)pmax;
    (void)ys;
    (void)us;
    pcl2_rls_start(np, P0, theta0, P, th);
}

PCL2_KERNEL void pcl2_rls2(struct pcl2_rls2 *self, int32_t np, pcl2_real y, pcl2_real u, pcl2_real en,
                           pcl2_real lambda, pcl2_real P0, pcl2_real pmax, pcl2_real *P, pcl2_real *ys,
                           pcl2_real *us, pcl2_real *phi, pcl2_real *s, pcl2_real *th)
{
    (void)np;
    const struct pcl2_rls_size size = {4, 2, 2, 0};
    const struct pcl2_rls_state at = {&self->blind, &self->status, P, ys, us, phi, s, th};
    pcl2_rls_scan(size, at, y, u, en, lambda, P0, pmax);
}

PCL2_KERNEL void pcl2_rlsn_init(struct pcl2_rlsn *self, int32_t np, int32_t d, int32_t nA, int32_t nB,
                                pcl2_real lambda, pcl2_real P0, pcl2_real pmax, const pcl2_real *theta0, pcl2_real *P, pcl2_real *ys,
                                pcl2_real *us, pcl2_real *th)
{
    (void)self;
    (void)d;
    (void)nA;
    (void)nB;
    (void)lambda;
    (void)pmax;
    (void)ys;
    (void)us;
    pcl2_rls_start(np, P0, theta0, P, th);
}

PCL2_KERNEL void pcl2_rlsn(struct pcl2_rlsn *self, int32_t np, pcl2_real y, pcl2_real u, pcl2_real en,
                           int32_t d, int32_t nA, int32_t nB,
                           pcl2_real lambda, pcl2_real P0, pcl2_real pmax, pcl2_real *P, pcl2_real *ys,
                           pcl2_real *us, pcl2_real *phi, pcl2_real *s, pcl2_real *th)
{
    const struct pcl2_rls_size size = {np, nA - 1, nB, d};
    const struct pcl2_rls_state at = {&self->blind, &self->status, P, ys, us, phi, s, th};
    pcl2_rls_scan(size, at, y, u, en, lambda, P0, pmax);
}

#undef RLS_UNROLL
