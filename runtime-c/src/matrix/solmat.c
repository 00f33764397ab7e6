/* Solutions of linear equations, and inverses. */
#include "pcl2_solmat.h"
#include "pcl2_lu.h"

#define SOLMAT_SINGULAR 1
#define SOLMAT_SIGNAL 2

static int32_t pcl2_solmat_any_bad(int32_t n, const pcl2_real *v)
{
    for (int32_t i = 0; i < n; i++) {
        if (pcl2_is_bad(v[i])) {
            return 1;
        }
    }
    return 0;
}

/* Factors a copy of a; the status. */
static int32_t pcl2_solmat_factor(
    int32_t n, const pcl2_real *a, pcl2_real eps, pcl2_real *lu, int32_t *order, pcl2_real *work)
{
    const pcl2_real limit = eps > PCL2_REAL_EPSILON ? eps : PCL2_REAL_EPSILON;
    if (pcl2_solmat_any_bad(n * n, a) != 0) {
        return SOLMAT_SIGNAL;
    }
    memcpy(lu, a, (size_t)(n * n) * sizeof *lu);
    return pcl2_lu_factor(n, lu, order, work) >= limit ? 0 : SOLMAT_SINGULAR;
}

/* A solution beyond the range of a real is none. */
PCL2_KERNEL void pcl2_solmat(
    struct pcl2_solmat *self, int32_t n, const pcl2_real *a, const pcl2_real *b, pcl2_real eps, pcl2_real *lu,
    int32_t *order, pcl2_real *work, pcl2_real *x)
{
    self->status = pcl2_solmat_any_bad(n, b) != 0 ? SOLMAT_SIGNAL : pcl2_solmat_factor(n, a, eps, lu, order, work);
    if (self->status == 0) {
        pcl2_lu_solve(n, lu, order, b, work);
        self->status = pcl2_solmat_any_bad(n, work) != 0 ? SOLMAT_SINGULAR : 0;
    }
    self->ok = self->status == 0;
    if (self->ok != 0) {
        memcpy(x, work, (size_t)n * sizeof *x);
    }
}

/* Two passes: the first one only looks whether all columns are finite. */
PCL2_KERNEL void pcl2_invmat(
    struct pcl2_invmat *self, int32_t n, const pcl2_real *a, pcl2_real eps, pcl2_real *lu, int32_t *order,
    pcl2_real *work, pcl2_real *m)
{
    pcl2_real *const unit = work;
    pcl2_real *const column = &work[n];
    self->status = pcl2_solmat_factor(n, a, eps, lu, order, work);
    for (int32_t pass = 0; pass < 2; pass++) {
        for (int32_t j = 0; j < n && self->status == 0; j++) {
            memset(unit, 0, (size_t)n * sizeof *unit);
            unit[j] = PCL2_R(1.0);
            pcl2_lu_solve(n, lu, order, unit, column);
            self->status = pcl2_solmat_any_bad(n, column) != 0 ? SOLMAT_SINGULAR : 0;
            for (int32_t i = 0; i < n && pass == 1; i++) {
                m[i * n + j] = column[i];
            }
        }
    }
    self->ok = self->status == 0;
}

#undef SOLMAT_SINGULAR
#undef SOLMAT_SIGNAL
