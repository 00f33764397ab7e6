/* All roots of a real polynomial. */
#ifndef PCL2_POLYROOTS_H
#define PCL2_POLYROOTS_H

#include "pcl2.h"

/* The largest degree. */
#define PCL2_POLYROOTS_MAX 32

/* The least k >= least for which 2^k is a bound of the largest |a[i]|^(1/(i+1)); no root is larger than 2^(k+1)
 * (Fujiwara, Tohoku Math. J. 10, 1916). */
int32_t pcl2_polyroots_scale(int32_t n, const pcl2_real *a, int32_t least);

/* The n roots re + im j of s^n + a[0] s^(n-1) + .. + a[n-1], n from 1 to PCL2_POLYROOTS_MAX, in no order.
 * Roots 0 are exact; the others are as good as the coefficients' last digits allow. At most 200 sweeps. */
void pcl2_polyroots(int32_t n, const pcl2_real *a, pcl2_real *re, pcl2_real *im);

#endif
