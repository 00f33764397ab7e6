/* The tunable table: changes parameters as a transaction. Check all, then keep all, then derive.
 *
 * PCL2_OFFSET is defined by the generated file that includes this one: the smallest unsigned type that holds the
 * size of its instance and the number of points in its map. */
#ifndef PCL2_TUNE_H
#define PCL2_TUNE_H

#include <stddef.h>

#include "pcl2_map.h"

/* Linkage of a composite's function that has many calls: gcc would study it anew for each. */
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 8
#define PCL2_SHARED static __attribute__((noipa))
#else
#define PCL2_SHARED static
#endif

/* Where a parameter of a function code stands. */
struct pcl2_place {
    PCL2_OFFSET offset; /* from the instance or from the cold parameters */
    PCL2_OFFSET count;  /* elements */
    uint8_t type;       /* PCL2_REAL or PCL2_INT */
    uint8_t cold;       /* 1: among the cold parameters */
};

/* What there is to do for blocks of one code; NULL: nothing. */
struct pcl2_code {
    int32_t (*check)(const void *instance, const void *cold, pcl2_real *left);
    void (*tune)(void *instance, const void *cold);
    void (*init)(void *instance, const void *cold);
    const struct pcl2_place *places;
    PCL2_OFFSET count; /* of places */
};

/* One block, or one operator cell. Rows stand in order of first. */
struct pcl2_row {
    const struct pcl2_code *code;
    PCL2_OFFSET instance; /* offset in the program's instance */
    PCL2_OFFSET cold;     /* offset of its cold parameters */
    PCL2_OFFSET first;    /* index in the map of its first parameter */
};

/* Derives every block from its parameters, then starts every block. */
static inline void pcl2_derive(void *self, const struct pcl2_row *rows, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        if (rows[i].code->tune != NULL) {
            rows[i].code->tune((char *)self + rows[i].instance, (char *)self + rows[i].cold);
        }
    }
    for (int32_t i = 0; i < n; i++) {
        if (rows[i].code->init != NULL) {
            rows[i].code->init((char *)self + rows[i].instance, (char *)self + rows[i].cold);
        }
    }
}

static inline int32_t pcl2_row_has(const struct pcl2_row *row, int32_t point)
{
    return point >= (int32_t)row->first && point < (int32_t)row->first + (int32_t)row->code->count;
}

/* The row that a point belongs to, or NULL. */
static inline const struct pcl2_row *pcl2_row_of(const struct pcl2_row *rows, int32_t n, int32_t point)
{
    int32_t low = 0;
    while (n - low > 1) {
        const int32_t middle = low + (n - low) / 2;
        if ((int32_t)rows[middle].first <= point) {
            low = middle;
        } else {
            n = middle;
        }
    }
    return pcl2_row_has(&rows[low], point) ? &rows[low] : NULL;
}

/* Exchanges the value of a set with that in the instance, bit for bit. */
static inline void pcl2_exchange(void *self, const struct pcl2_row *row, struct pcl2_set *set)
{
    const struct pcl2_place *place = &row->code->places[set->point - (int32_t)row->first];
    char *at = (char *)self + (place->cold ? row->cold : row->instance) + place->offset;
    if (place->type == PCL2_REAL) {
        pcl2_bits old;
        at += (size_t)set->element * sizeof old;
        memcpy(&old, at, sizeof old);
        memcpy(at, &set->value.real, sizeof old);
        memcpy(&set->value.real, &old, sizeof old);
    } else {
        int32_t old;
        at += (size_t)set->element * sizeof old;
        memcpy(&old, at, sizeof old);
        memcpy(at, &set->value.whole, sizeof old);
        set->value.whole = old;
    }
}

/* Takes the first n sets back, the last one first. */
static inline void pcl2_take_back(
    void *self, const struct pcl2_row *rows, int32_t n_rows, struct pcl2_set *sets, int32_t n)
{
    while (n > 0) {
        n--;
        pcl2_exchange(self, pcl2_row_of(rows, n_rows, sets[n].point), &sets[n]);
    }
}

/* 1 if an earlier set belongs to the same row. */
static inline int32_t pcl2_met(const struct pcl2_row *row, const struct pcl2_set *sets, int32_t i)
{
    while (i > 0) {
        i--;
        if (pcl2_row_has(row, sets[i].point)) {
            return 1;
        }
    }
    return 0;
}

/* 0: the set can be made. 1: its value is not a finite number. -1: it names no element. */
static inline int32_t pcl2_judge(const struct pcl2_row *row, const struct pcl2_set *set)
{
    if (row == NULL) {
        return -1;
    }
    const struct pcl2_place *place = &row->code->places[set->point - (int32_t)row->first];
    if (set->element < 0 || (uint32_t)set->element >= place->count) {
        return -1;
    }
    return place->type == PCL2_REAL && pcl2_is_bad(set->value.real);
}

/* All sets or none; see NAME_tune. */
static inline int32_t pcl2_tune(
    void *self, const struct pcl2_row *rows, int32_t n_rows, struct pcl2_health *health, struct pcl2_set *sets, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        const struct pcl2_row *row = pcl2_row_of(rows, n_rows, sets[i].point);
        const int32_t refusal = pcl2_judge(row, &sets[i]);
        if (refusal != 0) {
            pcl2_take_back(self, rows, n_rows, sets, i);
            pcl2_refuse(health);
            return refusal * (i + 1);
        }
        pcl2_exchange(self, row, &sets[i]);
    }
    for (int32_t i = 0; i < n; i++) {
        const struct pcl2_row *row = pcl2_row_of(rows, n_rows, sets[i].point);
        pcl2_real left[2] = {0, 0};
        if (row->code->check == NULL || pcl2_met(row, sets, i)) {
            continue;
        }
        if (row->code->check((char *)self + row->instance, (char *)self + row->cold, left) != 0) {
            pcl2_take_back(self, rows, n_rows, sets, n);
            pcl2_refuse(health);
            return i + 1;
        }
    }
    for (int32_t i = 0; i < n; i++) {
        const struct pcl2_row *row = pcl2_row_of(rows, n_rows, sets[i].point);
        if (row->code->tune != NULL && !pcl2_met(row, sets, i)) {
            row->code->tune((char *)self + row->instance, (char *)self + row->cold);
        }
    }
    return 0;
}

#endif
