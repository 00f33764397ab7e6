/* Stands in for LTSmin: counts the states and transitions of a plugin. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ltsmin/pins.h>
#include <ltsmin/pins-util.h>
#include <ltsmin/dlopen-api.h>

struct lts_type_s { int types, length, labels; };
struct grey_box_model { struct lts_type_s *type; int groups, chunks; int *initial; next_method_grey_t next; };

static struct lts_type_s the_type;

lts_type_t lts_type_create(void) { return &the_type; }
int lts_type_put_type(lts_type_t t, const char *name, data_format_t format, int *is_new)
{
    (void)name, (void)format;
    *is_new = 1;
    return t->types++;
}
void lts_type_set_state_length(lts_type_t t, int length) { t->length = length; }
void lts_type_set_state_name(lts_type_t t, int i, const char *name) { if (i >= t->length || !*name) { abort(); } }
void lts_type_set_state_typeno(lts_type_t t, int i, int no) { if (i >= t->length || no >= t->types) { abort(); } }
void lts_type_set_edge_label_count(lts_type_t t, int count) { t->labels = count; }
void lts_type_set_edge_label_name(lts_type_t t, int i, const char *name) { if (i >= t->labels || !*name) { abort(); } }
void lts_type_set_edge_label_typeno(lts_type_t t, int i, int no) { if (i >= t->labels || no >= t->types) { abort(); } }
void lts_type_validate(lts_type_t t) { if (t->length == 0 || t->labels == 0) { abort(); } }

void dm_create(matrix_t *m, const int rows, const int columns) { m->rows = rows, m->columns = columns; }
void dm_set(matrix_t *m, const int row, const int column) { if (row >= m->rows || column >= m->columns) { abort(); } }

void GBsetLTStype(model_t model, lts_type_t type) { model->type = type; }
void GBsetDMInfo(model_t model, matrix_t *m) { model->groups = m->rows; }
void GBsetDMInfoRead(model_t model, matrix_t *m) { (void)model, (void)m; }
void GBsetDMInfoMayWrite(model_t model, matrix_t *m) { (void)model, (void)m; }
void GBsetDMInfoMustWrite(model_t model, matrix_t *m) { (void)model, (void)m; }
void GBsetInitialState(model_t model, int *state) { model->initial = state; }
void GBsetNextStateLong(model_t model, next_method_grey_t method) { model->next = method; }
int pins_chunk_put(model_t model, int type_no, const chunk c) { (void)type_no; return c.len ? model->chunks++ : -1; }

#define SLOTS (1u << 20)

static struct grey_box_model model;
static int *states, *slots;
static int found;

static unsigned hash(const int *state)
{
    unsigned sum = 2166136261u;
    for (int i = 0; i < model.type->length; i++) {
        sum = (sum ^ (unsigned)state[i]) * 16777619u;
    }
    return sum;
}

static void add(const int *state)
{
    const size_t length = (size_t)model.type->length;
    unsigned at = hash(state) % SLOTS;
    while (slots[at] != 0) {
        if (memcmp(states + (size_t)(slots[at] - 1) * length, state, length * sizeof *state) == 0) {
            return;
        }
        at = (at + 1) % SLOTS;
    }
    if (found >= (int)(SLOTS / 2)) {
        abort();
    }
    memcpy(states + (size_t)found * length, state, length * sizeof *state);
    slots[at] = ++found;
}

static void reached(void *context, transition_info_t *info, int *dst, int *cpy)
{
    (void)cpy;
    if (info->group >= model.groups || *info->labels != info->group) {
        abort();
    }
    ++*(long *)context;
    add(dst);
}

int main(void)
{
    long edges = 0;
    pins_model_init(&model);
    const size_t length = (size_t)model.type->length;
    states = malloc(SLOTS / 2 * length * sizeof *states);
    slots = calloc(SLOTS, sizeof *slots);
    if (states == NULL || slots == NULL) {
        return 1;
    }
    add(model.initial);
    for (int i = 0; i < found; i++) {
        for (int group = 0; group < model.groups; group++) {
            (void)model.next(&model, group, states + (size_t)i * length, reached, &edges);
        }
    }
    printf("%s %d %ld\n", pins_plugin_name, found, edges);
    free(states);
    free(slots);
    return 0;
}
