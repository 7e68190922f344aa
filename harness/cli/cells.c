#include "harness/cli/cells.h"

#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"

int cells_runs(const sweep *s, int index)
{
    const series *one = &s->series[index];
    return one->missing[0] == '\0' && one->imported == NULL &&
           s->point[one->point].status == STATUS_OK;
}

double cells_expense(const sweep *s, int index)
{
    double all = 0;
    for (int k = 0; k < s->series[index].meshes; k++)
        all += expense_of_cell(s, index, k);
    return all;
}

static void add_numbers(digest *to, const double *value, int count)
{
    for (int i = 0; value != NULL && i < count; i++)
        digest_add_number(to, value[i]);
}

static void add_quantity(digest *to, const quantity_result *q)
{
    digest_add_number(to, q->status);
    digest_add_number(to, q->value);
    digest_add_number(to, q->x);
    add_numbers(to, q->curve.x, q->curve.points);
    add_numbers(to, q->curve.value, q->curve.points);
}

/* Values, how each of them ended, and the work that was counted; no times. */
static void add_cell(digest *to, const cell_result *cell)
{
    const solve_result *r = &cell->solve;
    const counters *c = &cell->counters;
    const double work[] = {(double)c->iterations,         (double)c->steps,
                           (double)c->rejected_steps,     (double)c->factorisations,
                           (double)c->strain_evaluations, (double)c->stress_evaluations,
                           (double)cell->size.free,       (double)cell->size.elements};
    digest_add_number(to, r->status);
    digest_add_text(to, r->reason);
    for (int q = 0; q < r->quantities; q++)
        add_quantity(to, &r->quantity[q]);
    for (int k = 0; k < r->matrix_sets; k++) {
        add_numbers(to, r->matrices[k].compliance, 36 * r->matrices[k].stations);
        add_numbers(to, r->matrices[k].stiffness, 36 * r->matrices[k].stations);
    }
    add_numbers(to, work, sizeof work / sizeof work[0]);
}

/* An array that may not be there. */
static int put_array(FILE *to, const void *array, size_t size)
{
    const int there = array != NULL;
    return fwrite(&there, sizeof there, 1, to) == 1 &&
           (!there || size == 0 || fwrite(array, size, 1, to) == 1);
}

static int get_array(FILE *from, void **array, size_t size)
{
    int there;
    *array = NULL;
    if (fread(&there, sizeof there, 1, from) != 1)
        return 0;
    if (!there)
        return 1;
    *array = calloc(size + 1, 1);
    return *array != NULL && (size == 0 || fread(*array, size, 1, from) == 1);
}

static size_t noise_size(const sweep *s, const series *one)
{
    return (size_t)s->point[one->point].scene.quantities * sizeof *one->noise;
}

status cells_write(FILE *to, const sweep *s, int index, digest *content, fault *f)
{
    const series *one = &s->series[index];
    const size_t meshes = (size_t)one->meshes;
    int good = 1;
    digest_add_text(content, one->formulation.key);
    for (int k = 0; k < one->meshes; k++) {
        add_cell(content, &one->cell[k]);
        good = good && serialise_write(to, &one->cell[k]) == 0;
    }
    add_numbers(content, one->noise, s->point[one->point].scene.quantities);
    good = good && put_array(to, one->noise, noise_size(s, one)) &&
           put_array(to, one->timing, meshes * sizeof *one->timing);
    return good ? STATUS_OK : fault_set(f, STATUS_FAULT, "out of memory for a batch");
}

status cells_read(FILE *from, sweep *s, int index, fault *f)
{
    series *one = &s->series[index];
    const size_t meshes = (size_t)one->meshes;
    void *noise = NULL, *timing = NULL;
    int good = 1;
    for (int k = 0; k < one->meshes && good; k++) {
        cell_result_free(&one->cell[k]);
        good = serialise_read(from, &one->cell[k]) == 0;
    }
    good = good && get_array(from, &noise, noise_size(s, one)) &&
           get_array(from, &timing, meshes * sizeof *one->timing);
    one->noise = noise;
    one->timing = timing;
    return good ? STATUS_OK : fault_set(f, STATUS_FAULT, "a batch ends too soon");
}

void cells_forget(series *one)
{
    for (int k = 0; k < one->meshes; k++)
        cell_result_free(&one->cell[k]);
    free(one->noise);
    free(one->timing);
    one->noise = NULL;
    one->timing = NULL;
}

void cells_keep(sweep *s, const char keep[])
{
    int kept = 0;
    for (int i = 0; i < s->seriess; i++) {
        if (!keep[i]) {
            s->unfinished += s->series[i].meshes;
            sweep_series_free(&s->series[i]);
        } else
            s->series[kept++] = s->series[i];
    }
    s->seriess = kept;
    s->partial = s->unfinished > 0;
}
