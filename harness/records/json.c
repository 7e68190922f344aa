#include "harness/records/records_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/model/model.h"

static json_t *json_record_numbers(int count, const double value[]);

enum { DUMP = JSON_INDENT(1) | JSON_REAL_PRECISION(17) };
static const char unwritten[] =
    "the JSON output could not be written, because the disk or the memory is full; free disk space "
    "or memory, and run the command again";

static json_t *values_of(const assignment_list *l, const double value[])
{
    json_t *all = json_object();
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(l->part, i)) != NULL; i++) {
        char text[ASSIGNMENT_VALUE];
        assignment_value_text(p, value[i], text, sizeof text);
        json_object_set_new(all, p->name,
                            p->choices != NULL ? json_string(text) : json_real(value[i]));
    }
    return all;
}

static json_t *truths_of(const subject *s, const truths *t)
{
    const sweep_point *p = s->point;
    subject one = *s;
    json_t *list = json_array();
    if (t != NULL)
        for (int i = 0; i < t->rows; i++) {
            const truth *row = &t->row[i];
            if (row->formulation[0] != '\0' || row->on_curve ||
                strcmp(row->quantity, p->scene.quantity[s->index].name) != 0 ||
                !truth_holds(row, p->type, p->parameter))
                continue;
            one.truth = row;
            json_record_add(list, &record_truth, &one, 0);
        }
    return list;
}

static void add_list(json_t *root, const gathering *g, const record_type *type)
{
    subjects list = {0};
    json_t *all = json_array();
    gather_mesh(g, type, 0, 0, &list);
    for (int i = 0; i < list.count; i++)
        json_record_add(all, type, &list.row[i], 0);
    json_object_set_new(root, type->table, all);
    gather_free(&list);
}

static void add_quantities(json_t *root, const gathering *g)
{
    subjects list = {0};
    json_t *all = json_array();
    gather_mesh(g, &record_quantity, 0, 0, &list);
    for (int i = 0; i < list.count; i++) {
        const subject *s = &list.row[i];
        json_t *one = json_record(&record_quantity, s, 0);
        json_object_set_new(one, "truths", truths_of(s, g->truths));
        json_array_append_new(all, one);
    }
    json_object_set_new(root, record_quantity.table, all);
    gather_free(&list);
}

static void add_curves(json_t *root, const gathering *g)
{
    subjects list = {0};
    json_t *all = json_array();
    gather_mesh(g, &record_curve, 0, 0, &list);
    for (int i = 0; i < list.count; i++) {
        subject s = list.row[i];
        const curve *c = &((const quantity_result *)s.record)->curve;
        s.group = 0;
        json_t *one = json_record(&record_curve, &s, 0);
        json_object_set_new(one, "curve_x", json_record_numbers(c->points, c->x));
        json_object_set_new(one, "curve_value", json_record_numbers(c->points, c->value));
        json_array_append_new(all, one);
    }
    json_object_set_new(root, record_curve.table, all);
    gather_free(&list);
}

status json_finish(json_t *root, FILE *to, fault *f)
{
    const int bad = root == NULL || json_dumpf(root, to, DUMP) != 0 || fputc('\n', to) == EOF;
    json_decref(root);
    return bad ? fault_set(f, STATUS_FAULT, unwritten) : STATUS_OK;
}

void json_add_physics(json_t *root, const sweep_point *p)
{
    json_t *omitted = json_array(), *assumptions = json_array();
    const unsigned features = p->status == STATUS_OK ? features_omitted(&p->scene) : 0;
    subjects list = {0};
    for (const scene_omission *o = scene_omissions; o->word != NULL; o++)
        if (features & o->feature)
            json_array_append_new(omitted, json_string(o->word));
    gather_assumptions(p, &list);
    for (int i = 0; i < list.count; i++)
        json_record_add(assumptions, &record_assumption, &list.row[i], 0);
    gather_free(&list);
    json_object_set_new(root, "omitted", omitted);
    json_object_set_new(root, record_assumption.table, assumptions);
}

status json_write_solution(FILE *to, const sweep *s, const truths *t, fault *f)
{
    static const record_type *const lists[] = {&record_event, &record_motion, &record_step,
                                               &record_iteration, &record_matrix};
    const gathering g = {s, NULL, t};
    const subject cell = gather_cell(&g, 0, 0);
    json_t *root = json_pack("{s:i,s:s,s:s,s:i}", "schema_version", SCHEMA_VERSION, "case",
                             cell.point->type->name, "formulation", cell.series->formulation.key,
                             "elements", cell.series->mesh[0]);
    const formulation *chosen = &cell.series->formulation;
    const assignment_list options = formulation_options(chosen->type),
                          parameters = parameters_list(cell.point->type);
    json_object_set_new(root, "options", values_of(&options, chosen->option));
    json_object_set_new(root, "parameters", values_of(&parameters, cell.point->parameter));
    json_add_physics(root, cell.point);
    json_object_set_new(root, "shear_theory",
                        json_string(features_theory_words(
                            chosen->type, features_theory(&cell.point->scene, chosen->type))));
    json_object_set_new(root, record_cell.name, json_record(&record_cell, &cell, 0));
    add_quantities(root, &g);
    add_curves(root, &g);
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++)
        add_list(root, &g, lists[i]);
    return json_finish(root, to, f);
}

