/* Hand-written C to compare the rls kernels with: 6 parameters (3 of A, 3 of B), d = 0. */
#ifndef HAND_RLS_H
#define HAND_RLS_H
#include "pcl2.h"

struct hand_rls {
    pcl2_real lambda, pmax;
    pcl2_real P[6][6], theta[6];
    pcl2_real phi[6];           /* y(t-1) .. y(t-3), u(t-1) .. u(t-3) */
};

void hand_rls_init(struct hand_rls *self, pcl2_real lambda, pcl2_real P0, pcl2_real pmax);
void hand_rls_step(struct hand_rls *self, pcl2_real y, pcl2_real u, pcl2_real en);
#endif
