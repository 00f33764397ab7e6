/* The emitted plant and the emitted controller of the paper's loops, coupled by hand: a scan of the plant, then one of
 * the controller. Reads the stimulus (k,w.value) from standard input, writes a trace. */
#include <stdio.h>

#include "paper_gpc_cut.h"
#include "paper_gpc_cut_plant.h"

static paper_gpc_cut controller;
static paper_gpc_cut_plant plant;

int main(void)
{
    struct pcl2_set set = {pcl2_find(&paper_gpc_cut_map, "w.value"), 0, {0.0}};
    int scan;
    double w;
    paper_gpc_cut_init(&controller);
    paper_gpc_cut_plant_init(&plant);
    if (scanf("%*[^\n]") != 0) {
        return 2;
    }
    printf("@k,w,y1,u1,y2,u2\n");
    while (scanf("%d,%lf", &scan, &w) == 2) {
        set.value.real = w;
        if (paper_gpc_cut_tune(&controller, &set, 1) != 0) {
            return 1;
        }
        plant.in.u1 = controller.out.u1;
        plant.in.u2 = controller.out.u2;
        paper_gpc_cut_plant_step(&plant);
        controller.in.y1 = plant.out.y1;
        controller.in.y2 = plant.out.y2;
        paper_gpc_cut_step(&controller);
        printf("%d,%.17g,%.17g,%.17g,%.17g,%.17g\n", scan, controller.w.y, plant.out.y1, controller.out.u1,
               plant.out.y2, controller.out.u2);
    }
    return 0;
}
