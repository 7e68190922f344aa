#include "harness/record/store.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/judge/reach.h"
#include "harness/record/vtkhdf.h"

static void put_environment(record *r, const environment *e)
{
    record_text(r, r->file, "schema", "beamwork-results");
    record_count(r, r->file, "schema_version", STORE_VERSION);
    record_text(r, r->file, "program_version", e->version);
    record_text(r, r->file, "commit", e->commit);
    record_text(r, r->file, "compiler", e->compiler);
    record_text(r, r->file, "flags", e->flags);
    record_text(r, r->file, "libraries", e->libraries);
    record_text(r, r->file, "processor", e->processor);
    record_text(r, r->file, "clock", e->clock);
    record_count(r, r->file, "threads", e->threads);
}

static void put_point(record *r, hid_t at, const point *p)
{
    record_text(r, at, "parameters", p->text);
    record_text(r, at, "summary", p->type->summary);
    record_text(r, at, "source", p->type->source);
    record_text(r, at, "status", status_name(p->status));
    record_text(r, at, "reason", p->reason);
    for (int i = 0; p->type->parameters[i].name != NULL; i++) {
        char name[80], text[64];
        snprintf(name, sizeof name, "parameter_%s", p->type->parameters[i].name);
        if (p->type->parameters[i].choices == NULL) {
            record_number(r, at, name, p->parameter[i]);
            continue;
        }
        parameters_value_text(&p->type->parameters[i], p->parameter[i], text, sizeof text);
        record_text(r, at, name, text);
    }
}

enum { TEXTS = 7, NUMBERS = 15 };
static const char *const text_name[TEXTS] = {"quantity", "verdict", "expected", "kind", "reason", "proof", "source"};
static const char *const number_name[NUMBERS] = {
    "truth",       "truth_uncertainty", "limit",  "limit_uncertainty", "order",   "order_uncertainty", "error",     "model_truth",
    "model_error", "tolerance",         "finest", "reach_10",          "reach_1", "reach_0.1",         "reach_0.01"};

/* Elements of the coarsest mesh within a level and all finer ones too; NAN: none. */
static double reach(const sweep *s, const verdict *v, int level)
{
    const int mesh = reach_mesh(s, v, reach_level[level]);
    return mesh >= 0 ? s->series[v->series].mesh[mesh] : NAN;
}

static void verdict_fields(const sweep *s, const point *p, const verdict *v, const char *text[TEXTS], double number[NUMBERS])
{
    const char *const words[TEXTS] = {p->scene.quantity[v->quantity].name,
                                      verdict_name(v->kind),
                                      v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "?",
                                      v->truth != NULL ? v->truth->kind : "",
                                      v->reason,
                                      v->finding != NULL ? v->finding->proof : "",
                                      v->truth != NULL ? v->truth->source : ""};
    const double values[NUMBERS] = {v->truth != NULL ? v->truth->value : NAN,
                                    v->truth != NULL ? v->truth->uncertainty : NAN,
                                    v->fit.limit,
                                    v->fit.limit_uncertainty,
                                    v->fit.order,
                                    v->fit.order_uncertainty,
                                    v->error,
                                    v->model_truth != NULL ? v->model_truth->value : NAN,
                                    v->model_error,
                                    v->tolerance,
                                    v->finest,
                                    reach(s, v, 0),
                                    reach(s, v, 1),
                                    reach(s, v, 2),
                                    reach(s, v, 3)};
    memcpy(text, words, sizeof words);
    memcpy(number, values, sizeof values);
}

