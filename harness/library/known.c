#include "harness/library/known.h"

#include <limits.h>
#include <pthread.h>
#include <string.h>

#include "harness/truth/data_place.h"

static pthread_mutex_t hdf5 = PTHREAD_MUTEX_INITIALIZER;
static struct {
    H5E_auto2_t print;
    void *context;
} host;                      /* what it wants told of HDF5's errors */
static char place[PATH_MAX]; /* "": where they usually are */

void known_lock(void)
{
    pthread_mutex_lock(&hdf5);
    H5Eget_auto2(H5E_DEFAULT, &host.print, &host.context);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

void known_unlock(void)
{
    H5Eset_auto2(H5E_DEFAULT, host.print, host.context);
    pthread_mutex_unlock(&hdf5);
}

static void place_now(char path[PATH_MAX])
{
    if (place[0] != '\0')
        memcpy(path, place, PATH_MAX);
    else
        data_place_truths(path);
}

status known_read(const case_type *type, truths *out, fault *f)
{
    char path[PATH_MAX];
    place_now(path);
    known_lock();
    const status outcome =
        type != NULL ? truths_read_case(path, type, out, f) : truths_read_rules(path, out, f);
    known_unlock();
    return outcome;
}

status known_read_all(truths *out, fault *f)
{
    char path[PATH_MAX];
    place_now(path);
    known_lock();
    const status outcome = truths_read(path, out, f);
    known_unlock();
    return outcome;
}

status known_place(const char *path, fault *f)
{
    truths t;
    const size_t length = path != NULL ? strlen(path) : 0;
    if (length >= PATH_MAX)
        return fault_set(f, STATUS_REFUSED, "truths: the path is too long; give a shorter one");
    memcpy(place, path != NULL ? path : "", length + 1);
    const status outcome = known_read_all(&t, f);
    if (outcome == STATUS_OK)
        truths_free(&t);
    else
        place[0] = '\0';
    return outcome;
}
