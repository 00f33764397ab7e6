/* Elements of vectors and matrices, by an index that is read every scan. */
#ifndef PCL2_VTOF_INLINE_H
#define PCL2_VTOF_INLINE_H

#include "pcl2.h"

/* i from 1 to n, as an index from 0. */
static inline int32_t pcl2_vtof_index(int32_t i, int32_t n)
{
    return i < 1 ? 0 : i > n ? n - 1 : i - 1;
}

static inline pcl2_real pcl2_vtof(const pcl2_real *v, int32_t i, int32_t n)
{
    return v[pcl2_vtof_index(i, n)];
}

static inline int32_t pcl2_vtoi(const int32_t *v, int32_t i, int32_t n)
{
    return v[pcl2_vtof_index(i, n)];
}

static inline pcl2_real pcl2_mtof(const pcl2_real *m, int32_t i, int32_t j, int32_t r, int32_t c)
{
    return m[pcl2_vtof_index(i, r) * c + pcl2_vtof_index(j, c)];
}

static inline void pcl2_ftom(int32_t r, int32_t c, pcl2_real x, int32_t i, int32_t j, pcl2_real *m)
{
    (void)r;
    m[(i - 1) * c + (j - 1)] = x;
}

#endif
