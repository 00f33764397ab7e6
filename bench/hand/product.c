#include "product.h"

void hand_product4(const pcl2_real *a, const pcl2_real *b, pcl2_real *m)
{
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            pcl2_real sum = 0;
            for (int k = 0; k < 4; k++) {
                sum += a[4 * i + k] * b[4 * k + j];
            }
            m[4 * i + j] = sum;
        }
    }
}

void hand_product8(const pcl2_real *a, const pcl2_real *b, pcl2_real *m)
{
    for (int i = 0; i < 8; i++) {
        for (int j = 0; j < 8; j++) {
            pcl2_real sum = 0;
            for (int k = 0; k < 8; k++) {
                sum += a[8 * i + k] * b[8 * k + j];
            }
            m[8 * i + j] = sum;
        }
    }
}
