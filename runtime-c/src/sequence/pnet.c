/* Petri nets given by their matrices: one scan, and the state equation. */
#include "pcl2_pnet.h"
#include "pcl2_products.h"

PCL2_KERNEL int32_t pcl2_pnet_check(
    int32_t np, int32_t nt, const int32_t *Bm, const int32_t *Bp, const int32_t *m0, const int32_t *cap, pcl2_real *left)
{
    (void)nt;
    (void)Bm;
    (void)Bp;
    for (int32_t i = 0; i < np; i++) {
        if (cap[i] > 0 && m0[i] > cap[i]) {
            left[0] = (pcl2_real)(i + 1);
            left[1] = (pcl2_real)m0[i];
            return 1;
        }
    }
    return 0;
}

PCL2_KERNEL void pcl2_pnet_init(
    struct pcl2_pnet *self, int32_t np, int32_t nt, const int32_t *Bm, const int32_t *Bp, const int32_t *m0,
    const int32_t *cap, int32_t *m, int32_t *f)
{
    (void)self;
    (void)nt;
    (void)Bm;
    (void)Bp;
    (void)cap;
    (void)f;
    memcpy(m, m0, (size_t)np * sizeof *m);
}

/* The tokens that a transition adds to a place. */
static inline int32_t pcl2_pnet_excess(int32_t takes, int32_t puts)
{
    return puts > takes ? puts - takes : 0;
}

/* Whether the transition whose column begins at Bm and Bp has its tokens and its room. */
static int32_t pcl2_pnet_enabled(
    int32_t np, int32_t nt, const int32_t *Bm, const int32_t *Bp, const int32_t *start, const int32_t *rest,
    const int32_t *room)
{
    for (int32_t i = 0; i < np; i++) {
        const int32_t takes = Bm[i * nt];
        const int32_t puts = Bp[i * nt];
        const int32_t there = takes == puts ? start[i] : rest[i];
        if (there < takes || room[i] < pcl2_pnet_excess(takes, puts)) {
            return 0;
        }
    }
    return 1;
}

static void pcl2_pnet_fire(
    int32_t np, int32_t nt, const int32_t *Bm, const int32_t *Bp, int32_t *rest, int32_t *room, int32_t *m)
{
    for (int32_t i = 0; i < np; i++) {
        const int32_t takes = Bm[i * nt];
        const int32_t puts = Bp[i * nt];
        rest[i] -= takes == puts ? 0 : takes;
        room[i] -= pcl2_pnet_excess(takes, puts);
        m[i] += puts - takes;
    }
}

PCL2_KERNEL void pcl2_pnet(
    struct pcl2_pnet *self, int32_t np, int32_t nt, const int32_t *cond, int32_t rst, const int32_t *Bm,
    const int32_t *Bp, const int32_t *m0, const int32_t *cap, int32_t *start, int32_t *rest, int32_t *room, int32_t *m,
    int32_t *f)
{
    self->status = 0;
    if (rst != 0) {
        memcpy(m, m0, (size_t)np * sizeof *m);
        memset(f, 0, (size_t)nt * sizeof *f);
        return;
    }
    for (int32_t i = 0; i < np; i++) {
        const int32_t most = cap[i] > 0 ? cap[i] : INT32_MAX;
        start[i] = m[i];
        rest[i] = m[i];
        room[i] = most > m[i] ? most - m[i] : 0;
    }
    for (int32_t j = 0; j < nt; j++) {
        f[j] = cond[j] != 0 && pcl2_pnet_enabled(np, nt, &Bm[j], &Bp[j], start, rest, room);
        if (f[j] != 0) {
            pcl2_pnet_fire(np, nt, &Bm[j], &Bp[j], rest, room, m);
        }
    }
}

PCL2_KERNEL void pcl2_pnfire(
    struct pcl2_pnfire *self, const int32_t *x, const int32_t *B, const int32_t *f, int32_t np, int32_t nt, int32_t *y)
{
    self->status = 0;
    for (int32_t i = 0; i < np; i++) {
        y[i] = pcl2_products(x[i], &B[i * nt], f, 1, nt);
        if (y[i] < 0) {
            self->status = 1;
        }
    }
}
