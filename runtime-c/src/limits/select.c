/* Selectors of real signals. A selector hands back to each of its inputs: who is not selected would wind up otherwise. */
#include "pcl2_return.h"
#include "pcl2_select.h"

/* The index of the greatest (high) or least good signal, the first of equal ones; -1 when none is good. */
static inline int32_t pcl2_select_end(const pcl2_real *x, int32_t n, int32_t high)
{
    int32_t best = -1;
    for (int32_t i = 0; i < n; i++) {
        if (!pcl2_is_bad(x[i]) && (best < 0 || (high ? x[i] > x[best] : x[i] < x[best]))) {
            best = i;
        }
    }
    return best;
}

/* Hands back to the selected signal what downstream follows, to the others that value as a limit. */
static inline void pcl2_select_answer(pcl2_real y, int32_t best, const pcl2_real *back, int32_t n, int32_t limit,
                                      pcl2_real *bk)
{
    const int32_t state = pcl2_return_state(back);
    const pcl2_real followed = state == PCL2_FOLLOWING ? y : back[0];
    const int32_t others = state == PCL2_WAITING ? PCL2_WAITING : limit;
    for (int32_t i = 0; i < n; i++) {
        pcl2_hand_back(bk + 2 * i, followed, i == best ? state : others);
    }
}

PCL2_KERNEL void pcl2_hisel(struct pcl2_hisel *self, const pcl2_real *x, int32_t n, const pcl2_real *back,
                            pcl2_real *bk)
{
    const int32_t best = pcl2_select_end(x, n, 1);
    self->status = best < 0;
    if (best >= 0) {
        self->y = x[best];
        self->idx = best + 1;
        pcl2_select_answer(self->y, best, back, n, PCL2_LIMITED_LOW, bk);
    }
}

PCL2_KERNEL void pcl2_losel(struct pcl2_losel *self, const pcl2_real *x, int32_t n, const pcl2_real *back,
                            pcl2_real *bk)
{
    const int32_t best = pcl2_select_end(x, n, 0);
    self->status = best < 0;
    if (best >= 0) {
        self->y = x[best];
        self->idx = best + 1;
        pcl2_select_answer(self->y, best, back, n, PCL2_LIMITED_HIGH, bk);
    }
}

enum { MIDSEL_SINGLE = 1, MIDSEL_NONE = 2, MIDSEL_DEVIATION = 3 };

static inline pcl2_real pcl2_midsel_distance(pcl2_real a, pcl2_real b)
{
    return a < b ? b - a : a - b;
}

/* Of three good signals the median; odd is the one that is furthest from it, if further than dev. */
static inline void pcl2_midsel_three(struct pcl2_midsel *self, const pcl2_real *x, pcl2_real dev)
{
    const pcl2_real low = x[0] < x[1] ? x[0] : x[1];
    const pcl2_real high = x[0] < x[1] ? x[1] : x[0];
    const pcl2_real y = x[2] < low ? low : x[2] > high ? high : x[2];
    pcl2_real furthest = dev;
    for (int32_t i = 0; i < 3 && dev > PCL2_R(0.0); i++) {
        const pcl2_real distance = pcl2_midsel_distance(x[i], y);
        if (distance > furthest) {
            furthest = distance;
            self->odd = i + 1;
        }
    }
    self->y = y;
}

/* Of two good signals the mean, or the one nearer to the last y when they are further than dev apart; the first of
 * them where there is no last y. */
static inline void pcl2_midsel_two(struct pcl2_midsel *self, const pcl2_real *x, int32_t i, int32_t j, pcl2_real dev)
{
    if (dev > PCL2_R(0.0) && pcl2_midsel_distance(x[i], x[j]) > dev) {
        const int32_t nearer = pcl2_midsel_distance(x[j], self->y) < pcl2_midsel_distance(x[i], self->y);
        const int32_t second = self->started & nearer;
        self->odd = second ? i + 1 : j + 1;
        self->y = second ? x[j] : x[i];
    } else {
        /* Halves first: the sum may be beyond the reals. */
        self->y = x[i] * PCL2_R(0.5) + x[j] * PCL2_R(0.5);
    }
}

