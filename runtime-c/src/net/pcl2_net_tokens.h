/* Records of the table of a net, and the tokens of its boxes, with their attributes. */
#ifndef PCL2_NET_TOKENS_H
#define PCL2_NET_TOKENS_H

#include "pcl2_net.h"

#define NET_ORDER_FIFO 0
#define NET_ORDER_LIFO 1
#define NET_ORDER_LEAST 2

static const pcl2_net_word *net_record(const struct pcl2_net *net, int32_t list, int32_t index)
{
    return net->table + net->table[net->table[list] + index];
}

static const pcl2_net_word *net_box_record(const struct pcl2_net *net, int32_t b)
{
    return net_record(net, PCL2_NET_BOXES, b);
}

static const pcl2_net_word *net_part_record(const struct pcl2_net *net, int32_t part)
{
    return net_record(net, PCL2_NET_PARTS, 1 + part);
}

static void *net_word_at(const struct pcl2_net *net, int32_t word)
{
    return net->base + net->words[word];
}

static void *net_hand_at(const struct pcl2_net *net, int32_t hand)
{
    return net->base + net->hands[hand];
}

static const pcl2_net_word *net_class_of(const struct pcl2_net *net, const pcl2_net_word *box)
{
    return box[1] == 0 ? NULL : net_record(net, PCL2_NET_CLASSES, box[1] - 1);
}

/* How many ints and reals a token of a class has. */
static void net_sizes_of(const pcl2_net_word *class, int32_t *ints, int32_t *reals)
{
    *ints = 0;
    *reals = 0;
    for (int32_t i = 1; i <= class[0]; i++) {
        *(class[i] == 0 ? ints : reals) += 1;
    }
}

static void net_load(struct pcl2_net *net, const pcl2_net_word *box, int32_t place)
{
    const pcl2_net_word *class = net_class_of(net, box);
    int32_t ints, reals;
    if (class == NULL) {
        return;
    }
    net_sizes_of(class, &ints, &reals);
    const int32_t *from_ints = net->ints + box[5] + place * ints;
    const pcl2_real *from_reals = net->reals + box[6] + place * reals;
    for (int32_t i = 1; i <= class[0]; i++) {
        void *hand = net_hand_at(net, box[7] + i - 1);
        if (class[i] == 0) {
            *(int32_t *)hand = *from_ints++;
        } else {
            *(pcl2_real *)hand = *from_reals++;
        }
    }
}

/* Puts what stands in the hand of one box into a place of another of the same class. */
static void net_store(struct pcl2_net *net, const pcl2_net_word *from, const pcl2_net_word *box, int32_t place)
{
    const pcl2_net_word *class = net_class_of(net, box);
    int32_t ints, reals;
    if (class == NULL) {
        return;
    }
    net_sizes_of(class, &ints, &reals);
    int32_t *to_ints = net->ints + box[5] + place * ints;
    pcl2_real *to_reals = net->reals + box[6] + place * reals;
    for (int32_t i = 1; i <= class[0]; i++) {
        const void *hand = net_hand_at(net, from[7] + i - 1);
        if (class[i] == 0) {
            *to_ints++ = *(const int32_t *)hand;
        } else {
            *to_reals++ = *(const pcl2_real *)hand;
        }
    }
}

/* A net inside. */
static struct pcl2_net *net_inside(struct pcl2_net *net, int32_t part)
{
    return net + net_part_record(net, part)[2];
}

/* What a token carries goes from the hand of a box of one net into that of a box of another, of the same class. */
static void net_hand_over(struct pcl2_net *from, const pcl2_net_word *source, struct pcl2_net *to,
                          const pcl2_net_word *target)
{
    const pcl2_net_word *class = net_class_of(from, source);
    for (int32_t i = 0; class != NULL && i < class[0]; i++) {
        const size_t size = class[i + 1] ? sizeof(pcl2_real) : sizeof(int32_t);
        memcpy(net_hand_at(to, target[7] + i), net_hand_at(from, source[7] + i), size);
    }
}

