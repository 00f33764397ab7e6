/* Moving average by running sums with carries (Neumaier, Zeitschrift fuer angewandte Mathematik und Mechanik 54, 1974),
 * so that a single huge value leaves no trace when it leaves the window. */
#include "pcl2_mavg.h"
#include "pcl2_sum.h"

PCL2_KERNEL void pcl2_mavg_init(struct pcl2_mavg *self, int32_t n, pcl2_real *ring)
{
    (void)n;
    (void)ring;
    self->started = 0;
}

/* 1 when the sum has a place among the reals. */
static int32_t pcl2_mavg_start(struct pcl2_mavg *self, pcl2_real x, int32_t n, pcl2_real *ring)
{
    const pcl2_real sum = x * (pcl2_real)n;
    for (int32_t i = 0; i < n; i++) {
        ring[i] = x;
    }
    self->started = !pcl2_is_bad(sum);
    self->sum = self->started != 0 ? sum : PCL2_R(0.0);
    return self->started;
}

/* fresh is the sum of what the ring got since slot 0: with the last slot it is the whole sum. */
PCL2_KERNEL void pcl2_mavg(struct pcl2_mavg *self, pcl2_real x, int32_t n, pcl2_real *ring)
{
    pcl2_real come = PCL2_R(0.0);
    pcl2_real gone;
    pcl2_real error;
    if (pcl2_is_bad(x) || (self->started == 0 && !pcl2_mavg_start(self, x, n, ring))) {
        return;
    }
    const int32_t last = self->at + 1 == n;
    const pcl2_real fresh = pcl2_two_sum(self->fresh, x, &error);
    const pcl2_real fresh_carry = self->fresh_carry + error;
    const pcl2_real less = pcl2_two_sum(self->sum, -ring[self->at], &gone);
    const pcl2_real sum = last ? fresh : pcl2_two_sum(less, x, &come);
    const pcl2_real carry = last ? fresh_carry : self->carry + (gone + come);
    if (pcl2_is_bad(sum) || pcl2_is_bad(fresh) || pcl2_is_bad(carry)) {
        return;
    }
    ring[self->at] = x;
    self->sum = sum;
    self->carry = carry;
    self->fresh = last ? PCL2_R(0.0) : fresh;
    self->fresh_carry = last ? PCL2_R(0.0) : fresh_carry;
    self->at = last ? 0 : self->at + 1;
    self->y = (sum + carry) / (pcl2_real)n;
}
