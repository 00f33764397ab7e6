/* A proportional drive with integral action. */
#include "pcl2_drive.h"

enum { DRIVE_OK = 0, DRIVE_BAD_Y = 1, DRIVE_LARGE = 2 };

PCL2_KERNEL int32_t pcl2_drive_check(
    pcl2_real K, pcl2_real Ti, pcl2_real umin, pcl2_real umax, int64_t T, pcl2_real *left)
{
    (void)Ti;
    (void)umin;
    (void)umax;
    (void)T;
    left[0] = K;
    return K > PCL2_R(1000.0) ? DRIVE_LARGE : DRIVE_OK;
}

PCL2_KERNEL void pcl2_drive_tune(
    struct pcl2_drive *self, pcl2_real K, pcl2_real Ti, pcl2_real umin, pcl2_real umax, int64_t T)
{
    self->kp = K;
    self->ki = Ti > PCL2_R(0.0) ? K * pcl2_seconds(T) / Ti : PCL2_R(0.0);
    self->lo = umin;
    self->hi = umax;
}

PCL2_KERNEL void pcl2_drive_init(
    struct pcl2_drive *self, pcl2_real K, pcl2_real Ti, pcl2_real umin, pcl2_real umax, pcl2_real *bk)
{
    (void)K;
    (void)Ti;
    (void)umin;
    (void)umax;
    (void)bk;
    self->i = PCL2_R(0.0);
}

PCL2_KERNEL void pcl2_drive(struct pcl2_drive *self, pcl2_real y, pcl2_real w, int32_t mode, pcl2_real um,
                            const pcl2_real *back, pcl2_real *bk)
{
    (void)back;
    self->status = pcl2_is_bad(y) ? DRIVE_BAD_Y : DRIVE_OK;
    if (self->status != DRIVE_OK) {
        return;
    }
    const pcl2_real e = w - y;
    pcl2_real u = mode == 0 ? um : self->kp * e + self->i;
    u = u > self->lo ? u : self->lo;
    u = u < self->hi ? u : self->hi;
    self->i = mode == 0 ? u - self->kp * e : self->i + self->ki * e;
    self->wf = w;
    self->u = u;
    self->actual = mode;
    bk[0] = u;
    bk[1] = PCL2_R(0.0);
}