/* Text before and after the verdicts of a document with no other contents, in the same layout. */
static const char alone_before[] = "{\n \"verdicts\": [", alone_behind[] = "\n ]\n}",
                  none[] = "\n \"verdicts\": []";

void json_part_begin(json_part *part)
{
    *part = (json_part){.verdicts = 0};
    part->to = open_memstream(&part->text, &part->size);
}

void json_part_add(json_part *part, const sweep *s, const evaluation *j)
{
    const gathering g = {s, j, NULL};
    json_t *list = json_array(), *alone = json_pack("{s:o}", record_verdict.table, list);
    if (part->to == NULL || part->verdicts == j->verdicts) {
        json_decref(alone);
        return;
    }
    if (part->verdicts > 0)
        fputc(',', part->to);
    for (; part->verdicts < j->verdicts; part->verdicts++) {
        const subject one = gather_verdict(&g, &j->verdict[part->verdicts]);
        json_record_add(list, &record_verdict, &one, KEY_AROUND);
    }
    char *text = json_dumps(alone, DUMP);
    const size_t around = strlen(alone_before) + strlen(alone_behind);
    if (text == NULL || strlen(text) < around) {
        fclose(part->to);
        part->to = NULL;
    } else
        fwrite(text + strlen(alone_before), 1, strlen(text) - around, part->to);
    free(text);
    json_decref(alone);
}

void json_part_free(json_part *part)
{
    if (part->to != NULL)
        fclose(part->to);
    free(part->text);
    *part = (json_part){.verdicts = 0};
}

static json_t *assumptions_of(const sweep *s)
{
    json_t *all = json_array();
    subjects list = {0};
    for (int i = 0; i < s->points; i++)
        gather_assumptions(&s->point[i], &list);
    for (int i = 0; i < list.count; i++)
        json_record_add(all, &record_assumption, &list.row[i], KEY_AROUND);
    gather_free(&list);
    return all;
}

static json_t *breaches_of(const evaluation *j)
{
    json_t *all = json_array();
    for (int i = 0; i < j->breaches; i++)
        json_array_append_new(all, json_pack("{s:s, s:s}", "formulation", j->breach[i].formulation,
                                             "reason", j->breach[i].why));
    return all;
}

static json_t *regressions_of(const evaluation *j)
{
    json_t *all = json_array();
    for (int i = 0; i < j->regressions; i++)
        json_array_append_new(all, json_pack("{s:s, s:s}", "of", j->regression[i].of, "reason",
                                             j->regression[i].why));
    return all;
}

static json_t *around_verdicts(const sweep *s, const evaluation *j, const environment *e)
{
    const gathering g = {s, j, NULL};
    json_t *agreements = json_array(), *coverages = json_array(), *counts = json_object();
    for (int i = 0; i < j->agreements; i++) {
        const subject one = gather_agreement(&g, &j->agreement[i]);
        json_record_add(agreements, &record_agreement, &one, KEY_AROUND);
    }
    for (int i = 0; i < j->coverages; i++)
        for (int k = 0; k < COVERAGE_MESHES; k++) {
            const subject one = gather_coverage(&g, &j->coverage[i], k);
            json_record_add(coverages, &record_coverage, &one, KEY_AROUND);
        }
    for (int k = 0; k < VERDICT_KINDS; k++)
        json_object_set_new(counts, verdict_name((verdict_kind)k), json_integer(j->by_kind[k]));
    json_t *root = json_pack("{s:i,s:s,s:s,s:s,s:s,s:i,s:i,s:i,s:i,s:i,s:i,s:i}", "schema_version",
                             SCHEMA_VERSION, "program_version", e->version, "commit", e->commit,
                             "compiler", e->compiler, "clock", e->clock, "cells", sweep_cells(s),
                             "noise_cells", noise_cells(s), "judged", j->evaluated, "unexpected",
                             j->unexpected, "disagreements", j->disagreements,
                             "unobserved_findings", j->unobserved, "unmet_truths", j->unmet);
    json_object_set_new(root, "outcome", json_string(evaluation_outcome(j)));
    json_object_set_new(root, "broken_contracts", breaches_of(j));
    json_object_set_new(root, "regressions", regressions_of(j));
    json_object_set_new(root, "unfinished_cells", json_integer(s->unfinished));
    json_object_set_new(root, "contradictory_cells", json_integer(j->flaws));
    json_object_set_new(root, "counts", counts);
    json_object_set_new(root, record_verdict.table, json_array());
    json_object_set_new(root, record_agreement.table, agreements);
    json_object_set_new(root, record_coverage.table, coverages);
    json_object_set_new(root, record_assumption.table, assumptions_of(s));
    return root;
}

