/* Start values, both ways of writing a signal, rates, and parameters as transactions. */
#include "emit_shapes.h"

#define CHECK(holds) \
    do { \
        if (!(holds)) { \
            return __LINE__; \
        } \
    } while (0)

static emit_shapes plant, before;

static struct pcl2_set set(const char *name, int32_t element, pcl2_real value)
{
    struct pcl2_set change = {pcl2_find(&emit_shapes_map, name), element, {0}};
    if (change.point >= 0 && pcl2_kind_of(&emit_shapes_map, change.point)->type == PCL2_INT) {
        change.value.whole = (int32_t)value;
    } else {
        change.value.real = value;
    }
    return change;
}

/* A refused set leaves every bit as it was, but for the count. */
static int untouched(void)
{
    before.health.refused = plant.health.refused;
    return memcmp(&plant, &before, sizeof plant) == 0;
}

static int start(void)
{
    emit_shapes_init(&plant);
    CHECK(plant.vv[0] == 2 && plant.vv[1] == 1);
    CHECK(plant.a[0] == 100 && plant.a[1] == 2 && plant.i0 == 7);
    CHECK(plant.errno_.y == 2 && plant.b82.y == 3 && plant.slow.y == 0);
    CHECK(plant.t1.r.p == PCL2_R(0.3) && plant.t1.u.p == PCL2_R(0.25));
    CHECK(plant.due1 == 1 && plant.due2 == 0 && plant.health.faults == 0);
    return 0;
}

static int scans(void)
{
    plant.in.ain_0_1_1 = 5;
    plant.in.pv = 2;
    plant.in.pv2 = 1;
    emit_shapes_step(&plant);
    CHECK(plant.b[0] == 5 && plant.b[1] == 100);
    CHECK(plant.c[0] == 100 && plant.c[1] == 2);
    CHECK(plant.vv[0] == 205 && plant.vv[1] == 105 && plant.vv_1.z[0] == 101 && plant.vv_1.z[1] == 5);
    CHECK(plant.m.y == (plant.in.pv + 5 + plant.l1.u.s.u + plant.l2.u.s.u + 7) / 5);
    CHECK(plant.out.aout_0_1_2 == plant.m.y && plant.out.FIC == plant.FIC.s.u && plant.out.int_ == 1);
    CHECK(plant.cold.FIC_um == plant.FIC.s.u && plant.slow.y == 0 && plant.errno_.y != 2);
    emit_shapes_step(&plant);
    CHECK(plant.c[0] == 200 && plant.vv[0] == 405 && plant.vv[1] == 109 && plant.slow.y != 0);
    CHECK(plant.vv_1.past[0] == 1 && plant.vv_1.past[1] == 2 && plant.vv_1.s.elapsed == 10 && plant.scan == 2);
    return 0;
}

static int accepted(void)
{
    struct pcl2_set sets[4] = {set("FIC.umax", 0, 10), set("FIC.umin", 0, 9), set("t1.p", 0, 0.5), set("FIC.w", 0, 4)};
    CHECK(emit_shapes_tune(&plant, sets, 4) == 0);
    CHECK(sets[0].value.real == 100 && sets[1].value.real == 0 && sets[2].value.real == PCL2_R(0.3));
    CHECK(plant.FIC.s.lo == 9 && plant.FIC.s.hi == 10 && plant.t1.r.p == PCL2_R(0.5) && plant.cold.FIC_w == 4);
    struct pcl2_set element = set("vv#1.k", 2, 7);
    CHECK(emit_shapes_tune(&plant, &element, 1) == 0 && plant.vv_1.k[2] == 7 && plant.health.refused == 0);
    return 0;
}

static int refused(struct pcl2_set *sets, int32_t n, int expected)
{
    before = plant;
    CHECK(emit_shapes_tune(&plant, sets, n) == expected && untouched());
    CHECK(plant.health.refused == before.health.refused);
    return 0;
}

static int refusals(void)
{
    struct pcl2_set crossed[3] = {set("l1.a", 0, 3), set("FIC.umin", 0, 11), set("FIC.umin", 0, 12)};
    struct pcl2_set gain[2] = {set("l1.K", 0, 2), set("l2.K", 0, 1001)};
    struct pcl2_set sign = set("l2.K", 0, 0);
    struct pcl2_set inner = set("t2.K", 0, -1);
    struct pcl2_set bad[2] = {set("FIC.K", 0, 3), set("FIC.Ti", 0, 0)};
    struct pcl2_set mode = set("FIC.mode", 0, 2);
    struct pcl2_set hand = set("u2.um", 0, 151);
    struct pcl2_set nowhere[2] = {set("FIC.K", 0, 3), set("m", 0, 1)};
    struct pcl2_set beyond = set("vv#1.k", 3, 1);
    bad[1].value.real = pcl2_bad();
    CHECK(refused(crossed, 3, 2) == 0);
    CHECK(refused(gain, 2, 2) == 0);
    CHECK(refused(&sign, 1, 1) == 0);
    CHECK(refused(&inner, 1, 1) == 0);
    CHECK(refused(bad, 2, 2) == 0);
    CHECK(refused(&mode, 1, 1) == 0);
    CHECK(refused(&hand, 1, 1) == 0);
    CHECK(refused(nowhere, 2, -2) == 0);
    CHECK(refused(&beyond, 1, -1) == 0);
    CHECK(plant.health.refused == 9);
    return 0;
}

/* The faults of one scan in block order; a composite's are its own. */
static int faults(void)
{
    plant.in.ain_0_1_1 = pcl2_bad();
    emit_shapes_step(&plant);
    CHECK(plant.health.first_block == 3 && plant.health.first_status == 1 && plant.health.first_scan == 2);
    CHECK(plant.health.faults > 1 && plant.health.last_scan == 2);
    return 0;
}

int main(void)
{
    int (*const parts[])(void) = {start, scans, accepted, refusals, faults};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const int line = parts[i]();
        if (line != 0) {
            return line > 255 ? 255 : line;
        }
    }
    return 0;
}
