/* The player of nets. Records of the table:
 *
 * box     kind, class + 1, capacity (0: none), order, attribute of the order, first int, first real, first hand,
 *         then of TIME: the statement of its duration; ACTION: n, statements; PROCESS: until + 1, within + 1, n,
 *         statements, n, statements of AFTER, hand of the cause; GENERATION: when, n, statements; MACRO: its part
 * gate    befores, afters, reads, inhibits, permits, rules; (box, weight) of each before and after;
 *         (part + 1, box, weight) of each read and inhibit; permits; then of each rule: condition + 1,
 *         n, boxes whose tokens it looks at, n, words that it clears, n, moves (before + 1, n, afters), n, statements
 * statement  n, words that it writes and that may conflict, n, words that it counts on,
 *         n, boxes whose token it looks at
 * class   n, of each attribute 0 an int, 1 a real
 * levels  n, of each: word, n, boxes, n, (part, output)
 * actives n, of each: word, word of the time + 1, n, boxes
 * parts   n, of each: entry, exit, how far behind the net it stands, box of the macro + 1,
 *         abort: condition + 1, box, n, statements, n, words that it clears; n, (output, word)
 * operated  words, each + 1: of BLOCKED, of the mode, of the commands go, fire, put, take; n, of each word that has a
 *         value of its own while the net is stopped: word, its place among the attributes, whether it is what it was;
 *         the gates in the order of the file; by gate the number of its first permissive term */
#include "pcl2_net_statements.h"

int64_t pcl2_net_nanoseconds(const pcl2_real *seconds)
{
    return pcl2_net_time(*seconds);
}

/* The box phase. */

static void net_set_phase(struct pcl2_net *net, int32_t b, int32_t phase)
{
    net->phase[b] = (net->phase[b] & ~3) | phase;
}

/* Completion, timeout, and the answer of AFTER. */
static void net_finish(struct pcl2_net *net, int32_t b, const pcl2_net_word *after, int32_t late)
{
    const int32_t gate = net->phase[b] >> 2;
    int32_t ready = 1;
    if (late) {
        pcl2_net_fault(net->status, PCL2_NET_TIMEOUT);
    }
    if (after[0] != 0) {
        int32_t *cause = net_hand_at(net, after[after[0] + 1]), *answer = net_hand_at(net, after[after[0] + 1] + 1);
        *cause = late;
        *answer = 1;
        net_run_all(net, after, gate);
        ready = *answer != 0;
    }
    net->since[b] = net->now;
    net_set_phase(net, b, ready ? PCL2_NET_READY : PCL2_NET_RUNNING);
}

/* Whether a box has had its token for the time that a statement gives. */
static int32_t net_has_passed(struct pcl2_net *net, int32_t b, int32_t statement)
{
    net_lend(net, statement);
    const int64_t time = net->duration(net, statement);
    net_release(net, statement);
    return pcl2_net_over(net->now - net->since[b], time);
}

static void net_process(struct pcl2_net *net, int32_t b, const pcl2_net_word *more)
{
    const pcl2_net_word *enter = more + 2, *after = enter + enter[0] + 1;
    if ((net->phase[b] & 3) == PCL2_NET_NEW) {
        net_run_all(net, enter, net->phase[b] >> 2);
        net->since[b] = net->now;
        net_set_phase(net, b, PCL2_NET_RUNNING);
        return;
    }
    if ((net->phase[b] & 3) != PCL2_NET_RUNNING) {
        return;
    }
    const int32_t complete = more[0] == 0 || net_run(net, more[0] - 1, 0);
    const int32_t late = more[1] != 0 && net_has_passed(net, b, more[1] - 1);
    if (complete || late) {
        net_finish(net, b, after, !complete);
    }
}

/* Puts the class's initial values into the hand of a box: they stand in its place behind the last. */
static void net_fresh(struct pcl2_net *net, const pcl2_net_word *box)
{
    net_load(net, box, box[2]);
}

