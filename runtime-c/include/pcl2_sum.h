/* Sums that move however small the terms are beside them: a value, and in a carry what rounding took from it. */
#ifndef PCL2_SUM_H
#define PCL2_SUM_H

#include "pcl2.h"

/* sum + term; *carry goes in and comes out (Knuth, The Art of Computer Programming 2, 4.2.2, theorem B).
 * The carry is not a number when the sum leaves the range: keep it only with a good sum. */
static inline pcl2_real pcl2_sum(pcl2_real sum, pcl2_real term, pcl2_real *carry)
{
    const pcl2_real whole = term + *carry;
    const pcl2_real next = sum + whole;
    const pcl2_real taken = next - sum;
    *carry = (sum - (next - taken)) + (whole - taken);
    return next;
}

#endif
