/* Angles less whole quarter turns: pi/2 in four parts for moderate ones (Cody and Waite, Software Manual for the
 * Elementary Functions, 1980, ch. 8), the needed bits of 2/pi for large ones (Payne and Hanek, ACM SIGNUM Newsletter
 * 18, 1983). */
#include "pcl2_trig.h"

/* Up to TRIG_NEAR a multiple of the first three parts of pi/2 is exact. Beyond it an angle is a whole number of
 * TRIG_DIGITS digits of 32 bits times a power of 2, and its product with TRIG_WORDS words of 2/pi, each 32 bits,
 * holds the quarter turn and 70 (40) bits more than the nearest angle to a multiple of pi/2 needs. The table
 * of 2/pi begins with 64 bits 0. */
#if PCL2_REAL_BITS == 64
#define TRIG_NEAR 1600000.0
#define TRIG_DIGITS 2
#define TRIG_WORDS 6
#define TRIG_TABLE 40
static const pcl2_real pcl2_trig_quarter[4] = {
    1.5707963267341256, 6.077100506303966e-11, 2.0222662487111665e-21, 8.4784276603689e-32};
static const struct pcl2_pair pcl2_trig_turn = {6.283185307179586, 2.4492935982947064e-16};
static const uint32_t pcl2_trig_two_over_pi[TRIG_TABLE] = {
    0x00000000, 0x00000000, 0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab,
    0xdebbc561, 0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484,
    0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f, 0xef2f118b,
    0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b, 0x3d0739f7, 0x8a5292ea,
    0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab};
#else
#define TRIG_NEAR 400.0f
#define TRIG_DIGITS 1
#define TRIG_WORDS 3
#define TRIG_TABLE 10
static const pcl2_real pcl2_trig_quarter[4] = {1.5707703f, 2.6063062e-05f, 6.0770944e-11f, 6.123234e-17f};
static const struct pcl2_pair pcl2_trig_turn = {6.2831855f, -1.7484555e-07f};
static const uint32_t pcl2_trig_two_over_pi[TRIG_TABLE] = {
    0x00000000, 0x00000000, 0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab,
    0xdebbc561};
#endif


/* Words of 2/pi from a bit on. */
static void pcl2_trig_window(int32_t bit, uint32_t *window)
{
    const uint32_t *word = &pcl2_trig_two_over_pi[bit / 32];
    for (int32_t i = 0; i < TRIG_WORDS; i++) {
        window[i] = (uint32_t)(((((uint64_t)word[i] << 32) | word[i + 1]) << (bit % 32)) >> 32);
    }
}

/* The lowest words of window times whole, the highest first. */
static void pcl2_trig_product(const uint32_t *window, uint64_t whole, uint32_t *product)
{
    memset(product, 0, TRIG_WORDS * sizeof *product);
    for (int32_t d = 0; d < TRIG_DIGITS; d++) {
        const uint64_t digit = (whole >> (32 * d)) & UINT32_MAX;
        uint64_t carry = 0;
        for (int32_t i = TRIG_WORDS - 1 - d; i >= 0; i--) {
            carry += window[i + d] * digit + product[i];
            product[i] = (uint32_t)carry;
            carry >>= 32;
        }
    }
}

/* A fraction of words as a pair, the lowest half word first. */
static struct pcl2_pair pcl2_trig_fraction(const uint32_t *word)
{
    struct pcl2_pair y = {PCL2_R(0.0), PCL2_R(0.0)};
    for (int32_t i = 2 * TRIG_WORDS - 1; i >= 0; i--) {
        const uint32_t digit = i % 2 == 0 ? word[i / 2] >> 16 : word[i / 2] & UINT32_C(0xffff);
        const struct pcl2_pair sum = pcl2_pair_ordered_sum((pcl2_real)digit * pcl2_power_of_2(-16 * (i + 1)), y.head);
        y.head = sum.head;
        y.tail += sum.tail;
    }
    return y;
}

static void pcl2_trig_negate(uint32_t *word)
{
    uint64_t carry = 1;
    for (int32_t i = TRIG_WORDS - 1; i >= 0; i--) {
        carry += (uint32_t)~word[i];
        word[i] = (uint32_t)carry;
        carry >>= 32;
    }
}

/* With x = whole 2^e, the bits of 2/pi above 2^(2 - e) are whole turns and do not count: the window begins below
 * them, and its product with whole is the angle in turns, a fraction of words. */
static int32_t pcl2_trig_far(pcl2_real x, struct pcl2_pair *r)
{
    uint32_t window[TRIG_WORDS];
    uint32_t product[TRIG_WORDS];
    const pcl2_bits one = (pcl2_bits)1 << PCL2_FRACTION_BITS;
    pcl2_trig_window(pcl2_exponent(x) - PCL2_FRACTION_BITS + 62, window);
    pcl2_trig_product(window, (pcl2_bits_of(x) & (one - 1)) | one, product);
    const uint32_t quarters = ((product[0] >> 29) + 1) >> 1;
    product[0] -= quarters << 30;
    const int32_t negative = (product[0] >> 31) != 0;
    if (negative) {
        pcl2_trig_negate(product);
    }
    *r = pcl2_pair_times(pcl2_trig_fraction(product), pcl2_trig_turn);
    r->head = negative ? -r->head : r->head;
    r->tail = negative ? -r->tail : r->tail;
    return (int32_t)(quarters & 3);
}

static int32_t pcl2_trig_near(pcl2_real x, struct pcl2_pair *r)
{
    const int32_t quarters = (int32_t)(x * PCL2_R(0.6366197723675814) + PCL2_R(0.5));
    const pcl2_real k = (pcl2_real)quarters;
    const struct pcl2_pair second = pcl2_pair_sum(x - k * pcl2_trig_quarter[0], -k * pcl2_trig_quarter[1]);
    const struct pcl2_pair third = pcl2_pair_sum(second.head, -k * pcl2_trig_quarter[2]);
    *r = pcl2_pair_ordered_sum(third.head, (second.tail + third.tail) - k * pcl2_trig_quarter[3]);
    return quarters & 3;
}

int32_t pcl2_trig_reduce(pcl2_real x, struct pcl2_pair *r)
{
    const pcl2_real size = pcl2_math_fabs(x);
    if (size <= PCL2_R(0.785)) {
        r->head = x;
        r->tail = PCL2_R(0.0);
        return 0;
    }
    const int32_t quarters = size < TRIG_NEAR ? pcl2_trig_near(size, r) : pcl2_trig_far(size, r);
    if (x > 0) {
        return quarters;
    }
    r->head = -r->head;
    r->tail = -r->tail;
    return -quarters & 3;
}

#undef TRIG_NEAR
#undef TRIG_DIGITS
#undef TRIG_WORDS
#undef TRIG_TABLE
