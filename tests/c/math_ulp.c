/* Compares an elementary function of the runtime with a table of true values, and sweeps it for monotony; in a build
 * with floats also with the C library's double function, all over the range.
 *
 *     cc -std=c99 -O2 -ffp-contract=off -I CONFIG -I runtime-c/include \
 *        tests/c/math_ulp.c runtime-c/src/math/NAME.c -lm -o math_ulp
 *     ./math_ulp NAME tests/reference/math/NAME.f64.csv
 *
 * for every NAME in the list below (link all of runtime-c/src/math). CONFIG holds a pcl2_config.h; the table's width
 * must be its width (.f64 or .f32). Prints one line and exits with 0 when no value is more than 1 ulp from the truth
 * and the function never turns back; with 1 when it is not so; with 2 for wrong usage. Without arguments it prints the
 * names. Rows of the table: x,y,rest or x,z,y,rest with the bits of the arguments and of the nearest y, and the rest in
 * ulp (tests/reference/math_tables.py). */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "pcl2_math.h"

struct math_function {
    const char *name;                        /* as in the table's file name */
    pcl2_real (*call)(pcl2_real);            /* NULL for a function of two arguments */
    pcl2_real (*call2)(pcl2_real, pcl2_real);
    double (*libm)(double);
    double (*libm2)(double, double);
    int32_t rises;                           /* 1 or -1: monotone from low to high; 0: not swept */
    double low;
    double high;
};

#define ONE(name, rises, low, high) {#name, pcl2_math_##name, NULL, name, NULL, rises, low, high}
#define TWO(name) {#name, NULL, pcl2_math_##name, NULL, name, 0, 0.0, 0.0}
static const struct math_function functions[] = {
    ONE(exp, 1, -INFINITY, INFINITY), ONE(expm1, 1, -INFINITY, INFINITY), ONE(tanh, 1, -INFINITY, INFINITY),
    ONE(log, 1, 0.0, INFINITY),       ONE(log10, 1, 0.0, INFINITY),       ONE(log1p, 1, -1.0, INFINITY),
    ONE(sin, 1, -1.5707, 1.5707),     ONE(cos, -1, 0.0, 3.1415),          ONE(tan, 1, -1.5707, 1.5707),
    ONE(asin, 1, -1.0, 1.0),          ONE(acos, -1, -1.0, 1.0),           ONE(atan, 1, -INFINITY, INFINITY),
    TWO(pow),                         TWO(atan2)};

/* Place of a real among all reals: neighbours differ by 1, both zeros are 0. */
static int64_t place_of(pcl2_real x)
{
    const pcl2_bits sign = (pcl2_bits)1 << (PCL2_REAL_BITS - 1);
    const pcl2_bits bits = pcl2_bits_of(x);
    return (bits & sign) != 0 ? -(int64_t)(bits & ~sign) : (int64_t)bits;
}

static pcl2_real real_at(int64_t place)
{
    const pcl2_bits sign = (pcl2_bits)1 << (PCL2_REAL_BITS - 1);
    return pcl2_of_bits(place < 0 ? (pcl2_bits)-place | sign : (pcl2_bits)place);
}

/* Error of a value in units of the last place; special values must be met to the bit (any NaN for a NaN). */
static double error_of(pcl2_real got, pcl2_bits expected, double rest)
{
    const pcl2_real y = pcl2_of_bits(expected);
    if (y != y) {
        return got != got ? 0.0 : 1e9;
    }
    if (got != got || (rest == 0.0 && pcl2_bits_of(got) != expected && (pcl2_is_bad(y) || y == 0))) {
        return 1e9;
    }
    const double error = (double)(place_of(got) - place_of(y)) - rest;
    return error < 0 ? -error : error;
}

/* Of a run of neighbours from a place on: how often the function turns back. */
static int64_t turns_from(const struct math_function *f, int64_t place, int64_t run)
{
    int64_t turns = 0;
    if (!((double)real_at(place) >= f->low && (double)real_at(place + run) <= f->high)) {
        return 0;
    }
    pcl2_real before = f->call(real_at(place));
    for (int64_t j = 1; j < run; j++) {
        const pcl2_real now = f->call(real_at(place + j));
        turns += f->rises > 0 ? !(now >= before) : !(now <= before);
        before = now;
    }
    return turns;
}

