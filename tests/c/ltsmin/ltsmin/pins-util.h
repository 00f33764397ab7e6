#ifndef PINS_UTIL_H
#define PINS_UTIL_H

#include <ltsmin/pins.h>

int pins_chunk_put(model_t model, int type_no, const chunk c);

#endif
