#include "harness/formulations/formulations.h"

#include <gsl/gsl_version.h>
#include <hdf5.h>
#include <jansson.h>
#include <klu.h>
#include <lapacke.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static void read_processor(char *out, int size)
{
    char line[256];
    FILE *cpu = fopen("/proc/cpuinfo", "r");
    snprintf(out, (size_t)size, "unknown");
    while (cpu != NULL && fgets(line, sizeof line, cpu) != NULL)
        if (strncmp(line, "model name", 10) == 0 && strchr(line, ':') != NULL) {
            snprintf(out, (size_t)size, "%.*s", (int)strcspn(strchr(line, ':') + 2, "\n"),
                     strchr(line, ':') + 2);
            break;
        }
    if (cpu != NULL)
        fclose(cpu);
}

const char *environment_version(void)
{
    return BEAMWORK_VERSION;
}

environment environment_now(int threads)
{
    environment e = {.version = environment_version(),
                     .released = BEAMWORK_RELEASED,
                     .commit = BEAMWORK_COMMIT,
                     .flags = BEAMWORK_CFLAGS,
                     .threads = threads};
#if defined(__clang__)
    e.compiler = "clang " __clang_version__;
#else
    e.compiler = "gcc " __VERSION__;
#endif
    unsigned major = 0, minor = 0, release = 0;
    int lapack[3] = {0};
    H5get_libversion(&major, &minor, &release);
    LAPACK_ilaver(&lapack[0], &lapack[1], &lapack[2]);
    snprintf(e.libraries, sizeof e.libraries,
             "GSL %s, LAPACK %d.%d.%d, HDF5 %u.%u.%u, SuiteSparse %d.%d.%d, jansson %s",
             gsl_version, lapack[0], lapack[1], lapack[2], major, minor, release,
             SUITESPARSE_MAIN_VERSION, SUITESPARSE_SUB_VERSION, SUITESPARSE_SUBSUB_VERSION,
             jansson_version_str());
    read_processor(e.processor, sizeof e.processor);
    const time_t now = time(NULL);
    struct tm utc;
    gmtime_r(&now, &utc);
    strftime(e.clock, sizeof e.clock, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return e;
}
