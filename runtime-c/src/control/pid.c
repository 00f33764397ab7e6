/* PID controller, ISA form (K. J. Astrom, T. Hagglund, Advanced PID Control, ch. 3). I and D are kept in units of the
 * output, so that a change of Ti or Td needs nothing and every transfer only sets I. */
#include "pcl2_pid.h"

#include "pcl2_math.h"
#include "pcl2_return.h"

/* mode and actual. */
#define PID_MAN 0
#define PID_AUTO 1
#define PID_CAS 2
#define PID_INIT 4
#define PID_FAILED 5

/* phase: nothing known yet, in control, to take up control from where u is. */
#define PID_FRESH 0
#define PID_RUNNING 1
#define PID_RETURNING 2

/* wait: scans that cas was waited for; this when it is followed. */
#define PID_LINKED (-1)
#define PID_PATIENCE 16

static pcl2_real pcl2_pid_limited(const struct pcl2_pid *self, pcl2_real u)
{
    return u > self->hi ? self->hi : u >= self->lo ? u : self->lo;
}

PCL2_KERNEL void pcl2_pid_tune(struct pcl2_pid *self, pcl2_real K, pcl2_real Ti, pcl2_real Td, pcl2_real N, pcl2_real b,
                               pcl2_real c, pcl2_real umin, pcl2_real umax, int32_t act, pcl2_real tbad, int32_t onfail,
                               pcl2_real ufail, int64_t T)
{
    const pcl2_real h = pcl2_seconds(T);
    const pcl2_real kp = act == 0 ? K : -K;
    const pcl2_real reset = Td > PCL2_R(0.0) ? pcl2_math_sqrt(Ti) * pcl2_math_sqrt(Td) : Ti;
    const pcl2_real shift = self->kp * (self->bw * self->ws - self->y1) - kp * (b * self->ws - self->y1);
    const int64_t patience = (pcl2_nanoseconds(tbad) + T - 1) / T;
    if (self->phase == PID_RUNNING && !pcl2_is_bad(self->i + shift)) {
        self->i += shift;
    }
    self->kp = kp;
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
    self->nbad = pcl2_saturate_i(patience);
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
    self->u = pcl2_pid_limited(self, PCL2_R(0.0));
    self->actual = PID_AUTO;
    pcl2_hand_back(bk, PCL2_R(0.0), PCL2_FOLLOWING);
}

/* The cascade's set-point: followed once it has come to the one in force. */
static pcl2_real pcl2_pid_cascade(struct pcl2_pid *self, pcl2_real y, pcl2_real cas, int32_t state)
{
    const int32_t apart = state == PCL2_WAITING || self->phase == PID_FRESH;
    if (self->wait == PID_LINKED && !apart) {
        return cas;
    }
    if (apart) {
        self->wait = 0;
        return y;
    }
    if (pcl2_has_come(cas, self->ws) || self->wait >= PID_PATIENCE) {
        self->wait = PID_LINKED;
        return cas;
    }
    self->wait++;
    return self->ws;
}

/* The set-point in force. */
static pcl2_real pcl2_pid_setpoint(struct pcl2_pid *self, pcl2_real y, pcl2_real w, int32_t mode, pcl2_real cas,
                                   int32_t state)
{
    const pcl2_real wanted = mode == PID_CAS ? cas : w;
    if (!pcl2_is_bad(wanted)) {
        if (mode == PID_CAS) {
            return pcl2_pid_cascade(self, y, cas, state);
        }
        self->wait = 0;
        return w;
    }
    self->wait = 0;
    if (pcl2_is_bad(self->ws)) {
        return y;
    }
    self->status = 3;
    return self->ws;
}

/* y is bad: hold, then shed. */
static void pcl2_pid_blind(struct pcl2_pid *self, int32_t mode, pcl2_real um)
{
    const int32_t shed = self->blind >= self->nbad;
    self->blind += !shed;
    self->status = shed ? 2 : 1;
    if (shed) {
        self->phase = self->phase == PID_FRESH ? PID_FRESH : PID_RETURNING;
        self->actual = self->fail ? PID_FAILED : PID_MAN;
    }
    if (mode == PID_MAN) {
        self->actual = PID_MAN;
    }
    if (self->actual == PID_FAILED) {
        self->u = pcl2_pid_limited(self, self->safe);
    } else if (self->actual == PID_MAN && !pcl2_is_bad(um)) {
        self->u = pcl2_pid_limited(self, um);
    }
}

