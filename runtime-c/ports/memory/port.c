/* A board port over memory: points are found by name in a table of raw values. For tests, and the least that a port
 * has to do: a real one replaces the table by the board's converters and pins. */
#include "port.h"

static struct pcl2_memory_point *points;
static int32_t count;

void pcl2_memory_port(struct pcl2_memory_point *table, int32_t length)
{
    points = table;
    count = length;
}

static struct pcl2_memory_point *find(const char *name)
{
    for (int32_t i = 0; i < count; i++) {
        if (strcmp(points[i].name, name) == 0) {
            return &points[i];
        }
    }
    return NULL;
}

int pcl2_port_read(const struct pcl2_io_point *point, pcl2_real *raw)
{
    const struct pcl2_memory_point *const found = find(point->point);
    if (found == NULL || found->broken != 0) {
        return 1;
    }
    *raw = found->raw;
    return 0;
}

int pcl2_port_write(const struct pcl2_io_point *point, pcl2_real raw)
{
    struct pcl2_memory_point *const found = find(point->point);
    if (found == NULL || found->broken != 0) {
        return 1;
    }
    found->raw = raw;
    return 0;
}
