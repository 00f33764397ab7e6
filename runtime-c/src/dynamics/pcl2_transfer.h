/* What trfun and tf share: the controllable canonical form of num/den. */
#ifndef PCL2_TRANSFER_H
#define PCL2_TRANSFER_H

#include "pcl2.h"

/* From den (monic, the leading 1 dropped) and num, both in descending powers: a and c, n values each, of
 * x1' = x2, .., xn' = u - sum a(i) x(i), y = sum c(i) x(i) + d u. Returns d, which is 0 unless nnum = n + 1. */
pcl2_real pcl2_transfer(int32_t n, int32_t nnum, const pcl2_real *den, const pcl2_real *num, pcl2_real *a, pcl2_real *c);

/* sum c(i) x(i) */
pcl2_real pcl2_transfer_output(int32_t n, const pcl2_real *c, const pcl2_real *x);

/* Takes over the state next when it and y are good: returns 1. Else changes nothing and returns 0. */
int32_t pcl2_transfer_accept(int32_t n, pcl2_real y, const pcl2_real *next, pcl2_real *x);

#endif
