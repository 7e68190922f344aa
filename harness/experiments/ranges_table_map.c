#include "harness/experiments/ranges_table_impl.h"
#include "harness/formulations/formulations.h"
#include "harness/terminal/terminal.h"

/* Errors against truths beside such against limits: only the first show what a theory leaves out.
 */
static int is_mixed(const tally *t, int which, int q)
{
    const tally_series *s = tally_of(t, which, q);
    return s->proven > 0 && s->proven < s->asked;
}

static void write_place(FILE *to, const tally_place *p, int mixed)
{
    char text[24];
    if (p->points == 0)
        snprintf(text, sizeof text, ".");
    else if (p->other == p->points)
        snprintf(text, sizeof text, "o");
    else if (p->asked == 0)
        snprintf(text, sizeof text, "?");
    else if (p->never > 0)
        snprintf(text, sizeof text, "-%s", mixed && p->proven > 0 ? "*" : "");
    else
        snprintf(text, sizeof text, "%d%s%s", p->least, mixed && p->proven > 0 ? "*" : "",
                 p->asked + p->other < p->points ? "?" : "");
    fprintf(to, "%*s", RANGES_TABLE_COLUMN, text);
}

/* Value of an axis, short. */
static void edge_text(const tally *t, int index, int place, char *text, int size)
{
    const sweep_axis *a = &t->of->axis[index];
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
        write_place(to, tally_at(t, which, q, at, i), is_mixed(t, which, q));
    fputc('\n', to);
}

/* Over two axes a map for each formulation, over one a line. */
static void write_maps_of(FILE *to, const tally *t, int q)
{
    const parameter_ranges *r = t->of;
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

static int has_mixed(const tally *t)
{
    int mixed = 0;
    for (int i = 0; i < t->of->formulations; i++)
        for (int q = 0; q <= t->of->quantities; q++)
            mixed |= is_mixed(t, i, q);
    return mixed;
}

static int has_other(const tally *t)
{
    long others = 0;
    for (int i = 0; i < t->of->formulations; i++)
        others += t->others[i];
    return others > 0;
}

/* Is a field without a reference? parts: has it points with and points without? */
static int has_unknown(const tally *t, int parts)
{
    const parameter_ranges *r = t->of;
    int unknown = 0;
    for (int i = 0; i < r->formulations * (r->quantities + 1) * t->lines * t->columns; i++) {
        const tally_place *p = &t->map[i];
        unknown |= p->asked + p->other < p->points && (parts ? p->asked > 0 : p->asked == 0);
    }
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
    const parameter_ranges *r = t->of;
    if (t->columns == 0) {
        fprintf(to, "\nno map: there are %d axes; the page of the sweep draws slices\n",
                r->design.axes);
        return;
    }
    fprintf(to, "\n");
    paragraph_say(to, fprintf(to, "least n "), 2,
                  "from which on every mesh is within %g %%; -: not even with n = %d%s%s%s%s%s",
                  100 * r->request.tolerance, r->mesh[r->meshes - 1],
                  has_other(t) ? "; o: another model" : "",
                  has_unknown(t, 0) ? "; ?: without a reference" : "",
                  has_unknown(t, 1) ? "; a number with ?: some of its points are without" : "",
                  has_mixed(t) ? "; *: against a truth, elsewhere against limits of meshes, which "
                                 "do not show what a theory leaves out"
                               : "",
                  is_coarse(t) ? "; a field holds what all its points need, and begins where its "
                                 "column and line say"
                               : "");
    for (int q = 0; q < r->quantities && every && r->quantities > 1; q++)
        write_maps_of(to, t, q);
    write_maps_of(to, t, r->quantities > 1 ? r->quantities : 0);
}