/* On the rising edge of the condition a token; while there is no room one waits, and a further one is lost. */
static void net_generate(struct pcl2_net *net, int32_t b, const pcl2_net_word *box, const pcl2_net_word *more)
{
    const int32_t now = net_run(net, more[0], 0) != 0, edge = now && (net->phase[b] & 1) == 0;
    int32_t wanted = ((net->phase[b] & 2) != 0) + edge;
    while (wanted > 0 && net->box[b] < box[2]) {
        net_fresh(net, box);
        net_store(net, box, box, net->box[b]);
        net->hold[b] = net->box[b] + 1;
        net->box[b] += 1;
        for (int32_t i = 1; i <= more[1]; i++) {
            (void)net_run(net, more[1 + i], 0);
        }
        net->hold[b] = PCL2_NET_NOT_HELD;
        wanted--;
    }
    if (wanted > 1) {
        pcl2_net_fault(net->status, PCL2_NET_LOST);
        pcl2_net_count(net->lost);
    }
    net->phase[b] = now | (wanted > 0 ? 2 : 0);
}

static void net_box_phase(struct pcl2_net *net)
{
    for (int32_t b = 0; b < net->table[PCL2_NET_N_BOXES]; b++) {
        const pcl2_net_word *box = net_box_record(net, b), *more = box + 8;
        if (box[0] == PCL2_NET_GENERATION) {
            net_generate(net, b, box, more);
        }
        if (net->box[b] == 0) {
            continue;
        }
        if (box[0] == PCL2_NET_TIME) {
            net_set_phase(net, b, net_has_passed(net, b, more[0]) ? PCL2_NET_DONE : PCL2_NET_NEW);
        } else if (box[0] == PCL2_NET_ACTION && (net->phase[b] & 3) == PCL2_NET_NEW) {
            net_run_all(net, more, net->phase[b] >> 2);
            net_set_phase(net, b, PCL2_NET_DONE);
        } else if (box[0] == PCL2_NET_PROCESS) {
            net_process(net, b, more);
        }
    }
}

/* The gate phase. */

/* A net inside, to look at. */
static const struct pcl2_net *net_part_of(const struct pcl2_net *net, int32_t part)
{
    return net + net_part_record(net, part)[2];
}

static int32_t net_excited(const struct pcl2_net *net, int32_t b)
{
    const pcl2_net_word *box = net_box_record(net, b);
    switch (box[0]) {
    case PCL2_NET_TIME:
    case PCL2_NET_ACTION:
        return net->box[b] > 0 && (net->phase[b] & 3) == PCL2_NET_DONE;
    case PCL2_NET_PROCESS:
        return net->box[b] > 0 && (net->phase[b] & 3) == PCL2_NET_READY;
    case PCL2_NET_COUNT:
        return net->box[b] >= box[2];
    case PCL2_NET_MACRO: {
        const struct pcl2_net *part = net_part_of(net, box[8]);
        return net->box[b] > 0 && part->box[net_part_record(net, box[8])[1]] > 0;
    }
    default:
        return net->box[b] > 0;
    }
}

static int32_t net_weight_in(const pcl2_net_word *arcs, int32_t n, int32_t b)
{
    for (int32_t i = 0; i < n; i++) {
        if (arcs[2 * i] == b) {
            return arcs[2 * i + 1];
        }
    }
    return 0;
}

/* Whether a net and the macros inside it are empty but for a box, -1: altogether. */
static int32_t net_empty_but(const struct pcl2_net *net, int32_t but)
{
    for (int32_t b = 0; b < net->table[PCL2_NET_N_BOXES]; b++) {
        if ((net->box[b] != 0 && b != but) || net->filled[b] != 0) {
            return 0;
        }
    }
    for (int32_t i = 0; i < net->table[net->table[PCL2_NET_PARTS]]; i++) {
        if (net_part_record(net, i)[3] != 0 && !net_empty_but(net_part_of(net, i), -1)) {
            return 0;
        }
    }
    return 1;
}

/* Whether a macro's net is empty, so that a token may enter; `leaves`: the one in the exit is about to go. */
static int32_t net_vacant(const struct pcl2_net *net, int32_t part, int32_t leaves)
{
    return net_empty_but(net_part_of(net, part), leaves ? net_part_record(net, part)[1] : -1);
}

