/* Sets of parameters from C: refused ones change nothing and are counted, good ones are kept. */
#include <string.h>

#include "gpc_closed_loop.h"

static struct pcl2_set set_of(const char *name, pcl2_real value)
{
    struct pcl2_set set = {pcl2_find(&gpc_closed_loop_map, name), 0, {0.0}};
    set.value.real = value;
    return set;
}

/* Whether two instances differ in nothing but the count of refused sets. */
static int same_but_refused(gpc_closed_loop *left, const gpc_closed_loop *right)
{
    left->health.refused = right->health.refused;
    return memcmp(left, right, sizeof *left) == 0;
}

int main(void)
{
    static gpc_closed_loop plain, tuned;
    const pcl2_real infinity = pcl2_of_bits(PCL2_EXPONENT_MASK);
    struct pcl2_set range[2] = {set_of("u1.umin", 20.0), set_of("u1.lambda", 5.0)};
    struct pcl2_set number[1] = {set_of("w.value", infinity)};
    struct pcl2_set both[2] = {set_of("u1.umin", 20.0), set_of("u1.umax", 30.0)};
    struct pcl2_set unknown[2] = {set_of("u1.lambda", 0.5), set_of("no.such", 1.0)};
    struct pcl2_set beyond[1] = {set_of("w.value", 1.0)};
    beyond[0].element = 1;
    gpc_closed_loop_init(&plain);
    gpc_closed_loop_init(&tuned);
    if (gpc_closed_loop_tune(&tuned, range, 2) <= 0 || tuned.health.refused != 1) {
        return 1;
    }
    if (gpc_closed_loop_tune(&tuned, number, 1) != 1 || tuned.health.refused != 2) {
        return 2;
    }
    if (gpc_closed_loop_tune(&tuned, unknown, 2) != -2 || gpc_closed_loop_tune(&tuned, beyond, 1) != -1) {
        return 3;
    }
    if (!same_but_refused(&tuned, &plain)) {
        return 4;
    }
    if (gpc_closed_loop_tune(&tuned, both, 2) != 0 || both[0].value.real != -0.5 || both[1].value.real != 1.6) {
        return 5;
    }
    gpc_closed_loop_step(&tuned);
    if (tuned.u1.s.u != 20.0) {
        return 6;
    }
    return gpc_closed_loop_tune(&tuned, both, 2) != 0 || both[0].value.real != 20.0 || both[1].value.real != 30.0;
}
