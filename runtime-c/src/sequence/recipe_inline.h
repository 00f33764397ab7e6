/* Table of recipes. */
#ifndef PCL2_RECIPE_INLINE_H
#define PCL2_RECIPE_INLINE_H

#include "pcl2.h"

static inline void pcl2_recipe(int32_t i, int32_t n, int32_t m, const pcl2_real *table, pcl2_real *v)
{
    const int32_t row = i < 1 ? 0 : i > n ? n - 1 : i - 1;
    memcpy(v, &table[row * m], (size_t)m * sizeof *v);
}

#endif
