/* Reals of twice the digits: the unrounded sum of a head and a much smaller tail, for what an elementary function
 * needs on its way to a result that is rounded once. Sums and products of two reals are exact as pairs, but for
 * products that leave the range of normal reals (Dekker, Numer. Math. 18, 1971; Knuth, The Art of Computer
 * Programming 2, 4.2.2). */
#ifndef PCL2_PAIR_H
#define PCL2_PAIR_H

#include "pcl2_math.h"

struct pcl2_pair {
    pcl2_real head;
    pcl2_real tail;
};

/* 2^h + 1, h half the digits. */
#if PCL2_REAL_BITS == 64
#define PCL2_PAIR_SPLIT 134217729.0
#else
#define PCL2_PAIR_SPLIT 4097.0f
#endif

/* High half of the digits of x: products of two halves are exact. */
static inline pcl2_real pcl2_pair_half(pcl2_real x)
{
    const pcl2_real scaled = PCL2_PAIR_SPLIT * x;
    return scaled - (scaled - x);
}

/* a + b, whatever their order. */
static inline struct pcl2_pair pcl2_pair_sum(pcl2_real a, pcl2_real b)
{
    struct pcl2_pair y;
    y.head = a + b;
    const pcl2_real part = y.head - a;
    y.tail = (a - (y.head - part)) + (b - part);
    return y;
}

/* a + b where |a| >= |b| or a = 0. */
static inline struct pcl2_pair pcl2_pair_ordered_sum(pcl2_real a, pcl2_real b)
{
    struct pcl2_pair y;
    y.head = a + b;
    y.tail = b - (y.head - a);
    return y;
}

/* a b */
static inline struct pcl2_pair pcl2_pair_product(pcl2_real a, pcl2_real b)
{
    struct pcl2_pair y;
    const pcl2_real a_high = pcl2_pair_half(a);
    const pcl2_real b_high = pcl2_pair_half(b);
    const pcl2_real a_low = a - a_high;
    const pcl2_real b_low = b - b_high;
    y.head = a * b;
    y.tail = (((a_high * b_high - y.head) + a_high * b_low) + a_low * b_high) + a_low * b_low;
    return y;
}

/* a b of two pairs; the product's tail has the last digit or two wrong. */
static inline struct pcl2_pair pcl2_pair_times(struct pcl2_pair a, struct pcl2_pair b)
{
    const struct pcl2_pair y = pcl2_pair_product(a.head, b.head);
    return pcl2_pair_ordered_sum(y.head, y.tail + (a.head * b.tail + a.tail * b.head));
}

/* a / b of two pairs; the quotient's tail has the last digit or two wrong. */
static inline struct pcl2_pair pcl2_pair_quotient(struct pcl2_pair a, struct pcl2_pair b)
{
    struct pcl2_pair y;
    y.head = a.head / b.head;
    const struct pcl2_pair back = pcl2_pair_product(y.head, b.head);
    y.tail = ((((a.head - back.head) - back.tail) + a.tail) - y.head * b.tail) / b.head;
    return y;
}

#endif
