/* Hand-written C to compare flc with: 7 x 7 rules, error and change of error. */
#ifndef HAND_FLC_H
#define HAND_FLC_H
#include "pcl2.h"

struct hand_flc {
    pcl2_real umin, umax, ge, gd, gu;
    pcl2_real e1, u;
    int started;
};

void hand_flc_sugeno(struct hand_flc *self, pcl2_real w, pcl2_real y);
void hand_flc_mamdani(struct hand_flc *self, pcl2_real w, pcl2_real y);
#endif
