/* three: step controller of a motor valve. Positions are times of the stroke, so that pulses add up exactly.
 *
 * at:     position
 * pulse:  time since the drive began to run this way
 * beyond: time driven against an end
 * drive:  1 up, -1 down, 0 at rest */
#include "pcl2_return.h"
#include "pcl2_three.h"

enum { THREE_SIGNAL = 1 };

PCL2_KERNEL void pcl2_three_init(struct pcl2_three *self, pcl2_real tstroke, pcl2_real tmin, pcl2_real db, pcl2_real *bk)
{
    (void)self;
    (void)tstroke;
    (void)tmin;
    (void)db;
    (void)bk;
}

PCL2_KERNEL void pcl2_three_tune(struct pcl2_three *self, pcl2_real tstroke, pcl2_real tmin, pcl2_real db, int64_t T)
{
    self->seconds = tstroke;
    self->stroke = pcl2_nanoseconds(tstroke);
    self->least = pcl2_nanoseconds(tmin);
    self->dead = pcl2_nanoseconds(db / PCL2_R(100.0) * tstroke);
    self->scan = T;
}

/* A position in percent as a time. */
static int64_t three_time(const struct pcl2_three *self, pcl2_real percent)
{
    const pcl2_real part = percent < PCL2_R(100.0) ? percent / PCL2_R(100.0) : PCL2_R(1.0);
    const int64_t time = pcl2_nanoseconds(part * self->seconds);
    return time < self->stroke ? time : self->stroke;
}

/* Where the valve is now. */
static void three_locate(struct pcl2_three *self, pcl2_real u, pcl2_real fb)
{
    const int64_t moved = self->at + self->drive * self->scan;
    if (!pcl2_is_bad(fb)) {
        self->at = three_time(self, fb);
    } else if (!self->started) {
        self->at = pcl2_is_bad(u) ? 0 : three_time(self, u);
    } else {
        self->at = moved < 0 ? 0 : moved > self->stroke ? self->stroke : moved;
    }
    self->pos = pcl2_is_bad(fb) ? pcl2_seconds(self->at) / self->seconds * PCL2_R(100.0) : fb;
}

/* The drive for a way still to go: a running one ends, or a resting one begins. */
static int32_t three_drive(const struct pcl2_three *self, int64_t way)
{
    const int64_t ahead = self->drive < 0 ? -way : way;
    if (self->drive != 0) {
        return self->pulse < self->least || ahead > self->scan / 2 ? self->drive : 0;
    }
    const int64_t size = way < 0 ? -way : way;
    return size <= self->dead || size < self->least || size <= self->scan / 2 ? 0 : way < 0 ? -1 : 1;
}

/* Against the end at which an estimated valve should be; 0 where that is done. */
static int32_t three_seat(struct pcl2_three *self, int64_t wanted)
{
    const int32_t end = wanted == 0 ? -1 : wanted == self->stroke ? 1 : 0;
    if (end == 0 || wanted != self->at) {
        self->beyond = 0;
        return 0;
    }
    if (self->beyond >= self->stroke / 10) {
        return 0;
    }
    self->beyond += self->scan;
    return end;
}

static void three_run(struct pcl2_three *self, pcl2_real u, int32_t known)
{
    const int64_t wanted = three_time(self, u);
    const int32_t seat = known ? 0 : three_seat(self, wanted);
    const int32_t drive = seat != 0 ? seat : three_drive(self, wanted - self->at);
    self->pulse = drive != 0 && drive == self->drive ? self->pulse + self->scan : self->scan;
    self->drive = drive;
}

PCL2_KERNEL void pcl2_three(struct pcl2_three *self, pcl2_real u, pcl2_real fb, pcl2_real *bk)
{
    const int32_t bad = pcl2_is_bad(u);
    const int32_t known = !pcl2_is_bad(fb);
    self->status = bad ? THREE_SIGNAL : 0;
    three_locate(self, u, fb);
    if (pcl2_awaits(&self->patience, bad || (known && bk != NULL && !self->started), bk, u, self->pos)) {
        self->drive = 0;
        pcl2_hand_back(bk, self->pos, PCL2_WAITING);
    } else {
        three_run(self, u, known);
        pcl2_hand_back(bk, u > PCL2_R(100.0) ? PCL2_R(100.0) : u > PCL2_R(0.0) ? u : PCL2_R(0.0),
                       u > PCL2_R(100.0) ? PCL2_LIMITED_HIGH : u < PCL2_R(0.0) ? PCL2_LIMITED_LOW : PCL2_FOLLOWING);
    }
    self->up = self->drive > 0;
    self->dn = self->drive < 0;
    self->started = 1;
}
