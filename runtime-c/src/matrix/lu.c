/* Linear equations by elimination with partial pivoting (Golub and Van Loan, Matrix Computations, 4th ed., 3.4), and
 * Hager's estimate of the condition (SIAM J. Sci. Stat. Comput. 5, 1984; Higham, Accuracy and Stability of Numerical
 * Algorithms, 2nd ed., 15.3). */
#include "pcl2_lu.h"
#include "pcl2_math.h"

/* Largest sum of sizes of a column. */
static pcl2_real pcl2_lu_norm(int32_t n, const pcl2_real *a)
{
    pcl2_real norm = PCL2_R(0.0);
    for (int32_t j = 0; j < n; j++) {
        pcl2_real sum = PCL2_R(0.0);
        for (int32_t i = 0; i < n; i++) {
            sum += pcl2_math_fabs(a[i * n + j]);
        }
        norm = sum > norm ? sum : norm;
    }
    return norm;
}

/* Brings the row with the largest element below the diagonal of column k to row k. */
static void pcl2_lu_pivot(int32_t n, pcl2_real *a, int32_t *order, int32_t k)
{
    int32_t best = k;
    for (int32_t i = k + 1; i < n; i++) {
        best = pcl2_math_fabs(a[i * n + k]) > pcl2_math_fabs(a[best * n + k]) ? i : best;
    }
    if (best == k) {
        return;
    }
    for (int32_t j = 0; j < n; j++) {
        const pcl2_real kept = a[k * n + j];
        a[k * n + j] = a[best * n + j];
        a[best * n + j] = kept;
    }
    const int32_t row = order[k];
    order[k] = order[best];
    order[best] = row;
}

static void pcl2_lu_eliminate(int32_t n, pcl2_real *a, int32_t k)
{
    const pcl2_real *const pivot = &a[k * n];
    for (int32_t i = k + 1; i < n; i++) {
        pcl2_real *const row = &a[i * n];
        const pcl2_real factor = row[k] / pivot[k];
        row[k] = factor;
        for (int32_t j = k + 1; j < n; j++) {
            row[j] -= factor * pivot[j];
        }
    }
}

/* L U x = x, in place. */
static void pcl2_lu_substitute(int32_t n, const pcl2_real *lu, pcl2_real *x)
{
    for (int32_t i = 1; i < n; i++) {
        for (int32_t j = 0; j < i; j++) {
            x[i] -= lu[i * n + j] * x[j];
        }
    }
    for (int32_t i = n - 1; i >= 0; i--) {
        for (int32_t j = i + 1; j < n; j++) {
            x[i] -= lu[i * n + j] * x[j];
        }
        x[i] /= lu[i * n + i];
    }
}

/* (L U)' x = x, in place. */
static void pcl2_lu_substitute_transposed(int32_t n, const pcl2_real *lu, pcl2_real *x)
{
    for (int32_t i = 0; i < n; i++) {
        for (int32_t j = 0; j < i; j++) {
            x[i] -= lu[j * n + i] * x[j];
        }
        x[i] /= lu[i * n + i];
    }
    for (int32_t i = n - 1; i >= 0; i--) {
        for (int32_t j = i + 1; j < n; j++) {
            x[i] -= lu[j * n + i] * x[j];
        }
    }
}

static pcl2_real pcl2_lu_size(int32_t n, const pcl2_real *x)
{
    pcl2_real sum = PCL2_R(0.0);
    for (int32_t i = 0; i < n; i++) {
        sum += pcl2_math_fabs(x[i]);
    }
    return sum;
}

/* Norm of the inverse from below: |inverse x| for the x that a few steps uphill from the mean of all columns find. */
static pcl2_real pcl2_lu_inverse_norm(int32_t n, const pcl2_real *lu, pcl2_real *x, pcl2_real *slope)
{
    pcl2_real norm = PCL2_R(0.0);
    for (int32_t i = 0; i < n; i++) {
        x[i] = 1 / (pcl2_real)n;
    }
    for (int32_t turn = 0; turn < 5; turn++) {
        pcl2_lu_substitute(n, lu, x);
        const pcl2_real size = pcl2_lu_size(n, x);
        if (!(size > norm)) {
            return size == size ? norm : size;
        }
        norm = size;
        for (int32_t i = 0; i < n; i++) {
            slope[i] = x[i] < 0 ? PCL2_R(-1.0) : PCL2_R(1.0);
        }
        pcl2_lu_substitute_transposed(n, lu, slope);
        int32_t steepest = 0;
        for (int32_t i = 1; i < n; i++) {
            steepest = pcl2_math_fabs(slope[i]) > pcl2_math_fabs(slope[steepest]) ? i : steepest;
        }
        for (int32_t i = 0; i < n; i++) {
            x[i] = i == steepest ? PCL2_R(1.0) : PCL2_R(0.0);
        }
    }
    return norm;
}

/* Higham's second guess, alternating signs of rising size: it finds what the steps uphill miss. */
static pcl2_real pcl2_lu_inverse_guess(int32_t n, const pcl2_real *lu, pcl2_real *x)
{
    const pcl2_real last = (pcl2_real)(n > 1 ? n - 1 : 1);
    for (int32_t i = 0; i < n; i++) {
        const pcl2_real size = 1 + (pcl2_real)i / last;
        x[i] = i % 2 == 0 ? size : -size;
    }
    pcl2_lu_substitute(n, lu, x);
    return 2 * pcl2_lu_size(n, x) / (3 * (pcl2_real)n);
}

pcl2_real pcl2_lu_factor(int32_t n, pcl2_real *a, int32_t *order, pcl2_real *work)
{
    const pcl2_real norm = pcl2_lu_norm(n, a);
    for (int32_t i = 0; i < n; i++) {
        order[i] = i;
    }
    for (int32_t k = 0; k < n; k++) {
        pcl2_lu_pivot(n, a, order, k);
        if (a[k * n + k] == 0) {
            return PCL2_R(0.0);
        }
        pcl2_lu_eliminate(n, a, k);
    }
    const pcl2_real climbed = pcl2_lu_inverse_norm(n, a, work, &work[n]);
    const pcl2_real guessed = pcl2_lu_inverse_guess(n, a, work);
    const pcl2_real reciprocal = 1 / norm / (guessed > climbed ? guessed : climbed);
    return reciprocal > 0 && !pcl2_is_bad(reciprocal) ? reciprocal : PCL2_R(0.0);
}

void pcl2_lu_solve(int32_t n, const pcl2_real *lu, const int32_t *order, const pcl2_real *b, pcl2_real *x)
{
    for (int32_t i = 0; i < n; i++) {
        x[i] = b[order[i]];
    }
    pcl2_lu_substitute(n, lu, x);
}
