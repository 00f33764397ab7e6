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
    PCL2_OFFSET count;      /* of places */
    PCL2_OFFSET cold_size;  /* bytes of the cold parameters of one block; 0: none */
    PCL2_OFFSET cold_align; /* their alignment less 1 */
};

/* One block, or one operator cell: four bytes of a small program. Rows stand in order of the map, so that the index
 * of a row's first parameter, and where its cold parameters are, follow from those of the row before. */
struct pcl2_row {
    PCL2_OFFSET code;     /* index in the table's codes */
    PCL2_OFFSET instance; /* offset in the program's instance */
};

/* What stands before every PCL2_MARK-th row. */
struct pcl2_mark {
    PCL2_OFFSET first; /* index in the map of the row's first parameter */
    PCL2_OFFSET cold;  /* offset of the next cold parameters */
};

enum { PCL2_MARK = 64 };

struct pcl2_table {
    const struct pcl2_row *rows;
    const struct pcl2_mark *marks;
    const struct pcl2_code *codes;
    int32_t count; /* of rows, at least 1 */
};

/* The alignment of cold parameters, less 1. */
struct pcl2_align_real {
    char before;
    pcl2_real after;
};
struct pcl2_align_int {
    char before;
    int32_t after;
};
#define PCL2_ALIGN_REAL (offsetof(struct pcl2_align_real, after) - 1)
#define PCL2_ALIGN_INT (offsetof(struct pcl2_align_int, after) - 1)

/* A row on the way through the table. */
struct pcl2_cursor {
    const struct pcl2_code *code;
    int32_t row;
    int32_t first;     /* index in the map of its first parameter */
    uint32_t instance; /* offsets */
    uint32_t cold;
};

static inline void pcl2_settle(struct pcl2_cursor *at, const struct pcl2_table *table)
{
    at->code = &table->codes[table->rows[at->row].code];
    at->instance = table->rows[at->row].instance;
    if (at->code->cold_size > 0) {
        at->cold = (at->cold + at->code->cold_align) & ~(uint32_t)at->code->cold_align;
    }
}

static inline struct pcl2_cursor pcl2_at_mark(const struct pcl2_table *table, int32_t mark)
{
    struct pcl2_cursor at = {NULL, mark * PCL2_MARK, table->marks[mark].first, 0, table->marks[mark].cold};
    pcl2_settle(&at, table);
    return at;
}

/* 1 if there is a next row. */
static inline int32_t pcl2_next(struct pcl2_cursor *at, const struct pcl2_table *table)
{
    at->first += (int32_t)at->code->count;
    at->cold += at->code->cold_size;
    at->row++;
    if (at->row == table->count) {
        return 0;
    }
    pcl2_settle(at, table);
    return 1;
}

/* Derives every block from its parameters, then starts every block. */
static inline void pcl2_derive(void *self, const struct pcl2_table *table)
{
    struct pcl2_cursor at = pcl2_at_mark(table, 0);
    do {
        if (at.code->tune != NULL) {
            at.code->tune((char *)self + at.instance, (char *)self + at.cold);
        }
    } while (pcl2_next(&at, table));
    at = pcl2_at_mark(table, 0);
    do {
        if (at.code->init != NULL) {
            at.code->init((char *)self + at.instance, (char *)self + at.cold);
        }
    } while (pcl2_next(&at, table));
}

static inline int32_t pcl2_holds(const struct pcl2_cursor *at, int32_t point)
{
    return point >= at->first && point < at->first + (int32_t)at->code->count;
}

/* The row that a point belongs to, or the last one looked at if there is none. */
static inline struct pcl2_cursor pcl2_seek(const struct pcl2_table *table, int32_t point)
{
    int32_t low = 0;
    int32_t end = (table->count + PCL2_MARK - 1) / PCL2_MARK;
    while (end - low > 1) {
        const int32_t middle = low + (end - low) / 2;
        if ((int32_t)table->marks[middle].first <= point) {
            low = middle;
        } else {
            end = middle;
        }
    }
    struct pcl2_cursor at = pcl2_at_mark(table, low);
    while (point >= at.first + (int32_t)at.code->count && pcl2_next(&at, table)) {
    }
    return at;
}

/* Exchanges the value of a set with that in the instance, bit for bit. */
static inline void pcl2_exchange(void *self, const struct pcl2_cursor *row, struct pcl2_set *set)
{
    const struct pcl2_place *place = &row->code->places[set->point - row->first];
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
static inline void pcl2_take_back(void *self, const struct pcl2_table *table, struct pcl2_set *sets, int32_t n)
{
    while (n > 0) {
        n--;
        const struct pcl2_cursor row = pcl2_seek(table, sets[n].point);
        pcl2_exchange(self, &row, &sets[n]);
    }
}

/* 1 if an earlier set belongs to the same row. */
static inline int32_t pcl2_met(const struct pcl2_cursor *row, const struct pcl2_set *sets, int32_t i)
{
    while (i > 0) {
        i--;
        if (pcl2_holds(row, sets[i].point)) {
            return 1;
        }
    }
    return 0;
}

/* 0: the set can be made. 1: its value is not a finite number. -1: it names no element. */
static inline int32_t pcl2_judge(const struct pcl2_cursor *row, const struct pcl2_set *set)
{
    if (!pcl2_holds(row, set->point)) {
        return -1;
    }
    const struct pcl2_place *place = &row->code->places[set->point - row->first];
    if (set->element < 0 || (uint32_t)set->element >= place->count) {
        return -1;
    }
    return place->type == PCL2_REAL && pcl2_is_bad(set->value.real);
}

/* All sets or none; see NAME_tune. */
static inline int32_t pcl2_tune(
    void *self, const struct pcl2_table *table, struct pcl2_health *health, struct pcl2_set *sets, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        const struct pcl2_cursor row = pcl2_seek(table, sets[i].point);
        const int32_t refusal = pcl2_judge(&row, &sets[i]);
        if (refusal != 0) {
            pcl2_take_back(self, table, sets, i);
            pcl2_refuse(health);
            return refusal * (i + 1);
        }
        pcl2_exchange(self, &row, &sets[i]);
    }
    for (int32_t i = 0; i < n; i++) {
        const struct pcl2_cursor row = pcl2_seek(table, sets[i].point);
        pcl2_real left[2] = {0, 0};
        if (row.code->check == NULL || pcl2_met(&row, sets, i)) {
            continue;
        }
        if (row.code->check((char *)self + row.instance, (char *)self + row.cold, left) != 0) {
            pcl2_take_back(self, table, sets, n);
            pcl2_refuse(health);
            return i + 1;
        }
    }
    for (int32_t i = 0; i < n; i++) {
        const struct pcl2_cursor row = pcl2_seek(table, sets[i].point);
        if (row.code->tune != NULL && !pcl2_met(&row, sets, i)) {
            row.code->tune((char *)self + row.instance, (char *)self + row.cold);
        }
    }
    return 0;
}

#endif
