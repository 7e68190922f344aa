/* Handles of HDF5. */
#ifndef BEAMWORK_HANDLES_H
#define BEAMWORK_HANDLES_H

#include <hdf5.h>

/* Closes those that are open, in this order, whatever they are of: a data set, an attribute, a
 * type, a space. */
static inline void handles_close(int count, const hid_t handle[])
{
    for (int i = 0; i < count; i++)
        if (handle[i] >= 0)
            H5Idec_ref(handle[i]);
}

#endif