/* One row of the table: the texts, each as long as the longest of its column, then the numbers. */
static hid_t verdict_type(int count, const char *const text[], size_t offset[TEXTS], size_t *size)
{
    size_t length[TEXTS];
    *size = 0;
    for (int k = 0; k < TEXTS; k++) {
        length[k] = 1;
        for (int i = 0; i < count; i++)
            length[k] = strlen(text[TEXTS * i + k]) > length[k] ? strlen(text[TEXTS * i + k]) : length[k];
        offset[k] = *size;
        *size += length[k];
    }
    const hid_t type = H5Tcreate(H5T_COMPOUND, *size + NUMBERS * sizeof(double));
    for (int k = 0; k < TEXTS; k++) {
        const hid_t word = record_text_type(length[k]);
        H5Tinsert(type, text_name[k], offset[k], word);
        H5Tclose(word);
    }
    for (int k = 0; k < NUMBERS; k++)
        H5Tinsert(type, number_name[k], *size + (size_t)k * sizeof(double), H5T_NATIVE_DOUBLE);
    *size += NUMBERS * sizeof(double);
    return type;
}

/* The verdicts of one series, [count]. */
static void put_verdicts(record *r, hid_t at, const sweep *s, const point *p, int count, const verdict v[])
{
    const char **text = calloc(((size_t)count + 1) * TEXTS, sizeof(const char *));
    double number[NUMBERS];
    size_t offset[TEXTS], size;
    r->bad |= text == NULL;
    for (int i = 0; i < count && !r->bad; i++)
        verdict_fields(s, p, &v[i], text + TEXTS * i, number);
    const hid_t type = verdict_type(r->bad ? 0 : count, text, offset, &size);
    char *rows = calloc((size_t)count + 1, size);
    r->bad |= rows == NULL;
    for (int i = 0; i < count && !r->bad; i++) {
        char *row = rows + (size_t)i * size;
        verdict_fields(s, p, &v[i], text + TEXTS * i, number);
        for (int k = 0; k < TEXTS; k++)
            memcpy(row + offset[k], text[TEXTS * i + k], strlen(text[TEXTS * i + k]));
        memcpy(row + size - sizeof number, number, sizeof number);
    }
    if (!r->bad)
        record_table(r, at, "verdicts", type, count, rows);
    H5Tclose(type);
    free(rows);
    free(text);
}

enum { READING = 3 + CLOCK_ROUNDS, TIMING = 2 + 2 * READING + PHASES + 4 };

static void put_reading(const clock_reading *c, double column[READING])
{
    const double first[3] = {c->repeats, c->rounds > 0 ? c->setup : NAN, c->rounds > 0 ? c->solve : NAN};
    memcpy(column, first, sizeof first);
    for (int i = 0; i < CLOCK_ROUNDS; i++)
        column[3 + i] = i < c->rounds ? c->round[i] : NAN;
}

/* Unknowns with nothing left out, seconds of the parts of an iteration, the dense baseline. */
static void put_parts(const cell_timing *t, long iterations, double column[1 + PHASES + 4])
{
    const baseline *dense = &t->dense;
    *column++ = t->free_keep_all;
    for (int k = 0; k < PHASES; k++)
        *column++ = t->phase[k];
    *column++ = dense->unknowns;
    *column++ = dense->unknowns > 0 ? dense->iteration : NAN;
    *column++ = dense->unknowns > 0 ? baseline_seconds(dense, iterations) : NAN;
    *column++ = dense->whole.rounds > 0; /* 0: one iteration times their number */
}

/* Of a benchmark: a row for each mesh. */
static void put_timing(record *r, hid_t at, const series *one)
{
    const hsize_t size[2] = {(hsize_t)one->meshes, TIMING};
    double *table = calloc((size_t)one->meshes + 1, TIMING * sizeof *table);
    r->bad |= table == NULL;
    for (int i = 0; i < one->meshes && table != NULL; i++) {
        double *row = table + (size_t)TIMING * (size_t)i;
        row[0] = one->mesh[i];
        put_reading(&one->timing[i].as_is, row + 1);
        put_reading(&one->timing[i].keep_all, row + 1 + READING);
        put_parts(&one->timing[i], one->cell[i].counters.iterations, row + 1 + 2 * READING);
    }
    const hid_t set = record_values(r, at, "timing", 2, size, table, NULL);
    record_text(
        r, set, "columns",
        "elements repeats setup solve round_1 round_2 round_3 round_4 round_5 all_repeats all_setup all_solve all_round_1 "
        "all_round_2 all_round_3 all_round_4 all_round_5 all_free elements_part assembly_part factorisation_part solution_part "
        "dense_unknowns dense_iteration dense_seconds dense_whole");
    H5Dclose(set);
    free(table);
}

