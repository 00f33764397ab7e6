/* Programs of one function code each, as generated, against hand-written C: same inputs, same results. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "compare.h"
#include "kept_model.h"
#include "gpc_one.h"
#include "gpc_three.h"
#include "hand/flc.h"
#include "hand/gpc.h"
#include "hand/nn.h"
#include "hand/rls.h"
#include "mamdani.h"
#include "nn_large.h"
#include "nn_small.h"
#include "rls_six.h"
#include "sugeno.h"

enum { SIGNALS = 256 };

/* What comes in: a disturbed sine, and its successor as a second signal. */
static double signal[SIGNALS + 8];

static void make_signal(void)
{
    unsigned noise = 1;
    for (int i = 0; i < SIGNALS + 8; i++) {
        noise = noise * 1664525u + 1013904223u;
        signal[i] = 0.7 * sin(0.05 * i) + 0.3 * ((double)(noise >> 8) / 16777216.0 - 0.5);
    }
}

/* A contender's loop: the present scan is k. */
#define RUN(name, body)                             \
    static long name##_k;                           \
    static void run_##name(long n)                  \
    {                                               \
        while (n-- > 0) {                           \
            const long k = name##_k++ % SIGNALS;    \
            const double s = signal[k];             \
            body                                    \
        }                                           \
    }

/* The b0 of the adaptive models: new in every scan. */
#define B0 (0.28 + 0.01 * s)

static kept_model kept;
static gpc_one one;
static gpc_three three;
static rls_six six;
static sugeno fuzzy_s;
static mamdani fuzzy_m;
static nn_small small, small_learns;
static nn_large large, large_learns;

static struct hand_gpc hand_kept, hand_one, hand_three;
static struct hand_rls hand_six;
static struct hand_flc hand_s, hand_m;
static struct hand_nn_small hand_small, hand_small_learns;
static struct hand_nn_large hand_large, hand_large_learns;
static double hand_o[4][4];

static const double setpoint = 0.2;

RUN(empty_call, kept.in.y = s; compare_nothing(&kept);)
RUN(kept_model, kept.in.y = s; kept_model_step(&kept);)
RUN(kept_model_hand, hand_gpc_fixed(&hand_kept, setpoint, s, 0.0);)
RUN(gpc_one, one.in.y = s; one.in.p[2] = B0; gpc_one_step(&one);)
RUN(gpc_one_hand, hand_one.p[2] = B0; hand_gpc_adaptive1(&hand_one, setpoint, s, hand_one.p, 0.0);)
RUN(gpc_three, three.in.y = s; three.in.p[2] = B0; gpc_three_step(&three);)
RUN(gpc_three_hand, hand_three.p[2] = B0; hand_gpc_adaptive3(&hand_three, setpoint, s, hand_three.p, 0.0);)
RUN(rls_six, six.in.y = s; six.in.u = signal[k + 1]; rls_six_step(&six);)
RUN(rls_six_hand, hand_rls_step(&hand_six, s, signal[k + 1], 1.0);)
RUN(sugeno, fuzzy_s.in.y = s; sugeno_step(&fuzzy_s);)
RUN(sugeno_hand, hand_flc_sugeno(&hand_s, setpoint, s);)
RUN(mamdani, fuzzy_m.in.y = s; mamdani_step(&fuzzy_m);)
RUN(mamdani_hand, hand_flc_mamdani(&hand_m, setpoint, s);)
RUN(nn_small, small.in.x[0] = s; small.in.x[1] = signal[k + 1]; nn_small_step(&small);)
RUN(nn_small_hand, hand_nn_small(&hand_small, &signal[k], NULL, hand_o[0]); (void)s;)
RUN(nn_small_learns, small_learns.in.x[0] = s; small_learns.in.x[1] = signal[k + 1];
    small_learns.in.t[0] = signal[k + 2]; nn_small_step(&small_learns);)
RUN(nn_small_learns_hand, hand_nn_small(&hand_small_learns, &signal[k], &signal[k + 2], hand_o[1]); (void)s;)
RUN(nn_large, large.in.x[0] = s; nn_large_step(&large);)
RUN(nn_large_learns, large_learns.in.x[0] = s; nn_large_step(&large_learns);)

static double large_x[2][8];
static const double large_t[4] = {0.1, 0.2, 0.3, 0.4};

RUN(nn_large_hand, large_x[0][0] = s; hand_nn_large(&hand_large, large_x[0], NULL, hand_o[2]);)
RUN(nn_large_learns_hand, large_x[1][0] = s; hand_nn_large(&hand_large_learns, large_x[1], large_t, hand_o[3]);)