/* Everything but the usual scan: u comes from elsewhere and I is set to fit. */
static void pcl2_pid_apart(struct pcl2_pid *self, pcl2_real y, pcl2_real sp, pcl2_real p, int32_t mode, pcl2_real um,
                           int32_t state, pcl2_real value)
{
    pcl2_real u = self->u;
    if (state == PCL2_WAITING) {
        u = value;
        self->actual = PID_INIT;
    } else if (mode == PID_MAN) {
        u = pcl2_is_bad(um) ? u : um;
        self->actual = PID_MAN;
    } else if (self->phase == PID_FRESH) {
        u = self->ki == PCL2_R(0.0) ? p : pcl2_is_bad(um) ? u : um;
        self->actual = PID_AUTO;
    } else {
        self->actual = PID_AUTO;
    }
    self->u = pcl2_pid_limited(self, u);
    self->i = self->u - p;
    if (self->phase == PID_FRESH && self->actual == PID_AUTO && self->ki == PCL2_R(0.0)) {
        self->i = PCL2_R(0.0);
    }
    self->carry = PCL2_R(0.0);
    self->d = PCL2_R(0.0);
    self->y1 = y;
    self->ws = sp;
    self->phase = PID_RUNNING;
}

/* I, compensated: a float integral moves by steps far below its last digit (Neumaier). */
static void pcl2_pid_integrate(struct pcl2_pid *self, pcl2_real step)
{
    const pcl2_real with_carry = step + self->carry;
    const pcl2_real sum = self->i + with_carry;
    if (!pcl2_is_bad(sum)) {
        self->carry = with_carry - (sum - self->i);
        self->i = sum;
    }
}

/* What of the step is left, and what is followed, where the block downstream is limited. */
static pcl2_real pcl2_pid_held_back(int32_t state, pcl2_real value, pcl2_real *step, pcl2_real u)
{
    if (state == PCL2_LIMITED_HIGH) {
        *step = *step > PCL2_R(0.0) ? PCL2_R(0.0) : *step;
        return value < u ? value : u;
    }
    *step = *step < PCL2_R(0.0) ? PCL2_R(0.0) : *step;
    return value > u ? value : u;
}

/* What the master of the cascade hears. */
static void pcl2_pid_answer(const struct pcl2_pid *self, int32_t state, pcl2_real *bk)
{
    int32_t limit = state;
    if (self->actual != PID_CAS) {
        pcl2_hand_back(bk, pcl2_is_bad(self->ws) ? PCL2_R(0.0) : self->ws, PCL2_WAITING);
        return;
    }
    if (limit == PCL2_FOLLOWING) {
        limit = self->u >= self->hi ? PCL2_LIMITED_HIGH : self->u <= self->lo ? PCL2_LIMITED_LOW : PCL2_FOLLOWING;
    }
    pcl2_hand_back(bk, self->ws, self->direct ? pcl2_return_reversed(limit) : limit);
}

PCL2_KERNEL void pcl2_pid(struct pcl2_pid *self, pcl2_real y, pcl2_real w, int32_t mode, pcl2_real cas, pcl2_real um,
                          const pcl2_real *back, pcl2_real *bk)
{
    const int32_t state = pcl2_return_state(back);
    pcl2_real sp, p, d, v;
    self->status = 0;
    sp = pcl2_pid_setpoint(self, y, w, mode, cas, state);
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
    } else if (pcl2_is_bad(v) || self->phase != PID_RUNNING || mode == PID_MAN || state == PCL2_WAITING) {
        pcl2_pid_apart(self, y, sp, p, mode, um, state, back[0]);
    } else {
        pcl2_real step = self->ki * (sp - y);
        const pcl2_real u = pcl2_pid_limited(self, v);
        const pcl2_real followed = state == PCL2_FOLLOWING ? u : pcl2_pid_held_back(state, back[0], &step, u);
        pcl2_pid_integrate(self, step + self->kt * (followed - v));
        self->d = d;
        self->y1 = y;
        self->ws = sp;
        self->u = u;
        self->actual = mode == PID_CAS && self->wait == PID_LINKED ? PID_CAS : PID_AUTO;
    }
    pcl2_pid_answer(self, state, bk);
}

#undef PID_MAN
#undef PID_AUTO
#undef PID_CAS
#undef PID_INIT
#undef PID_FAILED
#undef PID_FRESH
#undef PID_RUNNING
#undef PID_RETURNING
#undef PID_LINKED
#undef PID_PATIENCE
