#ifndef PINS_DLOPEN_API_H
#define PINS_DLOPEN_API_H

#include <ltsmin/pins.h>

extern char pins_plugin_name[];
void pins_model_init(model_t model);

#endif
