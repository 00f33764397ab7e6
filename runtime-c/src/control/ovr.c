/* ovr: override selector. */
#include "pcl2_ovr.h"
#include "pcl2_return.h"

enum { OVR_NONE = 1 };

PCL2_KERNEL void pcl2_ovr_init(struct pcl2_ovr *self, int32_t n, int32_t kind, pcl2_real *bk)
{
    (void)self;
    (void)n;
    (void)kind;
    (void)bk;
}

/* The number of the selected input, from 0; -1 when none is good. */
static int32_t ovr_select(const pcl2_real *x, int32_t n, int32_t high)
{
    int32_t best = -1;
    for (int32_t i = 0; i < n; ++i) {
        if (!pcl2_is_bad(x[i]) && (best < 0 || (high ? x[i] > x[best] : x[i] < x[best]))) {
            best = i;
        }
    }
    return best;
}

/* All wait for u. */
static void ovr_wait(const struct pcl2_ovr *self, int32_t n, pcl2_real *bk)
{
    for (int32_t i = 0; i < n; ++i) {
        pcl2_hand_back(bk + 2 * i, self->u, PCL2_WAITING);
    }
}

PCL2_KERNEL void pcl2_ovr(struct pcl2_ovr *self, const pcl2_real *x, int32_t n, const pcl2_real *back, int32_t kind,
                          pcl2_real *bk)
{
    const int32_t told = pcl2_return_state(back);
    const int32_t best = ovr_select(x, n, kind != 0);
    self->status = best < 0 ? OVR_NONE : 0;
    if (told == PCL2_WAITING) {
        self->u = back[0];
    }
    self->idx = best < 0 ? self->idx : best + 1;
    const pcl2_real selected = best < 0 ? self->u : x[best];
    if (pcl2_awaits(&self->patience, best < 0 || told == PCL2_WAITING, bk, selected, self->u)) {
        ovr_wait(self, n, bk);
        return;
    }
    self->u = selected;
    const pcl2_real followed = told == PCL2_FOLLOWING ? selected : back[0];
    const int32_t limited = kind != 0 ? PCL2_LIMITED_LOW : PCL2_LIMITED_HIGH;
    for (int32_t i = 0; i < n; ++i) {
        pcl2_hand_back(bk + 2 * i, followed, i == best ? told : limited);
    }
}
