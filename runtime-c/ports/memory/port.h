/* A board port over memory. */
#ifndef PCL2_MEMORY_PORT_H
#define PCL2_MEMORY_PORT_H

#include "pcl2_io.h"

/* One point of the board. */
struct pcl2_memory_point {
    const char *name; /* the physical point */
    pcl2_real raw;    /* its value in the raw unit */
    int32_t broken;   /* not 0: it can be neither read nor written */
};

/* Tells the port its points. */
void pcl2_memory_port(struct pcl2_memory_point *table, int32_t length);

#endif
