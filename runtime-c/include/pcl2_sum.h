/* Sums that move however small the terms are beside them: a value, and in a carry what rounding took from it. */
#ifndef PCL2_SUM_H
#define PCL2_SUM_H

#include "pcl2.h"

/* a + b, and in *error what rounding took: the two are the exact sum (Knuth, The Art of Computer Programming 2, 4.2.2,
 * theorem B). The error is not a number when the sum leaves the range: keep it only with a good sum. */
static inline pcl2_real pcl2_two_sum(pcl2_real a, pcl2_real b, pcl2_real *error)
{
    const pcl2_real sum = a + b;
    const pcl2_real taken = sum - a;
    *error = (a - (sum - taken)) + (b - taken);
    return sum;
}

/* sum + term for terms that are small beside the sum; *carry goes in with the term and comes out. */
static inline pcl2_real pcl2_sum(pcl2_real sum, pcl2_real term, pcl2_real *carry)
{
    return pcl2_two_sum(sum, term + *carry, carry);
}

#endif
