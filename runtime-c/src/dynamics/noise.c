/* Gaussian noise: PCG32 (O'Neill, 2014) and the polar method (Marsaglia and Bray, SIAM Review 6, 1964). */
#include "pcl2_noise.h"
#include "pcl2_math.h"

/* Twice the number of the sequence, 54, and 1. */
#define PCL2_NOISE_SEQUENCE 109U

static uint32_t pcl2_noise_bits(int32_t x)
{
    return (uint32_t)x;
}

static int32_t pcl2_noise_of_bits(uint32_t bits)
{
    int32_t x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* state += add, then one step of the congruence; returns the state before that step. */
static uint64_t pcl2_noise_step(struct pcl2_noise *self, uint64_t add)
{
    const uint64_t old = (((uint64_t)pcl2_noise_bits(self->high) << 32) | pcl2_noise_bits(self->low)) + add;
    const uint64_t state = old * UINT64_C(6364136223846793005) + PCL2_NOISE_SEQUENCE;
    self->high = pcl2_noise_of_bits((uint32_t)(state >> 32));
    self->low = pcl2_noise_of_bits((uint32_t)(state & UINT32_MAX));
    return old;
}

/* 24 random bits, less 2^23. */
static int32_t pcl2_noise_uniform(struct pcl2_noise *self)
{
    const uint64_t state = pcl2_noise_step(self, 0);
    const uint32_t mixed = (uint32_t)((((state >> 18) ^ state) >> 27) & UINT32_MAX);
    const uint32_t turn = (uint32_t)(state >> 59);
    const uint32_t turned = (mixed >> turn) | (mixed << ((32 - turn) & 31));
    return (int32_t)(turned >> 8) - 8388608;
}

PCL2_KERNEL void pcl2_noise_init(struct pcl2_noise *self, pcl2_real mean, pcl2_real sd, int32_t seed)
{
    (void)mean;
    (void)sd;
    self->high = 0;
    self->low = 0;
    self->kept = 0;
    pcl2_noise_step(self, 0);
    pcl2_noise_step(self, pcl2_noise_bits(seed));
}

/* Two normal numbers: one returned, one kept. The test is in integers, so both widths take the same pairs. */
static pcl2_real pcl2_noise_pair(struct pcl2_noise *self)
{
    const pcl2_real unit = PCL2_R(1.0) / 8388608;
    for (int32_t attempt = 0; attempt < 16; attempt++) {
        const int32_t u = pcl2_noise_uniform(self);
        const int32_t v = pcl2_noise_uniform(self);
        const int64_t square = (int64_t)u * u + (int64_t)v * v;
        if (square > 0 && square < INT64_C(70368744177664)) {
            const pcl2_real s = (pcl2_real)square * (unit * unit);
            const pcl2_real size = pcl2_math_sqrt(-2 * pcl2_math_log(s) / s) * unit;
            self->kept = 1;
            self->spare = (pcl2_real)v * size;
            return (pcl2_real)u * size;
        }
    }
    return PCL2_R(0.0);
}

PCL2_KERNEL void pcl2_noise(struct pcl2_noise *self, int32_t en, pcl2_real mean, pcl2_real sd)
{
    pcl2_real g = self->spare;
    if (en == 0) {
        self->y = PCL2_R(0.0);
        return;
    }
    if (self->kept != 0) {
        self->kept = 0;
    } else {
        g = pcl2_noise_pair(self);
    }
    self->y = mean + sd * g;
}

#undef PCL2_NOISE_SEQUENCE
