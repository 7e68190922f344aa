#include "harness/record/output.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

status output_temporary(const char *path, char *temporary, int size, fault *f)
{
    const int length = snprintf(temporary, (size_t)size, "%s.part%ld", path, (long)getpid());
    return length < size ? STATUS_OK : fault_set(f, STATUS_FAULT, "%.60s...: the path is too long", path);
}

status output_open(const char *path, output *out, fault *f)
{
    memset(out, 0, sizeof *out);
    if (strlen(path) >= sizeof out->path)
        return fault_set(f, STATUS_FAULT, "%.60s...: the path is too long", path);
    snprintf(out->path, sizeof out->path, "%s", path);
    const status named = output_temporary(path, out->temporary, sizeof out->temporary, f);
    if (named != STATUS_OK)
        return named;
    out->stream = fopen(out->temporary, "w");
    return out->stream != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "%.200s: cannot be written (%s); choose another place", path, strerror(errno));
}

void output_discard(output *out)
{
    if (out->stream != NULL)
        fclose(out->stream);
    out->stream = NULL;
    unlink(out->temporary);
}

status output_close(output *out, fault *f)
{
    const int bad =
        ferror(out->stream) | (fflush(out->stream) != 0) | (fsync(fileno(out->stream)) != 0 && errno != EINVAL && errno != EROFS);
    const int closed = fclose(out->stream);
    out->stream = NULL;
    if (bad || closed != 0 || rename(out->temporary, out->path) != 0) {
        const char *why = strerror(errno);
        unlink(out->temporary);
        return fault_set(f, STATUS_FAULT, "%.200s: cannot be written (%s); nothing was left", out->path, why);
    }
    return STATUS_OK;
}

status output_try(const char *path, fault *f)
{
    output probe;
    if (path == NULL)
        return STATUS_OK;
    const status opened = output_open(path, &probe, f);
    if (opened == STATUS_OK)
        output_discard(&probe);
    return opened;
}
