/* PID controller, ISA form (K. J. Astrom, T. Hagglund, Advanced PID Control, ch. 3). I and D are kept in units of the
 * output, so that a change of Ti or Td needs nothing and every transfer only sets I. */
#include "pcl2_pid.h"

#include "pcl2_control.h"
#include "pcl2_math.h"

PCL2_KERNEL void pcl2_pid_tune(struct pcl2_pid *self, pcl2_real K, pcl2_real Ti, pcl2_real Td, pcl2_real N, pcl2_real b,
                               pcl2_real c, pcl2_real umin, pcl2_real umax, int32_t act, pcl2_real tbad, int32_t onfail,
                               pcl2_real ufail, int64_t T)
{
    const pcl2_real h = pcl2_seconds(T);
    const pcl2_real kp = act == 0 ? K : -K;
    const pcl2_real reset = Td > PCL2_R(0.0) ? pcl2_math_sqrt(Ti) * pcl2_math_sqrt(Td) : Ti;
    const pcl2_real shift = self->kp * (self->bw * self->ws - self->y1) - kp * (b * self->ws - self->y1);
    if (self->phase == PCL2_RUNNING && self->sums && !pcl2_is_bad(self->i + shift)) {
        self->i += shift;
    }
    self->kp = kp;
    self->sums = Ti > PCL2_R(0.0);
    self->ki = Ti > PCL2_R(0.0) ? kp * (h / Ti) : PCL2_R(0.0);
    self->ad = Td / (Td + N * h);
    self->kd = kp * N * self->ad;
    self->kt = Ti > PCL2_R(0.0) ? (h < reset ? h / reset : PCL2_R(1.0)) : PCL2_R(0.0);
    self->bw = b;
    self->cw = c;
    self->lo = umin;
    self->hi = umax;
    self->safe = ufail;
    self->direct = act;
    self->nbad = pcl2_scans(tbad, T);
    self->fail = onfail;
}

PCL2_KERNEL void pcl2_pid_init(struct pcl2_pid *self, pcl2_real K, pcl2_real Ti, pcl2_real Td, pcl2_real N, pcl2_real b,
                               pcl2_real c, pcl2_real umin, pcl2_real umax, int32_t act, pcl2_real tbad, int32_t onfail,
                               pcl2_real ufail, pcl2_real *bk)
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
    self->ws = pcl2_bad();
    self->u = pcl2_limited(PCL2_R(0.0), self->lo, self->hi);
    self->actual = PCL2_AUTO;
    pcl2_hand_back(bk, PCL2_R(0.0), PCL2_FOLLOWING);
}

/* The cascade's set-point, once it is followed. */
static pcl2_real pcl2_pid_cascade(struct pcl2_pid *self, pcl2_real y, pcl2_real cas, int32_t state,
                                  const pcl2_real *bk)
{
    if (state == PCL2_WAITING || self->phase == PCL2_FRESH) {
        self->wait = 0;
        return y;
    }
    return pcl2_follows(&self->wait, bk, cas, self->ws) ? cas : self->ws;
}

/* The set-point in force. */
static pcl2_real pcl2_pid_setpoint(struct pcl2_pid *self, pcl2_real y, pcl2_real w, int32_t mode, pcl2_real cas,
                                   int32_t state, const pcl2_real *bk)
{
    const pcl2_real wanted = mode == PCL2_CAS ? cas : w;
    if (!pcl2_is_bad(wanted)) {
        if (mode == PCL2_CAS) {
            return pcl2_pid_cascade(self, y, cas, state, bk);
        }
        self->wait = 0;
        self->known = 1;
        return w;
    }
    self->wait = 0;
    if (pcl2_is_bad(self->ws)) {
        return y;
    }
    self->status = mode == PCL2_CAS || self->known ? 3 : self->status;
    return self->ws;
}

