/* Runs @NAME@: reads a script of 64-bit words from a file, writes what is recorded as 64-bit words to standard output,
 * or to the file that a second argument names (an emulated target has no standard output of bytes). */
#include <stdio.h>
#include <stdlib.h>

#include "@NAME@.c"

/* The words that start what is written: a row, a refused set, the end. */
enum { PCL2_RUN_ROW = 1, PCL2_RUN_REFUSED = 2, PCL2_RUN_END = 3 };

/* The script: counts, then columns and parameters (a point in the upper half, an element in the lower one), the scans
 * whose rows are wanted, and events (scan, point and element, bits of the value) in order of the scan. */
struct pcl2_run_script {
    uint64_t scans, columns, parameters, every_row, rows, events;
    const uint64_t *column, *parameter, *row, *event;
};

static @NAME@ pcl2_run_self;
static FILE *pcl2_run_out;

static void pcl2_run_put(uint64_t word)
{
    if (fwrite(&word, sizeof word, 1, pcl2_run_out) != 1) {
        exit(1);
    }
}

static char *pcl2_run_place(int32_t point, int32_t element)
{
    const uint8_t type = pcl2_kind_of(&@NAME@_map, point)->type;
    const size_t size = type == PCL2_REAL ? sizeof(pcl2_real) : type == PCL2_INT ? sizeof(int32_t) : sizeof(int64_t);
    return (char *)&pcl2_run_self + @NAME@_map.points[point].offset + size * (size_t)element;
}

static int32_t pcl2_run_point(uint64_t place)
{
    return (int32_t)(place >> 32);
}

static int32_t pcl2_run_element(uint64_t place)
{
    return (int32_t)(place & UINT32_MAX);
}

static uint64_t pcl2_run_get(uint64_t place)
{
    const char *const at = pcl2_run_place(pcl2_run_point(place), pcl2_run_element(place));
    const uint8_t type = pcl2_kind_of(&@NAME@_map, pcl2_run_point(place))->type;
    int32_t whole;
    int64_t time;
    pcl2_bits real;
    if (type == PCL2_INT) {
        memcpy(&whole, at, sizeof whole);
        return (uint32_t)whole;
    }
    if (type == PCL2_TIME) {
        memcpy(&time, at, sizeof time);
        return (uint64_t)time;
    }
    memcpy(&real, at, sizeof real);
    return real;
}

/* Inputs at once; parameters and operator cells are gathered. */
static int32_t pcl2_run_take(const uint64_t *event, struct pcl2_set *set)
{
    const int32_t point = pcl2_run_point(event[1]);
    const struct pcl2_kind *const p = pcl2_kind_of(&@NAME@_map, point);
    const pcl2_bits real = (pcl2_bits)event[2];
    const int32_t whole = (int32_t)(uint32_t)event[2];
    if (p->access == PCL2_TUNABLE || p->access == PCL2_OPERATOR) {
        set->point = point;
        set->element = pcl2_run_element(event[1]);
        if (p->type == PCL2_REAL) {
            set->value.real = pcl2_of_bits(real);
        } else {
            set->value.whole = whole;
        }
        return 1;
    }
    if (p->type == PCL2_REAL) {
        memcpy(pcl2_run_place(point, pcl2_run_element(event[1])), &real, sizeof real);
    } else {
        memcpy(pcl2_run_place(point, pcl2_run_element(event[1])), &whole, sizeof whole);
    }
    return 0;
}

/* The events before one scan; where the next ones start. */
static uint64_t pcl2_run_apply(const struct pcl2_run_script *script, uint64_t first, uint64_t scan, struct pcl2_set *sets)
{
    int32_t n = 0;
    while (first < script->events && script->event[3 * first] <= scan) {
        n += pcl2_run_take(&script->event[3 * first], &sets[n]);
        first++;
    }
    if (n > 0) {
        const int refused = @NAME@_tune(&pcl2_run_self, sets, n);
        if (refused != 0) {
            pcl2_run_put(PCL2_RUN_REFUSED);
            pcl2_run_put(scan);
            pcl2_run_put((uint32_t)(refused > 0 ? sets[refused - 1].point : -1));
        }
    }
    return first;
}

static void pcl2_run_row(const struct pcl2_run_script *script)
{
    pcl2_run_put(PCL2_RUN_ROW);
    for (uint64_t i = 0; i < script->columns; i++) {
        pcl2_run_put(pcl2_run_get(script->column[i]));
    }
}

static void pcl2_run_end(const struct pcl2_run_script *script)
{
    const struct pcl2_health *const health = &pcl2_run_self.health;
    pcl2_run_put(PCL2_RUN_END);
    pcl2_run_put(health->faults);
    pcl2_run_put(health->refused);
    pcl2_run_put((uint32_t)health->first_block);
    pcl2_run_put((uint32_t)health->first_status);
    pcl2_run_put(health->first_scan);
    pcl2_run_put((uint32_t)health->last_block);
    pcl2_run_put((uint32_t)health->last_status);
    pcl2_run_put(health->last_scan);
    for (uint64_t i = 0; i < script->parameters; i++) {
        pcl2_run_put(pcl2_run_get(script->parameter[i]));
    }
}

static void pcl2_run_all(const struct pcl2_run_script *script, struct pcl2_set *sets)
{
    uint64_t event = 0;
    uint64_t row = 0;
    uint64_t scan = 0;
    @NAME@_init(&pcl2_run_self);
    while (scan < script->scans) {
        uint64_t end = script->scans;
        event = pcl2_run_apply(script, event, scan, sets);
        if (event < script->events && script->event[3 * event] < end) {
            end = script->event[3 * event];
        }
        const uint64_t wanted = script->every_row ? scan : row < script->rows ? script->row[row] : UINT64_MAX;
        if (wanted < end) {
            end = wanted + 1;
        }
        for (; scan < end; scan++) {
            @NAME@_step(&pcl2_run_self);
        }
        if (wanted == end - 1) {
            pcl2_run_row(script);
            row++;
        }
    }
    pcl2_run_end(script);
}

static uint64_t *pcl2_run_read(const char *path)
{
    FILE *const file = fopen(path, "rb");
    uint64_t count;
    if (file == NULL || fread(&count, sizeof count, 1, file) != 1) {
        exit(1);
    }
    uint64_t *const words = malloc((size_t)count * sizeof *words);
    if (words == NULL || fread(words, sizeof *words, (size_t)count, file) != count) {
        exit(1);
    }
    fclose(file);
    return words;
}

int main(int argc, char **argv)
{
    pcl2_run_out = argc == 3 ? fopen(argv[2], "wb") : stdout;
    if (argc < 2 || argc > 3 || pcl2_run_out == NULL) {
        return 1;
    }
    uint64_t *const words = pcl2_run_read(argv[1]);
    struct pcl2_run_script script = {words[0], words[1], words[2], words[3], words[4], words[5], NULL, NULL, NULL, NULL};
    script.column = words + 6;
    script.parameter = script.column + script.columns;
    script.row = script.parameter + script.parameters;
    script.event = script.row + script.rows;
    struct pcl2_set *const sets = malloc((size_t)(script.events + 1) * sizeof *sets);
    if (sets == NULL) {
        return 1;
    }
    pcl2_run_all(&script, sets);
    free(sets);
    free(words);
    return fclose(pcl2_run_out) == 0 ? 0 : 1;
}