/* Runs from points spread over all arguments, and from even steps where the function is neither flat nor a line. */
static int64_t turns_of(const struct math_function *f)
{
    const int64_t end = place_of(pcl2_of_bits(PCL2_EXPONENT_MASK)) - 64;
    const int64_t points = 20000;
    int64_t turns = 0;
    for (int64_t i = 0; i < points; i++) {
        turns += turns_from(f, (i - points / 2) * (end / (points / 2)) + i, 64);
    }
    for (int32_t i = -300000; i < 300000; i++) {
        turns += turns_from(f, place_of((pcl2_real)i / PCL2_R(1.5e5)), 8);
        turns += i % 3 == 0 ? turns_from(f, place_of((pcl2_real)i / PCL2_R(1e4)), 8) : 0;
    }
    return turns;
}

struct worst {
    double error;     /* ulp */
    pcl2_real x;
    pcl2_real z;
};

static void judge(struct worst *worst, double error, pcl2_real x, pcl2_real z)
{
    if (error > worst->error) {
        worst->error = error;
        worst->x = x;
        worst->z = z;
    }
}

/* Rows that were compared. */
static long compare_table(const struct math_function *f, FILE *table, struct worst *worst)
{
    char line[160];
    long rows = 0;
    if (fgets(line, sizeof line, table) == NULL) {
        return 0;
    }
    while (fgets(line, sizeof line, table) != NULL) {
        char *at = line;
        const pcl2_real x = pcl2_of_bits((pcl2_bits)strtoull(at, &at, 16));
        const pcl2_real z = f->call != NULL ? x : pcl2_of_bits((pcl2_bits)strtoull(at + 1, &at, 16));
        const pcl2_bits y = (pcl2_bits)strtoull(at + 1, &at, 16);
        judge(worst, error_of(f->call != NULL ? f->call(x) : f->call2(x, z), y, strtod(at + 1, NULL)), x, z);
        rows++;
    }
    return rows;
}

#if PCL2_REAL_BITS == 32
/* Error against a double that is right to far more digits. */
static double error_beside(pcl2_real got, double truth)
{
    const pcl2_real nearest = (pcl2_real)truth;
    if (pcl2_is_bad(nearest) || nearest == 0) {
        return error_of(got, pcl2_bits_of(nearest), 0.0);
    }
    int exponent;
    frexp((double)nearest, &exponent);
    return fabs((double)got - truth) / ldexp(1.0, exponent < -125 ? -149 : exponent - 24);
}

/* Every 5003rd float, or pairs of floats that run through each other. */
static void compare_libm(const struct math_function *f, struct worst *worst)
{
    uint32_t other = 1;
    for (uint32_t bits = 0; bits < UINT32_MAX - 5003; bits += 5003) {
        const pcl2_real x = pcl2_of_bits(bits);
        other = other * UINT32_C(1664525) + UINT32_C(1013904223);
        const pcl2_real z = f->call != NULL ? x : pcl2_of_bits(other);
        const pcl2_real y = f->call != NULL ? f->call(x) : f->call2(x, z);
        judge(worst, error_beside(y, f->call != NULL ? f->libm((double)x) : f->libm2((double)x, (double)z)), x, z);
    }
}
#endif

static int compare(const struct math_function *f, FILE *table)
{
    struct worst worst = {0.0, PCL2_R(0.0), PCL2_R(0.0)};
    const long rows = compare_table(f, table, &worst);
#if PCL2_REAL_BITS == 32
    compare_libm(f, &worst);
#endif
    const int64_t turns = f->rises == 0 ? 0 : turns_of(f);
    printf("%s f%d: %ld rows, worst %.4f ulp at %a, %a; turns back %" PRId64 " times\n", f->name, PCL2_REAL_BITS, rows,
           worst.error, (double)worst.x, (double)worst.z, turns);
    return rows > 0 && worst.error <= 1.0 && turns == 0 ? 0 : 1;
}

int main(int argc, char **argv)
{
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        if (argc == 1) {
            puts(functions[i].name);
        } else if (argc == 3 && strcmp(argv[1], functions[i].name) == 0) {
            FILE *table = fopen(argv[2], "r");
            if (table != NULL) {
                const int result = compare(&functions[i], table);
                fclose(table);
                return result;
            }
        }
    }
    if (argc != 1) {
        fprintf(stderr, "usage: math_ulp [NAME TABLE]\n");
    }
    return argc == 1 ? 0 : 2;
}
