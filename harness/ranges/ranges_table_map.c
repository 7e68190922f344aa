#include "harness/catalogue/parameters.h"
#include "harness/ranges/ranges_table_impl.h"
#include "harness/tables/paragraph.h"

static void write_place(FILE *to, const tally_place *p)
{
    char text[24];
    if (p->points == 0)
        snprintf(text, sizeof text, ".");
    else if (p->asked == 0)
        snprintf(text, sizeof text, "?");
    else if (p->never > 0)
        snprintf(text, sizeof text, "-");
    else
        snprintf(text, sizeof text, "%d", p->least);
    fprintf(to, "%*s", RANGES_TABLE_COLUMN, text);
}

/* Value of an axis, short. */
static void edge_text(const tally *t, int index, int place, char *text, int size)
{
    const axis *a = &t->of->axis[index];
    if (a->of->choices != NULL)
        axis_text(a, tally_edge(t, index, place), text, size);
    else
        snprintf(text, (size_t)size, "%.3g", tally_edge(t, index, place));
}

/* The values of the first axis, behind what stands in their lines. */
static void write_columns(FILE *to, const tally *t)
{
    char edge[ASSIGNMENT_VALUE];
    fprintf(to, "  %-*.*s", RANGES_TABLE_NAME, RANGES_TABLE_NAME, t->of->axis[0].of->name);
    for (int i = 0; i < t->columns; i++) {
        edge_text(t, 0, i, edge, sizeof edge);
        fprintf(to, "%*.*s", RANGES_TABLE_COLUMN, RANGES_TABLE_COLUMN - 1, edge);
    }
    fputc('\n', to);
}

static void write_fields(FILE *to, const tally *t, const char *label, int which, int q, int at)
{
    fprintf(to, "  %-*.*s", RANGES_TABLE_NAME, RANGES_TABLE_NAME, label);
    for (int i = 0; i < t->columns; i++)
        write_place(to, tally_at(t, which, q, at, i));
    fputc('\n', to);
}

/* Over two axes a map for each formulation, over one a line. */
static void write_maps_of(FILE *to, const tally *t, int q)
{
    const ranges *r = t->of;
    if (r->design.axes == 1) {
        fprintf(to, "%s\n", ranges_table_name(r, q));
        write_columns(to, t);
        for (int i = 0; i < r->formulations; i++)
            write_fields(to, t, r->formulation[i].key, i, q, 0);
        return;
    }
    for (int i = 0; i < r->formulations; i++) {
        fprintf(to, "%s, %s\n", r->formulation[i].key, ranges_table_name(r, q));
        write_columns(to, t);
        for (int k = 0; k < t->lines; k++) {
            char edge[ASSIGNMENT_VALUE], label[2 * ASSIGNMENT_VALUE];
            edge_text(t, 1, k, edge, sizeof edge);
            snprintf(label, sizeof label, "%.*s %s", RANGES_TABLE_NAME - 10, r->axis[1].of->name,
                     edge);
            write_fields(to, t, label, i, q, k);
        }
    }
}

/* Is a field without a reference? */
static int has_unknown(const tally *t)
{
    const ranges *r = t->of;
    int unknown = 0;
    for (int i = 0; i < r->formulations * (r->quantities + 1) * t->lines * t->columns; i++)
        unknown |= t->map[i].points > 0 && t->map[i].asked == 0;
    return unknown;
}

/* Are there fields of several values? */
static int is_coarse(const tally *t)
{
    const int shown[] = {t->columns, t->lines};
    int coarse = 0;
    for (int i = 0; i < t->of->design.axes; i++)
        coarse |= t->of->axis[i].count != shown[i];
    return coarse;
}

void ranges_table_map(FILE *to, const tally *t, int every)
{
    const ranges *r = t->of;
    if (t->columns == 0) {
        fprintf(to, "\nno map: there are %d axes; the page of the sweep draws slices\n",
                r->design.axes);
        return;
    }
    fprintf(to, "\n");
    paragraph_say(to, fprintf(to, "least n "), 2,
                  "from which on every mesh is within %g %%; -: not even with n = %d%s%s",
                  100 * r->request.tolerance, r->mesh[r->meshes - 1],
                  has_unknown(t) ? "; ?: without a reference" : "",
                  is_coarse(t) ? "; a field holds what all its points need, and begins where its "
                                 "column and line say"
                               : "");
    for (int q = 0; q < r->quantities && every && r->quantities > 1; q++)
        write_maps_of(to, t, q);
    write_maps_of(to, t, r->quantities > 1 ? r->quantities : 0);
}
