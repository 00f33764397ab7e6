/* Hand-written C to compare nn with: a 2-16-1 and an 8-32-4 network, tanh, on-line training. */
#ifndef HAND_NN_H
#define HAND_NN_H
#include "pcl2.h"

struct hand_nn_small {
    pcl2_real w1[16][3], w2[17];
    pcl2_real d1[16][3], d2[17];
    pcl2_real eta, alpha;
};

struct hand_nn_large {
    pcl2_real w1[32][9], w2[4][33];
    pcl2_real d1[32][9], d2[4][33];
    pcl2_real eta, alpha;
};

/* t is NULL for the forward pass alone. */
void hand_nn_small(struct hand_nn_small *self, const pcl2_real *x, const pcl2_real *t, pcl2_real *o);
void hand_nn_large(struct hand_nn_large *self, const pcl2_real *x, const pcl2_real *t, pcl2_real *o);
#endif
