/* Test signals. Time is counted in nanoseconds: within the period, or negative before the beginning. */
#include "pcl2_sources.h"
#include "pcl2_math.h"
#include "pcl2_timing.h"

PCL2_KERNEL void pcl2_stepgen_init(struct pcl2_stepgen *self, pcl2_real y0, pcl2_real y1, pcl2_real td)
{
    (void)y1;
    (void)td;
    self->y = y0;
}

PCL2_KERNEL void pcl2_stepgen_tune(struct pcl2_stepgen *self, pcl2_real y0, pcl2_real y1, pcl2_real td, int64_t T)
{
    self->before = y0;
    self->after = y1;
    self->tick = T;
    self->begin = pcl2_set_time(td, T);
}

PCL2_KERNEL void pcl2_stepgen(struct pcl2_stepgen *self)
{
    self->y = self->now < self->begin ? self->before : self->after;
    self->now += self->now < INT64_MAX / 2 ? self->tick : 0;
}

/* The time in a period of another length, the phase kept. */
static int64_t pcl2_sources_rescaled(int64_t now, int64_t old, int64_t length)
{
    if (now <= 0 || old <= 0 || old == length) {
        return now;
    }
    const pcl2_real phase = (pcl2_real)now / (pcl2_real)old;
    const int64_t time = (int64_t)(phase * (pcl2_real)length);
    return time < length ? time : length - 1;
}

static int64_t pcl2_sources_length(pcl2_real period, int64_t T)
{
    const int64_t length = pcl2_set_time(period, T);
    return length > 0 ? length : 1;
}

static int64_t pcl2_sources_next(int64_t now, int64_t tick, int64_t length)
{
    const int64_t next = now + tick;
    return next < length ? next : next % length;
}

PCL2_KERNEL void pcl2_pulsgen_init(
    struct pcl2_pulsgen *self, pcl2_real amp, pcl2_real period, pcl2_real width, pcl2_real bias, pcl2_real td)
{
    (void)amp;
    (void)period;
    (void)width;
    (void)bias;
    self->now = -pcl2_set_time(td, self->tick);
}

PCL2_KERNEL void pcl2_pulsgen_tune(
    struct pcl2_pulsgen *self, pcl2_real amp, pcl2_real period, pcl2_real width, pcl2_real bias, int64_t T)
{
    const int64_t length = pcl2_sources_length(period, T);
    self->now = pcl2_sources_rescaled(self->now, self->length, length);
    self->high = bias + amp;
    self->low = bias;
    self->tick = T;
    self->length = length;
    self->on = pcl2_set_time(width, T);
}

PCL2_KERNEL void pcl2_pulsgen(struct pcl2_pulsgen *self)
{
    self->y = self->now >= 0 && self->now < self->on ? self->high : self->low;
    self->now = pcl2_sources_next(self->now, self->tick, self->length);
}

PCL2_KERNEL void pcl2_trigen_init(
    struct pcl2_trigen *self, pcl2_real amp, pcl2_real period, pcl2_real bias, pcl2_real td)
{
    (void)amp;
    (void)period;
    (void)bias;
    self->now = -pcl2_set_time(td, self->tick);
}

PCL2_KERNEL void pcl2_trigen_tune(
    struct pcl2_trigen *self, pcl2_real amp, pcl2_real period, pcl2_real bias, int64_t T)
{
    const int64_t length = pcl2_sources_length(period, T);
    self->now = pcl2_sources_rescaled(self->now, self->length, length);
    self->size = amp;
    self->middle = bias;
    self->tick = T;
    self->length = length;
}

PCL2_KERNEL void pcl2_trigen(struct pcl2_trigen *self)
{
    const pcl2_real quarters = self->now > 0 ? 4 * ((pcl2_real)self->now / (pcl2_real)self->length) : PCL2_R(0.0);
    const pcl2_real shape = quarters < 1 ? quarters : quarters < 3 ? 2 - quarters : quarters - 4;
    self->y = self->middle + self->size * shape;
    self->now = pcl2_sources_next(self->now, self->tick, self->length);
}

PCL2_KERNEL void pcl2_singen_init(
    struct pcl2_singen *self, pcl2_real amp, pcl2_real period, pcl2_real phase, pcl2_real bias, pcl2_real td)
{
    (void)amp;
    (void)period;
    (void)phase;
    (void)bias;
    self->now = -pcl2_set_time(td, self->tick);
}

PCL2_KERNEL void pcl2_singen_tune(
    struct pcl2_singen *self, pcl2_real amp, pcl2_real period, pcl2_real phase, pcl2_real bias, int64_t T)
{
    const int64_t length = pcl2_sources_length(period, T);
    self->now = pcl2_sources_rescaled(self->now, self->length, length);
    self->size = amp;
    self->middle = bias;
    self->angle = phase;
    self->tick = T;
    self->length = length;
}

PCL2_KERNEL void pcl2_singen(struct pcl2_singen *self)
{
    const pcl2_real turn = PCL2_R(6.283185307179586476925);
    const pcl2_real angle = turn * ((pcl2_real)self->now / (pcl2_real)self->length) + self->angle;
    self->y = self->now < 0 ? self->middle : self->middle + self->size * pcl2_math_sin(angle);
    self->now = pcl2_sources_next(self->now, self->tick, self->length);
}

PCL2_KERNEL void pcl2_sweep_init(
    struct pcl2_sweep *self, pcl2_real amp, pcl2_real f0, pcl2_real f1, pcl2_real length, pcl2_real bias, pcl2_real td)
{
    (void)amp;
    (void)f0;
    (void)f1;
    (void)length;
    (void)bias;
    self->now = -pcl2_set_time(td, self->tick);
}

PCL2_KERNEL void pcl2_sweep_tune(
    struct pcl2_sweep *self, pcl2_real amp, pcl2_real f0, pcl2_real f1, pcl2_real length, pcl2_real bias, int64_t T)
{
    self->size = amp;
    self->middle = bias;
    self->first = f0;
    self->slope = (f1 - f0) / length / 2;
    self->tick = T;
    self->span = pcl2_sources_length(length, T);
}

/* What is left of the turns when the whole ones are gone; of turns beyond counting nothing. */
static pcl2_real pcl2_sweep_part(pcl2_real turns)
{
    return turns < PCL2_R(1e9) ? turns - (pcl2_real)(int32_t)turns : PCL2_R(0.0);
}

PCL2_KERNEL void pcl2_sweep(struct pcl2_sweep *self)
{
    const pcl2_real turn = PCL2_R(6.283185307179586476925);
    const pcl2_real time = pcl2_seconds(self->now > 0 ? self->now : 0);
    const pcl2_real part = pcl2_sweep_part(time * (self->first + self->slope * time));
    self->y = self->middle + self->size * pcl2_math_sin(turn * part);
    self->now = pcl2_sources_next(self->now, self->tick, self->span);
}
