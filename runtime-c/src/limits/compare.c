/* Comparisons of reals. Each keeps its q for the hysteresis; a limit beyond the reals is never passed. */
#include "pcl2_compare.h"
#include "pcl2_onbad.h"

/* The hysteresis as it counts: while q is 1. */
static inline pcl2_real pcl2_compare_less(int32_t q, pcl2_real h)
{
    return q != 0 ? h : PCL2_R(0.0);
}

static inline int32_t pcl2_compare_bad(pcl2_real x, pcl2_real y)
{
    return pcl2_is_bad(x) | pcl2_is_bad(y);
}

static inline pcl2_real pcl2_compare_apart(pcl2_real x, pcl2_real y)
{
    return x < y ? y - x : x - y;
}

PCL2_KERNEL void pcl2_gt(struct pcl2_gt *self, pcl2_real x, pcl2_real y, pcl2_real h, int32_t onbad)
{
    const int32_t q = x > y - pcl2_compare_less(self->q, h);
    self->q = pcl2_compare_bad(x, y) ? pcl2_on_bad(onbad, self->q) : q;
}

PCL2_KERNEL void pcl2_ge(struct pcl2_ge *self, pcl2_real x, pcl2_real y, pcl2_real h, int32_t onbad)
{
    const int32_t q = x >= y - pcl2_compare_less(self->q, h);
    self->q = pcl2_compare_bad(x, y) ? pcl2_on_bad(onbad, self->q) : q;
}

PCL2_KERNEL void pcl2_lt(struct pcl2_lt *self, pcl2_real x, pcl2_real y, pcl2_real h, int32_t onbad)
{
    const int32_t q = x < y + pcl2_compare_less(self->q, h);
    self->q = pcl2_compare_bad(x, y) ? pcl2_on_bad(onbad, self->q) : q;
}

PCL2_KERNEL void pcl2_le(struct pcl2_le *self, pcl2_real x, pcl2_real y, pcl2_real h, int32_t onbad)
{
    const int32_t q = x <= y + pcl2_compare_less(self->q, h);
    self->q = pcl2_compare_bad(x, y) ? pcl2_on_bad(onbad, self->q) : q;
}

PCL2_KERNEL void pcl2_eq(struct pcl2_eq *self, pcl2_real x, pcl2_real y, pcl2_real h, int32_t onbad)
{
    const int32_t q = pcl2_compare_apart(x, y) <= h;
    self->q = pcl2_compare_bad(x, y) ? pcl2_on_bad(onbad, self->q) : q;
}

PCL2_KERNEL void pcl2_ne(struct pcl2_ne *self, pcl2_real x, pcl2_real y, pcl2_real h, int32_t onbad)
{
    const int32_t q = pcl2_compare_apart(x, y) > h;
    self->q = pcl2_compare_bad(x, y) ? pcl2_on_bad(onbad, self->q) : q;
}

PCL2_KERNEL void pcl2_hyst(struct pcl2_hyst *self, pcl2_real x, pcl2_real on, pcl2_real off, int32_t onbad)
{
    const int32_t reversed = on < off;
    const int32_t sets = reversed ? x <= on : x >= on;
    const int32_t clears = reversed ? x >= off : x <= off;
    self->q = pcl2_is_bad(x) ? pcl2_on_bad(onbad, self->q) : (sets | (self->q & !clears));
}

PCL2_KERNEL void pcl2_hlcmp(struct pcl2_hlcmp *self, pcl2_real x, pcl2_real hi, pcl2_real lo, pcl2_real db,
                            int32_t onbad)
{
    const int32_t bad = pcl2_is_bad(x);
    const int32_t high = x >= hi - pcl2_compare_less(self->qh, db);
    const int32_t low = x <= lo + pcl2_compare_less(self->ql, db);
    self->qh = bad ? pcl2_on_bad(onbad, self->qh) : high;
    self->ql = bad ? pcl2_on_bad(onbad, self->ql) : low;
}