PCL2_KERNEL void pcl2_midsel_init(struct pcl2_midsel *self, pcl2_real dev)
{
    (void)self;
    (void)dev;
}

PCL2_KERNEL void pcl2_midsel(struct pcl2_midsel *self, pcl2_real x1, pcl2_real x2, pcl2_real x3, pcl2_real dev)
{
    const pcl2_real x[3] = {x1, x2, x3};
    int32_t place[3] = {0, 0, 0};
    int32_t good = 0;
    for (int32_t i = 0; i < 3; i++) {
        place[good] = i;
        good += !pcl2_is_bad(x[i]);
    }
    self->good = good;
    self->odd = 0;
    if (good == 3) {
        pcl2_midsel_three(self, x, dev);
    } else if (good == 2) {
        pcl2_midsel_two(self, x, place[0], place[1], dev);
    } else if (good == 1) {
        self->y = x[place[0]];
    }
    self->started |= good != 0;
    self->status = good == 0 ? MIDSEL_NONE : good == 1 ? MIDSEL_SINGLE : self->odd != 0 ? MIDSEL_DEVIATION : 0;
}

/* The values of mode. */
enum { ISEL_FIRST = 0, ISEL_MIN = 1, ISEL_MAX = 2, ISEL_MID = 3, ISEL_AVG = 4, ISEL_OPERATOR = 5 };

/* The indexes of the good signals in ascending order of their values; returns how many there are. */
static int32_t pcl2_isel_sort(const pcl2_real *x, int32_t n, int32_t *order)
{
    int32_t good = 0;
    for (int32_t i = 0; i < n; i++) {
        if (!pcl2_is_bad(x[i])) {
            int32_t at = good;
            for (; at > 0 && x[order[at - 1]] > x[i]; at--) {
                order[at] = order[at - 1];
            }
            order[at] = i;
            good++;
        }
    }
    return good;
}

static pcl2_real pcl2_isel_mean(const pcl2_real *x, const int32_t *order, int32_t good)
{
    const pcl2_real part = PCL2_R(1.0) / (pcl2_real)good;
    pcl2_real sum = PCL2_R(0.0);
    for (int32_t i = 0; i < good; i++) {
        sum += x[order[i]] * part;
    }
    return sum;
}

PCL2_KERNEL void pcl2_isel(struct pcl2_isel *self, const pcl2_real *x, int32_t n, int32_t sel, int32_t mode,
                           int32_t mingood, int32_t *order)
{
    const int32_t good = pcl2_isel_sort(x, n, order);
    const int32_t chosen = sel < 1 ? 0 : sel > n ? n - 1 : sel - 1;
    int32_t idx = 0;
    self->status = good < mingood || (mode == ISEL_OPERATOR && pcl2_is_bad(x[chosen]));
    if (self->status != 0) {
        return;
    }
    if (mode == ISEL_OPERATOR) {
        idx = chosen + 1;
    } else if (mode == ISEL_MIN) {
        idx = order[0] + 1;
    } else if (mode == ISEL_MAX) {
        idx = order[good - 1] + 1;
    } else if (mode == ISEL_MID && good % 2 != 0) {
        idx = order[good / 2] + 1;
    } else if (mode == ISEL_FIRST) {
        while (pcl2_is_bad(x[idx])) {
            idx++;
        }
        idx++;
    }
    if (idx != 0) {
        self->y = x[idx - 1];
    } else if (mode == ISEL_MID) {
        self->y = x[order[good / 2 - 1]] * PCL2_R(0.5) + x[order[good / 2]] * PCL2_R(0.5);
    } else {
        self->y = pcl2_isel_mean(x, order, good);
    }
    self->idx = idx;
}
