/* Compares an elementary function of the runtime with a table of true values, and sweeps it for monotony.
 *
 *     cc -std=c99 -O2 -ffp-contract=off -I CONFIG -I runtime-c/include \
 *        tests/c/math_ulp.c runtime-c/src/math/NAME.c -lm -o math_ulp
 *     ./math_ulp NAME tests/reference/math/NAME.f64.csv
 *
 * for every NAME in the list below (link all of them: src/math/exp.c expm1.c tanh.c). CONFIG holds a pcl2_config.h;
 * the table's width must be its width (.f64 or .f32). Prints one line and exits with 0 when no value is more
 * than 1 ulp from the truth and the function never falls; with 1 when it is not so; with 2 for wrong usage.
 * Rows of the table: x,y,rest with the bits of x and of the nearest y, and the rest in ulp (tests/reference/math_tables.py). */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "pcl2_math.h"

struct math_function {
    const char *name;               /* as in the table's file name */
    pcl2_real (*call)(pcl2_real);   /* rises with its argument */
};

static const struct math_function functions[] = {{"exp", pcl2_math_exp}, {"expm1", pcl2_math_expm1}, {"tanh", pcl2_math_tanh}};

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

/* Runs of neighbours from points spread over all arguments: counts the falls. */
static int64_t falls_of(pcl2_real (*call)(pcl2_real), int64_t points, int64_t run)
{
    const int64_t end = place_of(pcl2_of_bits(PCL2_EXPONENT_MASK));
    int64_t falls = 0;
    for (int64_t i = 0; i < points; i++) {
        const int64_t start = (i - points / 2) * (end / (points / 2)) + i;
        pcl2_real before = call(real_at(start));
        for (int64_t j = 1; j < run && start + j <= end; j++) {
            const pcl2_real now = call(real_at(start + j));
            falls += !(now >= before);
            before = now;
        }
    }
    return falls;
}

/* Pairs of neighbours at even steps between two arguments, where the function is neither flat nor a line. */
static int64_t falls_between(pcl2_real (*call)(pcl2_real), pcl2_real low, pcl2_real high, int32_t points)
{
    int64_t falls = 0;
    for (int32_t i = 0; i < points; i++) {
        const int64_t place = place_of(low + (high - low) * ((pcl2_real)i / (pcl2_real)points));
        pcl2_real before = call(real_at(place));
        for (int64_t j = 1; j < 8; j++) {
            const pcl2_real now = call(real_at(place + j));
            falls += !(now >= before);
            before = now;
        }
    }
    return falls;
}

int main(int argc, char **argv)
{
    char line[128];
    double worst = 0.0;
    pcl2_bits worst_at = 0;
    long rows = 0;
    const struct math_function *function = NULL;
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        if (argc == 3 && strcmp(argv[1], functions[i].name) == 0) {
            function = &functions[i];
        }
    }
    FILE *table = function == NULL ? NULL : fopen(argv[2], "r");
    if (table == NULL || fgets(line, sizeof line, table) == NULL) {
        fprintf(stderr, "usage: math_ulp NAME TABLE\n");
        return 2;
    }
    while (fgets(line, sizeof line, table) != NULL) {
        char *at = line;
        const pcl2_bits x = (pcl2_bits)strtoull(at, &at, 16);
        const pcl2_bits y = (pcl2_bits)strtoull(at + 1, &at, 16);
        const double error = error_of(function->call(pcl2_of_bits(x)), y, strtod(at + 1, NULL));
        rows++;
        if (error > worst) {
            worst = error;
            worst_at = x;
        }
    }
    fclose(table);
    const int64_t falls = falls_of(function->call, 20000, 64) +
                          falls_between(function->call, PCL2_R(-2.0), PCL2_R(2.0), 300000) +
                          falls_between(function->call, PCL2_R(-30.0), PCL2_R(30.0), 100000);
    printf("%s f%d: %ld rows, worst %.4f ulp at 0x%" PRIx64 ", %" PRId64 " falls\n", function->name, PCL2_REAL_BITS, rows,
           worst, (uint64_t)worst_at, falls);
    return rows > 0 && worst <= 1.0 && falls == 0 ? 0 : 1;
}
