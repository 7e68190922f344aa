#include "harness/library/known.h"

#include <limits.h>
#include <pthread.h>
#include <string.h>

#include "harness/study/study.h"

static pthread_mutex_t hdf5 = PTHREAD_MUTEX_INITIALIZER;
static struct {
    H5E_auto2_t print;
    void *context;
} host;                      /* what it wants told of HDF5's errors */
static char place[PATH_MAX]; /* "": where they usually are */

void known_hold(void)
{
    pthread_mutex_lock(&hdf5);
}

void known_let_go(void)
{
    pthread_mutex_unlock(&hdf5);
}

/* HDF5 says nothing of its errors, until speak. */
static void hush(void)
{
    H5Eget_auto2(H5E_DEFAULT, &host.print, &host.context);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

static void speak(void)
{
    H5Eset_auto2(H5E_DEFAULT, host.print, host.context);
}

void known_lock(void)
{
    known_hold();
    hush();
}

void known_unlock(void)
{
    speak();
    known_let_go();
}

static void place_now(char path[PATH_MAX])
{
    if (place[0] != '\0')
        memcpy(path, place, PATH_MAX);
    else
        data_place_truths(path);
}

status known_read_held(const case_type *type, truths *out, fault *f)
{
    char path[PATH_MAX];
    place_now(path);
    hush();
    const status outcome =
        type != NULL ? truths_read_case(path, type, out, f) : truths_read_rules(path, out, f);
    speak();
    return outcome;
}

status known_read(const case_type *type, truths *out, fault *f)
{
    known_hold();
    const status outcome = known_read_held(type, out, f);
    known_let_go();
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
