/* Latching and delivering the process image. */
#include "pcl2_io.h"

static int32_t rounded(pcl2_real value)
{
    const pcl2_real limit = PCL2_R(2147483648.0);
    const pcl2_real nearest = value < PCL2_R(0.0) ? value - PCL2_R(0.5) : value + PCL2_R(0.5);
    if (nearest >= limit) {
        return INT32_MAX;
    }
    if (nearest <= -limit) {
        return INT32_MIN;
    }
    return (int32_t)nearest;
}

static int32_t latch_one(char *instance, const struct pcl2_io_point *point)
{
    pcl2_real raw = PCL2_R(0.0);
    const int unread = pcl2_port_read(point, &raw);
    const pcl2_real word = unread != 0 ? pcl2_bad() : point->gain * raw + point->bias;
    const int32_t bad = pcl2_is_bad(word);
    if (point->whole != 0) {
        const int32_t whole = bad ? 0 : rounded(word);
        if (!bad) {
            memcpy(instance + point->offset, &whole, sizeof whole);
        }
    } else if (!bad || point->hold == 0) {
        memcpy(instance + point->offset, &word, sizeof word);
    }
    return bad;
}

int32_t pcl2_latch(void *instance, const struct pcl2_io_point *points, int32_t count)
{
    int32_t bad = 0;
    for (int32_t i = 0; i < count; i++) {
        if (points[i].to_plant == 0) {
            bad += latch_one(instance, &points[i]);
        }
    }
    return bad;
}

static int32_t deliver_one(const char *instance, const struct pcl2_io_point *point)
{
    pcl2_real word;
    if (point->whole != 0) {
        int32_t whole;
        memcpy(&whole, instance + point->offset, sizeof whole);
        word = (pcl2_real)whole;
    } else {
        memcpy(&word, instance + point->offset, sizeof word);
    }
    const int32_t bad = pcl2_is_bad(word);
    if (bad && point->fails == 0) {
        return 1;
    }
    const pcl2_real raw = ((bad ? point->fail : word) - point->bias) / point->gain;
    return (pcl2_port_write(point, raw) != 0 || bad) ? 1 : 0;
}

int32_t pcl2_deliver(const void *instance, const struct pcl2_io_point *points, int32_t count)
{
    int32_t troubled = 0;
    for (int32_t i = 0; i < count; i++) {
        if (points[i].to_plant != 0) {
            troubled += deliver_one(instance, &points[i]);
        }
    }
    return troubled;
}
