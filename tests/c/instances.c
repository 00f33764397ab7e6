/* Two instances of one program with different set points, scan by scan in turn, do as each does alone. */
#include <string.h>

#include "paper_gpc.h"

enum { SCANS = 200 };

static int set(paper_gpc *self, pcl2_real w)
{
    struct pcl2_set change = {pcl2_find(&paper_gpc_map, "w.value"), 0, {0.0}};
    change.value.real = w;
    return paper_gpc_tune(self, &change, 1);
}

int main(void)
{
    static paper_gpc first, second, alone;
    paper_gpc_init(&first);
    paper_gpc_init(&second);
    if (set(&first, 1.0) != 0 || set(&second, -0.5) != 0) {
        return 2;
    }
    for (int scan = 0; scan < SCANS; scan++) {
        paper_gpc_step(&first);
        paper_gpc_step(&second);
    }
    paper_gpc_init(&alone);
    if (set(&alone, -0.5) != 0) {
        return 2;
    }
    for (int scan = 0; scan < SCANS; scan++) {
        paper_gpc_step(&alone);
    }
    if (first.w.y != 1.0 || memcmp(&first, &second, sizeof first) == 0) {
        return 3;
    }
    /* Plain data: a copy goes on as the original does. */
    first = alone;
    paper_gpc_step(&first);
    paper_gpc_step(&alone);
    return memcmp(&first, &alone, sizeof first) != 0 || second.scan + 1 != alone.scan;
}
