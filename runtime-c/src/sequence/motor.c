/* Motor and on/off valve. Times are nanoseconds. */
#include "pcl2_motor.h"
#include "pcl2_timing.h"

/* What state and cause of a motor say. */
enum { MOTOR_STOPPED = 0, MOTOR_STARTING = 1, MOTOR_RUNNING = 2, MOTOR_STOPPING = 3, MOTOR_FAILED = 4 };
enum { MOTOR_NONE = 0, MOTOR_INTERLOCK = 1, MOTOR_TRIP = 2, MOTOR_NO_START = 3, MOTOR_LOST = 4, MOTOR_NO_STOP = 5 };

PCL2_KERNEL void pcl2_motor_tune(
    struct pcl2_motor *self, pcl2_real tstart, pcl2_real tstop, pcl2_real tinh, int64_t T)
{
    self->starts = pcl2_set_time(tstart, T);
    self->stops = pcl2_set_time(tstop, T);
    self->inhibit = pcl2_set_time(tinh, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_motor_init(struct pcl2_motor *self, pcl2_real tstart, pcl2_real tstop, pcl2_real tinh)
{
    (void)tstart;
    (void)tstop;
    (void)tinh;
    self->rest = INT64_C(1) << 62;
}

static inline int32_t pcl2_motor_drives(int32_t state)
{
    return state == MOTOR_STARTING || state == MOTOR_RUNNING;
}

static void pcl2_motor_enter(struct pcl2_motor *self, int32_t state, int32_t cause)
{
    if (pcl2_motor_drives(self->state) && !pcl2_motor_drives(state)) {
        self->rest = 0;
    }
    self->state = state;
    self->cause = cause;
    self->elapsed = 0;
}

/* Starting or running, and no trip. */
static void pcl2_motor_driven(struct pcl2_motor *self, int32_t stop, int32_t fb, int32_t ilk)
{
    if (stop != 0) {
        pcl2_motor_enter(self, MOTOR_STOPPING, MOTOR_NONE);
    } else if (ilk == 0) {
        pcl2_motor_enter(self, MOTOR_STOPPING, MOTOR_INTERLOCK);
    } else if (self->state == MOTOR_RUNNING) {
        if (fb == 0) {
            pcl2_motor_enter(self, MOTOR_FAILED, MOTOR_LOST);
        }
    } else if (fb != 0) {
        pcl2_motor_enter(self, MOTOR_RUNNING, MOTOR_NONE);
    } else if (self->elapsed >= self->starts) {
        pcl2_motor_enter(self, MOTOR_FAILED, MOTOR_NO_START);
    }
}

static void pcl2_motor_stopping(struct pcl2_motor *self, int32_t fb)
{
    if (fb == 0) {
        pcl2_motor_enter(self, MOTOR_STOPPED, self->cause);
    } else if (self->elapsed >= self->stops) {
        pcl2_motor_enter(self, MOTOR_FAILED, MOTOR_NO_STOP);
    }
}

PCL2_KERNEL void pcl2_motor(
    struct pcl2_motor *self, int32_t start, int32_t stop, int32_t fb, int32_t trip, int32_t ilk, int32_t rst)
{
    const int64_t longest = INT64_C(1) << 62;
    const int32_t starts = (start != 0) & (self->laststart == 0) & self->started;
    const int32_t resets = (rst != 0) & (self->lastrst == 0) & self->started;
    const int32_t permitted = (stop == 0) & (trip == 0) & (ilk != 0) & (fb == 0);
    self->elapsed = pcl2_elapse(self->elapsed, self->tick, longest);
    self->rest = pcl2_elapse(self->rest, self->tick, longest);
    if (self->state == MOTOR_FAILED) {
        if (resets && trip == 0 && fb == 0) {
            pcl2_motor_enter(self, MOTOR_STOPPED, MOTOR_NONE);
        }
    } else if (trip != 0) {
        pcl2_motor_enter(self, MOTOR_FAILED, MOTOR_TRIP);
    } else if (self->state == MOTOR_STOPPED) {
        if (fb != 0) {
            pcl2_motor_enter(self, MOTOR_STOPPING, self->cause);
        } else if (starts && permitted && self->rest >= self->inhibit) {
            pcl2_motor_enter(self, MOTOR_STARTING, MOTOR_NONE);
        }
    } else if (self->state == MOTOR_STOPPING) {
        pcl2_motor_stopping(self, fb);
    } else {
        pcl2_motor_driven(self, stop, fb, ilk);
    }
    self->run = pcl2_motor_drives(self->state);
    self->ready = self->state == MOTOR_STOPPED && permitted && self->rest >= self->inhibit;
    self->tleft = self->rest < self->inhibit ? pcl2_seconds(self->inhibit - self->rest) : PCL2_R(0.0);
    self->laststart = start;
    self->lastrst = rst;
    self->started = 1;
}

/* What state and cause of a valve say. */
enum { VALVE_CLOSING = 0, VALVE_CLOSED = 1, VALVE_OPENING = 2, VALVE_OPENED = 3, VALVE_FAILED = 4 };
enum { VALVE_NONE = 0, VALVE_INTERLOCK = 1, VALVE_TRIP = 2, VALVE_NO_OPEN = 3, VALVE_MOVED = 4, VALVE_NO_CLOSE = 5 };

PCL2_KERNEL void pcl2_valveo_tune(struct pcl2_valveo *self, pcl2_real topen, pcl2_real tclose, int64_t T)
{
    self->opens = pcl2_set_time(topen, T);
    self->closes = pcl2_set_time(tclose, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_valveo_init(struct pcl2_valveo *self, pcl2_real topen, pcl2_real tclose)
{
    (void)self;
    (void)topen;
    (void)tclose;
}

static void pcl2_valveo_enter(struct pcl2_valveo *self, int32_t state, int32_t cause)
{
    self->state = state;
    self->cause = cause;
    self->elapsed = 0;
}

/* Opening or opened, and no trip. */
static void pcl2_valveo_driven(struct pcl2_valveo *self, int32_t close, int32_t ilk, int32_t is_open)
{
    if (close != 0) {
        pcl2_valveo_enter(self, VALVE_CLOSING, VALVE_NONE);
    } else if (ilk == 0) {
        pcl2_valveo_enter(self, VALVE_CLOSING, VALVE_INTERLOCK);
    } else if (self->state == VALVE_OPENED) {
        if (!is_open) {
            pcl2_valveo_enter(self, VALVE_FAILED, VALVE_MOVED);
        }
    } else if (is_open) {
        pcl2_valveo_enter(self, VALVE_OPENED, VALVE_NONE);
    } else if (self->elapsed >= self->opens) {
        pcl2_valveo_enter(self, VALVE_FAILED, VALVE_NO_OPEN);
    }
}

static void pcl2_valveo_closing(struct pcl2_valveo *self, int32_t is_closed)
{
    if (is_closed) {
        pcl2_valveo_enter(self, VALVE_CLOSED, self->cause);
    } else if (self->elapsed >= self->closes) {
        pcl2_valveo_enter(self, VALVE_FAILED, VALVE_NO_CLOSE);
    }
}

PCL2_KERNEL void pcl2_valveo(
    struct pcl2_valveo *self, int32_t open, int32_t close, int32_t fbo, int32_t fbc, int32_t trip, int32_t ilk,
    int32_t rst)
{
    const int64_t longest = INT64_C(1) << 62;
    const int32_t opens = (open != 0) & (self->lastopen == 0) & self->started;
    const int32_t resets = (rst != 0) & (self->lastrst == 0) & self->started;
    const int32_t is_open = (fbo != 0) & (fbc == 0);
    const int32_t is_closed = (fbo == 0) & (fbc != 0);
    const int32_t permitted = (close == 0) & (trip == 0) & (ilk != 0);
    self->elapsed = self->started != 0 ? pcl2_elapse(self->elapsed, self->tick, longest) : 0;
    if (self->state == VALVE_FAILED) {
        if (resets && trip == 0) {
            pcl2_valveo_enter(self, VALVE_CLOSING, VALVE_NONE);
        }
    } else if (trip != 0) {
        pcl2_valveo_enter(self, VALVE_FAILED, VALVE_TRIP);
    } else if (self->state == VALVE_CLOSING) {
        pcl2_valveo_closing(self, is_closed);
    } else if (self->state == VALVE_CLOSED) {
        if (!is_closed) {
            pcl2_valveo_enter(self, VALVE_FAILED, VALVE_MOVED);
        } else if (opens && permitted) {
            pcl2_valveo_enter(self, VALVE_OPENING, VALVE_NONE);
        }
    } else {
        pcl2_valveo_driven(self, close, ilk, is_open);
    }
    self->out = self->state == VALVE_OPENING || self->state == VALVE_OPENED;
    self->ready = self->state == VALVE_CLOSED && permitted;
    self->lastopen = open;
    self->lastrst = rst;
    self->started = 1;
}
