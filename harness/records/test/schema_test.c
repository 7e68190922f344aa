/* The tables of fields must be well formed, and every stored field must be transferred unchanged
 * between processes. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

static int is_name(const char *text)
{
    return text[0] >= 'a' && text[0] <= 'z' &&
           strspn(text, "abcdefghijklmnopqrstuvwxyz_0123456789.") == strlen(text);
}

static int is_number(const schema_field *f)
{
    return f->kind == FIELD_INT || f->kind == FIELD_LONG || f->kind == FIELD_DOUBLE;
}

static void well_formed(const record_type *type)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(type, KEY_AROUND, list);
    gsl_test(count < 2 || count >= SCHEMA_MOST_FIELDS, "%s has fields, and none is lost",
             type->name);
    for (int i = 0; i < count; i++) {
        const schema_field *f = list[i];
        int twice = 0;
        for (int k = 0; k < i; k++)
            twice |= strcmp(list[k]->name, f->name) == 0;
        gsl_test(twice || !is_name(f->name), "%s.%s is a name of its own", type->name, f->name);
        gsl_test(f->summary == NULL || f->summary[0] == '\0', "%s.%s says what it is", type->name,
                 f->name);
        gsl_test(is_number(f) != (f->unit[0] != '\0'), "%s.%s has a unit when it is a number",
                 type->name, f->name);
        gsl_test((f->kind == FIELD_ENUM) != (f->word != NULL && f->words > 0), "%s.%s has words",
                 type->name, f->name);
        gsl_test(f->count > 0 && f->kind != FIELD_DOUBLE, "%s.%s: an array has numbers", type->name,
                 f->name);
    }
}

static void parameters_differ(const case_type *type)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(&record_point, KEY_AROUND, list);
    for (int i = 0; i < parameter_count(type->parameters); i++)
        for (int k = 0; k < count; k++)
            gsl_test(strcmp(parameter_at(type->parameters, i)->name, list[k]->name) == 0,
                     "%s: parameter %s beside a field", type->name, list[k]->name);
}

static void plant(void *record, const schema_field *f, int value)
{
    char *at = (char *)record + f->offset;
    if (f->kind == FIELD_DOUBLE)
        *(double *)at = 0.5 + value;
    else if (f->kind == FIELD_LONG)
        *(long *)at = 1000 + value;
    else if (f->kind == FIELD_TEXT)
        snprintf(at, 16, "text %d", value);
    else
        *(int *)at = f->words > 0 ? value % f->words : value;
}

static int same(const void *a, const void *b, const schema_field *f)
{
    const subject left = {.record = a}, right = {.record = b};
    field_value x, y;
    schema_read(&left, f, &x);
    schema_read(&right, f, &y);
    if (f->kind == FIELD_DOUBLE)
        return *x.numbers == *y.numbers;
    return f->kind == FIELD_TEXT || f->kind == FIELD_ENUM ? strcmp(x.text, y.text) == 0
                                                          : x.whole == y.whole;
}

static void plant_all(const record_type *type, void *record)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(type, 0, list);
    for (int i = 0; i < count; i++)
        if (list[i]->get == NULL && list[i]->base == BASE_RECORD)
            plant(record, list[i], i + 1);
}

static void all_same(const record_type *type, const void *a, const void *b)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(type, 0, list);
    for (int i = 0; i < count; i++)
        if (list[i]->get == NULL && list[i]->base == BASE_RECORD)
            gsl_test(!same(a, b, list[i]), "%s.%s comes through the pipe", type->name,
                     list[i]->name);
}

static void pipe_carries_all(void)
{
    double x[2] = {1, 2}, y[2] = {3, 4}, path = 5, compliance[36], stiffness[36];
    char line[] = "one line", *lines[] = {line};
    quantity_result quantity = {.value = 0};
    step_record step = {.path = 0};
    iteration_record iteration = {.residual = 0};
    path_event event = {.factor = 0};
    motion_record motion = {.analysis = 0};
    nodal_matrices matrices = {.node = 0};
    cell_result cell = {.left_out_lines = 1, .left_out = lines}, back;
    for (int i = 0; i < 36; i++) {
        compliance[i] = i;
        stiffness[i] = -i;
    }
    plant_all(&record_cell, &cell);
    plant_all(&record_quantity, &quantity);
    plant_all(&record_step, &step);
    plant_all(&record_iteration, &iteration);
    plant_all(&record_event, &event);
    plant_all(&record_motion, &motion);
    plant_all(&record_matrix, &matrices);
    quantity.curve = (curve){2, x, y};
    matrices.stations = 1;
    matrices.path = &path;
    matrices.compliance = compliance;
    matrices.stiffness = stiffness;
    cell.solve.quantities = cell.solve.steps = cell.solve.iterations = cell.solve.events =
        cell.solve.motions = cell.solve.matrix_sets = 1;
    cell.solve.quantity = &quantity;
    cell.solve.step = &step;
    cell.solve.iteration = &iteration;
    cell.solve.event = &event;
    cell.solve.motion = &motion;
    cell.solve.matrices = &matrices;
    FILE *file = tmpfile();
    gsl_test(serialise_write(file, &cell) != 0, "written");
    rewind(file);
    gsl_test(serialise_read(file, &back) != 0, "read");
    all_same(&record_cell, &cell, &back);
    all_same(&record_quantity, &quantity, back.solve.quantity);
    all_same(&record_step, &step, back.solve.step);
    all_same(&record_iteration, &iteration, back.solve.iteration);
    all_same(&record_event, &event, back.solve.event);
    all_same(&record_motion, &motion, back.solve.motion);
    all_same(&record_matrix, &matrices, back.solve.matrices);
    gsl_test(memcmp(back.solve.matrices->compliance, compliance, sizeof compliance) != 0,
             "compliance");
    gsl_test(memcmp(back.solve.matrices->stiffness, stiffness, sizeof stiffness) != 0, "stiffness");
    gsl_test(back.solve.matrices->path[0] != path, "path");
    gsl_test(back.solve.quantity->curve.x[1] != 2 || back.solve.quantity->curve.value[1] != 4,
             "curve");
    gsl_test(strcmp(back.left_out[0], line) != 0, "what was left out");
    cell_result_free(&back);
    fclose(file);
}

static void schema_tests(void)
{
    for (int i = 0; record_types[i] != NULL; i++)
        well_formed(record_types[i]);
    well_formed(&record_declaration);
    for (int i = 0; registry_cases[i] != NULL; i++)
        parameters_differ(registry_cases[i]);
    pipe_carries_all();
}

static const case_type type = {.name = "case_of_test"};

static char *written(const sweep *s, const evaluation *j)
{
    const environment e = {.commit = "c0ffee", .compiler = "cc"};
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    overview o;
    fault f = {""};
    gsl_test(overview_make(s, j, &o, &f) != STATUS_OK, "overview: %s", f.text);
    markdown_write(to, s, j, &o, &e);
    overview_free(&o);
    fclose(to);
    return text;
}

static void holds(const char *text, const char *part)
{
    gsl_test(strstr(text, part) == NULL, "written: %s", part);
}

static int lines_with(const char *text, const char *part)
{
    int count = 0;
    for (const char *at = text; (at = strstr(at, part)) != NULL; at += strlen(part))
        count++;
    return count;
}

static void long_lists(void)
{
    enum { MANY = 60, EVALUATED = 40, WORSE = 53 };
    scene_quantity quantity = {.name = "load"};
    static char name[MANY][16];
    static case_type types[MANY];
    static sweep_point p[MANY];
    static series one[MANY];
    static verdict v[MANY];
    static regression worse[WORSE];
    truth row = {.value = 2};
    for (int i = 0; i < MANY; i++) {
        snprintf(name[i], sizeof name[i], "case_%d", i);
        types[i].name = name[i];
        p[i] = (sweep_point){
            .type = &types[i], .text = "", .scene = {.quantities = 1, .quantity = &quantity}};
        one[i] = (series){.point = i, .formulation.key = "beam"};
        v[i] = (verdict){.series = i, .kind = VERDICT_WRONG_LIMIT, .truth = &row, .reason = ""};
    }
    for (int i = 0; i < WORSE; i++) {
        snprintf(worse[i].of, sizeof worse[i].of, "mesh %d", i);
        snprintf(worse[i].why, sizeof worse[i].why, "twice as far off");
    }
    const sweep s = {.points = MANY, .seriess = MANY, .point = p, .series = one};
    evaluation j = {.verdicts = MANY,
                    .verdict = v,
                    .evaluated = MANY,
                    .unexpected = MANY,
                    .regressions = WORSE,
                    .regression = worse};
    char *text = written(&s, &j);
    gsl_test_int(lines_with(text, " | twice as far off |"), 50, "rows of what is worse");
    gsl_test_int(lines_with(text, " | **wrong limit** | "), 50, "rows of what differs");
    holds(text, "| mesh 49 | twice as far off |\n\n… and 3 more.\n");
    holds(text, "\n\n… and 10 more.\n");
    free(text);

    for (int i = 0; i < MANY; i++) {
        v[i].kind = v[i].expected = VERDICT_PASS;
        v[i].matches = 1;
    }
    j = (evaluation){.verdicts = EVALUATED, .verdict = v, .evaluated = EVALUATED};
    text = written(&s, &j);
    holds(text, "\nAll verdicts pass: case_0, case_1, ");
    holds(text, ", case_39.\n");
    holds(text, "\nNo verdict: case_40, case_41, ");
    holds(text, ", case_59.\n");
    free(text);
}

static void markdown_tests(void)
{
    scene_quantity quantity = {.name = "load"};
    sweep_point p = {
        .type = &type, .text = "a=1", .scene = {.quantities = 1, .quantity = &quantity}};
    series one = {.formulation.key = "beam:option=2"};
    sweep s = {.points = 1, .seriess = 1, .point = &p, .series = &one};
    truth row = {.value = 2};
    verdict v = {.kind = VERDICT_WRONG_LIMIT,
                 .expected = VERDICT_PASS,
                 .truth = &row,
                 .fit.limit = 2.5,
                 .error = 0.25,
                 .reason = "left | right\nbelow"};
    evaluation j = {.verdicts = 1, .verdict = &v, .evaluated = 1, .unexpected = 1};
    flaw flaws[2] = {{.series = 0}};
    char *text = written(&s, &j);
    holds(text, "## beamwork: fail");
    holds(text,
          "runs: 0; verdicts against reference values: 1; unexpected verdicts: 1; stored discrete");
    holds(text, "| case_of_test | a=1 | `beam:option=2` | load | **wrong limit** | pass | 2.5 | 2 "
                "| +25 % | left \\| right below |");
    holds(text, "FAIL: 1 verdict differs from the expected one.");
    holds(text, "| case | beam:option=2 |\n|---|---|\n| case_of_test | **!≠1** |\n");
    holds(text, "\n≠ limit outside the tolerance; **!** not as expected.");
    free(text);

    v.matches = 1;
    j.unexpected = 0;
    text = written(&s, &j);
    holds(text, "## beamwork: pass");
    gsl_test(strstr(text, "**wrong limit**") != NULL, "nothing differs: no table of differences");
    holds(text, "| `beam:option=2` |  |  | 1 |");
    holds(text, "PASS: every verdict is as expected");
    holds(text, "| case_of_test | ≠1 |\n");
    free(text);

    j.unobserved = 3;
    text = written(&s, &j);
    holds(text, "## beamwork: fail");
    holds(text, "3 known deviations were not observed");
    free(text);

    j.unobserved = 0;
    j.flaws = 2;
    j.flaw = flaws;
    text = written(&s, &j);
    holds(text, "## beamwork: fail");
    holds(text, "2 inconsistent run records");
    holds(text, "| case_of_test | **!c2** |\n");
    free(text);

    breach broken = {"mine", "energy: it is none"};
    j = (evaluation){.evaluated = 1, .breaches = 1, .breach = &broken};
    text = written(&s, &j);
    holds(text,
          "## beamwork: fail\n\n**mine violates the interface requirements**: energy: it is none");
    free(text);

    j = (evaluation){.verdicts = 0};
    text = written(&s, &j);
    holds(text, "## beamwork: nothing was judged");
    free(text);
    long_lists();
}

int main(void)
{
    schema_tests();
    markdown_tests();
    return gsl_test_summary();
}
