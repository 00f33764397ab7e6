/* Rate limiter with its return wire. */
#include "pcl2_ratelim.h"
#include "pcl2_return.h"
#include "pcl2_sum.h"

PCL2_KERNEL void pcl2_ratelim_init(struct pcl2_ratelim *self, pcl2_real up, pcl2_real dn, pcl2_real *bk)
{
    (void)up;
    (void)dn;
    (void)bk;
    self->started = 0;
}

PCL2_KERNEL void pcl2_ratelim_tune(struct pcl2_ratelim *self, pcl2_real up, pcl2_real dn, int64_t T)
{
    self->rise = up * pcl2_seconds(T);
    self->fall = dn * pcl2_seconds(T);
}

/* y is given from elsewhere: x is not followed. */
static void pcl2_ratelim_set(struct pcl2_ratelim *self, pcl2_real y, pcl2_real *bk)
{
    self->started = 1;
    self->y = y;
    self->carry = PCL2_R(0.0);
    self->lim = PCL2_FOLLOWING;
    pcl2_hand_back(bk, y, PCL2_WAITING);
}

static void pcl2_ratelim_move(struct pcl2_ratelim *self, pcl2_real x)
{
    const pcl2_real gap = self->started != 0 ? x - self->y : PCL2_R(0.0);
    self->started = 1;
    self->lim = gap > self->rise ? PCL2_LIMITED_HIGH : gap < -self->fall ? PCL2_LIMITED_LOW : PCL2_FOLLOWING;
    if (self->lim == PCL2_FOLLOWING) {
        self->y = x;
        self->carry = PCL2_R(0.0);
    } else {
        self->y = pcl2_sum(self->y, gap > PCL2_R(0.0) ? self->rise : -self->fall, &self->carry);
    }
}

PCL2_KERNEL void pcl2_ratelim(
    struct pcl2_ratelim *self, pcl2_real x, int32_t trk, pcl2_real xt, const pcl2_real *back, pcl2_real *bk)
{
    const int32_t state = pcl2_return_state(back);
    if (state == PCL2_WAITING) {
        pcl2_ratelim_set(self, back[0], bk);
    } else if (trk != 0) {
        pcl2_ratelim_set(self, pcl2_is_bad(xt) ? self->y : xt, bk);
    } else if (!pcl2_is_bad(x)) {
        pcl2_ratelim_move(self, x);
        if (state == PCL2_FOLLOWING) {
            pcl2_hand_back(bk, self->y, self->lim);
        } else {
            pcl2_hand_back(bk, back[0], state);
        }
    }
}
