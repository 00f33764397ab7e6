/* Recursive least squares of 6 parameters, the symmetric half of P only. */
#include "rls.h"

void hand_rls_init(struct hand_rls *self, pcl2_real lambda, pcl2_real P0, pcl2_real pmax)
{
    memset(self, 0, sizeof *self);
    self->lambda = lambda;
    self->pmax = pmax;
    for (int i = 0; i < 6; ++i) {
        self->P[i][i] = P0;
    }
}

static void hand_rls_adapt(struct hand_rls *self, pcl2_real y)
{
    pcl2_real s[6], gain = self->lambda, error = y, trace = PCL2_R(0.0);
    for (int i = 0; i < 6; ++i) {
        s[i] = self->P[i][0] * self->phi[0];
        for (int j = 1; j < 6; ++j) {
            s[i] += self->P[i][j] * self->phi[j];
        }
        gain += self->phi[i] * s[i];
        error -= self->phi[i] * self->theta[i];
        trace += self->P[i][i];
    }
    const pcl2_real inverse = PCL2_R(1.0) / gain;
    const pcl2_real growth = (trace > self->pmax) ? PCL2_R(1.0) : PCL2_R(1.0) / self->lambda;
    for (int i = 0; i < 6; ++i) {
        const pcl2_real k = s[i] * inverse;
        self->theta[i] += k * error;
        for (int j = i; j < 6; ++j) {
            self->P[i][j] = (self->P[i][j] - k * s[j]) * growth;
            self->P[j][i] = self->P[i][j];
        }
    }
}

void hand_rls_step(struct hand_rls *self, pcl2_real y, pcl2_real u, pcl2_real en)
{
    self->phi[5] = self->phi[4];
    self->phi[4] = self->phi[3];
    self->phi[3] = u;
    if (en != PCL2_R(0.0)) {
        hand_rls_adapt(self, y);
    }
    self->phi[2] = self->phi[1];
    self->phi[1] = self->phi[0];
    self->phi[0] = y;
}
