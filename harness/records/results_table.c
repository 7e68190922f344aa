#include "harness/records/results_table.h"

#include <string.h>

#include "harness/records/results.h"

const char results_table_head[] =
    "series,meshes,iterations,evaluations,factorisations,errors,decades,least,least_elements,"
    "least_quantity,largest,largest_elements,largest_quantity,limits";

/* "1:singular 2 4 8": the status where it is not ok. */
static void write_meshes(FILE *to, const result_series *s)
{
    for (int i = 0; i < s->meshes; i++) {
        const result_mesh *mesh = &s->mesh[i];
        fprintf(to, "%s%d", i > 0 ? " " : ",", mesh->elements);
        if (strcmp(mesh->status, "ok") != 0)
            fprintf(to, ":%s", mesh->status);
    }
}

static void write_error(FILE *to, const result_error *e)
{
    if (e->elements > 0)
        fprintf(to, ",%.*g,%d,%s", RESULTS_ERROR_DIGITS, e->size, e->elements, e->quantity);
    else
        fputs(",,,", to);
}

static void write_limits(FILE *to, const result_series *s)
{
    for (int i = 0; i < s->limits; i++)
        fprintf(to, "%s%s=%.*g", i > 0 ? " " : "", s->limit[i].quantity, RESULTS_LIMIT_DIGITS,
                s->limit[i].value);
}

void results_table_write(FILE *to, const stored_results *r)
{
    fprintf(to, "%s\n", results_table_head);
    for (int i = 0; i < r->seriess; i++) {
        const result_series *s = &r->series[i];
        fprintf(to, "\"%s\"", s->name);
        write_meshes(to, s);
        for (int k = 0; k < RESULTS_WORKS; k++)
            fprintf(to, ",%ld", s->work[k]);
        fprintf(to, ",%d,%.*f", s->errors, RESULTS_DECADES_DECIMALS, s->decades);
        write_error(to, &s->least);
        write_error(to, &s->largest);
        fputc(',', to);
        write_limits(to, s);
        fputc('\n', to);
    }
}
