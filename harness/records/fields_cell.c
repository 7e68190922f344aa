#include "harness/records/records_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/feature.h"
#include "harness/model/model.h"

static void get_features(const subject *s, field_value *out)
{
    feature_words(fields_keys_cell(s)->size.features, out->room, sizeof out->room);
    out->text = out->room;
}

static void get_left_out(const subject *s, field_value *out)
{
    const cell_result *cell = fields_keys_cell(s);
    size_t used = 0;
    out->room[0] = '\0';
    for (int i = 0;
         i < cell->left_out_lines && used + strlen(cell->left_out[i]) + 3 < sizeof out->room; i++)
        used += (size_t)sprintf(out->room + used, "%s%s", i > 0 ? "; " : "", cell->left_out[i]);
    out->text = out->room;
}

static void get_warping(const subject *s, field_value *out)
{
    warping_ends(&s->point->scene, out->room, sizeof out->room);
    out->text = out->room;
}

static void get_divided(const subject *s, field_value *out)
{
    out->room[0] = '\0';
    if (s->series->imported == NULL)
        division_words(&s->point->scene, s->series->mesh[s->mesh], out->room, sizeof out->room);
    out->text = out->room;
}

static void get_lumped(const subject *s, field_value *out)
{
    out->room[0] = '\0';
    if (s->series->imported == NULL)
        on_nodes(&s->point->scene, s->series->formulation.type, s->series->formulation.option,
                 out->room, sizeof out->room);
    out->text = out->room;
}

static void get_strains(const subject *s, field_value *out)
{
    const model_size *size = &fields_keys_cell(s)->size;
    out->whole = size->strains + size->inner;
}

static void get_cost(const subject *s, field_value *out)
{
    schema_set_number(out, s->series->imported == NULL
                               ? counted_cost(&s->series->formulation, fields_keys_cell(s))
                               : NAN);
}

static void get_has_cost(const subject *s, field_value *out)
{
    out->whole = has_cost_coefficients(cost_coefficients, &s->series->formulation);
}

static const schema_field fields_of_point[] = {
    {"parameters", "", FIELD_TEXT, "parameters that differ from their defaults",
     AT(sweep_point, text)},
    {"status", "", FIELD_ENUM, "status of building the scene", AT(sweep_point, status),
     .word = fields_keys_word_of_status, .words = STATUSES},
    {"reason", "", FIELD_TEXT, "reason for the rejection", AT(sweep_point, reason)},
    {0}};
const record_type record_point = {"point",
                                  "points",
                                  "a case with the values of its parameters",
                                  {keys_of_point, fields_of_point}};

static void get_theory(const subject *s, field_value *out)
{
    const element_type *type = s->series->formulation.type;
    schema_set_text(out, s->series->imported == NULL && s->point->status == STATUS_OK
                             ? features_theory_words(type, features_theory(&s->point->scene, type))
                             : "");
}

static void get_imported(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->imported != NULL ? s->series->imported->file : "");
}

static void get_model(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->imported != NULL ? s->series->imported->model : "beam");
}

/* Gives the bound of the relative change of values due to omitted physics; NAN: no physics is
 * omitted, or the bound is unknown. */
static void get_model_change(const subject *s, field_value *out)
{
    schema_set_number(out, s->series->without.what != 0 ? s->series->without.change : NAN);
}

static void get_without(const subject *s, field_value *out)
{
    omission_words(&s->series->without, out->room);
    out->text = out->room;
}

static const schema_field fields_of_series[] = {
    {"type", "", FIELD_TEXT, "name of the formulation", TEXT_OF(FORMULATION, element_type, name)},
    {"summary", "", FIELD_TEXT, "description", TEXT_OF(FORMULATION, element_type, summary)},
    {"source", "", FIELD_TEXT, "publication", TEXT_OF(FORMULATION, element_type, source)},
    {"missing", "", FIELD_TEXT,
     "features required by the case but not supported by the formulation, which was therefore not "
     "run",
     AT(series, missing)},
    {"not_modelled", "", FIELD_TEXT, "physics of the case that the formulation omits",
     AT(series, without.words)},
    {"model_change", "1", FIELD_DOUBLE,
     "bound on the relative change of the values of the scene due to the omitted physics",
     .get = get_model_change},
    {"other_model", "", FIELD_FLAG,
     "1 if model_change is above 1e-4 or unknown; there is then no verdict",
     AT(series, without.other)},
    {"model_words", "", FIELD_TEXT, "not_modelled, model_change and other_model in words",
     .get = get_without},
    {"imported", "", FIELD_TEXT,
     "imported file that contains this result; empty if beamwork computed the result",
     .get = get_imported},
    {"model", "", FIELD_TEXT, "model: beam, or a different model of another program",
     .get = get_model},
    {"shear_theory", "", FIELD_TEXT,
     "shear theory of the formulation in stability problems; empty if the formulation is rigid in "
     "shear",
     .get = get_theory},
    {0}};
