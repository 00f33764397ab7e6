/* Integral and totaliser: sums that lose nothing (Knuth, The Art of Computer Programming 2, 4.2.2). */
#include "pcl2_integ.h"
#include "pcl2_sum.h"

PCL2_KERNEL void pcl2_integ_init(
    struct pcl2_integ *self, pcl2_real k, pcl2_real lo, pcl2_real hi, pcl2_real y0, int32_t mode)
{
    (void)k;
    (void)lo;
    (void)hi;
    (void)mode;
    self->y = y0;
}

/* Both modes take step (x + other): other is x' or x. */
PCL2_KERNEL void pcl2_integ_tune(
    struct pcl2_integ *self, pcl2_real k, pcl2_real lo, pcl2_real hi, pcl2_real y0, int32_t mode, int64_t T)
{
    self->step = k * (pcl2_seconds(T) / 2);
    self->low = lo;
    self->high = hi;
    self->base = y0;
    self->euler = mode;
}

/* At a limit nothing is carried. */
static void pcl2_integ_put(struct pcl2_integ *self, pcl2_real y, pcl2_real carry)
{
    const int32_t inside = y >= self->low && y <= self->high;
    self->y = inside ? y : y > self->high ? self->high : self->low;
    self->carry = inside ? carry : PCL2_R(0.0);
}

PCL2_KERNEL void pcl2_integ(struct pcl2_integ *self, pcl2_real x, int32_t hold, int32_t rst)
{
    const pcl2_real other = self->euler == 0 && self->seeded != 0 ? self->x1 : x;
    const pcl2_real term = self->step * (x + other);
    pcl2_real carry = self->carry;
    self->seeded = !pcl2_is_bad(x);
    self->x1 = self->seeded ? x : PCL2_R(0.0);
    if (rst != 0) {
        pcl2_integ_put(self, self->base, PCL2_R(0.0));
    } else if (hold == 0 && !pcl2_is_bad(term)) {
        const pcl2_real y = pcl2_sum(self->y, term, &carry);
        pcl2_integ_put(self, y, carry);
    }
}

/* Counts before r starts again; most counts of a scan. */
#define PCL2_TOTAL_FULL 1000000000
#define PCL2_TOTAL_MOST PCL2_R(5e8)

PCL2_KERNEL void pcl2_total_init(struct pcl2_total *self, pcl2_real k, int32_t unit, pcl2_real cut)
{
    (void)k;
    (void)unit;
    (void)cut;
    self->whole = 0;
}

PCL2_KERNEL void pcl2_total_tune(struct pcl2_total *self, pcl2_real k, int32_t unit, pcl2_real cut, int64_t T)
{
    const pcl2_real seconds = unit == 0 ? PCL2_R(1.0) : unit == 1 ? PCL2_R(60.0) : PCL2_R(3600.0);
    self->step = k * (pcl2_seconds(T) / seconds);
    self->least = cut;
}

/* Moves whole counts out of the fraction, which stays below 1 and takes term, at most PCL2_TOTAL_MOST. */
static void pcl2_total_count(struct pcl2_total *self, pcl2_real term)
{
    const pcl2_real sum = pcl2_sum(self->fraction, term, &self->carry);
    const int32_t counts = (int32_t)sum;
    self->fraction = sum - (pcl2_real)counts;
    self->whole += counts;
    if (self->whole >= PCL2_TOTAL_FULL) {
        self->whole -= PCL2_TOTAL_FULL;
        self->wrap = pcl2_add_i(self->wrap, 1);
    }
}

PCL2_KERNEL void pcl2_total(struct pcl2_total *self, pcl2_real x, int32_t rst)
{
    self->status = 0;
    if (rst != 0) {
        self->whole = 0;
        self->fraction = PCL2_R(0.0);
        self->carry = PCL2_R(0.0);
        self->wrap = 0;
    } else if (!pcl2_is_bad(x) && x >= self->least && x > PCL2_R(0.0)) {
        const pcl2_real term = self->step * x;
        self->status = !(term <= PCL2_TOTAL_MOST);
        pcl2_total_count(self, term <= PCL2_TOTAL_MOST ? term : PCL2_TOTAL_MOST);
    }
    self->r = (pcl2_real)self->whole + self->fraction;
}

#undef PCL2_TOTAL_FULL
#undef PCL2_TOTAL_MOST