/* Whether a box can take so many tokens more. */
static int32_t net_room(const struct pcl2_net *net, int32_t b, int32_t more)
{
    const pcl2_net_word *box = net_box_record(net, b);
    const int32_t fits = more <= 0 || box[2] == 0 || net->box[b] + net->used[b] + more <= box[2];
    return fits && (box[0] != PCL2_NET_MACRO || net_vacant(net, box[8], more <= 0));
}

/* Whether a tested box has so many tokens. */
static int32_t net_has(const struct pcl2_net *net, const pcl2_net_word *tested, int32_t only_excited)
{
    const struct pcl2_net *where = tested[0] == 0 ? net : net_part_of(net, tested[0] - 1);
    const int32_t there = where->box[tested[1]] >= tested[2];
    return there && (!only_excited || net_excited(where, tested[1]));
}

/* Whether the tokens are there, those that are read and those that must not be there. */
static int32_t net_enabled(const struct pcl2_net *net, const pcl2_net_word *gate)
{
    const pcl2_net_word *arc = gate + 6, *tested = arc + 2 * (gate[0] + gate[1]);
    for (int32_t i = 0; i < gate[0]; i++, arc += 2) {
        const int32_t counts = net_box_record(net, arc[0])[0] == PCL2_NET_COUNT;
        const int32_t there = counts ? net->taken[arc[0]] == 0 : net_left(net, arc[0]) >= arc[1];
        if (!there || !net_excited(net, arc[0])) {
            return 0;
        }
    }
    for (int32_t i = 0; i < gate[2]; i++, tested += 3) {
        if (!net_has(net, tested, 1)) {
            return 0;
        }
    }
    for (int32_t i = 0; i < gate[3]; i++, tested += 3) {
        if (net_has(net, tested, 0)) {
            return 0;
        }
    }
    return 1;
}

/* Where the records of a rule begin. */
struct net_rule {
    int32_t condition;     /* + 1; 0: always */
    const pcl2_net_word *looks; /* lists: n, then n words */
    const pcl2_net_word *clears;
    const pcl2_net_word *moves; /* n, then the moves */
    const pcl2_net_word *actions;
    const pcl2_net_word *end;
};

static struct net_rule net_rule_at(const pcl2_net_word *at)
{
    struct net_rule rule;
    rule.condition = at[0];
    rule.looks = at + 1;
    rule.clears = rule.looks + rule.looks[0] + 1;
    rule.moves = rule.clears + rule.clears[0] + 1;
    const pcl2_net_word *move = rule.moves + 1;
    for (int32_t i = 0; i < rule.moves[0]; i++) {
        move += 2 + move[1];
    }
    rule.actions = move;
    rule.end = move + move[0] + 1;
    return rule;
}

/* Takes the first tokens that satisfy the condition into hand: the last box's change quickest. */
static int32_t net_satisfied(struct pcl2_net *net, const struct net_rule *rule, int32_t gate)
{
    const int32_t n = rule->looks[0];
    if (rule->condition == 0) {
        return 1;
    }
    int32_t at = 0;
    while (at >= 0) {
        if (at == n) {
            if (net_act(net, rule->condition - 1, gate)) {
                return 1;
            }
            at--;
            continue;
        }
        const int32_t b = rule->looks[at + 1];
        const int32_t place = net_next_token(net, b, net->hold[b] - 1);
        net->hold[b] = place + 1;
        if (place < 0) {
            at--;
            continue;
        }
        net_see(net, b, place);
        at++;
        if (at < n) {
            net->hold[rule->looks[at + 1]] = PCL2_NET_NOT_HELD;
        }
    }
    return 0;
}

static void net_let_go(struct pcl2_net *net, const struct net_rule *rule)
{
    for (int32_t i = 1; i <= rule->looks[0]; i++) {
        net->hold[rule->looks[i]] = PCL2_NET_NOT_HELD;
    }
    if (rule->condition != 0) {
        net_release(net, rule->condition - 1);
    }
}

