/* Instructions of a step on the mps2-an386 board under QEMU with -icount shift=0: every instruction takes a virtual
 * nanosecond, and the SysTick timer runs from the 25 MHz clock, so it ticks once in 40 instructions. */
#include <stdint.h>
#include <stdio.h>

#include "kept_model.h"
#include "product4.h"

#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)

enum { TURNS = 20000, INSTRUCTIONS_A_TICK = 40, SYST_MASK = 0xFFFFFF };

static kept_model control;
static product4 product;

static void gpc(void)
{
    kept_model_step(&control);
}

static void mulmat(void)
{
    product4_step(&product);
}

static void nothing(void)
{
    __asm__ volatile("");
}

static uint32_t ticks(void (*volatile step)(void))
{
    SYST_CVR = 0;
    const uint32_t start = SYST_CVR;
    for (int i = 0; i < TURNS; i++) {
        step();
    }
    return (start - SYST_CVR) & SYST_MASK;
}

/* In tenths, since this printf knows no reals here. */
static void print(const char *name, void (*step)(void))
{
    const uint32_t more = ticks(step) - ticks(nothing);
    const uint32_t tenths = (uint32_t)((uint64_t)more * INSTRUCTIONS_A_TICK * 10u / TURNS);
    printf("%s %lu.%lu\n", name, (unsigned long)(tenths / 10u), (unsigned long)(tenths % 10u));
}

int main(void)
{
    SYST_RVR = SYST_MASK;
    SYST_CSR = 5; /* on, from the processor's clock, no interrupt */
    kept_model_init(&control);
    control.in.w = 0.2f;
    control.in.y = 0.1f;
    kept_model_step(&control);
    product4_init(&product);
    print("gpc", gpc);
    print("product", mulmat);
    return 0;
}
