/* Masks of decimal digits: one digit for each signal, the first signal's on the left; 0 off, 1 on, 2 either. */
#ifndef PCL2_MASKS_H
#define PCL2_MASKS_H

#include "pcl2.h"

/* The value of a digit that stands for either. */
#define PCL2_MASK_EITHER 2

/* Whether a mask that is not negative has no digit above the highest. */
static inline int32_t pcl2_mask_is_legal(int32_t mask, int32_t highest)
{
    while (mask > 0 && mask % 10 <= highest) {
        mask /= 10;
    }
    return mask == 0;
}

/* Whether n signals, each 0 or not, are as the mask wants them. */
static inline int32_t pcl2_mask_agrees(int32_t mask, const int32_t *x, int32_t n)
{
    for (int32_t i = n - 1; i >= 0; i--) {
        const int32_t wanted = mask % 10;
        if (wanted != PCL2_MASK_EITHER && wanted != (x[i] != 0)) {
            return 0;
        }
        mask /= 10;
    }
    return 1;
}

#endif
