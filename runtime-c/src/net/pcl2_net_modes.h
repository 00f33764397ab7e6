/* Modes of a net: what an operator says, and what outputs are while the net is stopped. */
#ifndef PCL2_NET_MODES_H
#define PCL2_NET_MODES_H

#include "pcl2_net_tokens.h"

#define NET_OPERATED_BLOCKED 0
#define NET_OPERATED_MODE 1
#define NET_OPERATED_GO 2
#define NET_OPERATED_FIRE 3
#define NET_OPERATED_PUT 4
#define NET_OPERATED_TAKE 5
#define NET_OPERATED_STOPS 6

static const pcl2_net_word *net_operated(const struct pcl2_net *net)
{
    const int32_t at = net->table[PCL2_NET_OPERATED];
    return at == 0 ? NULL : net->table + at;
}

/* The record of a net that has a mode of its own. */
static const pcl2_net_word *net_modes(const struct pcl2_net *net)
{
    const pcl2_net_word *operated = net_operated(net);
    return operated != NULL && operated[NET_OPERATED_MODE] != 0 ? operated : NULL;
}

static const pcl2_net_word *net_gates_in_file(const pcl2_net_word *operated)
{
    return operated + NET_OPERATED_STOPS + 1 + 3 * operated[NET_OPERATED_STOPS];
}

static int32_t net_command(struct pcl2_net *net, const pcl2_net_word *modes, int32_t which)
{
    return modes[which] == 0 ? 0 : pcl2_net_command(net_word_at(net, modes[which] - 1));
}

static void net_record_command(struct pcl2_net *net, int32_t obeyed)
{
    pcl2_net_fault(net->status, obeyed ? PCL2_NET_FORCED : PCL2_NET_REFUSED);
    pcl2_net_count(obeyed ? net->forced : net->refused);
}

static void net_refuse(struct pcl2_net *net, const pcl2_net_word *modes, int32_t first, int32_t last)
{
    for (int32_t which = first; which <= last; which++) {
        if (net_command(net, modes, which) != 0) {
            net_record_command(net, 0);
        }
    }
}

/* The mode of a scan; commands of other modes are refused. */
static int32_t net_mode(struct pcl2_net *net, const pcl2_net_word *modes)
{
    const int32_t mode = *(const int32_t *)net_word_at(net, modes[NET_OPERATED_MODE] - 1);
    int32_t go = 0;
    if (mode == PCL2_NET_STEP) {
        go = net_command(net, modes, NET_OPERATED_GO);
    }
    net_refuse(net, modes, NET_OPERATED_GO, mode == PCL2_NET_MANUAL ? NET_OPERATED_GO : NET_OPERATED_TAKE);
    if (mode == PCL2_NET_STEP) {
        return go != 0 ? PCL2_NET_AUTOMATIC : PCL2_NET_STEP;
    }
    return mode == PCL2_NET_AUTOMATIC || mode == PCL2_NET_MANUAL ? mode : PCL2_NET_STOPPED;
}

static int32_t net_is_real(const struct pcl2_net *net, int32_t word)
{
    return net->table[net->table[PCL2_NET_WORDS] + word] & 1;
}

/* Where the value stands aside that a word has while the net is stopped, and else while it is not. */
static void *net_aside(const struct pcl2_net *net, const pcl2_net_word *stop)
{
    return net_is_real(net, stop[0]) ? (void *)(net->reals + stop[1]) : (void *)(net->ints + stop[1]);
}

/* Outputs and what they are while the net is stopped change places: the one that is not used stands aside. */
static void net_swap(struct pcl2_net *net, const pcl2_net_word *modes)
{
    const pcl2_net_word *stop = modes + NET_OPERATED_STOPS + 1;
    for (int32_t i = 0; i < modes[NET_OPERATED_STOPS]; i++, stop += 3) {
        const size_t size = net_is_real(net, stop[0]) ? sizeof(pcl2_real) : sizeof(int32_t);
        void *aside = net_aside(net, stop), *word = net_word_at(net, stop[0]);
        pcl2_real kept;
        memcpy(&kept, word, size);
        memcpy(word, aside, size);
        memcpy(aside, &kept, size);
    }
}

/* Outputs that hold are what they were before the stop, whatever nets inside do. */
static void net_hold(struct pcl2_net *net, const pcl2_net_word *modes)
{
    const pcl2_net_word *stop = modes + NET_OPERATED_STOPS + 1;
    for (int32_t i = 0; i < modes[NET_OPERATED_STOPS]; i++, stop += 3) {
        if (stop[2] != 0) {
            const size_t size = net_is_real(net, stop[0]) ? sizeof(pcl2_real) : sizeof(int32_t);
            memcpy(net_aside(net, stop), net_word_at(net, stop[0]), size);
        }
    }
}

/* A stopped net shows what its outputs are meanwhile, and its time stands. */
static void net_end(struct pcl2_net *net, int64_t period)
{
    const pcl2_net_word *modes = net_modes(net);
    if (modes == NULL) {
        return;
    }
    const int32_t stopped = net->mode == PCL2_NET_STOPPED;
    if (stopped) {
        net_swap(net, modes);
        *net->stood = *net->stood > INT64_MAX - period ? INT64_MAX : *net->stood + period;
    }
    net->switched = *net->halted != stopped;
    *net->halted = stopped;
}

#endif
