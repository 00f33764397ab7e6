/* bgs: bias/gain station with a balance that takes up every bump.
 *
 * gain1, bias1:  those of the last scan
 * balance, way:  what is still added, and its way to 0 in a scan
 * stood:         x was not followed in the last scan */
#include "pcl2_bgs.h"
#include "pcl2_math.h"
#include "pcl2_station.h"

enum { BGS_HELD = 1 };

PCL2_KERNEL void pcl2_bgs_init(struct pcl2_bgs *self, pcl2_real bias, pcl2_real balt, pcl2_real gain, pcl2_real lo,
                               pcl2_real hi, pcl2_real *bk)
{
    (void)self;
    (void)bias;
    (void)balt;
    (void)gain;
    (void)lo;
    (void)hi;
    (void)bk;
}

PCL2_KERNEL void pcl2_bgs_tune(struct pcl2_bgs *self, pcl2_real bias, pcl2_real balt, pcl2_real gain, pcl2_real lo,
                               pcl2_real hi, int64_t T)
{
    self->offset = bias;
    self->slope = gain;
    self->scans = balt / pcl2_seconds(T);
    self->low = lo;
    self->high = hi;
}

/* More to take up: it is gone when the balance time is over. */
static void bgs_balance(struct pcl2_bgs *self, pcl2_real more)
{
    const pcl2_real balance = self->balance + more;
    const int32_t none = self->scans < PCL2_R(1.0) || pcl2_is_bad(balance);
    self->balance = none ? PCL2_R(0.0) : balance;
    self->way = none ? PCL2_R(0.0) : pcl2_math_fabs(balance) / self->scans;
}

/* y without its balance, before its limits. */
static pcl2_real bgs_line(const struct pcl2_bgs *self, pcl2_real x)
{
    return self->slope * x + self->offset;
}

/* The x that gives y. */
static pcl2_real bgs_inverse(const struct pcl2_bgs *self, pcl2_real y)
{
    return (y - self->offset - self->balance) / self->slope;
}

/* What is wanted where x is not followed. */
static void bgs_stand(struct pcl2_bgs *self, const pcl2_real *told, int32_t manual, pcl2_real um)
{
    if (told != NULL) {
        self->y = told[0];
        self->actual = PCL2_INIT;
    } else if (manual) {
        self->status = pcl2_is_bad(um) ? BGS_HELD : 0;
        self->y = pcl2_within_or(um, self->low, self->high, self->y);
        self->actual = PCL2_MAN;
    }
    self->balance = PCL2_R(0.0);
    self->stood = self->started;
}

/* What changes but by x goes into the balance. */
static int32_t bgs_follow(struct pcl2_bgs *self, pcl2_real x)
{
    const pcl2_real line = bgs_line(self, x);
    if (self->stood) {
        bgs_balance(self, self->y - (line + self->balance));
    } else if (self->started && (self->slope != self->gain1 || self->offset != self->bias1)) {
        bgs_balance(self, self->gain1 * x + self->bias1 - line);
    }
    const pcl2_real sum = line + self->balance;
    self->y = pcl2_within_or(sum, self->low, self->high, self->y);
    self->stood = 0;
    return pcl2_stopped(sum, self->y);
}

PCL2_KERNEL void pcl2_bgs(struct pcl2_bgs *self, pcl2_real x, int32_t mode, pcl2_real um, const pcl2_real *back,
                          pcl2_real *bk)
{
    const int32_t told = pcl2_return_state(back);
    const int32_t init = told == PCL2_WAITING;
    const int32_t invertible = self->slope != PCL2_R(0.0);
    const int32_t bad = pcl2_is_bad(bgs_line(self, x));
    const int32_t stands = init || mode == PCL2_MAN || bad;
    self->balance = pcl2_approach(self->balance, PCL2_R(0.0), self->way, self->way);
    self->status = bad ? BGS_HELD : 0;
    self->actual = mode == PCL2_CAS ? PCL2_CAS : PCL2_AUTO;
    if (stands) {
        bgs_stand(self, init ? back : NULL, mode == PCL2_MAN, um);
    }
    const pcl2_real *const heard = invertible ? bk : NULL;
    const int32_t waits = pcl2_awaits(&self->patience, stands, heard, x, invertible ? bgs_inverse(self, self->y) : x);
    int32_t own = PCL2_FOLLOWING;
    if (!waits) {
        own = bgs_follow(self, x);
    } else if (!stands) {
        self->actual = PCL2_INIT;
    }
    const int32_t state = waits ? PCL2_WAITING : own != PCL2_FOLLOWING ? own : told;
    const pcl2_real followed = !waits && told != PCL2_FOLLOWING ? back[0] : self->y;
    if (!invertible) {
        pcl2_hand_back(bk, x, PCL2_FOLLOWING);
    } else {
        pcl2_hand_back(bk, bgs_inverse(self, followed), self->slope < PCL2_R(0.0) ? pcl2_return_reversed(state) : state);
    }
    self->gain1 = self->slope;
    self->bias1 = self->offset;
    self->started = 1;
}
