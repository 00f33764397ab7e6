/* Straight line through two points, with its return wire. */
#include "pcl2_scale.h"
#include "pcl2_return.h"

/* A line that is so steep, or nearly level, that its slope or the inverse leaves the range of a real is none. */
PCL2_KERNEL int32_t pcl2_scale_check(
    pcl2_real x0, pcl2_real x1, pcl2_real y0, pcl2_real y1, int32_t clip, pcl2_real *left)
{
    (void)clip;
    left[0] = x0;
    left[1] = x1;
    return x0 == x1 || pcl2_is_bad((y1 - y0) / (x1 - x0)) || (y0 != y1 && pcl2_is_bad((x1 - x0) / (y1 - y0)));
}

PCL2_KERNEL void pcl2_scale_tune(
    struct pcl2_scale *self, pcl2_real x0, pcl2_real x1, pcl2_real y0, pcl2_real y1, int32_t clip)
{
    self->gain = (y1 - y0) / (x1 - x0);
    self->inverse = y0 == y1 ? PCL2_R(0.0) : (x1 - x0) / (y1 - y0);
    self->xa = x0;
    self->ya = y0;
    self->low = clip == 0 ? -PCL2_REAL_MAX : y0 < y1 ? y0 : y1;
    self->high = clip == 0 ? PCL2_REAL_MAX : y0 < y1 ? y1 : y0;
}

/* What is followed downstream, y, as the value of x that gives it. */
static void pcl2_scale_return(const struct pcl2_scale *self, pcl2_real y, int32_t state, pcl2_real *bk)
{
    const int32_t turned = self->gain < 0 ? pcl2_return_reversed(state) : state;
    pcl2_hand_back(bk, self->xa + (y - self->ya) * self->inverse, turned);
}

PCL2_KERNEL void pcl2_scale(struct pcl2_scale *self, pcl2_real x, const pcl2_real *back, pcl2_real *bk)
{
    const pcl2_real line = self->ya + (x - self->xa) * self->gain;
    const int32_t own = line > self->high ? PCL2_LIMITED_HIGH : line < self->low ? PCL2_LIMITED_LOW : PCL2_FOLLOWING;
    const pcl2_real y = own == PCL2_LIMITED_HIGH ? self->high : own == PCL2_LIMITED_LOW ? self->low : line;
    const int32_t state = pcl2_return_state(back);
    const int32_t level = self->gain > 0 || self->gain < 0 ? 0 : 1;
    self->y = pcl2_is_bad(x) ? pcl2_bad() : y;
    if (state != PCL2_FOLLOWING && level == 0) {
        pcl2_scale_return(self, back[0], state, bk);
    } else if (!pcl2_is_bad(x) && own != PCL2_FOLLOWING && level == 0) {
        pcl2_scale_return(self, y, own, bk);
    } else if (!pcl2_is_bad(x)) {
        pcl2_hand_back(bk, x, PCL2_FOLLOWING);
    }
}
