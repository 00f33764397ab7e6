/* Ints as words of 32 bits, in two's complement. */
#ifndef PCL2_WORDS_INLINE_H
#define PCL2_WORDS_INLINE_H

#include "pcl2.h"

/* The int of these bits. */
static inline int32_t pcl2_int_of_bits(uint32_t bits)
{
    int32_t x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline pcl2_real pcl2_dsum(int32_t x1, int32_t x2, int32_t x3, int32_t x4, int32_t x5, int32_t x6, int32_t x7,
                                  int32_t x8, pcl2_real w1, pcl2_real w2, pcl2_real w3, pcl2_real w4, pcl2_real w5,
                                  pcl2_real w6, pcl2_real w7, pcl2_real w8)
{
    pcl2_real y = x1 != 0 ? w1 : PCL2_R(0.0);
    y += x2 != 0 ? w2 : PCL2_R(0.0);
    y += x3 != 0 ? w3 : PCL2_R(0.0);
    y += x4 != 0 ? w4 : PCL2_R(0.0);
    y += x5 != 0 ? w5 : PCL2_R(0.0);
    y += x6 != 0 ? w6 : PCL2_R(0.0);
    y += x7 != 0 ? w7 : PCL2_R(0.0);
    y += x8 != 0 ? w8 : PCL2_R(0.0);
    return y;
}

static inline int32_t pcl2_pack(int32_t x1, int32_t x2, int32_t x3, int32_t x4, int32_t x5, int32_t x6, int32_t x7,
                                int32_t x8, int32_t x9, int32_t x10, int32_t x11, int32_t x12, int32_t x13,
                                int32_t x14, int32_t x15, int32_t x16)
{
    const int32_t first = (x1 != 0) | (x2 != 0) << 1 | (x3 != 0) << 2 | (x4 != 0) << 3;
    const int32_t second = (x5 != 0) | (x6 != 0) << 1 | (x7 != 0) << 2 | (x8 != 0) << 3;
    const int32_t third = (x9 != 0) | (x10 != 0) << 1 | (x11 != 0) << 2 | (x12 != 0) << 3;
    const int32_t fourth = (x13 != 0) | (x14 != 0) << 1 | (x15 != 0) << 2 | (x16 != 0) << 3;
    return first | second << 4 | third << 8 | fourth << 12;
}

static inline void pcl2_unpack(int32_t x, int32_t *q)
{
    for (uint32_t i = 0; i < 16; i++) {
        q[i] = (int32_t)((uint32_t)x >> i & 1u);
    }
}

static inline int32_t pcl2_bitand(int32_t a, int32_t b)
{
    return a & b;
}

static inline int32_t pcl2_bitor(int32_t a, int32_t b)
{
    return a | b;
}

static inline int32_t pcl2_bitxor(int32_t a, int32_t b)
{
    return a ^ b;
}

static inline int32_t pcl2_shl(int32_t x, int32_t k)
{
    return k >= 0 && k < 32 ? pcl2_int_of_bits((uint32_t)x << k) : 0;
}

static inline int32_t pcl2_shr(int32_t x, int32_t k)
{
    return k >= 0 && k < 32 ? pcl2_int_of_bits((uint32_t)x >> k) : 0;
}

#endif
