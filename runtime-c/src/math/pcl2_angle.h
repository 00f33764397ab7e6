/* What atan, atan2, asin and acos share: the angle of a point of the first quadrant as a pair. */
#ifndef PCL2_ANGLE_H
#define PCL2_ANGLE_H

#include "pcl2_pair.h"

/* atan(y/x), 0 to pi/2, with a relative error below 2^-60 (2^-31): x and y not negative, not both 0, at most 2^60,
 * the larger one at least 2^-60. */
struct pcl2_pair pcl2_angle(struct pcl2_pair y, struct pcl2_pair x);

/* pi/2 and pi */
#if PCL2_REAL_BITS == 64
static const struct pcl2_pair pcl2_right_angle = {1.5707963267948966, 6.123233995736766e-17};
#else
static const struct pcl2_pair pcl2_right_angle = {1.5707964f, -4.371139e-08f};
#endif

/* quarters pi/2 - angle, quarters 1 or 2 */
static inline struct pcl2_pair pcl2_angle_from(pcl2_real quarters, struct pcl2_pair angle)
{
    const struct pcl2_pair y = pcl2_pair_ordered_sum(quarters * pcl2_right_angle.head, -angle.head);
    return pcl2_pair_ordered_sum(y.head, y.tail + (quarters * pcl2_right_angle.tail - angle.tail));
}

/* sqrt(1 - x^2), the other side of a triangle, for |x| <= 1. */
static inline struct pcl2_pair pcl2_angle_side(pcl2_real x)
{
    const struct pcl2_pair square = pcl2_pair_product(x, x);
    const struct pcl2_pair rest = pcl2_pair_ordered_sum(PCL2_R(1.0), -square.head);
    const struct pcl2_pair w = pcl2_pair_ordered_sum(rest.head, rest.tail - square.tail);
    struct pcl2_pair y = {pcl2_math_sqrt(w.head), PCL2_R(0.0)};
    if (y.head > 0) {
        const struct pcl2_pair back = pcl2_pair_product(y.head, y.head);
        y.tail = (((w.head - back.head) - back.tail) + w.tail) / (2 * y.head);
    }
    return y;
}

#endif