static void init_gpc(struct hand_gpc *hand)
{
    *hand = (struct hand_gpc){.p = {0.893, -0.17377, 0.2807, 0.0}, .umin = -2.0, .umax = 2.0, .lambda = 0.1};
    hand_gpc_design(hand);
}

static void init_control(void)
{
    kept_model_init(&kept);
    gpc_one_init(&one);
    gpc_three_init(&three);
    kept.in.w = one.in.w = three.in.w = setpoint;
    memcpy(one.in.p, kept.p, sizeof one.in.p);
    memcpy(three.in.p, kept.p, sizeof three.in.p);
    init_gpc(&hand_kept);
    init_gpc(&hand_one);
    init_gpc(&hand_three);
    rls_six_init(&six);
    six.in.en = 1.0;
    hand_rls_init(&hand_six, 0.98, 1000.0, 1e6);
    sugeno_init(&fuzzy_s);
    mamdani_init(&fuzzy_m);
    fuzzy_s.in.w = fuzzy_m.in.w = setpoint;
    hand_s = (struct hand_flc){.umin = -2.0, .umax = 2.0, .ge = 1.0, .gd = 1.0, .gu = 0.4};
    hand_m = hand_s;
}

/* The hand-written networks start from the weights of the generated ones. */
static void init_networks(void)
{
    nn_small_init(&small);
    nn_small_init(&small_learns);
    small_learns.in.en = 1.0;
    memcpy(&hand_small, small.o.w, sizeof small.o.w);
    hand_small.eta = 0.01;
    hand_small.alpha = 0.5;
    hand_small_learns = hand_small;
    nn_large_init(&large);
    nn_large_init(&large_learns);
    large_learns.in.en = 1.0;
    memcpy(large_learns.in.t, large_t, sizeof large_t);
    memcpy(&hand_large, large.o.w, sizeof large.o.w);
    hand_large.eta = 0.01;
    hand_large.alpha = 0.5;
    hand_large_learns = hand_large;
}

/* Sums run in other orders, so the last digits may differ. */
static void agree(const char *name, double ours, double hand)
{
    if (!(fabs(ours - hand) <= 1e-7 * (1.0 + fabs(hand)))) {
        fprintf(stderr, "%s: %.17g by hand: %.17g\n", name, ours, hand);
        exit(1);
    }
}

static void check(void)
{
    agree("kept_model", kept.u.s.u, hand_kept.u);
    agree("gpc_one", one.u.s.u, hand_one.u);
    agree("gpc_three", three.u.s.u, hand_three.u);
    agree("rls_six", six.th.th[0], hand_six.theta[0]);
    agree("sugeno", fuzzy_s.u.s.u, hand_s.u);
    agree("mamdani", fuzzy_m.u.s.u, hand_m.u);
    agree("nn_small", small.o.o[0], hand_o[0][0]);
    agree("nn_small_learns", small_learns.o.o[0], hand_o[1][0]);
    agree("nn_large", large.o.o[3], hand_o[2][3]);
    agree("nn_large_learns", large_learns.o.o[3], hand_o[3][3]);
}

#define CONTENDER(name) {#name, run_##name}

static const struct contender all[] = {
    CONTENDER(empty_call), CONTENDER(kept_model), CONTENDER(kept_model_hand),
    CONTENDER(gpc_one), CONTENDER(gpc_one_hand),
    CONTENDER(gpc_three), CONTENDER(gpc_three_hand),
    CONTENDER(rls_six), CONTENDER(rls_six_hand),
    CONTENDER(sugeno), CONTENDER(sugeno_hand),
    CONTENDER(mamdani), CONTENDER(mamdani_hand),
    CONTENDER(nn_small), CONTENDER(nn_small_hand),
    CONTENDER(nn_small_learns), CONTENDER(nn_small_learns_hand),
    CONTENDER(nn_large), CONTENDER(nn_large_hand),
    CONTENDER(nn_large_learns), CONTENDER(nn_large_learns_hand),
};

enum { CONTENDERS = sizeof all / sizeof all[0] };

int main(int argc, char **argv)
{
    make_signal();
    init_control();
    init_networks();
    for (int i = 0; i < CONTENDERS; i++) {
        all[i].run(100);
    }
    check();
    compare(all, CONTENDERS, argc > 1 ? atoi(argv[1]) : 9);
    return 0;
}
