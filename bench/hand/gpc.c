/* GPC of a second-order model, d = 0, N2 = 10, as one would write it for exactly these sizes:
 * free and step response in one sweep, then the normal equations of 1 or 3 moves. */
#include "gpc.h"

enum { HAND_N2 = 10 };

static pcl2_real hand_clamp(pcl2_real u, pcl2_real umin, pcl2_real umax)
{
    return (u < umin) ? umin : (u > umax) ? umax : u;
}

static void hand_apply(struct hand_gpc *self, pcl2_real y, pcl2_real u)
{
    u = hand_clamp(u, self->umin, self->umax);
    self->du1 = u - self->u;
    self->u = u;
    self->y2 = self->y1;
    self->y1 = y;
}

static int hand_begin(struct hand_gpc *self, pcl2_real y, pcl2_real sw)
{
    if (!self->started) {
        self->y1 = y;
        self->y2 = y;
        self->u = self->u0;
        self->started = 1;
    }
    if (sw != PCL2_R(0.0)) {
        hand_apply(self, y, self->u0);
        return 1;
    }
    return 0;
}

/* Step response g_1.. and free response f_1.. of the model. */
static inline void hand_responses(const struct hand_gpc *self, const pcl2_real *p, pcl2_real y,
                                  pcl2_real *g, pcl2_real *f)
{
    const pcl2_real a1 = p[0], a2 = p[1], b01 = p[2] + p[3];
    const pcl2_real c1 = PCL2_R(1.0) + a1, c2 = a2 - a1, c3 = -a2;
    pcl2_real g1 = p[2], g2 = PCL2_R(0.0);
    pcl2_real f1 = c1 * y + c2 * self->y1 + c3 * self->y2 + p[3] * self->du1, f2 = y, f3 = self->y1;
    g[0] = g1;
    f[0] = f1;
    for (int j = 1; j < HAND_N2; ++j) {
        const pcl2_real gj = b01 + a2 * g2 + a1 * g1;
        const pcl2_real fj = c3 * f3 + c2 * f2 + c1 * f1;
        g2 = g1;
        g1 = gj;
        f3 = f2;
        f2 = f1;
        f1 = fj;
        g[j] = gj;
        f[j] = fj;
    }
}

void hand_gpc_adaptive1(struct hand_gpc *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw)
{
    pcl2_real g[HAND_N2], f[HAND_N2];
    if (hand_begin(self, y, sw)) {
        return;
    }
    hand_responses(self, p, y, g, f);
    pcl2_real h = self->lambda, r = PCL2_R(0.0);
    for (int j = 0; j < HAND_N2; ++j) {
        h += g[j] * g[j];
        r += g[j] * (w - f[j]);
    }
    hand_apply(self, y, self->u + r / h);
}

void hand_gpc_adaptive3(struct hand_gpc *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw)
{
    pcl2_real g[HAND_N2], f[HAND_N2];
    if (hand_begin(self, y, sw)) {
        return;
    }
    hand_responses(self, p, y, g, f);
    pcl2_real h11 = self->lambda, h22 = self->lambda, h33 = self->lambda;
    pcl2_real h12 = 0, h13 = 0, h23 = 0, r1 = 0, r2 = 0, r3 = 0;
    for (int j = 0; j < HAND_N2; ++j) {
        const pcl2_real e = w - f[j], x = g[j];
        h11 += x * x;
        r1 += x * e;
        if (j >= 1) {
            const pcl2_real x1 = g[j - 1];
            h22 += x1 * x1;
            h12 += x * x1;
            r2 += x1 * e;
        }
        if (j >= 2) {
            const pcl2_real x2 = g[j - 2];
            h33 += x2 * x2;
            h13 += x * x2;
            h23 += g[j - 1] * x2;
            r3 += x2 * e;
        }
    }
    /* 3 x 3 elimination from the last move upwards; only the first move is wanted. */
    const pcl2_real i3 = PCL2_R(1.0) / h33;
    const pcl2_real f2 = h23 * i3, f1 = h13 * i3;
    h22 -= h23 * f2;
    h12 -= h13 * f2;
    h11 -= h13 * f1;
    r2 -= r3 * f2;
    r1 -= r3 * f1;
    const pcl2_real q = h12 / h22;
    hand_apply(self, y, self->u + (r1 - r2 * q) / (h11 - h12 * q));
}

void hand_gpc_design(struct hand_gpc *self)
{
    struct hand_gpc probe = *self;
    pcl2_real g[HAND_N2], f[HAND_N2], k[HAND_N2], h = self->lambda;
    probe.y1 = probe.y2 = probe.du1 = PCL2_R(0.0);
    hand_responses(&probe, self->p, PCL2_R(0.0), g, f);
    for (int j = 0; j < HAND_N2; ++j) {
        h += g[j] * g[j];
    }
    self->kw = PCL2_R(0.0);
    for (int j = 0; j < HAND_N2; ++j) {
        k[j] = g[j] / h;
        self->kw += k[j];
    }
    for (int i = 0; i < 4; ++i) {
        pcl2_real sum = PCL2_R(0.0);
        probe.y1 = (i == 1) ? PCL2_R(1.0) : PCL2_R(0.0);
        probe.y2 = (i == 2) ? PCL2_R(1.0) : PCL2_R(0.0);
        probe.du1 = (i == 3) ? PCL2_R(1.0) : PCL2_R(0.0);
        hand_responses(&probe, self->p, (i == 0) ? PCL2_R(1.0) : PCL2_R(0.0), g, f);
        for (int j = 0; j < HAND_N2; ++j) {
            sum += k[j] * f[j];
        }
        if (i < 3) {
            self->ky[i] = sum;
        } else {
            self->kd = sum;
        }
    }
}

void hand_gpc_fixed(struct hand_gpc *self, pcl2_real w, pcl2_real y, pcl2_real sw)
{
    if (hand_begin(self, y, sw)) {
        return;
    }
    const pcl2_real move = self->kw * w - self->ky[0] * y - self->ky[1] * self->y1
                         - self->ky[2] * self->y2 - self->kd * self->du1;
    hand_apply(self, y, self->u + move);
}
