/* PID controller with tracking, feed-forward, inhibits, measurement filter and four forms (K. J. Astrom, T. Hagglund,
 * Advanced PID Control, ch. 3 and 13). I and D are kept in units of the output: every transfer only sets I. */
#include "pcl2_apid.h"

#include "pcl2_control.h"
#include "pcl2_math.h"

/* form */
#define APID_PARALLEL 1
#define APID_SERIES 2
#define APID_EXTERNAL 3

/* The error with a smaller gain inside the gap; continuous at its ends. lost: what the gap takes outside. */
static pcl2_real pcl2_apid_error(const struct pcl2_apid *self, pcl2_real e)
{
    if (e > self->dead) {
        return e - self->lost;
    }
    if (e < -self->dead) {
        return e + self->lost;
    }
    return self->dead > PCL2_R(0.0) ? e * (PCL2_R(1.0) - self->lost / self->dead) : e;
}

static pcl2_real pcl2_apid_proportional(const struct pcl2_apid *self, pcl2_real w, pcl2_real y)
{
    return self->kp * (pcl2_apid_error(self, w - y) - (PCL2_R(1.0) - self->bw) * w);
}

/* The measurement filter over one period, from [x1 - y, x2] with x2 = Tf x1': e^(A a), A = [0 1; -2 -2], a = T/Tf. */
static void pcl2_apid_filter(struct pcl2_apid *self, pcl2_real Tf, pcl2_real h)
{
    const pcl2_real a = Tf > PCL2_R(0.0) ? h / Tf : PCL2_R(800.0);
    const int32_t gone = !(a < PCL2_R(800.0));
    const pcl2_real decay = gone ? PCL2_R(0.0) : pcl2_math_exp(-a);
    const pcl2_real cosine = gone ? PCL2_R(0.0) : decay * pcl2_math_cos(a);
    const pcl2_real sine = gone ? PCL2_R(0.0) : decay * pcl2_math_sin(a);
    self->f11 = cosine + sine;
    self->f12 = sine;
    self->f21 = PCL2_R(-2.0) * sine;
    self->f22 = cosine - sine;
}

/* Coefficients of the forms. */
static void pcl2_apid_form(struct pcl2_apid *self, pcl2_real gain, pcl2_real Ti, pcl2_real Td, pcl2_real N, pcl2_real Tt,
                           int32_t form, pcl2_real h)
{
    const pcl2_real sign = self->direct ? PCL2_R(-1.0) : PCL2_R(1.0);
    const int32_t serial = form == APID_SERIES && Ti > PCL2_R(0.0);
    const pcl2_real ti = serial ? Ti + Td : Ti;
    const pcl2_real td = serial ? Td * (Ti / (Ti + Td)) : Td;
    const pcl2_real k = serial ? gain * ((Ti + Td) / Ti) : gain;
    const pcl2_real other = sign * (form == APID_PARALLEL ? PCL2_R(1.0) : k);
    const pcl2_real own = td > PCL2_R(0.0) ? pcl2_math_sqrt(ti) * pcl2_math_sqrt(td) : ti;
    const pcl2_real reset = Tt > PCL2_R(0.0) ? Tt : own;
    self->kp = sign * k;
    self->ad = td / (td + N * h);
    self->kd = other * N * self->ad;
    self->sums = ti > PCL2_R(0.0);
    self->external = self->sums && form == APID_EXTERNAL;
    self->ki = self->sums && !self->external ? other * (h / ti) : PCL2_R(0.0);
    self->kt = !self->sums ? PCL2_R(0.0)
               : self->external ? -pcl2_math_expm1(-h / ti)
               : h < reset ? h / reset : PCL2_R(1.0);
}

PCL2_KERNEL void pcl2_apid_tune(struct pcl2_apid *self, pcl2_real K, pcl2_real Ti, pcl2_real Td, pcl2_real N,
                                pcl2_real b, pcl2_real c, pcl2_real umin, pcl2_real umax, int32_t act, pcl2_real tbad,
                                int32_t onfail, pcl2_real ufail, pcl2_real Tf, pcl2_real du, pcl2_real Tt,
                                pcl2_real bias, pcl2_real gap, pcl2_real kgap, int32_t form, int32_t sptrack,
                                pcl2_real yspan, pcl2_real uspan, int64_t T)
{
    const pcl2_real h = pcl2_seconds(T);
    const int32_t shifts = self->phase == PCL2_RUNNING && self->sums;
    const pcl2_real before = shifts ? pcl2_apid_proportional(self, self->ws, self->y1) : PCL2_R(0.0);
    self->direct = act;
    self->bw = b;
    self->cw = c;
    self->dead = gap;
    self->lost = gap * (PCL2_R(1.0) - kgap);
    self->lo = umin;
    self->hi = umax;
    self->safe = ufail;
    self->fail = onfail;
    self->nbad = pcl2_scans(tbad, T);
    self->rate = du > PCL2_R(0.0) ? du * h : PCL2_REAL_MAX;
    self->follow = sptrack;
    self->offset = Ti > PCL2_R(0.0) ? PCL2_R(0.0) : bias;
    pcl2_apid_form(self, K * (uspan / yspan), Ti, Td, N, Tt, form, h);
    pcl2_apid_filter(self, Tf, h);
    if (shifts) {
        const pcl2_real i = self->i + (before - pcl2_apid_proportional(self, self->ws, self->y1));
        self->i = pcl2_is_bad(i) ? self->i : i;
    }
}

