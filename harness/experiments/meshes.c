#include "harness/experiments/meshes.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

status meshes_parse(const char *list, int most, int mesh[], int *count, fault *f)
{
    for (const char *at = list;; at++) {
        const int length = (int)strcspn(at, ",");
        char *end;
        if (*count == most)
            return fault_set(f, STATUS_REFUSED, "too many meshes; give at most %d", most);
        errno = 0;
        const long value = strtol(at, &end, 10);
        if (end == at || end != at + length || errno != 0 || value < 1 || value > MESHES_FINEST)
            return fault_set(f, STATUS_REFUSED,
                             "number of elements '%.*s': give a whole number from 1 to %d",
                             length < 40 ? length : 40, at, MESHES_FINEST);
        mesh[(*count)++] = (int)value;
        at = end;
        if (*at == '\0')
            return STATUS_OK;
    }
}