const record_type record_series = {"series",
                                   "series",
                                   "a formulation at a point, on all its meshes",
                                   {keys_of_point, keys_of_series, fields_of_series}};

#define CELL(member) AT(cell_result, member)
static const schema_field fields_of_cell[] = {
    {"status", "", FIELD_ENUM, "ok, or the kind of failure", CELL(solve.status),
     .word = fields_keys_word_of_status, .words = STATUSES},
    {"reason", "", FIELD_TEXT, "reason for the failure", CELL(solve.reason)},
    {"elements_total", "1", FIELD_INT, "number of elements in the whole structure",
     CELL(size.elements)},
    {"element_kinds", "1", FIELD_INT, "number of distinct elements, each of which is prepared once",
     CELL(size.kinds)},
    {"free", "1", FIELD_INT, "unknown coordinates", CELL(size.free)},
    {"driven", "1", FIELD_INT, "prescribed coordinates", CELL(size.driven)},
    {"strains", "1", FIELD_INT, "number of strains of an element, including internal unknowns",
     .get = get_strains},
    {"features", "", FIELD_TEXT, "physics of the model", .get = get_features},
    {"omitted", "", FIELD_TEXT, "physics that the structure requires but the scene omits",
     .get = fields_keys_omitted},
    {"assumed", "", FIELD_TEXT, "assumptions about sections: see the table 'assumptions'",
     .get = fields_keys_assumed},
    {"left_out", "", FIELD_TEXT, "eliminated coordinates and omitted effects", .get = get_left_out},
    {"warping", "", FIELD_TEXT, "warping at ends of members: fixed, shared or free",
     .get = get_warping},
    {"divided", "", FIELD_TEXT, "members with more elements than requested, and the reason",
     .get = get_divided},
    {"lumped", "", FIELD_TEXT,
     "loads and masses that are lumped at nodes by convention, with the order of the error",
     .get = get_lumped},
    {"cost", "s", FIELD_DOUBLE,
     "cost of the counted work, with the cost coefficients of the reference machine",
     .get = get_cost},
    {"priced", "", FIELD_FLAG,
     "1 if the formulation has its own cost coefficients, 0 if the general cost coefficients are "
     "used",
     .get = get_has_cost},
    {"seconds_setup", "s", FIELD_DOUBLE, "processor time of the set-up in one run",
     CELL(solve.seconds_setup)},
    {"seconds_solve", "s", FIELD_DOUBLE, "processor time of the solution in one run",
     CELL(solve.seconds_solve)},
    {0}};