/* One picture of a point is enough: that of the first formulation with a solution; its place becomes an attribute. */
static void put_picture(record *r, hid_t at_point, hid_t at_series, const point *p, const series *one, int mesh)
{
    char place[FORMULATION_KEY + 32], name[16];
    const shapes *s = &one->cell[mesh].solve.shapes;
    if (r->bad || s->states == 0 || one->cell[mesh].solve.status != STATUS_OK || H5Aexists(at_point, "shapes") > 0)
        return;
    snprintf(name, sizeof name, "n%d", one->mesh[mesh]);
    snprintf(place, sizeof place, "%s/%s/shapes", one->formulation.key, name);
    const hid_t here = record_group(r, at_series, name);
    store_shapes(r, here, &p->scene, s);
    record_text(r, at_point, "shapes", place);
    H5Gclose(here);
}

/* v[count]: its verdicts; NULL: it was not judged. */
static void put_series(record *r, hid_t cases, const sweep *all, int index, int count, const verdict v[])
{
    const series *one = &all->series[index];
    const point *p = &all->point[one->point];
    const verdict **of = calloc((size_t)p->scene.quantities + 1, sizeof(const verdict *));
    const hid_t of_case = record_group(r, cases, p->type->name);
    const int new_point = H5Lexists(of_case, p->name, H5P_DEFAULT) <= 0;
    const hid_t at_point = record_group(r, of_case, p->name), here = record_group(r, at_point, one->formulation.key);
    if (new_point)
        put_point(r, at_point, p);
    record_text(r, here, "formulation", one->formulation.type->name);
    record_text(r, here, "summary", one->formulation.type->summary);
    record_text(r, here, "source", one->formulation.type->source);
    record_text(r, here, "missing", one->missing);
    if (v != NULL)
        put_verdicts(r, here, all, p, count, v);
    if (one->timing != NULL)
        put_timing(r, here, one);
    r->bad |= of == NULL;
    for (int i = 0; i < count && of != NULL; i++)
        of[v[i].quantity] = &v[i];
    for (int i = 0; i < one->meshes && one->missing[0] == '\0' && !r->bad; i++) {
        store_cell(r, here, p, one->mesh[i], &one->cell[i], of);
        put_picture(r, at_point, here, p, one, i);
    }
    free(of);
    H5Gclose(here);
    H5Gclose(at_point);
    H5Gclose(of_case);
}

status store_write(const char *path, const sweep *all, const judgement *j, const environment *e, fault *f)
{
    record r;
    const status opened = record_open(&r, f);
    if (opened != STATUS_OK)
        return opened;
    put_environment(&r, e);
    record_count(&r, r.file, "unfinished_cells", all->unfinished);
    const hid_t cases = record_group(&r, r.file, "cases");
    int first = 0; /* verdicts come in the order of the series */
    for (int i = 0; i < all->seriess && !r.bad; i++) {
        int count = 0;
        while (first + count < j->verdicts && j->verdict[first + count].series == i)
            count++;
        put_series(&r, cases, all, i, count, &j->verdict[first]);
        first += count;
    }
    H5Gclose(cases);
    return record_close(&r, path, f);
}

status store_write_solution(const char *path, const sweep *s, const environment *e, fault *f)
{
    record r;
    const status opened = record_open(&r, f);
    if (opened != STATUS_OK)
        return opened;
    put_environment(&r, e);
    const hid_t cases = record_group(&r, r.file, "cases");
    put_series(&r, cases, s, 0, 0, NULL);
    const point *p = &s->point[s->series[0].point];
    if (s->series[0].cell[0].solve.shapes.states > 0)
        vtkhdf_write(&r, &p->scene, &s->series[0].cell[0].solve.shapes);
    H5Gclose(cases);
    return record_close(&r, path, f);
}
