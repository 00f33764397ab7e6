/* As much of LTSmin's interface, under its names, as a plugin of `net export` uses. */
#ifndef PINS_H
#define PINS_H

#include <stdint.h>

typedef struct grey_box_model *model_t;
typedef struct lts_type_s *lts_type_t;
typedef struct matrix { int rows, columns; } matrix_t;
typedef struct { uint32_t len; char *data; } chunk;
#define chunk_str(s) ((chunk){(uint32_t)strlen(s), ((char *)s)})

typedef enum { LTStypeDirect, LTStypeRange, LTStypeChunk, LTStypeEnum } data_format_t;

typedef struct transition_info { int *labels; int group; int por_proviso; } transition_info_t;
#define GB_TI(A, B) {(A), (B), 0}

typedef void (*TransitionCB)(void *context, transition_info_t *info, int *dst, int *cpy);
typedef int (*next_method_grey_t)(model_t self, int group, int *src, TransitionCB cb, void *context);

lts_type_t lts_type_create(void);
int lts_type_put_type(lts_type_t t, const char *name, data_format_t format, int *is_new);
void lts_type_set_state_length(lts_type_t t, int length);
void lts_type_set_state_name(lts_type_t t, int index, const char *name);
void lts_type_set_state_typeno(lts_type_t t, int index, int typeno);
void lts_type_set_edge_label_count(lts_type_t t, int count);
void lts_type_set_edge_label_name(lts_type_t t, int label, const char *name);
void lts_type_set_edge_label_typeno(lts_type_t t, int label, int typeno);
void lts_type_validate(lts_type_t t);

void dm_create(matrix_t *m, const int rows, const int columns);
void dm_set(matrix_t *m, const int row, const int column);

void GBsetLTStype(model_t model, lts_type_t info);
void GBsetDMInfo(model_t model, matrix_t *m);
void GBsetDMInfoRead(model_t model, matrix_t *m);
void GBsetDMInfoMayWrite(model_t model, matrix_t *m);
void GBsetDMInfoMustWrite(model_t model, matrix_t *m);
void GBsetInitialState(model_t model, int *state);
void GBsetNextStateLong(model_t model, next_method_grey_t method);

#endif
