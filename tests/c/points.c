/* The program of tests/projects/points over a board of memory: prints what reaches the plant while points break. */
#include "loop.h"
#include "port.h"

#include <stdio.h>

static loop controller;
static struct pcl2_memory_point board[] = {{"LT101", 12.0, 0}, {"TT7", 50.0, 0}, {"FV104", 0.0, 0}, {"FQ1", 0.0, 0}};

static void scan(const char *what)
{
    const int32_t count = (int32_t)(sizeof loop_io / sizeof loop_io[0]);
    const int32_t bad = pcl2_latch(&controller, loop_io, count);
    loop_step(&controller);
    const int32_t troubled = pcl2_deliver(&controller, loop_io, count);
    printf("%s: bad %d, troubled %d, h %g, FV104 %g, FQ1 %g, faults %u\n", what, (int)bad, (int)troubled, controller.in.h,
           board[2].raw, board[3].raw, (unsigned)controller.health.faults);
}

int main(void)
{
    loop_init(&controller);
    pcl2_memory_port(board, 4);
    scan("good");
    board[0].raw = 20.0;
    scan("level up");
    board[1].broken = 1;
    scan("temperature broken");
    board[0].broken = 1;
    scan("level broken too");
    board[0].broken = board[1].broken = 0;
    scan("mended");
    board[3].broken = 1;
    scan("valve broken");
    return 0;
}