/* y is bad: hold, then shed. */
static void pcl2_pid_blind(struct pcl2_pid *self, int32_t mode, pcl2_real um)
{
    const int32_t shed = self->blind >= self->nbad;
    self->blind += !shed;
    self->status = shed ? 2 : 1;
    if (shed) {
        self->phase = self->phase == PCL2_FRESH ? PCL2_FRESH : PCL2_RETURNING;
        self->actual = self->fail ? PCL2_FAILED : PCL2_MAN;
    }
    if (mode == PCL2_MAN) {
        self->actual = PCL2_MAN;
    }
    if (self->actual == PCL2_FAILED) {
        self->u = pcl2_limited(self->safe, self->lo, self->hi);
    } else if (self->actual == PCL2_MAN && !pcl2_is_bad(um)) {
        self->u = pcl2_limited(um, self->lo, self->hi);
    }
}

/* Everything but the usual scan: u comes from elsewhere and I is set to fit. */
static void pcl2_pid_apart(struct pcl2_pid *self, pcl2_real y, pcl2_real sp, pcl2_real p, int32_t mode, pcl2_real um,
                           int32_t state, pcl2_real value)
{
    pcl2_real u = self->u;
    if (state == PCL2_WAITING) {
        u = value;
        self->actual = PCL2_INIT;
    } else if (mode == PCL2_MAN) {
        u = pcl2_is_bad(um) ? u : um;
        self->actual = PCL2_MAN;
    } else if (self->phase == PCL2_FRESH) {
        u = !self->sums ? p : pcl2_is_bad(um) ? u : um;
        self->actual = PCL2_AUTO;
    } else {
        self->actual = PCL2_AUTO;
    }
    self->u = pcl2_limited(u, self->lo, self->hi);
    self->i = self->u - p;
    if (self->phase == PCL2_FRESH && self->actual == PCL2_AUTO && !self->sums) {
        self->i = PCL2_R(0.0);
    }
    self->carry = PCL2_R(0.0);
    self->d = PCL2_R(0.0);
    self->y1 = y;
    self->ws = sp;
    self->phase = PCL2_RUNNING;
}

PCL2_KERNEL void pcl2_pid(struct pcl2_pid *self, pcl2_real y, pcl2_real w, int32_t mode, pcl2_real cas, pcl2_real um,
                          const pcl2_real *back, pcl2_real *bk)
{
    const int32_t state = pcl2_return_state(back);
    pcl2_real sp, p, d, v;
    self->status = 0;
    sp = pcl2_pid_setpoint(self, y, w, mode, cas, state, bk);
    if (self->blind != 0 && !pcl2_is_bad(y)) {
        self->blind = 0;
        self->y1 = y;
    }
    p = self->kp * (self->bw * sp - y);
    d = self->ad * self->d + self->kd * (self->cw * (sp - self->ws) - (y - self->y1));
    v = p + self->i + d;
    if (pcl2_is_bad(p)) {
        self->ws = pcl2_is_bad(sp) ? self->ws : sp;
        pcl2_pid_blind(self, mode, um);
    } else if (pcl2_is_bad(v) || self->phase != PCL2_RUNNING || mode == PCL2_MAN || state == PCL2_WAITING) {
        pcl2_pid_apart(self, y, sp, p, mode, um, state, back[0]);
    } else {
        pcl2_real step = self->ki * (sp - y);
        const pcl2_real u = pcl2_limited(v, self->lo, self->hi);
        const pcl2_real followed = state == PCL2_FOLLOWING ? u : pcl2_held_back(state, back[0], self->u, &step, u);
        pcl2_accumulate(&self->i, &self->carry, step + self->kt * (followed - v));
        self->d = d;
        self->y1 = y;
        self->ws = sp;
        self->u = u;
        self->actual = mode == PCL2_CAS && self->wait == PCL2_LINKED ? PCL2_CAS : PCL2_AUTO;
    }
    pcl2_answer_master(bk, self->actual, self->ws, state, self->direct, pcl2_limit_state(self->u, self->lo, self->hi));
}
