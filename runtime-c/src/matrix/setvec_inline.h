/* Vectors and matrices from parameters. */
#ifndef PCL2_SETVEC_INLINE_H
#define PCL2_SETVEC_INLINE_H

#include "pcl2.h"

PCL2_INLINE void pcl2_setvec(int32_t n, const pcl2_real *v, pcl2_real *y)
{
    PCL2_UNROLL
    for (int32_t i = 0; i < n; i++) {
        y[i] = v[i];
    }
}

PCL2_INLINE void pcl2_setivec(int32_t n, const int32_t *v, int32_t *y)
{
    PCL2_UNROLL
    for (int32_t i = 0; i < n; i++) {
        y[i] = v[i];
    }
}

PCL2_INLINE void pcl2_setmat(int32_t r, int32_t c, const pcl2_real *v, pcl2_real *m)
{
    pcl2_setvec(r * c, v, m);
}

PCL2_INLINE void pcl2_setimat(int32_t r, int32_t c, const int32_t *v, int32_t *m)
{
    pcl2_setivec(r * c, v, m);
}

#endif
