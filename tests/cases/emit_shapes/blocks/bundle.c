/* middle, bundle: groups of ports. */
#include "pcl2_bundle.h"

PCL2_KERNEL void pcl2_middle(struct pcl2_middle *self, const pcl2_real *x, int32_t n)
{
    pcl2_real sum = x[0];
    for (int32_t i = 1; i < n; i++) {
        sum += x[i];
    }
    self->y = sum / (pcl2_real)n;
}

PCL2_KERNEL void pcl2_bundle_init(struct pcl2_bundle *self, int32_t n, int32_t id, const pcl2_real *k, int32_t mode,
                                  int32_t *past, pcl2_real *y, pcl2_real *z)
{
    (void)n;
    (void)mode;
    (void)past;
    (void)z;
    self->elapsed = 0;
    y[0] = k[0] + (pcl2_real)id;
    y[1] = k[1];
}

PCL2_KERNEL void pcl2_bundle(struct pcl2_bundle *self, int32_t n, const pcl2_real *x, const pcl2_real *k, int32_t mode,
                             int32_t *past, pcl2_real *sum, int32_t *order, int64_t *t, pcl2_real *y, pcl2_real *z)
{
    self->count++;
    self->elapsed += 5;
    *t = self->elapsed;
    past[0] = past[1];
    past[1] = self->count;
    sum[0] = sum[1] = PCL2_R(0.0);
    for (int32_t i = 0; i < n; i++) {
        order[i] = i;
        sum[0] += x[2 * i] * k[order[i] % 3];
        sum[1] += x[2 * i + 1];
    }
    y[0] = sum[0];
    y[1] = sum[1] + (pcl2_real)mode;
    z[0] = sum[0] - sum[1];
    z[1] = (pcl2_real)*t;
}
