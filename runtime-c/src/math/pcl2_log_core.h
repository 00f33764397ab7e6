/* What log, log10, log1p and pow share: the natural logarithm as a pair, with a table of reciprocals after Tang,
 * ACM Trans. Math. Softw. 16, 1990. */
#ifndef PCL2_LOG_CORE_H
#define PCL2_LOG_CORE_H

#include "pcl2_pair.h"

/* ln(x + rest) with a relative error below 2^-66 (2^-33): x positive, finite; |rest| at most half a last place of x,
 * 0 for a subnormal x. */
struct pcl2_pair pcl2_log_pair(pcl2_real x, pcl2_real rest);

#endif