/* Whether there is room where the rule puts tokens. */
static int32_t net_rule_room(const struct pcl2_net *net, const pcl2_net_word *gate, const struct net_rule *rule)
{
    const pcl2_net_word *befores = gate + 6, *afters = befores + 2 * gate[0], *move = rule->moves + 1;
    for (int32_t i = 0; i < rule->moves[0]; i++, move += 2 + move[1]) {
        for (int32_t j = 0; j < move[1]; j++) {
            const pcl2_net_word *arc = afters + 2 * move[2 + j];
            if (!net_room(net, arc[0], arc[1] - net_weight_in(befores, gate[0], arc[0]))) {
                return 0;
            }
        }
    }
    return 1;
}

static void net_take(struct pcl2_net *net, const pcl2_net_word *arc)
{
    const pcl2_net_word *box = net_box_record(net, arc[0]);
    if (box[0] == PCL2_NET_MACRO) {
        struct pcl2_net *part = net_inside(net, box[8]);
        const int32_t exit = net_part_record(net, box[8])[1];
        part->taken[exit] = part->box[exit];
        net_see(net, arc[0], 0);
        net->taken[arc[0]] += 1;
        net->hold[arc[0]] = PCL2_NET_ON_ITS_WAY;
        return;
    }
    const int32_t held = net->hold[arc[0]];
    const int32_t place = held > 0 ? held - 1 : net_next_token(net, arc[0], -1);
    for (int32_t i = 0; i < arc[1]; i++) {
        if (i == 0) {
            net_load(net, box, place);
        }
        net_remove_token(net, arc[0], i == 0 ? place : 0);
    }
    net->hold[arc[0]] = PCL2_NET_ON_ITS_WAY;
}

/* A token goes from the hand of one box into another. */
static void net_put(struct pcl2_net *net, int32_t from, const pcl2_net_word *arc, int32_t excess, int32_t gate)
{
    const int32_t b = arc[0];
    const pcl2_net_word *box = net_box_record(net, b), *source = from < 0 ? box : net_box_record(net, from);
    if (box[1] != 0) {
        net_store(net, source, box, box[0] == PCL2_NET_MACRO ? 0 : net_left(net, b) + net->filled[b]);
    }
    net->filled[b] = pcl2_add_i(net->filled[b], arc[1]);
    net->used[b] = pcl2_add_i(net->used[b], excess > 0 ? excess : 0);
    net->by[b] = gate;
    if (box[0] == PCL2_NET_MACRO) {
        struct pcl2_net *part = net_inside(net, box[8]);
        const int32_t entry = net_part_record(net, box[8])[0];
        const pcl2_net_word *inner = net_box_record(part, entry);
        net_hand_over(net, source, part, inner);
        net_store(part, inner, inner, 0);
        part->filled[entry] += 1;
        part->used[entry] += 1;
        part->by[entry] = 0;
    }
}

/* Puts the tokens that were taken, or new ones. The new token of a box before the gate has no hand of its own. */
static void net_deposit(struct pcl2_net *net, const pcl2_net_word *gate, const struct net_rule *rule, int32_t index,
                        int32_t new_ones)
{
    const pcl2_net_word *befores = gate + 6, *afters = befores + 2 * gate[0], *move = rule->moves + 1;
    for (int32_t i = 0; i < rule->moves[0]; i++, move += 2 + move[1]) {
        for (int32_t j = 0; (move[0] == 0) == new_ones && j < move[1]; j++) {
            const pcl2_net_word *arc = afters + 2 * move[2 + j];
            const int32_t taken = net_weight_in(befores, gate[0], arc[0]), excess = arc[1] - taken;
            if (new_ones && taken > 0) {
                net_fresh(net, net_box_record(net, arc[0]));
            }
            net_put(net, new_ones ? -1 : befores[2 * (move[0] - 1)], arc, excess, index);
        }
    }
}

