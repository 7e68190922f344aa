#include "harness/study/truth_index.h"

#include <stdlib.h>
#include <string.h>

static int is_of(const truth *row, const case_type *type, const char *quantity)
{
    return row->type == type && strcmp(row->quantity, quantity) == 0;
}

/* FNV-1a of the quantity, begun with the case. */
static uint64_t hash_of(const case_type *type, const char *quantity)
{
    uint64_t hash = 14695981039346656037ULL ^ (uint64_t)(uintptr_t)type;
    for (const char *c = quantity; *c != '\0'; c++)
        hash = (hash ^ (unsigned char)*c) * 1099511628211ULL;
    return hash;
}

/* Where the first row of the case and quantity stands, or would stand. */
static int place_of(const truths *t, const case_type *type, const char *quantity)
{
    int at = (int)(hash_of(type, quantity) % (uint64_t)t->places);
    while (t->first[at] >= 0 && !is_of(&t->row[t->first[at]], type, quantity))
        at = (at + 1) % t->places;
    return at;
}

/* From row i on, without the index. */
static int walk(const truths *t, const case_type *type, const char *quantity, int i)
{
    while (i < t->rows && !is_of(&t->row[i], type, quantity))
        i++;
    return i;
}

int truth_index_first(const truths *t, const case_type *type, const char *quantity)
{
    const int first = t->indexed > 0 ? t->first[place_of(t, type, quantity)] : -1;
    return first >= 0 ? first : walk(t, type, quantity, t->indexed);
}

int truth_index_next(const truths *t, int i)
{
    const truth *row = &t->row[i];
    if (i < t->indexed && t->next[i] < t->indexed)
        return t->next[i];
    return walk(t, row->type, row->quantity, i < t->indexed ? t->indexed : i + 1);
}

/* From the last row to the first, so that what stands at a place comes before what it found there.
 */
static void chain(truths *t)
{
    for (int k = 0; k < t->places; k++)
        t->first[k] = -1;
    for (int i = t->rows - 1; i >= 0; i--) {
        const int at = place_of(t, t->row[i].type, t->row[i].quantity);
        t->next[i] = t->first[at] >= 0 ? t->first[at] : t->rows;
        t->first[at] = i;
    }
    t->indexed = t->rows;
}

status truth_index_make(truths *t, fault *f)
{
    const size_t places = 2 * (size_t)t->rows + 1;
    int *first = malloc(places * sizeof *first),
        *next = malloc(((size_t)t->rows + 1) * sizeof *next);
    if (first == NULL || next == NULL) {
        free(first);
        free(next);
        return fault_set(f, STATUS_FAULT, "out of memory for truths");
    }
    truth_index_free(t);
    t->first = first;
    t->next = next;
    t->places = (int)places;
    chain(t);
    return STATUS_OK;
}

void truth_index_free(truths *t)
{
    free(t->first);
    free(t->next);
    t->first = t->next = NULL;
    t->indexed = t->places = 0;
}
