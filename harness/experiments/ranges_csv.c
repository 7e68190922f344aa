#include "harness/experiments/ranges_csv.h"

#include <math.h>
#include <stdlib.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"

void ranges_csv_head(FILE *to, const parameter_ranges *r)
{
    for (int i = 0; i < r->design.axes; i++)
        fprintf(to, "%s,", r->axis[i].of->name);
    fprintf(to, "formulation,elements,quantity,unit,value,reference,reference_kind,error,status,"
                "cost,seconds,not_modelled\n");
}

static void put(FILE *to, double value)
{
    if (isfinite(value))
        fprintf(to, "%.17g", value);
    fputc(',', to);
}

/* Options of a formulation are joined by commas. */
static void put_cell(FILE *to, const parameter_ranges *r, const rows *w, const char *where, int at,
                     int which, int mesh)
{
    const size_t cell = rows_cell(w, at, which, mesh);
    char lacks[OMIT_WORDS];
    missing_omit_words((unsigned)w->lacks[rows_lacks(w, at, which)], lacks);
    for (int q = 0; q < r->quantities; q++) {
        const size_t value = rows_value(w, at, which, mesh, q), known = rows_quantity(w, at, q);
        fprintf(to, "%s\"%s\",%d,%s,%s,", where, r->formulation[which].key, r->mesh[mesh],
                r->quantity[q].name, r->quantity[q].unit);
        put(to, w->value[value]);
        put(to, w->reference[known]);
        fprintf(to, "%s,", rows_reference_name(w->kind[known]));
        put(to, w->error[value]);
        fprintf(to, "%s,", rows_status_name(w->status[cell]));
        put(to, w->cost[cell]);
        put(to, w->seconds[cell]);
        fprintf(to, lacks[0] != '\0' ? "\"%s\"\n" : "%s\n", lacks);
    }
}

static void put_point(FILE *to, const parameter_ranges *r, const rows *w, const double value[],
                      int at)
{
    char where[CASE_MAX_PARAMETERS * (ASSIGNMENT_VALUE + 1) + 1];
    int used = 0;
    where[0] = '\0';
    for (int i = 0; i < r->design.axes; i++) {
        axis_text(&r->axis[i], value[i], where + used, ASSIGNMENT_VALUE);
        while (where[used] != '\0')
            used++;
        where[used++] = ',';
        where[used] = '\0';
    }
    for (int i = 0; i < r->formulations; i++)
        for (int k = 0; k < r->meshes; k++)
            put_cell(to, r, w, where, at, i, k);
}

status ranges_csv_add(FILE *to, const parameter_ranges *r, long first, const rows *w, fault *f)
{
    const int axes = r->design.axes;
    double *at = malloc((size_t)w->points * (size_t)axes * sizeof *at);
    const status outcome = at != NULL ? design_points(&r->design, first, w->points, at, f)
                                      : fault_set(f, STATUS_FAULT, "out of memory for points");
    for (int i = 0; i < w->points && outcome == STATUS_OK; i++)
        put_point(to, r, w, at + (size_t)i * (size_t)axes, i);
    free(at);
    return outcome;
}