/* Add new counters here, in one line each. */
#define WORK(counter) AT(cell_result, counters.counter)
static const schema_field fields_of_work[] = {
    {"strain_evaluations", "1", FIELD_LONG, "number of evaluated deformation functions",
     WORK(strain_evaluations)},
    {"stress_evaluations", "1", FIELD_LONG, "number of evaluated stress functions",
     WORK(stress_evaluations)},
    {"inertia_evaluations", "1", FIELD_LONG,
     "number of computed mass matrices of elements, and of lumped masses with 'conserving'",
     WORK(inertia_evaluations)},
    {"geometric_evaluations", "1", FIELD_LONG,
     "number of computed geometric element stiffness matrices", WORK(geometric_evaluations)},
    {"iterations", "1", FIELD_LONG,
     "number of Newton iterations, including those of rejected steps", WORK(iterations)},
    {"load_steps", "1", FIELD_LONG, "accepted load steps", WORK(steps)},
    {"rejected_steps", "1", FIELD_LONG, "rejected load steps", WORK(rejected_steps)},
    {"factorisations", "1", FIELD_LONG, "factorisations of matrices", WORK(factorisations)},
    {"solutions", "1", FIELD_LONG, "right-hand sides solved", WORK(numerics.solutions)},
    {"solved_entries", "1", FIELD_DOUBLE,
     "sum of the numbers of entries of the factors over all right-hand sides",
     WORK(numerics.solved_entries)},
    {"factor_flops", "1", FIELD_DOUBLE, "number of floating-point operations of all factorisations",
     WORK(numerics.factor_flops)},
    {"dense_operations", "1", FIELD_DOUBLE,
     "sum of n^3 over dense n x n matrices that were factored or whose eigenvalues were computed",
     WORK(numerics.dense_operations)},
    {"negative_pivots", "1", FIELD_LONG,
     "largest number of negative pivots of a symmetric tangent along the path",
     WORK(negative_pivots)},
    {0}};
const record_type record_cell = {
    "cell",
    "cells",
    "a formulation on one mesh: size, work, times",
    {keys_of_point, keys_of_series, key_of_mesh, fields_of_cell, fields_of_work}};

static void get_elements(const subject *s, field_value *out)
{
    out->whole = s->series->mesh[s->mesh];
}

const schema_field keys_of_point[] = {
    {"case", "", FIELD_TEXT, "name of the case", TEXT_OF(CASE, case_type, name), .key = KEY_AROUND},
    {"point", "", FIELD_TEXT, "default, or the first digits of the hash of the parameters",
     OF(POINT, sweep_point, name), .key = KEY},
    {0}};

const schema_field keys_of_series[] = {
    {"parameters", "", FIELD_TEXT, "parameters that differ from their defaults",
     OF(POINT, sweep_point, text), .key = KEY_AROUND},
    {"formulation", "", FIELD_TEXT,
     "name of the formulation, with options that differ from their defaults",
     OF(SERIES, series, formulation.key), .key = KEY},
    {0}};

const schema_field key_of_mesh[] = {{"elements", "1", FIELD_INT,
                                     "number of elements of each member", .get = get_elements,
                                     .key = KEY},
                                    {0}};

const schema_field names_of_quantity[] = {
    {"quantity", "", FIELD_TEXT, "name of the quantity", OF(QUANTITY, scene_quantity, name)},
    {"unit", "", FIELD_TEXT, "unit of the value", OF(QUANTITY, scene_quantity, unit)},
    {0}};

const char *fields_keys_word_of_status(int value)
{
    return status_name((status)value);
}

const char *fields_keys_word_of_moments(int convention)
{
    return scene_moments_name((scene_moments)convention);
}

const scene_quantity *fields_keys_quantity(const subject *s)
{
    return &s->point->scene.quantity[s->index];
}

const cell_result *fields_keys_cell(const subject *s)
{
    return &s->series->cell[s->mesh];
}

void fields_keys_omitted(const subject *s, field_value *out)
{
    char words[SCENE_OMISSION_WORDS] = "";
    if (s->point->status == STATUS_OK)
        scene_omission_words(features_omitted(&s->point->scene), words);
    snprintf(out->room, sizeof out->room, "%s", words);
    out->text = out->room;
}

void fields_keys_assumed(const subject *s, field_value *out)
{
    assumptions_words(s->point, sizeof out->room, out->room);
    out->text = out->room;
}

static const schema_field field_omitted[] = {
    {"omitted", "", FIELD_TEXT, "physics that the structure requires but the scene omits",
     .get = fields_keys_omitted},
    {"assumed", "", FIELD_TEXT, "assumptions about sections: see the table 'assumptions'",
     .get = fields_keys_assumed},
    {0}};
const record_type record_omission = {
    "omission",
    "",
    "physics omitted by the scene of a value, and assumptions about sections",
    {field_omitted}};

static const cell_timing *timing_of(const subject *s)
{
    return s->record;
}

static const rounds_reading *reading_of(const field_value *out, const cell_timing *t)
{
    return out->of->offset < offsetof(cell_timing, keep_all) ? &t->as_is : &t->keep_all;
}

