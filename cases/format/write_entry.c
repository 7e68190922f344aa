/* Entries of a scene file, by their tables. */
#include <string.h>

#include "cases/format/write_impl.h"

static void write_value(writer *w, const entry_field *k, const void *entry)
{
    const void *at = (const char *)entry + k->at;
    const int whole = k->size == sizeof(int) ? *(const int *)at : 0;
    const scene_path *path = at;
    switch (k->kind) {
    case ENTRY_NUMBER:
        write_values_number(w, *(const double *)at);
        break;
    case ENTRY_WHOLE:
        fprintf(w->to, "%d", whole);
        break;
    case ENTRY_VECTOR:
    case ENTRY_DIRECTION:
    case ENTRY_POSITION:
        write_values_numbers(w, k->count, at);
        break;
    case ENTRY_NUMBERS:
        write_values_numbers(w, path->stations, path->value);
        break;
    case ENTRY_NAME:
        write_values_name(w, k->of, whole);
        break;
    case ENTRY_WORD:
        write_values_word(w, k->words, entry_index(k, whole));
        break;
    case ENTRY_FLAG:
        write_values_word(w, k->words, whole);
        break;
    case ENTRY_WORDS:
        write_values_bits(w, k->words, *(const unsigned *)at);
        break;
    default:
        break;
    }
}

static const write_own *find_own(const write_own own[], const char *key)
{
    for (; own != NULL && own->key != NULL; own++)
        if (strcmp(own->key, key) == 0)
            return own;
    return NULL;
}

/* Nothing else can say it: it must be there, or is said in any case. */
static int is_due(const entry_field *k, const void *entry)
{
    const int must = k->always || (k->needed && k->group == 0);
    return (must && (k->kind != ENTRY_NAME || k->size > 0)) || !entry_is_usual(k, entry);
}

void write_entry(writer *w, const entry_field *table, const void *entry, const write_own own[])
{
    w->begun = 0;
    fputc('{', w->to);
    for (const entry_field *k = table; k->name != NULL; k++) {
        const write_own *by_hand = find_own(own, k->name);
        if (by_hand != NULL)
            by_hand->write(w, entry);
        else if ((k->size > 0 || k->kind == ENTRY_MAP) && is_due(k, entry)) {
            write_values_key(w, k->name);
            if (k->kind == ENTRY_MAP)
                write_entry(w, entry_below(k), entry, own);
            else
                write_value(w, k, entry);
        }
    }
    fputc('}', w->to);
    w->begun = 1;
}
