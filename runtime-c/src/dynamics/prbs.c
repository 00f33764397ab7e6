/* Pseudo-random binary signal (Golomb, Shift Register Sequences, 1967). */
#include "pcl2_prbs.h"

PCL2_KERNEL void pcl2_prbs_init(struct pcl2_prbs *self, pcl2_real amp, int32_t order, int32_t nhold)
{
    (void)amp;
    (void)order;
    (void)nhold;
    self->bits = 0;
}

/* The bit after the last one of the register; bit j of a row is tapped where the polynomial has x^j. */
static int32_t pcl2_prbs_next(int32_t bits, int32_t order)
{
    static const uint16_t taps[14] = {
        0x0005, 0x0009, 0x0009, 0x0021, 0x0041, 0x00c3, 0x0021,
        0x0081, 0x0201, 0x0c11, 0x1901, 0x3005, 0x4001, 0xa011,
    };
    uint32_t sum = (uint32_t)bits & taps[order - 3];
    sum ^= sum >> 8;
    sum ^= sum >> 4;
    sum ^= sum >> 2;
    sum ^= sum >> 1;
    return (int32_t)(sum & 1U);
}

/* The lowest bit is the one that is out; a register of zeros, as before the first scan, counts as ones. */
PCL2_KERNEL void pcl2_prbs(struct pcl2_prbs *self, int32_t en, pcl2_real amp, int32_t order, int32_t nhold)
{
    const int32_t ones = (int32_t)((UINT32_C(1) << order) - 1);
    if (en == 0) {
        self->y = PCL2_R(0.0);
        return;
    }
    if (self->held >= nhold) {
        self->held = 0;
        self->bits = (self->bits >> 1) | (pcl2_prbs_next(self->bits, order) << (order - 1));
    }
    self->held++;
    self->bits &= ones;
    self->bits = self->bits != 0 ? self->bits : ones;
    self->y = (self->bits & 1) != 0 ? amp : -amp;
}