/* Gives a measured time; NAN: nothing was measured. */
static void get_measured(const subject *s, field_value *out)
{
    const cell_timing *t = timing_of(s);
    const double stored = *(const double *)((const char *)t + out->of->offset);
    schema_set_number(out, reading_of(out, t)->rounds > 0 ? stored : NAN);
}

static void get_round(const subject *s, field_value *out)
{
    get_measured(s, out);
    if (out->number == 0)
        out->number = NAN; /* fewer rounds were measured */
}

static void get_least(const subject *s, field_value *out)
{
    const rounds_reading *c = &timing_of(s)->as_is;
    schema_set_number(out, c->rounds > 0 ? rounds_least(c) : NAN);
}

static void get_most(const subject *s, field_value *out)
{
    const rounds_reading *c = &timing_of(s)->as_is;
    schema_set_number(out, c->rounds > 0 ? rounds_most(c) : NAN);
}

static void get_dense_iteration(const subject *s, field_value *out)
{
    const dense_reference *dense = &timing_of(s)->dense;
    schema_set_number(out, dense->unknowns > 0 ? dense->iteration : NAN);
}

static void get_dense_seconds(const subject *s, field_value *out)
{
    const dense_reference *dense = &timing_of(s)->dense;
    schema_set_number(out,
                      dense->unknowns > 0
                          ? dense_reference_seconds(dense, fields_keys_cell(s)->counters.iterations)
                          : NAN);
}

static void get_dense_whole(const subject *s, field_value *out)
{
    out->whole = timing_of(s)->dense.whole.rounds > 0;
}

#define TIMES(member) AT(cell_timing, member)
static const schema_field fields_of_readings[] = {
    {"repeats", "1", FIELD_INT, "number of runs; 0 if not measured", TIMES(as_is.repeats)},
    {"seconds_setup", "s", FIELD_DOUBLE, "fastest run: set-up", TIMES(as_is.setup),
     .get = get_measured},
    {"seconds_solve", "s", FIELD_DOUBLE, "fastest run: solution", TIMES(as_is.solve),
     .get = get_measured},
    {"seconds_least", "s", FIELD_DOUBLE, "time of set-up and solution in the fastest round",
     .get = get_least},
    {"seconds_most", "s", FIELD_DOUBLE, "time of set-up and solution in the slowest round",
     .get = get_most},
    {"round_1", "s", FIELD_DOUBLE, "time of set-up and solution in round 1", TIMES(as_is.round[0]),
     .get = get_round},
    {"round_2", "s", FIELD_DOUBLE, "time of set-up and solution in round 2", TIMES(as_is.round[1]),
     .get = get_round},
    {"round_3", "s", FIELD_DOUBLE, "time of set-up and solution in round 3", TIMES(as_is.round[2]),
     .get = get_round},
    {"round_4", "s", FIELD_DOUBLE, "time of set-up and solution in round 4", TIMES(as_is.round[3]),
     .get = get_round},
    {"round_5", "s", FIELD_DOUBLE, "time of set-up and solution in round 5", TIMES(as_is.round[4]),
     .get = get_round},
    {"keep_all_repeats", "1", FIELD_INT, "number of runs with all degrees of freedom",
     TIMES(keep_all.repeats)},
    {"keep_all_setup", "s", FIELD_DOUBLE, "time of the set-up with all degrees of freedom",
     TIMES(keep_all.setup), .get = get_measured},
    {"keep_all_solve", "s", FIELD_DOUBLE, "time of the solution with all degrees of freedom",
     TIMES(keep_all.solve), .get = get_measured},
    {"keep_all_round_1", "s", FIELD_DOUBLE,
     "time of set-up and solution with all degrees of freedom in round 1", TIMES(keep_all.round[0]),
     .get = get_round},
    {"keep_all_round_2", "s", FIELD_DOUBLE,
     "time of set-up and solution with all degrees of freedom in round 2", TIMES(keep_all.round[1]),
     .get = get_round},
    {"keep_all_round_3", "s", FIELD_DOUBLE,
     "time of set-up and solution with all degrees of freedom in round 3", TIMES(keep_all.round[2]),
     .get = get_round},
    {"keep_all_round_4", "s", FIELD_DOUBLE,
     "time of set-up and solution with all degrees of freedom in round 4", TIMES(keep_all.round[3]),
     .get = get_round},
    {"keep_all_round_5", "s", FIELD_DOUBLE,
     "time of set-up and solution with all degrees of freedom in round 5", TIMES(keep_all.round[4]),
     .get = get_round},
    {"keep_all_free", "1", FIELD_INT, "number of unknowns with all degrees of freedom",
     TIMES(free_keep_all)},
    {0}};
