/* Generated products of matrices against Eigen and the textbook's loops. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "compare.h"
#include "hand/product.h"
#include "product4.h"
#include "product8.h"

void eigen_product4(const double *a, const double *b, double *m);
void eigen_product8(const double *a, const double *b, double *m);

static product4 four;
static product8 eight;
static double result[2][64];

#define RUN(name, call)              \
    static void run_##name(long n)   \
    {                                \
        while (n-- > 0) {            \
            call;                    \
        }                            \
    }

RUN(ours4, product4_step(&four))
RUN(hand4, hand_product4(four.in.a, four.in.b, result[0]))
RUN(eigen4, eigen_product4(four.in.a, four.in.b, result[0]))
RUN(ours8, product8_step(&eight))
RUN(hand8, hand_product8(eight.in.a, eight.in.b, result[1]))
RUN(eigen8, eigen_product8(eight.in.a, eight.in.b, result[1]))

static void fill(double *m, int n, double step)
{
    for (int i = 0; i < n; i++) {
        m[i] = sin(step * i);
    }
}

static void agree(const double *ours, const double *other, int n)
{
    for (int i = 0; i < n; i++) {
        if (!(fabs(ours[i] - other[i]) <= 1e-14 * 8)) {
            fprintf(stderr, "element %d: %.17g and %.17g\n", i, ours[i], other[i]);
            exit(1);
        }
    }
}

static const struct contender all[] = {
    {"ours4", run_ours4}, {"hand4", run_hand4}, {"eigen4", run_eigen4},
    {"ours8", run_ours8}, {"hand8", run_hand8}, {"eigen8", run_eigen8},
};

int main(int argc, char **argv)
{
    product4_init(&four);
    product8_init(&eight);
    fill(four.in.a, 16, 0.3);
    fill(four.in.b, 16, 0.7);
    fill(eight.in.a, 64, 0.3);
    fill(eight.in.b, 64, 0.7);
    for (int i = 0; i < 6; i++) {
        all[i].run(1);
        agree(four.m, i < 3 && i > 0 ? result[0] : four.m, 16);
        agree(eight.m, i > 3 ? result[1] : eight.m, 64);
    }
    compare(all, 6, argc > 1 ? atoi(argv[1]) : 9);
    return 0;
}
