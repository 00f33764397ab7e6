/* Fuzzy controller as one would write it: the two active sets of each input by index, four rules. */
#include "flc.h"

static pcl2_real hand_limit(pcl2_real x, pcl2_real low, pcl2_real high)
{
    return (x < low) ? low : (x > high) ? high : x;
}

static int hand_rule(int i, int j)
{
    const int r = i + j - 6;
    return (r < -3) ? -3 : (r > 3) ? 3 : r;
}

struct hand_inputs {
    int i, j;
    pcl2_real a, b; /* memberships in the sets i + 1 and j + 1 */
};

static struct hand_inputs hand_fuzzify(struct hand_flc *self, pcl2_real w, pcl2_real y)
{
    struct hand_inputs in;
    const pcl2_real e = w - y;
    const pcl2_real de = self->started ? e - self->e1 : PCL2_R(0.0);
    const pcl2_real x = (hand_limit(self->ge * e, PCL2_R(-1.0), PCL2_R(1.0)) + PCL2_R(1.0)) * PCL2_R(3.0);
    const pcl2_real v = (hand_limit(self->gd * de, PCL2_R(-1.0), PCL2_R(1.0)) + PCL2_R(1.0)) * PCL2_R(3.0);
    self->e1 = e;
    self->started = 1;
    in.i = (x < PCL2_R(6.0)) ? (int)x : 5;
    in.j = (v < PCL2_R(6.0)) ? (int)v : 5;
    in.a = x - (pcl2_real)in.i;
    in.b = v - (pcl2_real)in.j;
    return in;
}

void hand_flc_sugeno(struct hand_flc *self, pcl2_real w, pcl2_real y)
{
    const struct hand_inputs in = hand_fuzzify(self, w, y);
    const pcl2_real a0 = PCL2_R(1.0) - in.a, b0 = PCL2_R(1.0) - in.b;
    const pcl2_real w00 = a0 * b0, w01 = a0 * in.b, w10 = in.a * b0, w11 = in.a * in.b;
    const pcl2_real sum = w00 * (pcl2_real)hand_rule(in.i, in.j)
                        + (w01 + w10) * (pcl2_real)hand_rule(in.i, in.j + 1)
                        + w11 * (pcl2_real)hand_rule(in.i + 1, in.j + 1);
    const pcl2_real out = sum / (PCL2_R(3.0) * (w00 + w01 + w10 + w11));
    self->u = hand_limit(self->u + self->gu * out, self->umin, self->umax);
}

void hand_flc_mamdani(struct hand_flc *self, pcl2_real w, pcl2_real y)
{
    const struct hand_inputs in = hand_fuzzify(self, w, y);
    pcl2_real level[7] = {0}, area = 0, moment = 0;
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            const pcl2_real a = i ? in.a : PCL2_R(1.0) - in.a, b = j ? in.b : PCL2_R(1.0) - in.b;
            const pcl2_real fire = (a < b) ? a : b;
            const int r = hand_rule(in.i + i, in.j + j) + 3;
            if (fire > level[r]) {
                level[r] = fire;
            }
        }
    }
    /* Only two neighbouring output sets reach any point; points of sets that do not fire are skipped. */
    for (int m = 0; m <= 200; ++m) {
        const int r = (m < 200) ? 3 * m / 100 : 5;
        if (level[r] + level[r + 1] > PCL2_R(0.0)) {
            const pcl2_real t = PCL2_R(0.03) * (pcl2_real)m - (pcl2_real)r;
            const pcl2_real fall = (PCL2_R(1.0) - t < level[r]) ? PCL2_R(1.0) - t : level[r];
            const pcl2_real rise = (t < level[r + 1]) ? t : level[r + 1];
            const pcl2_real height = (fall > rise) ? fall : rise;
            area += height;
            moment += height * (PCL2_R(0.01) * (pcl2_real)m - PCL2_R(1.0));
        }
    }
    self->u = hand_limit(self->u + self->gu * (moment / area), self->umin, self->umax);
}
