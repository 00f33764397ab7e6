/* nn: network of one hidden layer, tanh units, linear outputs, trained on line.
 *
 * D. E. Rumelhart, G. E. Hinton, R. J. Williams, "Learning representations by back-propagating errors",
 * Nature 323 (1986) 533-536: E = 1/2 sum (o - t)^2, dw = -eta dE/dw + alpha dw'.
 * Weights layer by layer, neuron by neuron, inputs then bias: (n+1) h, then (h+1) m values.
 */
#include "pcl2_math.h"
#include "pcl2_nn.h"

enum { NN_OK = 0, NN_SIGNAL = 1, NN_DIVERGED = 2 };

/* w[0..n-1] x + w[n]; the bias first, so that the sum waits for nothing. */
PCL2_INLINE pcl2_real pcl2_nn_neuron(int32_t n, const pcl2_real *w, const pcl2_real *x)
{
    pcl2_real sum = w[n];
    for (int32_t i = 0; i < n; ++i) {
        sum += w[i] * x[i];
    }
    return sum;
}

PCL2_INLINE void pcl2_nn_forward(int32_t m, int32_t n, int32_t h, const pcl2_real *w, const pcl2_real *x,
                            pcl2_real *z, pcl2_real *o)
{
    const pcl2_real *const output = w + (n + 1) * h;
    for (int32_t j = 0; j < h; ++j) {
        z[j] = pcl2_math_tanh(pcl2_nn_neuron(n, w + j * (n + 1), x));
    }
    for (int32_t k = 0; k < m; ++k) {
        o[k] = pcl2_nn_neuron(h, output + k * (h + 1), z);
    }
}

/* One neuron's weights: step = -eta dE/d(its sum). */
PCL2_INLINE void pcl2_nn_learn(int32_t n, pcl2_real *w, pcl2_real *dw, const pcl2_real *x, pcl2_real step,
                          pcl2_real alpha)
{
    for (int32_t i = 0; i < n; ++i) {
        dw[i] = step * x[i] + alpha * dw[i];
        w[i] += dw[i];
    }
    dw[n] = step + alpha * dw[n];
    w[n] += dw[n];
}

/* delta = -eta times the errors of the hidden sums, then of the outputs; returns their largest size times
 * the largest input, which bounds every change of a weight (tanh is at most 1). */
PCL2_INLINE pcl2_real pcl2_nn_errors(int32_t m, int32_t n, int32_t h, const pcl2_real *w, const pcl2_real *x,
                                const pcl2_real *t, const pcl2_real *z, const pcl2_real *o,
                                pcl2_real eta, pcl2_real *delta)
{
    const pcl2_real *const output = w + (n + 1) * h;
    pcl2_real reach = PCL2_R(1.0);
    pcl2_real size = PCL2_R(0.0);
    for (int32_t k = 0; k < m; ++k) {
        delta[h + k] = eta * (t[k] - o[k]);
        size += pcl2_math_fabs(delta[h + k]);
    }
    for (int32_t j = 0; j < h; ++j) {
        pcl2_real sum = output[j] * delta[h];
        for (int32_t k = 1; k < m; ++k) {
            sum += output[k * (h + 1) + j] * delta[h + k];
        }
        delta[j] = sum * (PCL2_R(1.0) - z[j] * z[j]);
        size += pcl2_math_fabs(delta[j]);
    }
    for (int32_t i = 0; i < n; ++i) {
        reach += pcl2_math_fabs(x[i]);
    }
    return size * reach;
}

PCL2_INLINE int32_t pcl2_nn_any_bad(int32_t n, const pcl2_real *x)
{
    int32_t bad = 0;
    for (int32_t i = 0; i < n; ++i) {
        bad |= pcl2_is_bad(x[i]);
    }
    return bad;
}

PCL2_KERNEL void pcl2_nn_init(struct pcl2_nn *self, int32_t m, int32_t n, int32_t h, pcl2_real eta,
                              pcl2_real alpha, const pcl2_real *weights, pcl2_real *w, pcl2_real *dw,
                              pcl2_real *o)
{
    (void)self;
    (void)eta;
    (void)alpha;
    (void)dw;
    (void)o;
    for (int32_t i = 0; i < (n + 1) * h + (h + 1) * m; ++i) {
        w[i] = weights[i];
    }
}

PCL2_KERNEL void pcl2_nn(struct pcl2_nn *self, int32_t m, const pcl2_real *x, const pcl2_real *t, pcl2_real en,
                         int32_t n, int32_t h, pcl2_real eta, pcl2_real alpha, pcl2_real *w, pcl2_real *dw,
                         pcl2_real *z, pcl2_real *delta, pcl2_real *o)
{
    /* A step beyond this is divergence; far below the largest real, so that no weight overflows. */
    const pcl2_real limit = (PCL2_REAL_BITS == 32) ? PCL2_R(1e12) : PCL2_R(1e30);
    const int32_t first = (n + 1) * h;
    self->status = NN_SIGNAL;
    if (pcl2_nn_any_bad(n, x)) {
        return;
    }
    /* The outputs wait in delta: sums of huge x may cancel to NaN. */
    pcl2_nn_forward(m, n, h, w, x, z, delta + h);
    if (pcl2_nn_any_bad(m, delta + h)) {
        return;
    }
    for (int32_t k = 0; k < m; ++k) {
        o[k] = delta[h + k];
    }
    self->status = NN_OK;
    if (!(en != PCL2_R(0.0)) || pcl2_is_bad(en)) {
        return;
    }
    if (!(pcl2_nn_errors(m, n, h, w, x, t, z, o, eta, delta) < limit)) {
        self->status = pcl2_nn_any_bad(m, t) ? NN_SIGNAL : NN_DIVERGED;
        return;
    }
    for (int32_t j = 0; j < h; ++j) {
        pcl2_nn_learn(n, w + j * (n + 1), dw + j * (n + 1), x, delta[j], alpha);
    }
    for (int32_t k = 0; k < m; ++k) {
        pcl2_nn_learn(h, w + first + k * (h + 1), dw + first + k * (h + 1), z, delta[h + k], alpha);
    }
}
