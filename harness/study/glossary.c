#include "harness/study/glossary.h"

#include <ctype.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/columns.h"
#include "harness/study/truths_file.h"

static status read_all(table_columns *c, glossary_entry **out)
{
    static const columns_field field[] = {
        {"term", 1, offsetof(glossary_entry, term)},
        {"also", 1, offsetof(glossary_entry, also)},
        {"group", 1, offsetof(glossary_entry, group)},
        {"meaning", 1, offsetof(glossary_entry, meaning)},
        {"see", 1, offsetof(glossary_entry, see)},
    };
    c->rows = c->group >= 0 ? columns_length(c->group, "term") : -1;
    if (c->rows < 0)
        return columns_broken(c, "term");
    glossary_entry *all = *out = calloc((size_t)c->rows + 1, sizeof *all);
    if (all == NULL)
        return fault_set(c->f, STATUS_FAULT, "out of memory for the glossary");
    for (size_t k = 0; k < sizeof field / sizeof field[0]; k++)
        TRY(columns_read(c, &field[k], all, sizeof *all));
    return STATUS_OK;
}

/* With what glossary_read closes. */
static status glossary_read_open(const char *path, hid_t *file, glossary *out, fault *f)
{
    table_columns c = {.path = path, .name = "glossary", .f = f};
    TRY(truths_file_open(path, file, f));
    c.group = H5Lexists(*file, c.name, H5P_DEFAULT) > 0 ? H5Gopen2(*file, c.name, H5P_DEFAULT) : -1;
    const status outcome = read_all(&c, &out->entry);
    if (c.group >= 0)
        H5Gclose(c.group);
    out->entries = out->entry != NULL ? c.rows : 0;
    return outcome;
}

status glossary_read(const char *path, glossary *out, fault *f)
{
    hid_t file = -1;
    memset(out, 0, sizeof *out);
    const status outcome = glossary_read_open(path, &file, out, f);
    if (file >= 0)
        H5Fclose(file);
    if (outcome != STATUS_OK)
        glossary_free(out);
    return outcome;
}

void glossary_free(glossary *g)
{
    for (int i = 0; i < g->entries; i++) {
        free(g->entry[i].term);
        free(g->entry[i].also);
        free(g->entry[i].group);
        free(g->entry[i].meaning);
        free(g->entry[i].see);
    }
    free(g->entry);
    memset(g, 0, sizeof *g);
}

int glossary_part(const char *list, int index, char word[GLOSSARY_WORD])
{
    for (int i = 0; i < index && list != NULL; i++) {
        list = strchr(list, '|');
        list = list != NULL ? list + 1 : NULL;
    }
    if (list == NULL || list[0] == '\0')
        return 0;
    snprintf(word, GLOSSARY_WORD, "%.*s", (int)strcspn(list, "|"), list);
    return 1;
}

static int blank(char c)
{
    return c == ' ' || c == '_' || c == '-';
}

int glossary_same(const char *a, const char *b)
{
    for (;; a++, b++) {
        while (blank(a[0]) && blank(a[1]))
            a++;
        while (blank(b[0]) && blank(b[1]))
            b++;
        if (!(blank(*a) && blank(*b)) && tolower((unsigned char)*a) != tolower((unsigned char)*b))
            return 0;
        if (*a == '\0')
            return 1;
    }
}

static int is_named(const glossary_entry *e, const char *word)
{
    char other[GLOSSARY_WORD];
    if (glossary_same(e->term, word))
        return 1;
    for (int i = 0; glossary_part(e->also, i, other); i++)
        if (glossary_same(other, word))
            return 1;
    return 0;
}

const glossary_entry *glossary_find(const glossary *g, const char *word)
{
    for (int i = 0; i < g->entries; i++)
        if (is_named(&g->entry[i], word))
            return &g->entry[i];
    return NULL;
}
