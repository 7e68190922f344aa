/* Memory that is given back all at once: what a scene file is made of. */
#ifndef BEAMWORK_ARENA_H
#define BEAMWORK_ARENA_H

#include <stddef.h>

typedef struct arena {
    struct arena_block *block;
    size_t used, total; /* bytes: of the first block; of all */
    int failed;         /* 1: memory, or the share of it that a file may take, ran out */
} arena;

/* Zeroed and aligned for every type; NULL when memory ran out, which `failed` keeps. {0} is an
 * empty arena. */
void *arena_take(arena *a, size_t size);
/* The first `length` bytes of a text, and a zero. */
const char *arena_copy(arena *a, const char *text, size_t length);
/* Room for one more entry in a list of `count`: the list, or a copy of it with twice the room; NULL
 * when memory ran out. */
void *arena_grow(arena *a, void *list, int count, size_t size);
void arena_free(arena *a);

#endif
