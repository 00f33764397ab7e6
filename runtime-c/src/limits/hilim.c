/* High and low limit with its return wire. */
#include "pcl2_hilim.h"
#include "pcl2_return.h"

PCL2_KERNEL void pcl2_hilim(struct pcl2_hilim *self, pcl2_real x, const pcl2_real *back, pcl2_real lo, pcl2_real hi,
                            pcl2_real *bk)
{
    if (PCL2_RARELY(pcl2_is_bad(x))) {
        self->y = x;
        self->flag = PCL2_FOLLOWING;
        return;
    }
    const int32_t state = pcl2_return_state(back);
    self->flag = x > hi ? PCL2_LIMITED_HIGH : x < lo ? PCL2_LIMITED_LOW : PCL2_FOLLOWING;
    self->y = x > hi ? hi : x < lo ? lo : x;
    if (state != PCL2_FOLLOWING) {
        pcl2_hand_back(bk, back[0], state);
    } else {
        pcl2_hand_back(bk, self->y, self->flag);
    }
}
