/* One scan of the generated loops against one of the hand-written. */
#include <stdio.h>
#include <stdlib.h>

#include "compare.h"
#include "hand/loops.h"
#include "loops.h"

static loops ours;
static struct hand_loops hand;

static void run_ours(long n)
{
    while (n-- > 0) {
        loops_step(&ours);
    }
}

static void run_hand(long n)
{
    while (n-- > 0) {
        hand_loops_step(&hand);
    }
}

/* Ends the program if a signal of ours is not that of the hand-written loop, bit for bit. */
static void agree(const char *letter, int i, pcl2_real expected)
{
    char name[16];
    snprintf(name, sizeof name, "%s%d", letter, i);
    const int32_t point = pcl2_find(&loops_map, name);
    if (point < 0 || memcmp((const char *)&ours + loops_map.points[point].offset, &expected, sizeof expected) != 0) {
        fprintf(stderr, "%s differs\n", name);
        exit(1);
    }
}

static void check(void)
{
    for (int i = 0; i < HAND_LOOPS; i++) {
        agree("y", i, hand_y(&hand, i));
        agree("u", i, hand_u(&hand, i));
    }
}

int main(int argc, char **argv)
{
    const struct contender all[] = {{"ours", run_ours}, {"hand", run_hand}};
    loops_init(&ours);
    hand_loops_init(&hand);
    run_ours(100);
    run_hand(100);
    check();
    compare(all, 2, argc > 1 ? atoi(argv[1]) : 9);
    return 0;
}
