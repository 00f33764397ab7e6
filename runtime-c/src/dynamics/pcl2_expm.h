/* Exponential of a matrix. */
#ifndef PCL2_EXPM_H
#define PCL2_EXPM_H

#include "pcl2.h"

/* p = exp(m) - 1 for an n x n matrix m. Minus 1, because a slow mode beside a fast one keeps its digits so.
 * m is used up, work has n x n values; none of the three may overlap. */
void pcl2_expm1m(int32_t n, pcl2_real *m, pcl2_real *p, pcl2_real *work);

#endif
