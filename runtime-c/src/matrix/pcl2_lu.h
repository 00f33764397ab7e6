/* Linear equations by elimination with partial pivoting (Golub and Van Loan, Matrix Computations, 4th ed., 3.4). */
#ifndef PCL2_LU_H
#define PCL2_LU_H

#include "pcl2.h"

/* Factors n rows of a in place: a = L U of its rows in order. Returns an estimate of the reciprocal condition number
 * in the 1-norm, at most twice or three times too large as a rule; 0 where a is singular or its factors leave the
 * range of a real. work: 2 n reals. */
pcl2_real pcl2_lu_factor(int32_t n, pcl2_real *a, int32_t *order, pcl2_real *work);

/* Solves L U x = b with the rows of b in order; b and x are different. */
void pcl2_lu_solve(int32_t n, const pcl2_real *lu, const int32_t *order, const pcl2_real *b, pcl2_real *x);

#endif
