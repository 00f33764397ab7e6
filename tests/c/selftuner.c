/* The self-tuner: some hundred scans with excitation, then a million without. Every real number of both instances,
 * found through the maps, must stay finite. Without excitation the estimator's covariance may lose its definiteness and start
 * again, which it counts as a fault; the loop must hold its set point all the same. */
#include <stdio.h>

#include "selftuner.h"
#include "selftuner_plant.h"

enum { EXCITED = 400, QUIET = 1000000, LOOK = 1000 };

static selftuner controller;
static selftuner_plant plant;

static int finite_all(const struct pcl2_map *map, const void *instance, long scan)
{
    int good = 1;
    for (int32_t i = 0; i < map->count; i++) {
        const struct pcl2_point *point = &map->points[i];
        const struct pcl2_kind *kind = pcl2_kind_of(map, i);
        for (uint32_t j = 0; kind->type == PCL2_REAL && j < kind->rows * kind->columns; j++) {
            pcl2_real value;
            memcpy(&value, (const char *)instance + point->offset + j * sizeof value, sizeof value);
            if (pcl2_is_bad(value)) {
                printf("scan %ld: %s, element %u\n", scan, point->name, (unsigned)j);
                good = 0;
            }
        }
    }
    return good;
}

int main(void)
{
    struct pcl2_set w = {pcl2_find(&selftuner_map, "w.value"), 0, {0.0}};
    int good = 1;
    selftuner_init(&controller);
    selftuner_plant_init(&plant);
    for (long scan = 0; scan < EXCITED + QUIET && good; scan++) {
        if (scan % 40 == 0 && scan <= EXCITED) {
            w.value.real = scan % 80 == 0 ? PCL2_R(1.0) : PCL2_R(-1.0);
            good = selftuner_tune(&controller, &w, 1) == 0;
        }
        plant.in.u = controller.out.u;
        selftuner_plant_step(&plant);
        controller.in.y = plant.out.y;
        selftuner_step(&controller);
        good = good && !pcl2_is_bad(controller.out.u) && !pcl2_is_bad(plant.out.y);
        if (scan % LOOK == 0) {
            good = finite_all(&selftuner_map, &controller, scan) && finite_all(&selftuner_plant_map, &plant, scan) && good;
        }
    }
    printf("w %g, y %g, u %g, faults %lu\n", (double)controller.w.y, (double)plant.out.y, (double)controller.out.u,
           (unsigned long)controller.health.faults);
    return good ? 0 : 1;
}
