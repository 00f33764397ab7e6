/* Split range: one master, several outputs, and the return wire from these to that. */
#include "pcl2_return.h"
#include "pcl2_split.h"

enum { SPLIT_ORDER = 1, SPLIT_FLAT = 2 };

PCL2_KERNEL int32_t pcl2_split_check(int32_t n, const pcl2_real *x0, const pcl2_real *x1, const pcl2_real *y0,
                                     const pcl2_real *y1, pcl2_real *left)
{
    for (int32_t i = 0; i < n; i++) {
        const pcl2_real slope = (y1[i] - y0[i]) / (x1[i] - x0[i]);
        if (!(x0[i] < x1[i])) {
            left[0] = x0[i];
            left[1] = x1[i];
            return SPLIT_ORDER;
        }
        /* A slope that is lost beside 0 or beyond the reals cannot be mapped back. */
        if (slope == PCL2_R(0.0) || pcl2_is_bad(slope) || pcl2_is_bad(PCL2_R(1.0) / slope)) {
            left[0] = y0[i];
            return SPLIT_FLAT;
        }
    }
    return 0;
}

PCL2_KERNEL void pcl2_split_tune(struct pcl2_split *self, int32_t n, const pcl2_real *x0, const pcl2_real *x1,
                                 const pcl2_real *y0, const pcl2_real *y1, pcl2_real *start, pcl2_real *stop,
                                 pcl2_real *first, pcl2_real *last, pcl2_real *slope, pcl2_real *inverse)
{
    self->status = 0;
    for (int32_t i = 0; i < n; i++) {
        start[i] = x0[i];
        stop[i] = x1[i];
        first[i] = y0[i];
        last[i] = y1[i];
        slope[i] = (y1[i] - y0[i]) / (x1[i] - x0[i]);
        inverse[i] = (x1[i] - x0[i]) / (y1[i] - y0[i]);
    }
}

PCL2_KERNEL void pcl2_split(struct pcl2_split *self, pcl2_real x, int32_t n, const pcl2_real *back1,
                            const pcl2_real *back2, const pcl2_real *back3, const pcl2_real *back4,
                            const pcl2_real *start, const pcl2_real *stop, const pcl2_real *first,
                            const pcl2_real *last, const pcl2_real *slope, const pcl2_real *inverse, pcl2_real *y,
                            pcl2_real *bk)
{
    (void)self;
    const pcl2_real *const back[4] = {back1, back2, back3, back4};
    const int32_t bad = pcl2_is_bad(x);
    pcl2_real lowest = start[0];
    pcl2_real highest = stop[0];
    /* Whether some output can follow upwards and downwards; the limited output that holds x; the output to wait for. */
    int32_t up = 0;
    int32_t down = 0;
    int32_t limited = 0;
    int32_t waits = 0;
    int32_t inside = 0;
    pcl2_real stopped = x;
    pcl2_real awaited = x;
    for (int32_t i = 0; i < n; i++) {
        const pcl2_real on_line = x >= stop[i] ? last[i] : first[i] + slope[i] * (x - start[i]);
        const int32_t told = pcl2_return_state(back[i]);
        const int32_t state = slope[i] < PCL2_R(0.0) ? pcl2_return_reversed(told) : told;
        y[i] = bad ? x : x < start[i] ? first[i] : on_line;
        lowest = start[i] < lowest ? start[i] : lowest;
        highest = stop[i] > highest ? stop[i] : highest;
        up |= x < stop[i] && state != PCL2_LIMITED_HIGH;
        down |= x > start[i] && state != PCL2_LIMITED_LOW;
        if (state == PCL2_FOLLOWING) {
            continue;
        }
        const pcl2_real mapped = start[i] + inverse[i] * (back[i][0] - first[i]);
        if (state == PCL2_WAITING) {
            const int32_t within = mapped > start[i] && mapped < stop[i];
            awaited = waits == 0 || (within && !inside) ? mapped : awaited;
            inside |= within;
            waits = 1;
        } else if (limited == 0 && x >= start[i] && x <= stop[i]) {
            stopped = mapped;
            limited = 1;
        }
    }
    if (bad) {
        return;
    }
    const pcl2_real own = x < lowest ? lowest : x > highest ? highest : x;
    if (waits) {
        pcl2_hand_back(bk, pcl2_is_bad(awaited) ? own : awaited, PCL2_WAITING);
    } else if (up && down) {
        pcl2_hand_back(bk, own, PCL2_FOLLOWING);
    } else {
        const pcl2_real value = limited && !pcl2_is_bad(stopped) ? stopped : own;
        pcl2_hand_back(bk, value, up ? PCL2_LIMITED_LOW : PCL2_LIMITED_HIGH);
    }
}
