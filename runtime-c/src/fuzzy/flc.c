/* flc: fuzzy PI controller, Sugeno or Mamdani.
 *
 * Rules: D. Driankov, H. Hellendoorn, M. Reinfrank, "An Introduction to Fuzzy Control", Springer 1993, the
 * diagonal table r(i, j) = clip(i + j, -3, 3) over the error and its change, seven triangles each.
 * T. Takagi, M. Sugeno, IEEE Trans. SMC 15 (1985) 116-132 (weighted mean); E. H. Mamdani, S. Assilian,
 * Int. J. Man-Machine Studies 7 (1975) 1-13 (min, max, centre of gravity).
 *
 * Neighbouring triangles add up to 1, so at most two sets of each input, four rules, are active.
 */
#include "pcl2_flc.h"

enum { FLC_OK = 0, FLC_SIGNAL = 1 };
enum { FLC_SUGENO = 0 };

/* The lower of the two active sets, 0..5 from NB, and the membership in the upper one. */
struct pcl2_flc_place {
    int32_t set;
    pcl2_real upper;
};

/* A NaN ends at the lower limit. */
PCL2_INLINE pcl2_real pcl2_flc_clamp(pcl2_real x, pcl2_real low, pcl2_real high)
{
    x = (x > low) ? x : low;
    return (x < high) ? x : high;
}

PCL2_INLINE struct pcl2_flc_place pcl2_flc_fuzzify(pcl2_real x)
{
    struct pcl2_flc_place place;
    const pcl2_real position = (pcl2_flc_clamp(x, PCL2_R(-1.0), PCL2_R(1.0)) + PCL2_R(1.0)) * PCL2_R(3.0);
    const int32_t set = (int32_t)position;
    place.set = (set < 5) ? set : 5;
    place.upper = position - (pcl2_real)place.set;
    return place;
}

/* Output set of the sets i and j, both counted from NB: -3 .. 3. */
PCL2_INLINE int32_t pcl2_flc_rule(int32_t i, int32_t j)
{
    const int32_t r = i + j - 6;
    return (r < -3) ? -3 : (r > 3) ? 3 : r;
}

/* Product of the memberships, singletons r/3.  The weights add up to 1. */
PCL2_INLINE pcl2_real pcl2_flc_sugeno(struct pcl2_flc_place e, struct pcl2_flc_place de)
{
    const pcl2_real low = PCL2_R(1.0) - e.upper;
    const pcl2_real mixed = (pcl2_real)pcl2_flc_rule(e.set, de.set + 1);
    const pcl2_real lower = (pcl2_real)pcl2_flc_rule(e.set, de.set) * (PCL2_R(1.0) - de.upper) + mixed * de.upper;
    const pcl2_real upper = mixed * (PCL2_R(1.0) - de.upper) + (pcl2_real)pcl2_flc_rule(e.set + 1, de.set + 1) * de.upper;
    return (low * lower + e.upper * upper) / PCL2_R(3.0);
}

PCL2_INLINE pcl2_real pcl2_flc_min(pcl2_real a, pcl2_real b)
{
    return (a < b) ? a : b;
}

PCL2_INLINE pcl2_real pcl2_flc_max(pcl2_real a, pcl2_real b)
{
    return (a > b) ? a : b;
}

/* Min, clipped triangles, max, centre of gravity over the points m/100, m = -100..100.  Between the
 * centres r/3 and (r+1)/3 only the output sets r and r+1 are not zero. */
PCL2_INLINE pcl2_real pcl2_flc_mamdani(struct pcl2_flc_place e, struct pcl2_flc_place de)
{
    /* Levels of the sets -4 .. 4; the outer ones only close the last gaps. */
    pcl2_real level[9] = {PCL2_R(0.0)};
    const pcl2_real low_e = PCL2_R(1.0) - e.upper;
    const pcl2_real low_de = PCL2_R(1.0) - de.upper;
    pcl2_real *const out = level + 4;
    const int32_t bottom = pcl2_flc_rule(e.set, de.set);
    const int32_t middle = pcl2_flc_rule(e.set, de.set + 1);
    const int32_t top = pcl2_flc_rule(e.set + 1, de.set + 1);
    out[bottom] = pcl2_flc_min(low_e, low_de);
    out[middle] = pcl2_flc_max(out[middle], pcl2_flc_max(pcl2_flc_min(low_e, de.upper), pcl2_flc_min(e.upper, low_de)));
    out[top] = pcl2_flc_max(out[top], pcl2_flc_min(e.upper, de.upper));
    pcl2_real area = PCL2_R(0.0);
    pcl2_real moment = PCL2_R(0.0);
    for (int32_t r = (bottom > -3) ? bottom - 1 : -3; r <= top && r <= 3; ++r) {
        /* First point at or after the centre r/3, and before the next centre; 3 has its centre only. */
        const int32_t first = (100 * (r + 3) + 2) / 3 - 100;
        const int32_t after = (r < 3) ? (100 * (r + 4) + 2) / 3 - 100 : 101;
        const pcl2_real fall = out[r];
        const pcl2_real rise = out[r + 1];
        const pcl2_real centre = (pcl2_real)(100 * r);
        for (int32_t m = first; m < after; ++m) {
            const pcl2_real t = ((pcl2_real)(3 * m) - centre) * PCL2_R(0.01);
            const pcl2_real height = pcl2_flc_max(pcl2_flc_min(fall, PCL2_R(1.0) - t), pcl2_flc_min(rise, t));
            area += height;
            moment += (pcl2_real)m * height;
        }
    }
    return moment / (area * PCL2_R(100.0));
}

PCL2_KERNEL void pcl2_flc_init(struct pcl2_flc *self, int32_t type, pcl2_real u0, pcl2_real umin,
                               pcl2_real umax, pcl2_real ge, pcl2_real gd, pcl2_real gu)
{
    (void)type;
    (void)umin;
    (void)umax;
    (void)ge;
    (void)gd;
    (void)gu;
    self->u = u0;
}

PCL2_KERNEL void pcl2_flc(struct pcl2_flc *self, pcl2_real w, pcl2_real y, pcl2_real sw, int32_t type,
                          pcl2_real u0, pcl2_real umin, pcl2_real umax, pcl2_real ge, pcl2_real gd,
                          pcl2_real gu)
{
    const pcl2_real e = w - y;
    const int32_t bad = pcl2_is_bad(e);
    /* The change of the error starts from nothing on the first scan and after a bad signal. */
    const pcl2_real de = (self->seeded != 0) ? e - self->e1 : PCL2_R(0.0);
    self->status = bad ? FLC_SIGNAL : FLC_OK;
    self->seeded = !bad;
    if (!bad) {
        self->e1 = e;
    }
    if (sw != PCL2_R(0.0) && !pcl2_is_bad(sw)) {
        self->u = pcl2_flc_clamp(u0, umin, umax);
    } else if (!bad) {
        const struct pcl2_flc_place place_e = pcl2_flc_fuzzify(ge * e);
        const struct pcl2_flc_place place_de = pcl2_flc_fuzzify(gd * de);
        const pcl2_real out = (type == FLC_SUGENO) ? pcl2_flc_sugeno(place_e, place_de) : pcl2_flc_mamdani(place_e, place_de);
        self->u = pcl2_flc_clamp(self->u + gu * out, umin, umax);
    }
}
