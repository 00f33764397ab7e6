/* The angle of a point of the first quadrant: with y <= x and c the nearest eighth to y/x,
 * atan(y/x) = atan(c) + atan(t), t = (y - c x)/(x + c y), |t| <= 1/16 (Muller, Elementary Functions, 3rd ed., 2016,
 * ch. 6 on table-based methods). */
#include "pcl2_angle.h"

/* atan(i/8), and the polynomial of (atan(t)/t - 1)/t^2 in t^2 through the Chebyshev points of t^2 <= 1/256. */
#if PCL2_REAL_BITS == 64
#define ANGLE_TERMS 7
static const struct pcl2_pair pcl2_angle_table[9] = {
    {0.0, 0.0}, {0.12435499454676144, -3.1253241424539383e-18}, {0.24497866312686414, 1.0698755618734451e-17},
    {0.35877067027057225, -2.4623815582638635e-17}, {0.4636476090008061, 2.2698777452961687e-17},
    {0.5585993153435624, -5.4556305485916264e-18}, {0.6435011087932844, 1.5834785051444286e-17},
    {0.7188299996216245, -2.1478388444456983e-17}, {0.7853981633974483, 3.061616997868383e-17}};
static const pcl2_real pcl2_angle_term[ANGLE_TERMS] = {
    -0.3333333333333333, 0.2, -0.14285714285713222, 0.11111111109493473,
    -0.09090907918678863, 0.07691871405964566, -0.06586045324446833};
#else
#define ANGLE_TERMS 3
static const struct pcl2_pair pcl2_angle_table[9] = {
    {0.0f, 0.0f}, {0.124354996f, -1.2403822e-09f}, {0.24497867f, -3.1786778e-09f}, {0.35877067f, 1.7639499e-09f},
    {0.4636476f, 5.0121587e-09f}, {0.5585993f, 2.2111598e-08f}, {0.6435011f, 5.8689373e-09f},
    {0.71883f, 1.01883355e-08f}, {0.7853982f, -2.1855694e-08f}};
static const pcl2_real pcl2_angle_term[ANGLE_TERMS] = {-0.33333334f, 0.19999903f, -0.14220197f};
#endif

/* a + c b, c of few digits. */
static struct pcl2_pair pcl2_angle_line(struct pcl2_pair a, pcl2_real c, struct pcl2_pair b)
{
    const struct pcl2_pair product = pcl2_pair_product(c, b.head);
    const struct pcl2_pair sum = pcl2_pair_sum(a.head, product.head);
    return pcl2_pair_ordered_sum(sum.head, sum.tail + (product.tail + (a.tail + c * b.tail)));
}

struct pcl2_pair pcl2_angle(struct pcl2_pair y, struct pcl2_pair x)
{
    const int32_t steep = y.head > x.head;
    const struct pcl2_pair small = steep ? x : y;
    const struct pcl2_pair large = steep ? y : x;
    const int32_t i = (int32_t)(8 * (small.head / large.head) + PCL2_R(0.5));
    const pcl2_real c = (pcl2_real)i / 8;
    const struct pcl2_pair t =
        pcl2_pair_quotient(pcl2_angle_line(small, -c, large), pcl2_angle_line(large, c, small));
    const pcl2_real t2 = t.head * t.head;
    pcl2_real series = pcl2_angle_term[ANGLE_TERMS - 1];
    PCL2_UNROLL
    for (int32_t j = ANGLE_TERMS - 2; j >= 0; j--) {
        series = series * t2 + pcl2_angle_term[j];
    }
    const struct pcl2_pair sum = pcl2_pair_sum(pcl2_angle_table[i].head, t.head);
    const pcl2_real tail = sum.tail + (pcl2_angle_table[i].tail + (t.tail + t.head * t2 * series));
    const struct pcl2_pair angle = pcl2_pair_ordered_sum(sum.head, tail);
    return steep ? pcl2_angle_from(PCL2_R(1.0), angle) : angle;
}

#undef ANGLE_TERMS