static const schema_field fields_of_parts[] = {
    {"seconds_elements", "s", FIELD_DOUBLE, "Newton iterations: elements",
     TIMES(phase[PHASE_ELEMENTS])},
    {"seconds_assembly", "s", FIELD_DOUBLE, "Newton iterations: assembly",
     TIMES(phase[PHASE_ASSEMBLY])},
    {"seconds_factorisation", "s", FIELD_DOUBLE, "Newton iterations: factorisation",
     TIMES(phase[PHASE_FACTORISATION])},
    {"seconds_solution", "s", FIELD_DOUBLE, "Newton iterations: solution",
     TIMES(phase[PHASE_SOLUTION])},
    {"seconds_rest", "s", FIELD_DOUBLE,
     "time outside the Newton iterations: loads, compliance, modes", TIMES(phase[PHASE_REST])},
    {"dense_unknowns", "1", FIELD_INT,
     "number of unknowns of the published algorithm (newton=dense); 0 if not measured",
     TIMES(dense.unknowns)},
    {"dense_iteration", "s", FIELD_DOUBLE, "fastest iteration of the published algorithm",
     .get = get_dense_iteration},
    {"dense_seconds", "s", FIELD_DOUBLE, "time of all iterations of the published algorithm",
     .get = get_dense_seconds},
    {"dense_whole", "", FIELD_FLAG,
     "1 if whole runs of the published algorithm were timed, 0 if the time of one iteration was "
     "multiplied by the number of iterations",
     .get = get_dense_whole},
    {0}};
const record_type record_timing = {
    "timing",
    "timings",
    "times of a formulation on one mesh, from repeated runs",
    {keys_of_point, keys_of_series, key_of_mesh, fields_of_readings, fields_of_parts}};

static void get_file(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->imported->file);
}

static void import_get_model(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->imported->model);
}

static void get_convention(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->imported->convention);
}

static void get_version(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->imported->version);
}

static const schema_field fields_of_import[] = {
    {"elements", "1", FIELD_INT, "number of elements, as given in the file",
     AT(imported_row, elements)},
    {"file", "", FIELD_TEXT, "name of the file", .get = get_file},
    {"line", "1", FIELD_INT, "line of the file", AT(imported_row, line)},
    {"model", "", FIELD_TEXT, "beam, or another model", .get = import_get_model},
    {"convention", "", FIELD_TEXT, "moment convention", .get = get_convention},
    {"version", "", FIELD_TEXT, "version of the program", .get = get_version},
    {"file_unit", "", FIELD_TEXT, "unit of the value in the file", AT(imported_row, unit)},
    {"factor", "1", FIELD_DOUBLE, "factor by which the value in the file was multiplied",
     AT(imported_row, factor)},
    {"unknowns", "1", FIELD_INT, "number of unknown coordinates; 0 if not given",
     AT(imported_row, unknowns)},
    {"seconds", "s", FIELD_DOUBLE, "time of the solution, as given in the file",
     AT(imported_row, seconds)},
    {"x_unit", "", FIELD_TEXT, "unit of the abscissa of a curve",
     OF(QUANTITY, scene_quantity, x.unit)},
    {"x", "x_unit", FIELD_DOUBLE, "abscissa of a curve", AT(imported_row, x)},
    {"value", OWN_UNIT, FIELD_DOUBLE, "value in the unit of the quantity", AT(imported_row, value)},
    {"uncertainty", OWN_UNIT, FIELD_DOUBLE, "uncertainty of the value",
     AT(imported_row, uncertainty)},
    {0}};
const record_type record_import = {
    "import",
    "imports",
    "a value of another program, with its source",
    {keys_of_point, keys_of_series, names_of_quantity, fields_of_import}};
