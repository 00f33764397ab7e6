/* The process image and the plant: a table of physical points, latched before a step and delivered after it.
 *
 * The table NAME_io comes from [io] of the project file. A board port supplies pcl2_port_read and pcl2_port_write; a
 * user with I/O of his own leaves table and port out, and writes self->in and reads self->out himself. */
#ifndef PCL2_IO_H
#define PCL2_IO_H

#include "pcl2.h"

/* One physical point and the word of the instance that it is bound to. */
struct pcl2_io_point {
    const char *point;  /* the physical point, as in [io] */
    const char *name;   /* the word: a named input or output, or an address such as ain(0,1,1) */
    uint32_t offset;    /* of the word in the instance, bytes */
    uint8_t to_plant;   /* 0: latched before a step; 1: delivered after it */
    uint8_t whole;      /* 0: a real; 1: an int32_t */
    uint8_t hold;       /* a bad sample is held instead of handed on */
    uint8_t fails;      /* a bad value is replaced by fail instead of left out */
    pcl2_real gain;     /* word = gain raw + bias; never 0 */
    pcl2_real bias;
    pcl2_real fail;     /* the fail-safe value, in the word's unit */
};

/* The board's part. Reads one point in its raw unit; 0: done, else the sample is bad. */
int pcl2_port_read(const struct pcl2_io_point *point, pcl2_real *raw);

/* Writes one point in its raw unit; 0: done. */
int pcl2_port_write(const struct pcl2_io_point *point, pcl2_real raw);

/* Reads all inputs into the instance. Returns the number of bad samples. */
int32_t pcl2_latch(void *instance, const struct pcl2_io_point *points, int32_t count);

/* Writes all outputs from the instance; a non-finite value never reaches the plant. Returns the number of points that
 * were held, failed safe, or could not be written. */
int32_t pcl2_deliver(const void *instance, const struct pcl2_io_point *points, int32_t count);

#endif
