/* Vote of m out of n, degraded by bad signals. */
#include "pcl2_onbad.h"
#include "pcl2_vote.h"

/* The values of degrade. */
enum { VOTE_LOWER = 0, VOTE_KEEP = 1 };

PCL2_KERNEL void pcl2_vote_init(struct pcl2_vote *self, int32_t n, int32_t m, pcl2_real lim, pcl2_real db,
                                int32_t side, int32_t degrade, int32_t onbad, int32_t *beyond)
{
    (void)self;
    (void)n;
    (void)m;
    (void)lim;
    (void)db;
    (void)side;
    (void)degrade;
    (void)onbad;
    (void)beyond;
}

/* How many votes are needed when some of the signals are bad. */
static inline int32_t pcl2_vote_needed(int32_t m, int32_t good, int32_t bad, int32_t degrade)
{
    if (degrade == VOTE_LOWER) {
        return m - bad > 1 ? m - bad : 1;
    }
    return degrade == VOTE_KEEP ? (m < good ? m : good) : m - bad;
}

PCL2_KERNEL void pcl2_vote(struct pcl2_vote *self, const pcl2_real *x, int32_t n, int32_t m, pcl2_real lim,
                           pcl2_real db, int32_t side, int32_t degrade, int32_t onbad, int32_t *beyond)
{
    const pcl2_real sign = side == 0 ? PCL2_R(1.0) : PCL2_R(-1.0);
    int32_t votes = 0;
    int32_t good = 0;
    for (int32_t i = 0; i < n; i++) {
        /* A bad signal starts anew, without the band. */
        const pcl2_real limit = sign * lim - (beyond[i] != 0 ? db : PCL2_R(0.0));
        const int32_t is_good = !pcl2_is_bad(x[i]);
        beyond[i] = is_good & (sign * x[i] > limit);
        votes += beyond[i];
        good += is_good;
    }
    self->votes = votes;
    self->good = good;
    self->status = good < n;
    if (good > 0 || degrade > VOTE_KEEP) {
        self->q = votes >= pcl2_vote_needed(m, good, n - good, degrade);
    } else {
        self->q = pcl2_on_bad(onbad, self->q);
    }
}
