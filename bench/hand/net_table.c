#include "net_table.h"

#include <string.h>

void net_player_init(struct net_player *player, const struct net_table *table, const uint8_t *tokens)
{
    memset(player, 0, sizeof *player);
    player->table = table;
    memcpy(player->tokens, tokens, (size_t)table->n_places);
}

static int32_t enabled(const struct net_player *player, const struct net_gate *gate, const int32_t *inputs)
{
    for (int i = 0; i < 3 && gate->before[i] >= 0; i++) {
        if (player->tokens[gate->before[i]] == player->taken[gate->before[i]]) {
            return 0;
        }
    }
    for (int i = 0; i < 3 && gate->after[i] >= 0; i++) {
        if (player->tokens[gate->after[i]] != 0 || player->filled[gate->after[i]] != 0) {
            return 0;
        }
    }
    return gate->guard == NULL || gate->guard(inputs);
}

int32_t net_player_step(struct net_player *player, const int32_t *inputs)
{
    const struct net_table *table = player->table;
    int32_t fired = 0;
    for (int32_t g = 0; g < table->n_gates; g++) {
        const struct net_gate *gate = &table->gates[g];
        if (!enabled(player, gate, inputs)) {
            continue;
        }
        for (int i = 0; i < 3 && gate->before[i] >= 0; i++) {
            player->taken[gate->before[i]] = 1;
        }
        for (int i = 0; i < 3 && gate->after[i] >= 0; i++) {
            player->filled[gate->after[i]] = 1;
        }
        fired++;
    }
    if (fired != 0) {
        for (int32_t p = 0; p < table->n_places; p++) {
            player->tokens[p] = (uint8_t)(player->tokens[p] - player->taken[p] + player->filled[p]);
        }
        memset(player->taken, 0, sizeof player->taken);
        memset(player->filled, 0, sizeof player->filled);
        memset(player->outputs, 0, sizeof player->outputs);
        for (int32_t i = 0; i < table->n_levels; i++) {
            player->outputs[table->levels[i].output] |= player->tokens[table->levels[i].place];
        }
    }
    return fired;
}
