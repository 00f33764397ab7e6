/* The controllable canonical form of a transfer function (Kailath, Linear Systems, 2.1). */
#include "pcl2_transfer.h"

pcl2_real pcl2_transfer(int32_t n, int32_t nnum, const pcl2_real *den, const pcl2_real *num, pcl2_real *a, pcl2_real *c)
{
    const pcl2_real d = nnum > n ? num[0] : PCL2_R(0.0);
    for (int32_t i = 0; i < n; i++) {
        a[i] = den[n - 1 - i];
        c[i] = (nnum > i ? num[nnum - 1 - i] : PCL2_R(0.0)) - d * a[i];
    }
    return d;
}

pcl2_real pcl2_transfer_output(int32_t n, const pcl2_real *c, const pcl2_real *x)
{
    pcl2_real sum = c[0] * x[0];
    for (int32_t i = 1; i < n; i++) {
        sum += c[i] * x[i];
    }
    return sum;
}

int32_t pcl2_transfer_accept(int32_t n, pcl2_real y, const pcl2_real *next, pcl2_real *x)
{
    int32_t bad = pcl2_is_bad(y);
    for (int32_t i = 0; i < n; i++) {
        bad |= pcl2_is_bad(next[i]);
    }
    if (bad != 0) {
        return 0;
    }
    for (int32_t i = 0; i < n; i++) {
        x[i] = next[i];
    }
    return 1;
}