static void net_move_tokens(struct pcl2_net *net, const pcl2_net_word *gate, const struct net_rule *rule, int32_t index)
{
    const pcl2_net_word *befores = gate + 6, *afters = befores + 2 * gate[0], *move = rule->moves + 1;
    for (int32_t i = 0; i < gate[0]; i++) {
        net_take(net, befores + 2 * i);
    }
    for (int32_t i = 0; i < rule->moves[0]; i++, move += 2 + move[1]) {
        for (int32_t j = 0; move[0] == 0 && j < move[1]; j++) {
            const int32_t b = afters[2 * move[2 + j]];
            if (net->hold[b] != PCL2_NET_ON_ITS_WAY) {
                net_fresh(net, net_box_record(net, b));
                net->hold[b] = PCL2_NET_ON_ITS_WAY;
            }
        }
    }
    net_run_all(net, rule->actions, index);
    net_deposit(net, gate, rule, index, 0);
    net_deposit(net, gate, rule, index, 1);
    for (int32_t i = 0; i < gate[0] + gate[1]; i++) {
        net->hold[befores[2 * i]] = PCL2_NET_NOT_HELD;
    }
}

/* What BLOCKED tells if this permissive is the first that holds a gate back. */
static void net_tell_blocked(struct pcl2_net *net, int32_t gate, int32_t term)
{
    const pcl2_net_word *operated = net_operated(net);
    if (operated != NULL && net->blocked == 0) {
        net->blocked = net_gates_in_file(operated)[net->table[PCL2_NET_N_GATES] + gate] + term;
    }
}

static int32_t net_permitted(struct pcl2_net *net, const pcl2_net_word *gate, const pcl2_net_word *permits,
                             int32_t index)
{
    for (int32_t i = 0; i < gate[4]; i++) {
        if (!net_run(net, permits[i], index)) {
            net_tell_blocked(net, index, i);
            return 0;
        }
    }
    return 1;
}

/* Clears the commands of a list. */
static void net_clear(struct pcl2_net *net, const pcl2_net_word *commands)
{
    for (int32_t i = 1; i <= commands[0]; i++) {
        *(int32_t *)net_word_at(net, commands[i]) = 0;
    }
}

/* Fires a gate by a rule. */
static void net_fire(struct pcl2_net *net, const pcl2_net_word *gate, const struct net_rule *rule, int32_t index)
{
    net_clear(net, rule->clears);
    net_move_tokens(net, gate, rule, index);
}

/* Tries a gate: the first part that is true is the part. */
static void net_try_gate(struct pcl2_net *net, int32_t index)
{
    const pcl2_net_word *gate = net_record(net, PCL2_NET_GATES, index);
    const pcl2_net_word *permits = gate + 6 + 2 * (gate[0] + gate[1]) + 3 * (gate[2] + gate[3]);
    const pcl2_net_word *at = permits + gate[4];
    if (!net_enabled(net, gate)) {
        return;
    }
    for (int32_t i = 0; i < gate[5]; i++) {
        const struct net_rule rule = net_rule_at(at);
        at = rule.end;
        if (net_satisfied(net, &rule, index)) {
            if (net_rule_room(net, gate, &rule) && net_permitted(net, gate, permits, index)) {
                net_fire(net, gate, &rule, index);
            }
            net_let_go(net, &rule);
            return;
        }
        net_let_go(net, &rule);
    }
}

/* Takes all tokens of a macro's net, and of the macros in it. */
static void net_empty(struct pcl2_net *net)
{
    for (int32_t b = 0; b < net->table[PCL2_NET_N_BOXES]; b++) {
        net->taken[b] = net->box[b];
    }
    for (int32_t i = 0; i < net->table[net->table[PCL2_NET_PARTS]]; i++) {
        if (net_part_record(net, i)[3] != 0) {
            net_empty(net_inside(net, i));
        }
    }
}

