/* Roots of a polynomial: Aberth, Iteration methods for finding all zeros of a polynomial simultaneously,
 * Math. Comp. 27, 1973; first points from the Newton polygon and the stop where rounding hides the rest as in
 * Bini, Numerical computation of polynomial zeros by means of Aberth's method, Numerical Algorithms 13, 1996. */
#include "pcl2_polyroots.h"
#include "pcl2_math.h"

struct pcl2_polyroots_complex {
    pcl2_real re;  /* real part */
    pcl2_real im;  /* imaginary part */
};

static struct pcl2_polyroots_complex pcl2_polyroots_mul(struct pcl2_polyroots_complex x, struct pcl2_polyroots_complex y)
{
    const struct pcl2_polyroots_complex z = {x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re};
    return z;
}

/* x/y without squares of y, which might leave the range (Smith, Comm. ACM 5, 1962); y is not 0. */
static struct pcl2_polyroots_complex pcl2_polyroots_div(struct pcl2_polyroots_complex x, struct pcl2_polyroots_complex y)
{
    struct pcl2_polyroots_complex z;
    if (pcl2_math_fabs(y.re) >= pcl2_math_fabs(y.im)) {
        const pcl2_real ratio = y.im / y.re;
        const pcl2_real size = y.re + y.im * ratio;
        z.re = (x.re + x.im * ratio) / size;
        z.im = (x.im - x.re * ratio) / size;
    } else {
        const pcl2_real ratio = y.re / y.im;
        const pcl2_real size = y.re * ratio + y.im;
        z.re = (x.re * ratio + x.im) / size;
        z.im = (x.im * ratio - x.re) / size;
    }
    return z;
}

/* Within a factor of the square root of 2: exact enough for bounds. */
static pcl2_real pcl2_polyroots_size(struct pcl2_polyroots_complex z)
{
    return pcl2_math_fabs(z.re) + pcl2_math_fabs(z.im);
}

/* Coefficient of s^k; 1 for k = n. */
static pcl2_real pcl2_polyroots_coefficient(int32_t n, const pcl2_real *a, int32_t k)
{
    return k == n ? PCL2_R(1.0) : a[n - 1 - k];
}

/* Exponent, rounded down, of the radius that the edge of the Newton polygon from s^low belongs to; *high gets its
 * other end. The polygon is the upper hull of (k, log2 |coefficient of s^k|). */
static int32_t pcl2_polyroots_edge(int32_t n, const pcl2_real *a, int32_t low, int32_t *high)
{
    const int32_t from = pcl2_exponent(pcl2_polyroots_coefficient(n, a, low));
    int32_t rise = 0;
    int32_t run = 0;
    for (int32_t k = low + 1; k <= n; k++) {
        const pcl2_real value = pcl2_polyroots_coefficient(n, a, k);
        const int32_t step = pcl2_exponent(value) - from;
        if (value != 0 && (run == 0 || step * run >= rise * (k - low))) {
            rise = step;
            run = k - low;
        }
    }
    *high = low + run;
    return -rise / run;
}

/* First points: on a circle for each edge, turned by the golden angle from one to the next so that no two meet and
 * no symmetry holds the iteration. */
static void pcl2_polyroots_start(int32_t n, const pcl2_real *a, pcl2_real *re, pcl2_real *im)
{
    const struct pcl2_polyroots_complex turn = {PCL2_R(-0.7373688780783197), PCL2_R(0.6754902942615238)};
    struct pcl2_polyroots_complex direction = {PCL2_R(0.8), PCL2_R(0.6)};
    int32_t i = 0;
    while (i < n) {
        int32_t high = n;
        const pcl2_real radius = pcl2_power_of_2(pcl2_polyroots_edge(n, a, i, &high));
        for (; i < high; i++) {
            re[i] = radius * direction.re;
            im[i] = radius * direction.im;
            direction = pcl2_polyroots_mul(direction, turn);
        }
    }
}

/* Newton's correction p/p' at z; 0 where p is no more than its own rounding errors. */
static struct pcl2_polyroots_complex pcl2_polyroots_newton(int32_t n, const pcl2_real *a, struct pcl2_polyroots_complex z)
{
    struct pcl2_polyroots_complex p = {PCL2_R(1.0), PCL2_R(0.0)};
    struct pcl2_polyroots_complex slope = {PCL2_R(0.0), PCL2_R(0.0)};
    const struct pcl2_polyroots_complex none = {PCL2_R(0.0), PCL2_R(0.0)};
    const pcl2_real radius = pcl2_math_sqrt(z.re * z.re + z.im * z.im);
    pcl2_real bound = PCL2_R(1.0);
    for (int32_t i = 0; i < n; i++) {
        slope = pcl2_polyroots_mul(slope, z);
        slope.re += p.re;
        slope.im += p.im;
        p = pcl2_polyroots_mul(p, z);
        p.re += a[i];
        bound = bound * radius + pcl2_math_fabs(a[i]);
    }
    if (pcl2_polyroots_size(p) <= 2 * PCL2_REAL_EPSILON * bound) {
        return none;
    }
    if (pcl2_polyroots_size(slope) == 0) {
        slope.re = bound;
    }
    return pcl2_polyroots_div(p, slope);
}