PCL2_KERNEL void pcl2_apid_init(struct pcl2_apid *self, pcl2_real K, pcl2_real Ti, pcl2_real Td, pcl2_real N,
                                pcl2_real b, pcl2_real c, pcl2_real umin, pcl2_real umax, int32_t act, pcl2_real tbad,
                                int32_t onfail, pcl2_real ufail, pcl2_real Tf, pcl2_real du, pcl2_real Tt,
                                pcl2_real bias, pcl2_real gap, pcl2_real kgap, int32_t form, int32_t sptrack,
                                pcl2_real yspan, pcl2_real uspan, pcl2_real *bk)
{
    (void)K;
    (void)Ti;
    (void)Td;
    (void)N;
    (void)b;
    (void)c;
    (void)umin;
    (void)umax;
    (void)act;
    (void)tbad;
    (void)onfail;
    (void)ufail;
    (void)Tf;
    (void)du;
    (void)Tt;
    (void)bias;
    (void)gap;
    (void)kgap;
    (void)form;
    (void)sptrack;
    (void)yspan;
    (void)uspan;
    self->ws = pcl2_bad();
    self->u = pcl2_limited(PCL2_R(0.0), self->lo, self->hi);
    self->actual = PCL2_AUTO;
    pcl2_hand_back(bk, PCL2_R(0.0), PCL2_FOLLOWING);
}

/* The set-point in force. */
static pcl2_real pcl2_apid_setpoint(struct pcl2_apid *self, pcl2_real y, pcl2_real w, int32_t mode, pcl2_real cas,
                                    int32_t trk, int32_t state, const pcl2_real *bk)
{
    const int32_t apart = state == PCL2_WAITING || trk != 0;
    if (self->follow && (mode == PCL2_MAN || trk != 0)) {
        self->wait = 0;
        return y;
    }
    if (pcl2_is_bad(mode == PCL2_CAS ? cas : w)) {
        self->wait = 0;
        self->status = !pcl2_is_bad(self->ws) && (mode == PCL2_CAS || self->known) ? 3 : self->status;
        return pcl2_is_bad(self->ws) ? y : self->ws;
    }
    if (mode != PCL2_CAS) {
        self->wait = 0;
        self->known = 1;
        return w;
    }
    if (apart || self->phase == PCL2_FRESH) {
        self->wait = 0;
        return y;
    }
    return pcl2_follows(&self->wait, bk, cas, self->ws) ? cas : self->ws;
}

/* y is bad: hold, then shed. */
static void pcl2_apid_blind(struct pcl2_apid *self, int32_t mode, pcl2_real um, int32_t trk, pcl2_real utr)
{
    const int32_t shed = self->blind >= self->nbad;
    pcl2_real u = self->u;
    self->blind += !shed;
    self->status = shed ? 2 : 1;
    if (shed) {
        self->phase = self->phase == PCL2_FRESH ? PCL2_FRESH : PCL2_RETURNING;
        self->actual = self->fail ? PCL2_FAILED : PCL2_MAN;
    }
    self->actual = trk != 0 ? PCL2_TRACK : mode == PCL2_MAN ? PCL2_MAN : self->actual;
    u = self->actual == PCL2_TRACK ? utr : self->actual == PCL2_FAILED ? self->safe : self->actual == PCL2_MAN ? um : u;
    self->u = pcl2_is_bad(u) ? self->u : pcl2_limited(u, self->lo, self->hi);
}

