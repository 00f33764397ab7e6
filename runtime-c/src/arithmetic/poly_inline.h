/* Polynomials. */
#ifndef PCL2_POLY_INLINE_H
#define PCL2_POLY_INLINE_H

#include "pcl2.h"

PCL2_INLINE pcl2_real pcl2_poly(pcl2_real x, int32_t n, const pcl2_real *c)
{
    pcl2_real y = c[n];
    PCL2_UNROLL
    for (int32_t i = n - 1; i >= 0; i--) {
        y = y * x + c[i];
    }
    return n == 0 && pcl2_is_bad(x) ? x : y;
}

#endif
