/* Products of square matrices, row by row: the textbook's three loops. */
#ifndef HAND_PRODUCT_H
#define HAND_PRODUCT_H
#include "pcl2.h"

void hand_product4(const pcl2_real *a, const pcl2_real *b, pcl2_real *m);
void hand_product8(const pcl2_real *a, const pcl2_real *b, pcl2_real *m);
#endif