/* Empties a macro whose ABORT holds: the token goes to the box that is named. */
static void net_abort_part(struct pcl2_net *net, int32_t part)
{
    const pcl2_net_word *record = net_part_record(net, part), *clears = record + 7 + record[6];
    if (record[3] == 0 || record[4] == 0 || net_left(net, record[3] - 1) <= 0 || !net_run(net, record[4] - 1, 0)) {
        return;
    }
    const int32_t macro = record[3] - 1;
    const pcl2_net_word arc[2] = {record[5], 1};
    if (!net_room(net, arc[0], 1)) {
        return;
    }
    net_clear(net, clears);
    net_empty(net_inside(net, part));
    net_see(net, macro, 0);
    net->taken[macro] = 1;
    net->hold[macro] = PCL2_NET_ON_ITS_WAY;
    net_run_all(net, record + 6, 0);
    net->hold[macro] = PCL2_NET_NOT_HELD;
    net_put(net, macro, arc, 1, 0);
}

static void net_gate_phase(struct pcl2_net *net)
{
    for (int32_t i = 0; i < net->table[net->table[PCL2_NET_PARTS]]; i++) {
        net_abort_part(net, i);
    }
    for (int32_t i = 0; i < net->table[PCL2_NET_N_GATES]; i++) {
        net_try_gate(net, i);
    }
}

/* Commands. */

/* The part that a net is of the one around it, if it is a macro; else NULL. */
static const pcl2_net_word *net_macro_of(const struct pcl2_net *net)
{
    const struct pcl2_net *outer = net->outer;
    for (int32_t i = 0; outer != NULL && i < outer->table[outer->table[PCL2_NET_PARTS]]; i++) {
        const pcl2_net_word *record = net_part_record(outer, i);
        if (outer + record[2] == net) {
            return record[3] != 0 ? record : NULL;
        }
    }
    return NULL;
}

/* Whether a macro's own net lets a token be forced: it has tokens while the macro is marked and no longer, and entry and
 * exit are the macro's own. */
static int32_t net_within_macro(const struct pcl2_net *net, int32_t b, int32_t takes)
{
    const pcl2_net_word *macro = net_macro_of(net);
    int32_t tokens = 0;
    if (macro == NULL) {
        return 1;
    }
    if (b == macro[0] || b == macro[1]) {
        return 0;
    }
    for (int32_t i = 0; i < net->table[PCL2_NET_N_BOXES]; i++) {
        tokens = pcl2_add_i(tokens, net_left(net, i) != 0 || net->filled[i] != 0 ? 1 : 0);
    }
    const int32_t last = tokens == 1 && net_left(net, b) + net->filled[b] == 1;
    return takes ? !last : net_left(net->outer, macro[3] - 1) > 0;
}

/* Fires a gate whose tokens and room are there: by the rule that holds, else by the first. */
static int32_t net_force_gate(struct pcl2_net *net, int32_t index)
{
    const pcl2_net_word *gate = net_record(net, PCL2_NET_GATES, index);
    const pcl2_net_word *rules = gate + 6 + 2 * (gate[0] + gate[1]) + 3 * (gate[2] + gate[3]) + gate[4];
    if (!net_enabled(net, gate)) {
        return 0;
    }
    struct net_rule rule = net_rule_at(rules);
    int32_t holds = net_satisfied(net, &rule, index);
    for (int32_t i = 1; i < gate[5] && !holds; i++) {
        net_let_go(net, &rule);
        rule = net_rule_at(rule.end);
        holds = net_satisfied(net, &rule, index);
    }
    if (!holds) {
        net_let_go(net, &rule);
        rule = net_rule_at(rules);
    }
    const int32_t fits = net_rule_room(net, gate, &rule);
    if (fits) {
        net_fire(net, gate, &rule, index);
    }
    net_let_go(net, &rule);
    return fits;
}

/* Puts a new token into a box that has room. */
static int32_t net_force_put(struct pcl2_net *net, int32_t b)
{
    const pcl2_net_word arc[2] = {(pcl2_net_word)b, 1};
    if (!net_room(net, b, 1) || !net_within_macro(net, b, 0)) {
        return 0;
    }
    net_fresh(net, net_box_record(net, b));
    net_put(net, -1, arc, 1, 0);
    return 1;
}

