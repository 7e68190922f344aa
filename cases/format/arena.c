#include "cases/format/arena.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK = 1 << 10, ALIGNMENT = 16 };
/* A file of the largest size needs less. */
static const size_t most = (size_t)1 << 28;

typedef struct arena_block {
    struct arena_block *next;
    size_t size;
    _Alignas(ALIGNMENT) char bytes[];
} arena_block;

static void *add_block(arena *a, size_t size)
{
    const size_t room = size > BLOCK ? size : BLOCK;
    arena_block *b = a->total + room > most ? NULL : calloc(1, sizeof *b + room);
    if (b == NULL) {
        a->failed = 1;
        return NULL;
    }
    b->next = a->block;
    b->size = room;
    a->block = b;
    a->used = size;
    a->total += room;
    return b->bytes;
}

void *arena_take(arena *a, size_t size)
{
    const size_t rounded = (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (a->block == NULL || a->used + rounded > a->block->size)
        return add_block(a, rounded);
    void *taken = a->block->bytes + a->used;
    a->used += rounded;
    return taken;
}

const char *arena_copy(arena *a, const char *text, size_t length)
{
    char *copy = arena_take(a, length + 1);
    if (copy != NULL)
        memcpy(copy, text, length);
    return copy;
}

void *arena_grow(arena *a, void *list, int count, size_t size)
{
    if ((count & (count - 1)) != 0)
        return list;
    void *larger = arena_take(a, (count == 0 ? 1 : 2 * (size_t)count) * size);
    if (larger != NULL && count > 0)
        memcpy(larger, list, (size_t)count * size);
    return larger;
}

void arena_free(arena *a)
{
    while (a->block != NULL) {
        arena_block *next = a->block->next;
        free(a->block);
        a->block = next;
    }
    memset(a, 0, sizeof *a);
}
