/* What every kernel and every generated file may rely on: the real type, its limits, bad signals,
 * saturating integers, time and the health record.
 *
 * pcl2_config.h is written by the compiler beside this file and chooses the width of a real:
 * it defines pcl2_real, PCL2_REAL_BITS (64 or 32) and PCL2_R(literal). */
#ifndef PCL2_H
#define PCL2_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "pcl2_config.h"

#ifdef __FAST_MATH__
#error "pcl2: -ffast-math removes the tests for bad signals and the order of the sums; compile without it"
#endif

#if FLT_EVAL_METHOD != 0
#error "pcl2: intermediate results must have the width of their type (on x86: -msse2 -mfpmath=sse)"
#endif

/* The width that the compiler wrote is the width that this C compiler has (a double of AVR may have 32 bits). */
typedef char pcl2_real_has_the_configured_width[sizeof(pcl2_real) * 8 == PCL2_REAL_BITS ? 1 : -1];

/* Linkage of a kernel: external, unless a generated file that takes kernels in says `static inline` before. */
#ifndef PCL2_KERNEL
#define PCL2_KERNEL
#endif

/* Before a loop over a size that is a literal where the function is inlined: a loop of at most 8 (4) turns
 * vanishes, a longer one is unrolled as often. Clang does as well by itself and worse when told. */
#if defined(__GNUC__) && !defined(__clang__)
#define PCL2_UNROLL _Pragma("GCC unroll 8")
#define PCL2_UNROLL_FEW _Pragma("GCC unroll 4")
#else
#define PCL2_UNROLL
#define PCL2_UNROLL_FEW
#endif

/* Linkage of a small function that must see its sizes as literals: gcc alone would share one general copy. */
#if defined(__GNUC__)
#define PCL2_INLINE static inline __attribute__((always_inline))
#else
#define PCL2_INLINE static inline
#endif

/* A condition that seldom holds: what follows gives up its registers to the usual way. */
#if defined(__GNUC__)
#define PCL2_RARELY(condition) __builtin_expect(condition, 0)
#else
#define PCL2_RARELY(condition) (condition)
#endif

/* The IEEE 754 format of a real: its bits as an unsigned number, the bits of the fraction, the exponent's
 * offset, the exponent's mask, the distance of 1 to the next larger real. */
#if PCL2_REAL_BITS == 64
typedef uint64_t pcl2_bits;
#define PCL2_FRACTION_BITS 52
#define PCL2_EXPONENT_BIAS 1023
#define PCL2_EXPONENT_MASK UINT64_C(0x7ff0000000000000)
#define PCL2_REAL_EPSILON DBL_EPSILON
#define PCL2_REAL_MAX DBL_MAX
#else
typedef uint32_t pcl2_bits;
#define PCL2_FRACTION_BITS 23
#define PCL2_EXPONENT_BIAS 127
#define PCL2_EXPONENT_MASK UINT32_C(0x7f800000)
#define PCL2_REAL_EPSILON FLT_EPSILON
#define PCL2_REAL_MAX FLT_MAX
#endif

static inline pcl2_bits pcl2_bits_of(pcl2_real x)
{
    pcl2_bits bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline pcl2_real pcl2_of_bits(pcl2_bits bits)
{
    pcl2_real x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* 1 for a bad signal (infinite or not a number), else 0. Reads the exponent, so no compiler option folds it. */
static inline int32_t pcl2_is_bad(pcl2_real x)
{
    return (pcl2_bits_of(x) & PCL2_EXPONENT_MASK) == PCL2_EXPONENT_MASK;
}

/* The bad signal as a constant: an operator cell that nobody wrote yet, an optional port without a wire. */
#define PCL2_BAD ((pcl2_real)NAN)

/* The bad signal that a block makes itself: a quiet NaN. */
static inline pcl2_real pcl2_bad(void)
{
    return pcl2_of_bits(PCL2_EXPONENT_MASK | ((pcl2_bits)1 << (PCL2_FRACTION_BITS - 1)));
}

/* The nearest int32_t. */
static inline int32_t pcl2_saturate_i(int64_t x)
{
    return x > INT32_MAX ? INT32_MAX : x < INT32_MIN ? INT32_MIN : (int32_t)x;
}

/* Integer arithmetic that saturates instead of wrapping. */
static inline int32_t pcl2_add_i(int32_t a, int32_t b)
{
    return pcl2_saturate_i((int64_t)a + b);
}

static inline int32_t pcl2_sub_i(int32_t a, int32_t b)
{
    return pcl2_saturate_i((int64_t)a - b);
}

static inline int32_t pcl2_mul_i(int32_t a, int32_t b)
{
    return pcl2_saturate_i((int64_t)a * b);
}

static inline int32_t pcl2_neg_i(int32_t a)
{
    return a == INT32_MIN ? INT32_MAX : -a;
}

/* A time in nanoseconds as seconds. */
static inline pcl2_real pcl2_seconds(int64_t nanoseconds)
{
    return (pcl2_real)nanoseconds / PCL2_R(1e9);
}

/* A time in seconds as nanoseconds, to the nearest; 0 for a negative or a bad one, at most 2^62 (146 years). */
static inline int64_t pcl2_nanoseconds(pcl2_real seconds)
{
    const pcl2_real limit = PCL2_R(4611686018.427387904);
    if (!(seconds > PCL2_R(0.0))) {
        return 0;
    }
    return seconds < limit ? (int64_t)(seconds * PCL2_R(1e9) + PCL2_R(0.5)) : INT64_C(4611686018427387904);
}

/* What went wrong since init. All zero: nothing did. Faults of one scan count in block order, whatever the order in
 * which they are told: the first is that of the lowest block, the latest that of the highest. */
struct pcl2_health {
    uint32_t faults;       /* block scans that ended with a status other than 0; stops at 2^32 - 1 */
    uint32_t refused;      /* sets of parameters that were refused as a whole; stops at 2^32 - 1 */
    int32_t first_block;   /* index of the block of the first fault, from 0 in block order; means nothing while faults is 0 */
    int32_t first_status;  /* status of the first fault, from 1 in the order of the block's FAULTS; 0: no fault yet */
    uint32_t first_scan;   /* scan of the first fault, from 0 */
    int32_t last_block;    /* index of the block of the latest fault, from 0 in block order */
    int32_t last_status;   /* status of the latest fault; 0: no fault yet */
    uint32_t last_scan;    /* scan of the latest fault, from 0 */
};

/* Counts a fault: block ended scan with status (not 0). */
static inline void pcl2_fault(struct pcl2_health *health, uint32_t scan, int32_t block, int32_t status)
{
    if (health->faults == 0 || (scan == health->first_scan && block < health->first_block)) {
        health->first_block = block;
        health->first_status = status;
        health->first_scan = scan;
    }
    if (health->faults == 0 || scan != health->last_scan || block >= health->last_block) {
        health->last_block = block;
        health->last_status = status;
        health->last_scan = scan;
    }
    if (health->faults != UINT32_MAX) {
        health->faults++;
    }
}

/* Counts a refused set of parameters. */
static inline void pcl2_refuse(struct pcl2_health *health)
{
    if (health->refused != UINT32_MAX) {
        health->refused++;
    }
}

#endif
