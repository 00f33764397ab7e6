/* Functions given by points: straight lines between them, one variable or two. */
#include "pcl2_fgen.h"

/* The largest i up to n - 2 with grid[i] <= x, or 0: the line from point i to point i + 1 is the one for x. */
static int32_t pcl2_fgen_line(int32_t n, const pcl2_real *grid, pcl2_real x)
{
    int32_t low = 0;
    int32_t high = n - 1;
    while (high - low > 1) {
        const int32_t middle = (low + high) / 2;
        if (x >= grid[middle]) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static pcl2_real pcl2_fgen_clamped(int32_t n, const pcl2_real *grid, pcl2_real x)
{
    return x < grid[0] ? grid[0] : x > grid[n - 1] ? grid[n - 1] : x;
}

/* The number of the first point that is not above the one before it, from 1, with its value; 0: there is none. */
static int32_t pcl2_fgen_falls(int32_t n, const pcl2_real *grid, pcl2_real *left)
{
    for (int32_t i = 1; i < n; i++) {
        if (!(grid[i] > grid[i - 1])) {
            left[0] = (pcl2_real)(i + 1);
            left[1] = grid[i];
            return i + 1;
        }
    }
    return 0;
}

PCL2_KERNEL int32_t pcl2_fgen_check(int32_t n, const pcl2_real *gx, const pcl2_real *gy, int32_t ext, pcl2_real *left)
{
    (void)gy;
    (void)ext;
    return pcl2_fgen_falls(n, gx, left) != 0;
}

/* An end point's own value is met exactly: the line through it starts there. */
PCL2_KERNEL void pcl2_fgen(
    struct pcl2_fgen *self, pcl2_real x, int32_t n, const pcl2_real *gx, const pcl2_real *gy, int32_t ext)
{
    const pcl2_real place = ext != 0 ? x : pcl2_fgen_clamped(n, gx, x);
    const int32_t i = pcl2_fgen_line(n, gx, place);
    const pcl2_real slope = (gy[i + 1] - gy[i]) / (gx[i + 1] - gx[i]);
    self->y = pcl2_is_bad(x)      ? pcl2_bad()
              : place == gx[i + 1] ? gy[i + 1]
                                   : gy[i] + (place - gx[i]) * slope;
}

PCL2_KERNEL int32_t pcl2_fgen2_check(
    int32_t nx, int32_t ny, const pcl2_real *gx, const pcl2_real *gy, const pcl2_real *z, pcl2_real *left)
{
    (void)z;
    return pcl2_fgen_falls(nx, gx, left) != 0 ? 1 : pcl2_fgen_falls(ny, gy, left) != 0 ? 2 : 0;
}

PCL2_KERNEL void pcl2_fgen2(
    struct pcl2_fgen2 *self, pcl2_real x, pcl2_real y, int32_t nx, int32_t ny, const pcl2_real *gx,
    const pcl2_real *gy, const pcl2_real *z)
{
    const pcl2_real row = pcl2_fgen_clamped(nx, gx, x);
    const pcl2_real column = pcl2_fgen_clamped(ny, gy, y);
    const int32_t i = pcl2_fgen_line(nx, gx, row);
    const int32_t j = pcl2_fgen_line(ny, gy, column);
    const pcl2_real a = (row - gx[i]) / (gx[i + 1] - gx[i]);
    const pcl2_real b = (column - gy[j]) / (gy[j + 1] - gy[j]);
    const pcl2_real *const near = &z[i * ny + j];
    const pcl2_real *const far = near + ny;
    const pcl2_real low = (1 - b) * near[0] + b * near[1];
    const pcl2_real high = (1 - b) * far[0] + b * far[1];
    self->w = pcl2_is_bad(x) || pcl2_is_bad(y) ? pcl2_bad() : (1 - a) * low + a * high;
}