/* Takes the first token of a box. */
static int32_t net_force_take(struct pcl2_net *net, int32_t b)
{
    const pcl2_net_word *box = net_box_record(net, b);
    if (net_left(net, b) <= 0 || !net_within_macro(net, b, 1)) {
        return 0;
    }
    if (box[0] == PCL2_NET_MACRO) {
        net_empty(net_inside(net, box[8]));
    }
    if (box[0] == PCL2_NET_COUNT) {
        net->taken[b] += 1;
    } else {
        net_remove_token(net, b, net_next_token(net, b, -1));
    }
    return 1;
}

/* The gate phase of a net in manual mode. */
static void net_obey(struct pcl2_net *net)
{
    const pcl2_net_word *modes = net_modes(net);
    for (int32_t which = NET_OPERATED_FIRE; modes != NULL && which <= NET_OPERATED_TAKE; which++) {
        const int32_t number = net_command(net, modes, which);
        const int32_t most = net->table[which == NET_OPERATED_FIRE ? PCL2_NET_N_GATES : PCL2_NET_N_BOXES];
        int32_t obeyed = 0;
        if (number == 0) {
            continue;
        }
        if (number < 1 || number > most) {
            obeyed = 0;
        } else if (which == NET_OPERATED_FIRE) {
            obeyed = net_force_gate(net, net_gates_in_file(modes)[number - 1]);
        } else if (which == NET_OPERATED_PUT) {
            obeyed = net_force_put(net, number - 1);
        } else {
            obeyed = net_force_take(net, number - 1);
        }
        net_record_command(net, obeyed);
    }
}

static void net_commit(struct pcl2_net *net)
{
    for (int32_t b = 0; b < net->table[PCL2_NET_N_BOXES]; b++) {
        if (net->filled[b] != 0) {
            net->since[b] = net->now;
            if (net_box_record(net, b)[0] != PCL2_NET_GENERATION) {
                net->phase[b] = net->by[b] << 2;
            }
        }
        net->box[b] = pcl2_add_i(net->box[b], net->filled[b] - net->taken[b]);
        net->filled[b] = 0;
        net->taken[b] = 0;
        net->used[b] = 0;
    }
}

/* What follows from the marking. */

static void net_active_box(struct pcl2_net *net, int32_t index, const pcl2_net_word *record)
{
    int32_t marked = 0;
    for (int32_t i = 0; i < record[2] && marked == 0; i++) {
        marked = net->box[record[3 + i]] > 0 ? i + 1 : 0;
    }
    if (marked != net->active[index]) {
        net->active[index] = marked;
        net->active_since[index] = net->now;
        pcl2_net_counted(&net->wrote[record[0]]);
    }
    *(int32_t *)net_word_at(net, record[0]) = marked;
    if (record[1] != 0) {
        pcl2_net_counted(&net->wrote[record[1] - 1]);
        *(pcl2_real *)net_word_at(net, record[1] - 1) = pcl2_seconds(net->now - net->active_since[index]);
    }
}

static void net_active_boxes(struct pcl2_net *net)
{
    const pcl2_net_word *at = net->table + net->table[PCL2_NET_ACTIVES];
    const int32_t n = *at++;
    for (int32_t i = 0; i < n; i++) {
        net_active_box(net, i, at);
        at += 3 + at[2];
    }
}

/* The output of BLOCKED: between steps it stays. */
static void net_blocked(struct pcl2_net *net)
{
    const pcl2_net_word *operated = net_operated(net);
    if (operated != NULL && operated[NET_OPERATED_BLOCKED] != 0 && net->mode != PCL2_NET_STEP) {
        const int32_t word = operated[NET_OPERATED_BLOCKED] - 1;
        *(int32_t *)net_word_at(net, word) = net->blocked;
        pcl2_net_counted(&net->wrote[word]);
    }
}

