/* Statements of a net: how they are run, and which of two writes stays. */
#ifndef PCL2_NET_STATEMENTS_H
#define PCL2_NET_STATEMENTS_H

#include "pcl2_net_modes.h"

static int32_t net_same(const struct pcl2_net *net, int32_t word, const void *value)
{
    return memcmp(net_word_at(net, word), value, net_is_real(net, word) ? sizeof(pcl2_real) : sizeof(int32_t)) == 0;
}

static void net_keep(const struct pcl2_net *net, int32_t word, void *value, int32_t back)
{
    const size_t size = net_is_real(net, word) ? sizeof(pcl2_real) : sizeof(int32_t);
    memcpy(back ? net_word_at(net, word) : value, back ? value : net_word_at(net, word), size);
}

/* A word has a new value: of two different ones in a scan that of the gate with the higher priority stays. */
static void net_written(struct pcl2_net *net, int32_t word, int32_t gate, void *before)
{
    struct pcl2_net_writes writes = {&net->wrote[word], net->status, net->conflicts};
    if (pcl2_net_yields(&writes, gate, !net_same(net, word, before))) {
        net_keep(net, word, before, 1);
    }
}

#define NET_MOST_TARGETS 16

/* The boxes that a statement looks at. */
static const pcl2_net_word *net_looks(const struct pcl2_net *net, int32_t script)
{
    const pcl2_net_word *counts = net_record(net, PCL2_NET_SCRIPTS, script);
    counts += counts[0] + 1;
    return counts + counts[0] + 1;
}

/* Tokens that nobody holds are lent to a statement that looks at them: the first of each box. Where there is none the
 * hand has what a new token has. */
static void net_lend(struct pcl2_net *net, int32_t script)
{
    const pcl2_net_word *looks = net_looks(net, script);
    for (int32_t i = 1; i <= looks[0]; i++) {
        const int32_t b = looks[i];
        if (net->hold[b] == PCL2_NET_NOT_HELD) {
            const pcl2_net_word *box = net_box_record(net, b);
            const int32_t first = net_next_token(net, b, -1);
            if (first < 0) {
                net_load(net, box, box[2]);
            } else {
                net_see(net, b, first);
            }
            net->hold[b] = first < 0 ? PCL2_NET_NOT_HELD : PCL2_NET_LENT - first;
        }
    }
}

/* What a statement made of a token that it looked at goes back to its place. */
static void net_give_back(struct pcl2_net *net, int32_t b)
{
    const int32_t hold = net->hold[b];
    if (hold > 0 || hold <= PCL2_NET_LENT) {
        net_return(net, b, hold > 0 ? hold - 1 : PCL2_NET_LENT - hold);
    }
}

/* Runs a statement for a gate. Tokens that it looks at are in hand meanwhile. */
static int32_t net_act(struct pcl2_net *net, int32_t script, int32_t gate)
{
    const pcl2_net_word *targets = net_record(net, PCL2_NET_SCRIPTS, script), *counts = targets + targets[0] + 1;
    const pcl2_net_word *looks = net_looks(net, script);
    pcl2_real before[NET_MOST_TARGETS];
    net_lend(net, script);
    for (int32_t i = 0; i < targets[0]; i++) {
        net_keep(net, targets[i + 1], &before[i], 0);
    }
    const int32_t result = net->act(net, script);
    for (int32_t i = 0; i < targets[0]; i++) {
        net_written(net, targets[i + 1], gate, &before[i]);
    }
    for (int32_t i = 1; i <= counts[0]; i++) {
        pcl2_net_counted(&net->wrote[counts[i]]);
    }
    for (int32_t i = 1; i <= looks[0]; i++) {
        net_give_back(net, looks[i]);
    }
    return result;
}

/* Takes back the tokens that were lent to a statement. */
static void net_release(struct pcl2_net *net, int32_t script)
{
    const pcl2_net_word *looks = net_looks(net, script);
    for (int32_t i = 1; i <= looks[0]; i++) {
        if (net->hold[looks[i]] <= PCL2_NET_LENT) {
            net->hold[looks[i]] = PCL2_NET_NOT_HELD;
        }
    }
}

static int32_t net_run(struct pcl2_net *net, int32_t script, int32_t gate)
{
    const int32_t result = net_act(net, script, gate);
    net_release(net, script);
    return result;
}

static void net_run_all(struct pcl2_net *net, const pcl2_net_word *list, int32_t gate)
{
    for (int32_t i = 1; i <= list[0]; i++) {
        (void)net_run(net, list[i], gate);
    }
}

#endif
