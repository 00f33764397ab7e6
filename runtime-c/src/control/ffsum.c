/* ffsum: feed-forward sum with a balance that takes up every bump.
 *
 * gain1, offset1: the feed-forward in force, 0 while it is off
 * balance, way:   what is still added, and its way to 0 in a scan
 * stood:          u was not followed in the last scan
 * known:          0 before the first scan, then 1 before the first good ff, 2 while ff is good, 3 while it is not */
#include "pcl2_ffsum.h"
#include "pcl2_math.h"
#include "pcl2_station.h"

enum { FFSUM_HELD = 1, FFSUM_FORWARD = 2 };

PCL2_KERNEL void pcl2_ffsum_init(struct pcl2_ffsum *self, pcl2_real k, pcl2_real bias, pcl2_real tb, pcl2_real *bk)
{
    (void)self;
    (void)k;
    (void)bias;
    (void)tb;
    (void)bk;
}

PCL2_KERNEL void pcl2_ffsum_tune(struct pcl2_ffsum *self, pcl2_real k, pcl2_real bias, pcl2_real tb, int64_t T)
{
    self->gain = k;
    self->offset = bias;
    self->scans = tb / pcl2_seconds(T);
}

/* More to take up: it is gone when the balance time is over. */
static void ffsum_balance(struct pcl2_ffsum *self, pcl2_real more)
{
    const pcl2_real balance = self->balance + more;
    const int32_t none = self->scans < PCL2_R(1.0) || pcl2_is_bad(balance);
    self->balance = none ? PCL2_R(0.0) : balance;
    self->way = none ? PCL2_R(0.0) : pcl2_math_fabs(balance) / self->scans;
}

/* The feed-forward, unless it is bad for this scan. What changes but by ff itself goes into the balance. */
static pcl2_real ffsum_forward(struct pcl2_ffsum *self, pcl2_real ff, int32_t on)
{
    const int32_t bad = pcl2_is_bad(ff);
    self->status = bad ? FFSUM_FORWARD : self->status;
    const pcl2_real now = bad ? self->ff1 : ff;
    const int32_t acts = on != 0 && !(bad && self->known < 2);
    const pcl2_real gain = acts ? self->gain : PCL2_R(0.0);
    const pcl2_real offset = acts ? self->offset : PCL2_R(0.0);
    const pcl2_real returns = self->known == 3 && !bad ? self->ff1 : now;
    if (self->known != 0 && (gain != self->gain1 || offset != self->offset1 || returns != now)) {
        ffsum_balance(self, self->gain1 * returns + self->offset1 - (gain * now + offset));
    }
    self->known = !bad ? 2 : self->known < 2 ? 1 : 3;
    self->ff1 = now;
    self->gain1 = gain;
    self->offset1 = offset;
    return gain * now + offset;
}

PCL2_KERNEL void pcl2_ffsum(struct pcl2_ffsum *self, pcl2_real u, pcl2_real ff, int32_t on, const pcl2_real *back,
                            pcl2_real *bk)
{
    const int32_t told = pcl2_return_state(back);
    self->balance = pcl2_approach(self->balance, PCL2_R(0.0), self->way, self->way);
    self->status = 0;
    const pcl2_real forward = ffsum_forward(self, ff, on);
    if (told == PCL2_WAITING) {
        self->y = back[0];
        self->balance = PCL2_R(0.0);
    }
    const int32_t bad = pcl2_is_bad(u + forward + self->balance);
    self->status = bad ? FFSUM_HELD : self->status;
    if (pcl2_awaits(&self->patience, bad || told == PCL2_WAITING, bk, u, self->y - forward - self->balance)) {
        self->stood = 1;
        pcl2_hand_back(bk, self->y - forward - self->balance, PCL2_WAITING);
        return;
    }
    if (self->stood) {
        ffsum_balance(self, self->y - (u + forward + self->balance));
        self->stood = 0;
    }
    const pcl2_real sum = u + forward + self->balance;
    self->y = pcl2_is_bad(sum) ? self->y : sum;
    pcl2_hand_back(bk, (told == PCL2_FOLLOWING ? self->y : back[0]) - forward - self->balance, told);
}