/* Where the token of a box is: itself, or of a macro whose exit is marked, that; then `b` is the exit. */
static struct pcl2_net *net_holder(struct pcl2_net *net, int32_t *b)
{
    const pcl2_net_word *box = net_box_record(net, *b);
    if (box[0] != PCL2_NET_MACRO) {
        return net;
    }
    struct pcl2_net *inner = net_inside(net, box[8]);
    const int32_t exit = net_part_record(net, box[8])[1];
    if (inner->box[exit] == 0) {
        return net;
    }
    *b = exit;
    return inner;
}

/* The token of a place gets into hand. */
static void net_see(struct pcl2_net *net, int32_t b, int32_t place)
{
    int32_t at = b;
    struct pcl2_net *holder = net_holder(net, &at);
    const pcl2_net_word *box = net_box_record(holder, at);
    net_load(holder, box, place);
    if (holder != net) {
        net_hand_over(holder, box, net, net_box_record(net, b));
    }
}

/* The token in hand gets back to its place. */
static void net_return(struct pcl2_net *net, int32_t b, int32_t place)
{
    int32_t at = b;
    struct pcl2_net *holder = net_holder(net, &at);
    const pcl2_net_word *box = net_box_record(holder, at);
    if (holder != net) {
        net_hand_over(net, net_box_record(net, b), holder, box);
    }
    net_store(holder, box, box, place);
}

/* The tokens that can still be taken. */
static int32_t net_left(const struct pcl2_net *net, int32_t b)
{
    return net->box[b] - net->taken[b];
}

/* Whether the value by which tokens are ordered lets one go before another. */
static int32_t net_goes_before(const struct pcl2_net *net, const pcl2_net_word *box, int32_t a, int32_t b)
{
    const pcl2_net_word *class = net_class_of(net, box);
    const int32_t least = box[3] == NET_ORDER_LEAST;
    int32_t ints, reals, before[2] = {0, 0};
    net_sizes_of(class, &ints, &reals);
    for (int32_t i = 1; i <= box[4]; i++) {
        before[class[i]] += 1;
    }
    if (class[box[4] + 1] == 0) {
        const int32_t *keys = net->ints + box[5] + before[0];
        return least ? keys[a * ints] < keys[b * ints] : keys[a * ints] > keys[b * ints];
    }
    const pcl2_real *keys = net->reals + box[6] + before[1];
    const pcl2_real sign = least ? PCL2_R(1.0) : PCL2_R(-1.0);
    return pcl2_net_key(sign * keys[a * reals]) < pcl2_net_key(sign * keys[b * reals]);
}

/* The token that goes after another (-1: the first); -1: there is none. */
static int32_t net_next_token(const struct pcl2_net *net, int32_t b, int32_t after)
{
    const pcl2_net_word *box = net_box_record(net, b);
    const int32_t n = net_left(net, b);
    int32_t best = -1;
    if (box[1] == 0 || box[3] == NET_ORDER_FIFO) {
        return after + 1 < n ? after + 1 : -1;
    }
    if (box[3] == NET_ORDER_LIFO) {
        return after < 0 ? n - 1 : after - 1;
    }
    for (int32_t i = 0; i < n; i++) {
        const int32_t behind = after < 0 || net_goes_before(net, box, after, i);
        const int32_t later = behind || (!net_goes_before(net, box, i, after) && i > after);
        if (later && (best < 0 || net_goes_before(net, box, i, best))) {
            best = i;
        }
    }
    return best;
}

/* Closes the gap that a token leaves. */
static void net_remove_token(struct pcl2_net *net, int32_t b, int32_t place)
{
    const pcl2_net_word *box = net_box_record(net, b), *class = net_class_of(net, box);
    const int32_t n = net_left(net, b) + net->filled[b];
    int32_t ints, reals;
    if (class != NULL) {
        net_sizes_of(class, &ints, &reals);
        /* A net without attributes of a type has no array of it. */
        if (ints > 0) {
            pcl2_net_close_gap(net->ints + box[5], (size_t)ints * sizeof *net->ints, place, n);
        }
        if (reals > 0) {
            pcl2_net_close_gap(net->reals + box[6], (size_t)reals * sizeof *net->reals, place, n);
        }
    }
    net->taken[b] = box[0] == PCL2_NET_COUNT ? net->box[b] : net->taken[b] + 1;
}

#endif
