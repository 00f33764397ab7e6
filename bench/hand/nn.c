/* Forward pass and one step of back-propagation with momentum, literal sizes. */
#include "nn.h"
#include "pcl2_math.h"

void hand_nn_small(struct hand_nn_small *self, const pcl2_real *x, const pcl2_real *t, pcl2_real *o)
{
    pcl2_real z[16];
    pcl2_real sum = self->w2[16];
    for (int j = 0; j < 16; ++j) {
        z[j] = pcl2_math_tanh(self->w1[j][2] + self->w1[j][0] * x[0] + self->w1[j][1] * x[1]);
        sum += self->w2[j] * z[j];
    }
    o[0] = sum;
    if (!t) {
        return;
    }
    const pcl2_real step = self->eta * (t[0] - sum);
    for (int j = 0; j < 16; ++j) {
        const pcl2_real hidden = self->w2[j] * step * (PCL2_R(1.0) - z[j] * z[j]);
        const pcl2_real in[3] = {x[0], x[1], PCL2_R(1.0)};
        for (int i = 0; i < 3; ++i) {
            self->d1[j][i] = hidden * in[i] + self->alpha * self->d1[j][i];
            self->w1[j][i] += self->d1[j][i];
        }
        self->d2[j] = step * z[j] + self->alpha * self->d2[j];
        self->w2[j] += self->d2[j];
    }
    self->d2[16] = step + self->alpha * self->d2[16];
    self->w2[16] += self->d2[16];
}

void hand_nn_large(struct hand_nn_large *self, const pcl2_real *x, const pcl2_real *t, pcl2_real *o)
{
    pcl2_real z[33], in[9], step[4];
    for (int i = 0; i < 8; ++i) {
        in[i] = x[i];
    }
    in[8] = PCL2_R(1.0);
    z[32] = PCL2_R(1.0);
    for (int j = 0; j < 32; ++j) {
        pcl2_real sum = self->w1[j][8];
        for (int i = 0; i < 8; ++i) {
            sum += self->w1[j][i] * in[i];
        }
        z[j] = pcl2_math_tanh(sum);
    }
    for (int k = 0; k < 4; ++k) {
        pcl2_real sum = self->w2[k][32];
        for (int j = 0; j < 32; ++j) {
            sum += self->w2[k][j] * z[j];
        }
        o[k] = sum;
        step[k] = t ? self->eta * (t[k] - sum) : PCL2_R(0.0);
    }
    if (!t) {
        return;
    }
    for (int j = 0; j < 32; ++j) {
        pcl2_real hidden = PCL2_R(0.0);
        for (int k = 0; k < 4; ++k) {
            hidden += self->w2[k][j] * step[k];
        }
        hidden *= PCL2_R(1.0) - z[j] * z[j];
        for (int i = 0; i < 9; ++i) {
            self->d1[j][i] = hidden * in[i] + self->alpha * self->d1[j][i];
            self->w1[j][i] += self->d1[j][i];
        }
    }
    for (int k = 0; k < 4; ++k) {
        for (int j = 0; j < 33; ++j) {
            self->d2[k][j] = step[k] * z[j] + self->alpha * self->d2[k][j];
            self->w2[k][j] += self->d2[k][j];
        }
    }
}
