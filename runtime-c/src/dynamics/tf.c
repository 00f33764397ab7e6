/* Transfer function, exact for an input that is constant over a period: the matrix exponential of
 * [A B; 0 0] T (Van Loan, IEEE Trans. Automatic Control 23, 1978). */
#include "pcl2_tf.h"
#include "pcl2_expm.h"
#include "pcl2_math.h"
#include "pcl2_polyroots.h"
#include "pcl2_transfer.h"

/* y = C x0: u is not known yet. */
PCL2_KERNEL void pcl2_tf_init(
    struct pcl2_tf *self, int32_t nden, int32_t nnum, int32_t nx, const pcl2_real *den, const pcl2_real *num,
    const pcl2_real *x0, pcl2_real *x, pcl2_real *c, pcl2_real *p, pcl2_real *m, pcl2_real *product)
{
    (void)nden;
    (void)nnum;
    (void)den;
    (void)num;
    (void)p;
    (void)m;
    (void)product;
    for (int32_t i = 0; i < nx; i++) {
        x[i] = x0[i];
    }
    self->y = pcl2_transfer_output(nx, c, x);
}

/* x s^k without leaving the range on the way. */
static pcl2_real pcl2_tf_scaled(pcl2_real x, pcl2_real s, int32_t k)
{
    for (; k > 0; k--) {
        x *= s;
    }
    for (; k < 0; k++) {
        x /= s;
    }
    return x;
}

/* u counts as state n + 1, whose rate is 0. The states s^-i x(i) are all of one size when s is that of the poles,
 * at least 1/T; each link of their chain is s. */
PCL2_KERNEL void pcl2_tf_tune(
    struct pcl2_tf *self, int32_t nden, int32_t nnum, int32_t nx, const pcl2_real *den, const pcl2_real *num,
    int64_t T, pcl2_real *c, pcl2_real *p, pcl2_real *m, pcl2_real *product)
{
    const int32_t size = nx + 1;
    const pcl2_real h = pcl2_seconds(T);
    const pcl2_real s = pcl2_power_of_2(pcl2_polyroots_scale(nden, den, -pcl2_exponent(h)));
    self->d = pcl2_transfer(nden, nnum, den, num, product, c);
    for (int32_t i = 0; i < size * size; i++) {
        m[i] = PCL2_R(0.0);
    }
    for (int32_t i = 0; i < nx; i++) {
        m[i * size + i + 1] = s * h;
    }
    for (int32_t j = 0; j < nx; j++) {
        m[(nx - 1) * size + j] -= pcl2_tf_scaled(den[nx - 1 - j] * h, s, j - nx + 1);
    }
    pcl2_expm1m(size, m, p, product);
    for (int32_t i = 0; i < size; i++) {
        for (int32_t j = 0; j < size; j++) {
            p[i * size + j] = pcl2_tf_scaled(p[i * size + j], s, i - j);
        }
    }
}

PCL2_KERNEL void pcl2_tf(
    struct pcl2_tf *self, pcl2_real u, int32_t nden, int32_t nnum, int32_t nx, pcl2_real *x, const pcl2_real *c,
    const pcl2_real *p, const pcl2_real *m, const pcl2_real *product, pcl2_real *next)
{
    (void)nden;
    (void)nnum;
    (void)m;
    (void)product;
    self->status = 0;
    if (pcl2_is_bad(u)) {
        return;
    }
    for (int32_t i = 0; i < nx; i++) {
        const pcl2_real *row = &p[i * (nx + 1)];
        next[i] = x[i] + (pcl2_transfer_output(nx, row, x) + row[nx] * u);
    }
    const pcl2_real y = pcl2_transfer_output(nx, c, next) + self->d * u;
    if (pcl2_transfer_accept(nx, y, next, x)) {
        self->y = y;
    } else {
        self->status = 1;
    }
}