/* One sweep of Aberth's iteration over all points; 1 while one of them still moves. */
static int32_t pcl2_polyroots_sweep(int32_t n, const pcl2_real *a, pcl2_real *re, pcl2_real *im)
{
    int32_t moved = 0;
    for (int32_t i = 0; i < n; i++) {
        const struct pcl2_polyroots_complex one = {PCL2_R(1.0), PCL2_R(0.0)};
        const struct pcl2_polyroots_complex z = {re[i], im[i]};
        const struct pcl2_polyroots_complex newton = pcl2_polyroots_newton(n, a, z);
        struct pcl2_polyroots_complex repel = {PCL2_R(0.0), PCL2_R(0.0)};
        for (int32_t j = 0; j < n; j++) {
            const struct pcl2_polyroots_complex gap = {z.re - re[j], z.im - im[j]};
            if (j != i && pcl2_polyroots_size(gap) != 0) {
                const struct pcl2_polyroots_complex push = pcl2_polyroots_div(one, gap);
                repel.re += push.re;
                repel.im += push.im;
            }
        }
        struct pcl2_polyroots_complex shrink = pcl2_polyroots_mul(newton, repel);
        shrink.re = 1 - shrink.re;
        shrink.im = -shrink.im;
        const struct pcl2_polyroots_complex step = pcl2_polyroots_size(shrink) == 0 ? newton : pcl2_polyroots_div(newton, shrink);
        re[i] -= step.re;
        im[i] -= step.im;
        moved |= pcl2_polyroots_size(step) > PCL2_REAL_EPSILON * pcl2_polyroots_size(z);
    }
    return moved;
}

/* s^2 + a s + b without cancellation. */
static void pcl2_polyroots_quadratic(pcl2_real a, pcl2_real b, pcl2_real *re, pcl2_real *im)
{
    const pcl2_real half = a / 2;
    const pcl2_real square = half * half - b;
    const pcl2_real root = pcl2_math_sqrt(pcl2_math_fabs(square));
    if (square < 0) {
        re[0] = re[1] = -half;
        im[0] = root;
        im[1] = -root;
    } else {
        re[0] = half > 0 ? -half - root : root - half;
        re[1] = re[0] != 0 ? b / re[0] : PCL2_R(0.0);
        im[0] = im[1] = PCL2_R(0.0);
    }
}

int32_t pcl2_polyroots_scale(int32_t n, const pcl2_real *a, int32_t least)
{
    int32_t scale = least;
    for (int32_t i = 0; i < n; i++) {
        const int32_t exponent = pcl2_exponent(a[i]) + 1;
        if (a[i] != 0 && exponent > scale * (i + 1)) {
            scale = exponent > 0 ? (exponent + i) / (i + 1) : exponent / (i + 1);
        }
    }
    return scale;
}

/* Roots of a polynomial whose last coefficient is not 0. */
static void pcl2_polyroots_solve(int32_t n, const pcl2_real *a, pcl2_real *re, pcl2_real *im)
{
    if (n == 1) {
        re[0] = -a[0];
        im[0] = PCL2_R(0.0);
    } else if (n == 2) {
        pcl2_polyroots_quadratic(a[0], a[1], re, im);
    } else if (n > 2) {
        pcl2_polyroots_start(n, a, re, im);
        for (int32_t sweep = 0; sweep < 200 && pcl2_polyroots_sweep(n, a, re, im); sweep++) {
        }
    }
}

/* The roots are found in units of a power of two near the largest, so that no power of one leaves the range. */
void pcl2_polyroots(int32_t n, const pcl2_real *a, pcl2_real *re, pcl2_real *im)
{
    pcl2_real scaled[PCL2_POLYROOTS_MAX];
    const pcl2_real unit = pcl2_power_of_2(pcl2_polyroots_scale(n, a, -PCL2_EXPONENT_BIAS / 2));
    int32_t roots = n;
    for (int32_t i = 0; i < n; i++) {
        scaled[i] = a[i];
        for (int32_t j = 0; j <= i; j++) {
            scaled[i] /= unit;
        }
    }
    while (roots > 0 && scaled[roots - 1] == 0) {
        roots--;
        re[roots] = PCL2_R(0.0);
        im[roots] = PCL2_R(0.0);
    }
    pcl2_polyroots_solve(roots, scaled, re, im);
    for (int32_t i = 0; i < n; i++) {
        re[i] *= unit;
        im[i] = pcl2_math_fabs(im[i]) * unit <= 1024 * PCL2_REAL_EPSILON * pcl2_math_fabs(re[i]) ? PCL2_R(0.0) : im[i] * unit;
    }
}
