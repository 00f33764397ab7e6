/* The map of a program: names, types, places and ranges of everything in its instance; and the sets that change
 * parameters and operator cells. */
#ifndef PCL2_MAP_H
#define PCL2_MAP_H

#include "pcl2.h"

/* The type of a point's elements. */
enum {
    PCL2_REAL, /* pcl2_real */
    PCL2_INT,  /* int32_t */
    PCL2_TIME  /* int64_t, nanoseconds */
};

/* Who writes a point. */
enum {
    PCL2_SIGNAL,   /* the blocks */
    PCL2_INPUT,    /* the caller: a named input */
    PCL2_IMAGE,    /* the caller: a word of the process image */
    PCL2_TUNABLE,  /* NAME_tune: a parameter */
    PCL2_OPERATOR, /* NAME_tune, and where it follows something its block: an operator cell */
    PCL2_STATE     /* the block that keeps it */
};

/* What points of one declared place have in common. */
struct pcl2_kind {
    const char *unit;  /* "" where none is declared */
    pcl2_real low;     /* declared range; what depends on other parameters counts as open */
    pcl2_real high;
    uint32_t rows;     /* 1 for a number; a vector has one column; 0: without elements */
    uint32_t columns;
    uint8_t type;      /* PCL2_REAL .. */
    uint8_t access;    /* PCL2_SIGNAL .. */
    uint8_t retain;    /* 1: kept over power loss */
};

/* One point. Elements stand row by row from offset on. */
struct pcl2_point {
    const char *name;
    uint32_t offset;   /* bytes from the start of the instance */
    uint32_t kind;     /* index in the map's kinds */
};

struct pcl2_map {
    const char *name;                /* of the program */
    uint64_t layout;                 /* hash over names and types: equal maps, equal saved values */
    int64_t period;                  /* of a scan, nanoseconds; 0 where the program needs none */
    uint32_t size;                   /* of the instance, bytes */
    int32_t count;                   /* of points */
    const struct pcl2_point *points;
    const struct pcl2_kind *kinds;
};

/* What a point of the map is. */
static inline const struct pcl2_kind *pcl2_kind_of(const struct pcl2_map *map, int32_t point)
{
    return &map->kinds[map->points[point].kind];
}

/* A new value for one element of a parameter or operator cell. */
struct pcl2_set {
    int32_t point;   /* index in the map */
    int32_t element; /* from 0, row by row */
    union {
        pcl2_real real;
        int32_t whole;
    } value;         /* as the point's type says; afterwards the value that was replaced */
};

/* The index of the point of this name, or -1. */
static inline int32_t pcl2_find(const struct pcl2_map *map, const char *name)
{
    for (int32_t i = 0; i < map->count; i++) {
        if (strcmp(map->points[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

#endif
