/* Exponential of a matrix by scaling and squaring (Moler and Van Loan, Nineteen dubious ways to compute the
 * exponential of a matrix, twenty-five years later, SIAM Review 45, 2003, method 3). With the norm scaled to 1/2
 * the series needs no division of matrices: the 15th term is below 2^-55. */
#include "pcl2_expm.h"
#include "pcl2_math.h"

/* The largest sum of magnitudes in a row. */
static pcl2_real pcl2_expm_norm(int32_t n, const pcl2_real *m)
{
    pcl2_real norm = PCL2_R(0.0);
    for (int32_t i = 0; i < n; i++) {
        pcl2_real sum = PCL2_R(0.0);
        for (int32_t j = 0; j < n; j++) {
            sum += pcl2_math_fabs(m[i * n + j]);
        }
        norm = sum > norm ? sum : norm;
    }
    return norm;
}

static void pcl2_expm_product(int32_t n, const pcl2_real *a, const pcl2_real *b, pcl2_real *c)
{
    for (int32_t i = 0; i < n; i++) {
        for (int32_t j = 0; j < n; j++) {
            pcl2_real sum = PCL2_R(0.0);
            for (int32_t k = 0; k < n; k++) {
                sum += a[i * n + k] * b[k * n + j];
            }
            c[i * n + j] = sum;
        }
    }
}

/* e^m - 1 = m (1 + m/2 (1 + m/3 (..))): p = m (1 + p) / k from the inside out. */
static void pcl2_expm_series(int32_t n, const pcl2_real *m, pcl2_real *p, pcl2_real *work)
{
    for (int32_t i = 0; i < n * n; i++) {
        p[i] = PCL2_R(0.0);
    }
    for (int32_t k = 15; k > 0; k--) {
        pcl2_expm_product(n, m, p, work);
        for (int32_t i = 0; i < n * n; i++) {
            p[i] = (m[i] + work[i]) / (pcl2_real)k;
        }
    }
}

void pcl2_expm1m(int32_t n, pcl2_real *m, pcl2_real *p, pcl2_real *work)
{
    const int32_t exponent = pcl2_exponent(pcl2_expm_norm(n, m)) + 2;
    const int32_t squarings = exponent > 0 ? exponent : 0;
    for (int32_t i = 0; i < n * n; i++) {
        for (int32_t s = 0; s < squarings; s++) {
            m[i] *= PCL2_R(0.5);
        }
    }
    pcl2_expm_series(n, m, p, work);
    for (int32_t s = 0; s < squarings; s++) {
        /* (1 + p)^2 - 1 = 2p + p^2 */
        pcl2_expm_product(n, p, p, work);
        for (int32_t i = 0; i < n * n; i++) {
            p[i] = 2 * p[i] + work[i];
        }
    }
}