/* Writes the document with the verdicts at their position. Returns 0 on success. */
static int write_around(FILE *to, const char *around, const json_part *part)
{
    const char *place = strstr(around, none);
    if (place == NULL || part->to == NULL || fflush(part->to) != 0)
        return -1;
    const char *behind = place + strlen(none);
    fwrite(around, 1, (size_t)(behind - around) - 1, to);
    fwrite(part->text, 1, part->size, to);
    fprintf(to, "%s]%s\n", part->verdicts > 0 ? "\n " : "", behind);
    return ferror(to);
}

status json_write_verdicts(FILE *to, const sweep *s, const evaluation *j, const environment *e,
                           json_part *part, fault *f)
{
    json_part whole = {.verdicts = 0};
    json_t *root = around_verdicts(s, j, e);
    char *around = json_dumps(root, DUMP);
    if (part == NULL)
        json_part_begin(&whole);
    json_part_add(part != NULL ? part : &whole, s, j);
    const int bad = around == NULL || write_around(to, around, part != NULL ? part : &whole) != 0;
    json_part_free(&whole);
    json_decref(root);
    free(around);
    return bad ? fault_set(f, STATUS_FAULT, unwritten) : STATUS_OK;
}

static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *json_record_numbers(int count, const double value[])
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, number(value[i]));
    return list;
}

static json_t *matrix(int count, const double value[])
{
    const int size = (int)lround(sqrt(count));
    json_t *rows = json_array();
    for (int i = 0; i < size; i++)
        json_array_append_new(rows, json_record_numbers(size, value + size * i));
    return rows;
}

static json_t *json_of(const schema_field *which, const field_value *v)
{
    if (which->kind == FIELD_INT || which->kind == FIELD_LONG)
        return json_integer(v->whole);
    if (which->kind == FIELD_FLAG)
        return json_boolean(v->whole);
    if (which->kind == FIELD_DOUBLE)
        return which->count > 0 ? matrix(which->count, v->numbers) : number(*v->numbers);
    return json_string(v->text);
}

json_t *json_record(const record_type *type, const subject *s, int keys)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(type, keys, list);
    json_t *out = json_object();
    for (int i = 0; i < count; i++) {
        field_value v;
        schema_read(s, list[i], &v);
        json_object_set_new(out, list[i]->name, json_of(list[i], &v));
    }
    return out;
}

void json_record_add(json_t *list, const record_type *type, const subject *s, int keys)
{
    json_array_append_new(list, json_record(type, s, keys));
}

/* Returns the times of a mesh, with the quantities that have a reference value. */
static json_t *timing_of(const gathering *g, int series_index, int mesh)
{
    subjects list = {0};
    subject cell = gather_cell(g, series_index, mesh);
    json_t *out = json_record(&record_cell, &cell, KEY_AROUND), *quantities = json_array();
    cell.record = &g->sweep->series[series_index].timing[mesh];
    json_t *times = json_record(&record_timing, &cell, 0);
    json_object_update(out, times);
    json_decref(times);
    gather_mesh(g, &record_quantity, series_index, mesh, &list);
    for (int i = 0; i < list.count; i++)
        if (list.row[i].truth != NULL)
            json_record_add(quantities, &record_quantity, &list.row[i], KEY);
    gather_free(&list);
    json_object_set_new(out, "quantities", quantities);
    return out;
}

status json_timing_write(FILE *to, const sweep *s, const evaluation *j, const environment *e,
                         fault *f)
{
    const gathering g = {s, j, NULL};
    json_t *all = json_array();
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; k < s->series[i].meshes && s->series[i].missing[0] == '\0'; k++)
            json_array_append_new(all, timing_of(&g, i, k));
    return json_finish(json_pack("{s:i,s:s,s:s,s:s,s:s,s:s,s:o}", "schema_version", SCHEMA_VERSION,
                                 "program_version", e->version, "commit", e->commit, "compiler",
                                 e->compiler, "processor", e->processor, "clock", e->clock,
                                 record_timing.table, all),
                       to, f);
}

static json_t *json_field(const schema_field *which)
{
    json_t *out = json_pack("{s:s,s:s,s:s,s:s,s:b}", "name", which->name, "kind",
                            schema_kind_name(which->kind), "unit", which->unit, "summary",
                            which->summary, "key", which->key != 0);
    json_object_set_new(out, "said_around", json_boolean(which->key == KEY_AROUND));
    json_t *words = json_array();
    for (int i = 0; i < which->words; i++)
        json_array_append_new(words, json_string(which->word(i)));
    json_object_set_new(out, "words", words);
    json_object_set_new(out, "count", json_integer(which->count > 0 ? which->count : 1));
    return out;
}

json_t *json_record_type(const record_type *type)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(type, KEY_AROUND, list);
    json_t *fields = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(fields, json_field(list[i]));
    return json_pack("{s:s,s:s,s:s,s:o}", "record", type->name, "table", type->table, "summary",
                     type->summary, "fields", fields);
}
