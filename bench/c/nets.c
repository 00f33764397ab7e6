/* Scans of a generated net against a table player with guard functions: idle ones, and ones in which gates fire. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare.h"
#include "hand/net_table.h"
#include "plant.h"

#include "peer.h" /* peer_table, peer_tokens, INPUTS, OUTPUTS, MOVING */

static plant idle, busy;
static struct net_player peer_idle, peer_busy;
static int32_t inputs[INPUTS];
static int32_t phase;

/* All inputs are ints, one after the other. */
static void set(plant *net, const int32_t *values)
{
    memcpy(&net->in, values, INPUTS * sizeof *values);
}

/* The inputs of moving loops change in each scan. */
static void next_inputs(int32_t *values)
{
    phase = !phase;
    for (int i = 0; i < MOVING; i++) {
        values[i] = phase;
    }
}

static void run_idle(long n)
{
    while (n-- > 0) {
        plant_step(&idle);
    }
}

static void run_peer_idle(long n)
{
    while (n-- > 0) {
        net_player_step(&peer_idle, inputs);
    }
}

static void run_busy(long n)
{
    while (n-- > 0) {
        next_inputs((int32_t *)&busy.in);
        plant_step(&busy);
    }
}

static void run_peer_busy(long n)
{
    static int32_t values[INPUTS];
    while (n-- > 0) {
        next_inputs(values);
        net_player_step(&peer_busy, values);
    }
}

/* Ends the program where the two differ; returns the gates that fired. */
static long agree(void)
{
    long fired = 0;
    uint32_t dice = 1;
    for (int scan = 0; scan < 20000; scan++) {
        int32_t values[INPUTS];
        for (int i = 0; i < INPUTS; i++) {
            dice = dice * 1664525 + 1013904223;
            values[i] = scan < 10000 ? (int32_t)(dice >> 31) : i < MOVING && (scan & 1);
        }
        set(&busy, values);
        plant_step(&busy);
        const int32_t now = net_player_step(&peer_busy, values);
        fired += scan >= 15000 ? now : 0;
        if (memcmp(&busy.out, peer_busy.outputs, OUTPUTS * sizeof(int32_t)) != 0) {
            fprintf(stderr, "outputs differ in scan %d\n", scan);
            exit(1);
        }
    }
    return fired;
}

int main(int argc, char **argv)
{
    const struct contender all[] = {
        {"idle", run_idle}, {"peer_idle", run_peer_idle}, {"busy", run_busy}, {"peer_busy", run_peer_busy}};
    plant_init(&idle);
    plant_init(&busy);
    net_player_init(&peer_idle, &peer_table, peer_tokens);
    net_player_init(&peer_busy, &peer_table, peer_tokens);
    printf("fired %.4f\n", (double)agree() / 5000.0);
    run_idle(1000);
    run_peer_idle(1000);
    compare(all, 4, argc > 1 ? atoi(argv[1]) : 9);
    return 0;
}
