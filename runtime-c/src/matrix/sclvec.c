/* Quotients of vectors, element by element. */
#include "pcl2_sclvec.h"
#include "pcl2_math.h"

/* An infinite divisor is a bad signal: its quotient is not 0. */
PCL2_KERNEL void pcl2_divvec(
    struct pcl2_divvec *self, int32_t n, const pcl2_real *a, const pcl2_real *b, pcl2_real eps, pcl2_real *y)
{
    self->status = 0;
    for (int32_t i = 0; i < n; i++) {
        const int32_t small = pcl2_math_fabs(b[i]) < eps;
        self->status |= small;
        y[i] = small || pcl2_is_bad(b[i]) ? pcl2_bad() : a[i] / b[i];
    }
}
