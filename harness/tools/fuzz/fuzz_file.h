/* A file in memory with given bytes, for libraries that open files by name. */
#ifndef BEAMWORK_FUZZ_FILE_H
#define BEAMWORK_FUZZ_FILE_H

#include <fcntl.h>
#include <unistd.h>

#include "harness/tools/fuzz/fuzz.h"

static char fuzz_path[64];

static inline void fuzz_unlink(void)
{
    unlink(fuzz_path);
}

/* Writes the bytes and returns the path of the file. The next call overwrites the file. The file is
 * removed when the program ends. */
static inline const char *fuzz_file(const uint8_t *data, size_t size)
{
    static int file = -1;
    if (file < 0) {
        snprintf(fuzz_path, sizeof fuzz_path, "/dev/shm/beamwork-fuzz-%ld", (long)getpid());
        file = open(fuzz_path, O_RDWR | O_CREAT | O_TRUNC, 0600);
        fuzz_must(file >= 0 && atexit(fuzz_unlink) == 0, "there is memory");
    }
    fuzz_must(ftruncate(file, 0) == 0 && pwrite(file, data, size, 0) == (ssize_t)size,
              "there is memory");
    return fuzz_path;
}

#endif
