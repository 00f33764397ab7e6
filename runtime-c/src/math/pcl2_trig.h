/* What sin, cos and tan share: an angle less whole quarter turns, and the series of what remains. */
#ifndef PCL2_TRIG_H
#define PCL2_TRIG_H

#include "pcl2_pair.h"

/* x = q pi/2 + r with |r| <= pi/4 but for rounding, to nearly all digits of the pair: returns q modulo 4, 0 to 3.
 * x finite, of any size. */
int32_t pcl2_trig_reduce(pcl2_real x, struct pcl2_pair *r);

/* Polynomials through the Chebyshev points of z = r^2 from 0 to (pi/4)^2: of (sin(r)/r - 1)/z and of
 * (cos(r) - 1 + z/2)/z^2. */
#if PCL2_REAL_BITS == 64
#define PCL2_SINE_TERMS 7
#define PCL2_COSINE_TERMS 6
static const pcl2_real pcl2_sine_term[PCL2_SINE_TERMS] = {
    -0.16666666666666666, 0.008333333333333331, -0.0001984126984126504, 2.755731921932058e-06,
    -2.50521062259944e-08, 1.6058530596645953e-10, -7.586636882825159e-13};
static const pcl2_real pcl2_cosine_term[PCL2_COSINE_TERMS] = {
    0.041666666666666664, -0.0013888888888887389, 2.48015872987544e-05,
    -2.755731726587808e-07, 2.087614504941318e-09, -1.138254464534925e-11};
#else
#define PCL2_SINE_TERMS 4
#define PCL2_COSINE_TERMS 3
static const pcl2_real pcl2_sine_term[PCL2_SINE_TERMS] = {-0.16666667f, 0.008333332f, -0.00019840084f, 2.724962e-06f};
static const pcl2_real pcl2_cosine_term[PCL2_COSINE_TERMS] = {0.041666664f, -0.0013888301f, 2.454769e-05f};
#endif

static inline pcl2_real pcl2_trig_sine(struct pcl2_pair r)
{
    const pcl2_real z = r.head * r.head;
    pcl2_real sum = pcl2_sine_term[PCL2_SINE_TERMS - 1];
    PCL2_UNROLL
    for (int32_t i = PCL2_SINE_TERMS - 2; i >= 0; i--) {
        sum = sum * z + pcl2_sine_term[i];
    }
    return r.head + (r.head * z * sum + r.tail * (1 - PCL2_R(0.5) * z));
}

/* 1 - z/2 with what its rounding loses, then the smaller terms. */
static inline pcl2_real pcl2_trig_cosine(struct pcl2_pair r)
{
    const pcl2_real z = r.head * r.head;
    const struct pcl2_pair top = pcl2_pair_ordered_sum(PCL2_R(1.0), PCL2_R(-0.5) * z);
    pcl2_real sum = pcl2_cosine_term[PCL2_COSINE_TERMS - 1];
    PCL2_UNROLL
    for (int32_t i = PCL2_COSINE_TERMS - 2; i >= 0; i--) {
        sum = sum * z + pcl2_cosine_term[i];
    }
    return top.head + (top.tail + (z * z * sum - r.head * r.tail));
}

#endif
