/* Hand-written C to compare the gpc kernels with: second-order models, d = 0, N2 = 10. */
#ifndef HAND_GPC_H
#define HAND_GPC_H
#include "pcl2.h"

struct hand_gpc {
    pcl2_real p[4];             /* a1, a2, b0, b1 */
    pcl2_real u0, umin, umax, lambda;
    pcl2_real kw, ky[3], kd;    /* law of the unchanged model */
    pcl2_real y1, y2, du1, u;   /* past */
    int started;
};

/* Law of self->p, once; then hand_gpc_fixed each scan. */
void hand_gpc_design(struct hand_gpc *self);
void hand_gpc_fixed(struct hand_gpc *self, pcl2_real w, pcl2_real y, pcl2_real sw);

/* p anew each scan; 1 and 3 moves. */
void hand_gpc_adaptive1(struct hand_gpc *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw);
void hand_gpc_adaptive3(struct hand_gpc *self, pcl2_real w, pcl2_real y, const pcl2_real *p, pcl2_real sw);
#endif
