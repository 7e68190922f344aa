/* Coordinates of the ends of members, and the patterns of what is left when members are condensed.
 */
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/condensation_impl.h"

static void note(const mesh_element *el, int number[])
{
    for (int k = 0; k < el->columns; k++)
        if (el->index[k] != NONE)
            number[el->index[k]] = 0;
}

/* Coordinates of ends, and those of them that are unknown. Returns how many. */
int condensation_number(condensation *s, int count, const int released[])
{
    const model *m = s->m;
    int ends = 0;
    for (int i = 0; i < s->all; i++)
        s->number[i] = NONE;
    for (int i = 0; i < s->members; i++)
        note(&s->member[i].ends, s->number);
    for (int i = 0; i < model_discretes(m); i++)
        note(&model_discrete(m, i)->el, s->number);
    for (int i = 0; i < s->all; i++)
        if (s->number[i] != NONE)
            s->number[i] = ends++;
    s->unknown = malloc(((size_t)ends + 1) * sizeof *s->unknown);
    for (int i = 0; i < s->all && s->unknown != NULL; i++) {
        int unknown = i < model_unknowns(m);
        for (int k = 0; k < count; k++)
            unknown |= released[k] == i;
        if (s->number[i] != NONE && unknown)
            s->unknown[s->unknowns++] = i;
    }
    return ends;
}

static void couple(const condensation *s, const mesh_element *el, int ends, char coupled[])
{
    for (int i = 0; i < el->columns; i++)
        for (int k = 0; k < el->columns; k++)
            if (el->index[i] != NONE && el->index[k] != NONE)
                coupled[s->number[el->index[k]] * ends + s->number[el->index[i]]] = 1;
}

/* The pattern of the coordinates list[count], in all coordinates or in those of the list. */
static status pattern_of(const condensation *s, int count, const int list[], int ends,
                         const char coupled[], int own, sparse *out, fault *f)
{
    size_t entries = 0;
    for (int j = 0; j < count; j++)
        for (int i = 0; i < count; i++)
            entries += coupled[s->number[list[j]] * ends + s->number[list[i]]];
    out->n = own ? count : s->all;
    out->column = calloc((size_t)out->n + 1, sizeof *out->column);
    out->row = malloc((entries + 1) * sizeof *out->row);
    out->value = calloc(entries + 1, sizeof *out->value);
    if (out->column == NULL || out->row == NULL || out->value == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the ends of members");
    int at = 0, done = 0;
    for (int j = 0; j < count; j++) {
        const int column = own ? j : list[j];
        for (; done <= column; done++)
            out->column[done] = at;
        for (int i = 0; i < (out->symmetric ? j + 1 : count); i++)
            if (coupled[s->number[list[j]] * ends + s->number[list[i]]])
                out->row[at++] = own ? i : list[i];
    }
    for (; done <= out->n; done++)
        out->column[done] = at;
    return STATUS_OK;
}

/* Where the entries of the unknowns are in K. */
static status find_sources(condensation *s, fault *f)
{
    const sparse *a = &s->inside;
    s->from = malloc(((size_t)a->column[a->n] + 1) * sizeof *s->from);
    if (s->from == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the ends of members");
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            int at = s->K.column[s->unknown[j]];
            while (s->K.row[at] != s->unknown[a->row[k]])
                at++;
            s->from[k] = at;
        }
    return STATUS_OK;
}

static status patterns_with(condensation *s, int ends, char coupled[], int list[], fault *f)
{
    for (int i = 0; i < s->members; i++)
        couple(s, &s->member[i].ends, ends, coupled);
    for (int i = 0; i < model_discretes(s->m); i++)
        couple(s, &model_discrete(s->m, i)->el, ends, coupled);
    for (int i = 0; i < ends; i++)
        coupled[i * ends + i] = 1;
    for (int i = 0; i < s->all; i++)
        if (s->number[i] != NONE)
            list[s->number[i]] = i;
    TRY(pattern_of(s, ends, list, ends, coupled, 0, &s->K, f));
    TRY(pattern_of(s, s->unknowns, s->unknown, ends, coupled, 1, &s->inside, f));
    return find_sources(s, f);
}

status condensation_patterns(condensation *s, int ends, fault *f)
{
    char *coupled = calloc((size_t)ends * (size_t)ends + 1, 1);
    int *list = calloc((size_t)ends + 1, sizeof *list);
    status outcome = STATUS_FAULT;
    if (coupled != NULL && list != NULL)
        outcome = patterns_with(s, ends, coupled, list, f);
    else
        fault_set(f, outcome, "out of memory for the ends of members");
    free(coupled);
    free(list);
    return outcome;
}
