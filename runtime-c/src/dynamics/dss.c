/* Discrete state space (Astrom and Wittenmark, Computer-Controlled Systems, ch. 2). */
#include "pcl2_dss.h"

PCL2_KERNEL void pcl2_dss_init(
    struct pcl2_dss *self, int32_t nx, int32_t nu, int32_t ny, const pcl2_real *x0, pcl2_real *state, pcl2_real *y,
    pcl2_real *x)
{
    (void)nu;
    (void)ny;
    (void)y;
    self->status = 0;
    for (int32_t i = 0; i < nx; i++) {
        state[i] = x0[i];
        x[i] = x0[i];
    }
}

/* out = M x + N u; 0 when an element is bad. */
static int32_t pcl2_dss_map(
    int32_t rows, int32_t nx, int32_t nu, const pcl2_real *m, const pcl2_real *n, const pcl2_real *x,
    const pcl2_real *u, pcl2_real *out)
{
    int32_t good = 1;
    for (int32_t i = 0; i < rows; i++) {
        pcl2_real sum = PCL2_R(0.0);
        for (int32_t j = 0; j < nx; j++) {
            sum += m[i * nx + j] * x[j];
        }
        for (int32_t j = 0; j < nu; j++) {
            sum += n[i * nu + j] * u[j];
        }
        good &= !pcl2_is_bad(sum);
        out[i] = sum;
    }
    return good;
}

static int32_t pcl2_dss_good(int32_t n, const pcl2_real *values)
{
    int32_t good = 1;
    for (int32_t i = 0; i < n; i++) {
        good &= !pcl2_is_bad(values[i]);
    }
    return good;
}

PCL2_KERNEL void pcl2_dss(
    struct pcl2_dss *self, const pcl2_real *u, int32_t nx, int32_t nu, int32_t ny, const pcl2_real *A,
    const pcl2_real *B, const pcl2_real *C, const pcl2_real *D, pcl2_real *state, pcl2_real *next, pcl2_real *out,
    pcl2_real *y, pcl2_real *x)
{
    self->status = 0;
    if (!pcl2_dss_good(nu, u)) {
        return;
    }
    self->status = !(pcl2_dss_map(ny, nx, nu, C, D, state, u, out) & pcl2_dss_map(nx, nx, nu, A, B, state, u, next));
    if (self->status != 0) {
        return;
    }
    for (int32_t i = 0; i < ny; i++) {
        y[i] = out[i];
    }
    for (int32_t i = 0; i < nx; i++) {
        x[i] = state[i];
        state[i] = next[i];
    }
}
