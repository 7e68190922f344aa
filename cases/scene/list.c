#include "cases/scene/list.h"

#include <stdlib.h>
#include <string.h>

/* Lists double when their count is a power of two. */
int scene_grow(scene *s, void *list, int *count, size_t size)
{
    void *entries;
    memcpy(&entries, list, sizeof entries);
    const int n = *count;
    if ((n & (n - 1)) == 0) {
        void *larger = realloc(entries, (n == 0 ? 1 : 2 * (size_t)n) * size);
        if (larger == NULL) {
            s->out_of_memory = 1;
            return SCENE_NONE;
        }
        entries = larger;
        memcpy(list, &entries, sizeof entries);
    }
    memset((char *)entries + (size_t)n * size, 0, size);
    return (*count)++;
}

double *scene_copy(scene *s, int n, const double from[])
{
    double *to = malloc((size_t)(n > 0 ? n : 1) * sizeof *to);
    if (to == NULL)
        s->out_of_memory = 1;
    else if (n > 0)
        memcpy(to, from, (size_t)n * sizeof *to);
    return to;
}