/* u comes from elsewhere and I is set to fit; rest is P + ff + bias. */
static void pcl2_apid_apart(struct pcl2_apid *self, pcl2_real rest, int32_t mode, pcl2_real um, int32_t trk,
                            pcl2_real utr, int32_t state, pcl2_real value)
{
    const int32_t fresh = self->phase == PCL2_FRESH;
    const int32_t sums = self->sums;
    pcl2_real u = fresh ? um : self->u;
    self->actual = state == PCL2_WAITING ? PCL2_INIT : trk != 0 ? PCL2_TRACK : mode == PCL2_MAN ? PCL2_MAN : PCL2_AUTO;
    switch (self->actual) {
    case PCL2_INIT:
        u = value;
        break;
    case PCL2_TRACK:
        u = utr;
        break;
    case PCL2_MAN:
        u = um;
        break;
    default:
        u = fresh && !sums ? rest : u;
        break;
    }
    self->u = pcl2_limited(pcl2_is_bad(u) ? self->u : u, self->lo, self->hi);
    self->i = fresh && !sums && self->actual == PCL2_AUTO ? PCL2_R(0.0) : self->u - rest;
    self->carry = PCL2_R(0.0);
    self->d = PCL2_R(0.0);
    self->phase = PCL2_RUNNING;
}

/* The limits of a move: range, rate, inhibits. */
static pcl2_real pcl2_apid_move(const struct pcl2_apid *self, pcl2_real v, int32_t inh, int32_t dnh)
{
    pcl2_real u = pcl2_limited(v, self->lo, self->hi);
    const pcl2_real move = u - self->u;
    u = move > self->rate ? self->u + self->rate : move < -self->rate ? self->u - self->rate : u;
    if ((inh != 0 && u > self->u) || (dnh != 0 && u < self->u)) {
        u = self->u;
    }
    return pcl2_limited(u, self->lo, self->hi);
}

PCL2_KERNEL void pcl2_apid(struct pcl2_apid *self, pcl2_real y, pcl2_real w, int32_t mode, pcl2_real cas, pcl2_real um,
                           int32_t trk, pcl2_real utr, pcl2_real ff, int32_t inh, int32_t dnh, const pcl2_real *back,
                           pcl2_real *bk)
{
    const int32_t state = pcl2_return_state(back);
    pcl2_real sp, yf, x2, p, d, v;
    self->status = 0;
    if (self->phase == PCL2_FRESH || self->blind != 0) {
        self->x1 = pcl2_is_bad(y) ? self->x1 : y;
        self->x2 = pcl2_is_bad(y) ? self->x2 : PCL2_R(0.0);
        self->y1 = self->x1;
    }
    yf = y + self->f11 * (self->x1 - y) + self->f12 * self->x2;
    x2 = self->f21 * (self->x1 - y) + self->f22 * self->x2;
    if (pcl2_is_bad(ff)) {
        self->status = 4;
        ff = self->f1;
    }
    sp = pcl2_apid_setpoint(self, yf, w, mode, cas, trk, state, bk);
    p = pcl2_apid_proportional(self, sp, yf) + ff + self->offset;
    d = self->ad * self->d + self->kd * (self->cw * (sp - self->ws) - (yf - self->y1));
    v = p + self->i + d;
    if (pcl2_is_bad(p) || pcl2_is_bad(x2)) {
        self->ws = pcl2_is_bad(sp) ? self->ws : sp;
        pcl2_apid_blind(self, mode, um, trk, utr);
        pcl2_answer_master(bk, self->actual, self->ws, state, self->direct, PCL2_FOLLOWING);
        return;
    }
    self->blind = 0;
    if (pcl2_is_bad(v) || self->phase != PCL2_RUNNING || mode == PCL2_MAN || trk != 0 || state == PCL2_WAITING) {
        pcl2_apid_apart(self, p, mode, um, trk, utr, state, back[0]);
    } else {
        pcl2_real step = self->ki * pcl2_apid_error(self, sp - yf);
        const pcl2_real u = pcl2_apid_move(self, v, inh, dnh);
        pcl2_real followed = u;
        if (state != PCL2_FOLLOWING) {
            followed = pcl2_held_back(state, back[0], self->u, &step, u);
        } else if (self->external && !pcl2_is_bad(back[0])) {
            followed = back[0];
        }
        step += self->kt * (self->external ? followed - ff - self->i : followed - v);
        pcl2_accumulate(&self->i, &self->carry, step);
        self->d = d;
        self->u = u;
        self->actual = mode == PCL2_CAS && self->wait == PCL2_LINKED ? PCL2_CAS : PCL2_AUTO;
    }
    self->x1 = yf;
    self->x2 = x2;
    self->y1 = yf;
    self->f1 = ff;
    self->ws = sp;
    self->e = sp - yf;
    pcl2_answer_master(bk, self->actual, sp, state, self->direct, pcl2_limit_state(self->u, self->lo, self->hi));
}

#undef APID_PARALLEL
#undef APID_SERIES
#undef APID_EXTERNAL
