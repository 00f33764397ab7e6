/* A net as many a soft PLC plays it: a table of gates, a function pointer for each guard, all gates tried in each scan. */
#ifndef NET_TABLE_H
#define NET_TABLE_H

#include <stdint.h>

struct net_gate {
    int32_t (*guard)(const int32_t *inputs); /* or NULL */
    int16_t before[3], after[3];             /* boxes, -1: no more */
};

struct net_level {
    int16_t output, place; /* a box and the output that it drives */
};

struct net_table {
    const struct net_gate *gates;
    const struct net_level *levels;
    int32_t n_places, n_gates, n_levels, n_outputs;
};

struct net_player {
    const struct net_table *table;
    uint8_t tokens[512], taken[512], filled[512];
    int32_t outputs[64];
};

void net_player_init(struct net_player *player, const struct net_table *table, const uint8_t *tokens);

/* One scan; the number of gates that fired. */
int32_t net_player_step(struct net_player *player, const int32_t *inputs);

#endif