/* Words that a part writes take its value when it wrote it. Its gates come after those of the net around it. */
static void net_part_writes(struct pcl2_net *net, int32_t part)
{
    const struct pcl2_net *inner = net_part_of(net, part);
    const pcl2_net_word *writes = net_part_record(net, part) + 6;
    writes += writes[0] + 1;
    writes += writes[0] + 1;
    for (int32_t i = 0; i < writes[0]; i++) {
        const int32_t output = writes[1 + 2 * i], word = writes[2 + 2 * i];
        const int32_t stops = inner->table[inner->table[PCL2_NET_WORDS] + output] & 2;
        if (inner->wrote[output] != 0 || (inner->switched && stops)) {
            pcl2_real before;
            net_keep(net, word, &before, 0);
            net_keep(net, word, net_word_at(inner, output), 1);
            net_written(net, word, net->table[PCL2_NET_N_GATES] + part, &before);
        }
    }
}

static void net_levels(struct pcl2_net *net)
{
    const pcl2_net_word *at = net->table + net->table[PCL2_NET_LEVELS];
    for (int32_t i = 0; i < net->table[net->table[PCL2_NET_PARTS]]; i++) {
        net_part_writes(net, i);
    }
    const int32_t n = *at++;
    for (int32_t i = 0; i < n; i++) {
        const pcl2_net_word *boxes = at + 1, *parts = boxes + boxes[0] + 1;
        int32_t level = 0;
        for (int32_t j = 1; j <= boxes[0]; j++) {
            level |= net->box[boxes[j]] > 0;
        }
        for (int32_t j = 0; j < parts[0]; j++) {
            level |= *(const int32_t *)net_word_at(net_part_of(net, parts[1 + 2 * j]), parts[2 + 2 * j]) != 0;
        }
        *(int32_t *)net_word_at(net, at[0]) = level;
        at = parts + 2 * parts[0] + 1;
    }
    if (net->mode != PCL2_NET_STOPPED) {
        net_active_boxes(net);
    }
    net_blocked(net);
}

/* A net takes the status of one inside if it has none. */
static void net_hand_out(const struct pcl2_net *net)
{
    if (net->outer != NULL && *net->outer->status == 0) {
        *net->outer->status = *net->status;
    }
}

/* Takes the inputs in. A net inside has the mode and the time of the one around it unless it has a mode of its own. */
static void net_begin(struct pcl2_net *net, int64_t now)
{
    const pcl2_net_word *modes = net_modes(net);
    const int32_t n = net->table[PCL2_NET_N_WORDS];
    *net->status = 0;
    net->blocked = 0;
    net->switched = 0;
    net->now = now;
    net->mode = PCL2_NET_AUTOMATIC;
    if (n != 0) {
        memset(net->wrote, 0, (size_t)n * sizeof *net->wrote);
    }
    if (net->outer != NULL) {
        net_lend(net->outer, net->inputs);
        (void)net->outer->act(net->outer, net->inputs);
        net_release(net->outer, net->inputs);
        net->now = net->outer->now;
        net->mode = net->outer->mode;
    }
    if (modes != NULL) {
        net->now = now - *net->stood;
        net->mode = net_mode(net, modes);
        if (*net->halted) {
            net_swap(net, modes);
        } else if (net->mode == PCL2_NET_STOPPED) {
            net_hold(net, modes);
        }
    }
}

void pcl2_net_scan(struct pcl2_net *nets, int32_t n, int64_t *now, int64_t period)
{
    for (int32_t i = 0; i < n; i++) {
        net_begin(&nets[i], *now);
        if (nets[i].mode != PCL2_NET_STOPPED) {
            net_box_phase(&nets[i]);
        }
    }
    for (int32_t i = 0; i < n; i++) {
        if (nets[i].mode == PCL2_NET_AUTOMATIC) {
            net_gate_phase(&nets[i]);
        } else if (nets[i].mode == PCL2_NET_MANUAL) {
            net_obey(&nets[i]);
        }
    }
    for (int32_t i = 0; i < n; i++) {
        net_commit(&nets[i]);
    }
    for (int32_t i = n - 1; i >= 0; i--) {
        net_levels(&nets[i]);
        net_end(&nets[i], period);
        net_hand_out(&nets[i]);
    }
    *now = *now > INT64_MAX - period ? INT64_MAX : *now + period;
}
