/* Times several ways of doing the same thing, in turn, so that what disturbs one disturbs all. */
#ifndef COMPARE_H
#define COMPARE_H

struct contender {
    const char *name;
    void (*run)(long n); /* does it n times */
};

/* Prints a line for each: its name, then nanoseconds a turn in every round. */
void compare(const struct contender *all, int count, int rounds);

/* Does nothing; not inlined. */
void compare_nothing(void *self);
#endif
