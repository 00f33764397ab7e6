/* Start of a program on an MPS2 board under QEMU: vectors, then the C library's own start, which gets
 * arguments, files and exit from the emulator by semihosting. */
#include <stdint.h>
#include <string.h>

extern char __stack[], __data_load[], __data_start[], __data_end[];
extern void _start(void);
void pcl2_reset(void);

void pcl2_reset(void)
{
    /* coprocessors 10 and 11: the floating-point unit */
    volatile uint32_t *const cpacr = (volatile uint32_t *)0xE000ED88u;
    *cpacr |= 0xFu << 20;
    __asm__ volatile("dsb\n isb");
    memcpy(__data_start, __data_load, (size_t)(__data_end - __data_start));
    _start();
}

__attribute__((section(".vectors"), used)) static const struct {
    char *stack;
    void (*entry[15])(void);
} vectors = {__stack, {pcl2_reset}};
