#include "harness/cli/cli_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/records/records.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

enum { LEVELS = 8, LINE = 1000, NAMED = 2 * FORMULATION_KEY };

typedef struct error_comparison {
    sweep s; /* sweep with two series, A and B */
    truths t;
    int levels, requested; /* levels: number of error targets; requested: number of targets given by
                              --error */
    double level[LEVELS];
    char note[DEFAULTS_NOTE];
} error_comparison;

typedef struct mesh_pair {
    equal_error at;
    int measured;
    compared_run one[2];
    against_times times;
} mesh_pair;

static status measure(const error_comparison *d, const bench_options *r, const mesh_pair *former,
                      int formers, mesh_pair *m, fault *f)
{
    for (int i = 0; i < formers; i++)
        if (former[i].measured && memcmp(former[i].at.mesh, m->at.mesh, sizeof m->at.mesh) == 0) {
            *m = former[i];
            return STATUS_OK;
        }
    for (int i = 0; i < 2; i++) {
        const series *one = &d->s.series[i];
        compared_run_here(&m->one[i], r, &d->s.point[0].scene, &one->formulation,
                          one->mesh[m->at.mesh[i]]);
    }
    m->one[1].slowdown = 0.01 * r->slowdown;
    m->measured = 1;
    return compared_run_measure(&m->one[0], &m->one[1], &m->times, f);
}

/* Writes text such as "NAME n = 4 (0.31 ms, largest error 0.021 %)". */
static void put(char out[NAMED], const mesh_pair *m, int i)
{
    char error[ROUNDING_TEXT];
    const double lap = i == 0 ? m->times.a : m->times.b;
    rounding_digits(100 * m->at.error[i], 2, error);
    snprintf(out, NAMED, "%.150s (%.3g ms, largest error %s %%)", m->one[i].name,
             1e3 * lap / m->one[i].repeats, error);
}

static void show_equal_error(const error_comparison *d, double level, const mesh_pair *m)
{
    char line[LINE], faster[NAMED], slower[NAMED];
    const against_times *v = &m->times;
    const int b_is_faster = v->outcome == AGAINST_FASTER;
    const double low = b_is_faster ? 1 / v->high : v->low,
                 high = b_is_faster ? 1 / v->low : v->high;
    const int at = printf("at %g %%: ", 100 * level);
    if (!m->measured) {
        snprintf(line, sizeof line,
                 "this error is not achieved by %s%s%s with the meshes of the case",
                 m->at.mesh[0] < 0 ? d->s.series[0].formulation.key : "",
                 m->at.mesh[0] < 0 && m->at.mesh[1] < 0 ? " and " : "",
                 m->at.mesh[1] < 0 ? d->s.series[1].formulation.key : "");
        paragraph_write(stdout, at, 4, line);
        return;
    }
    put(faster, m, b_is_faster);
    put(slower, m, !b_is_faster);
    if (v->outcome == AGAINST_UNDECIDED)
        snprintf(line, sizeof line,
                 "undecided between %s and %s: the second takes %.3f to %.3f times as long", faster,
                 slower, low, high);
    else if (reach_unranked(d->s.series[0].formulation.type)[0] != '\0' ||
             reach_unranked(d->s.series[1].formulation.type)[0] != '\0')
        snprintf(line, sizeof line, "not ranked: %s takes %.2f to %.2f times as long as %s", slower,
                 low, high, faster);
    else
        snprintf(line, sizeof line, "%s is faster: %s takes %.2f to %.2f times as long", faster,
                 slower, low, high);
    paragraph_write(stdout, at, 4, line);
}

static void show_defects(const error_comparison *d)
{
    for (int i = 0; i < 2; i++)
        for (int q = 0; q < d->s.point[0].scene.quantities; q++) {
            char text[2 * FAULT_TEXT];
            const scene_quantity *wanted = &d->s.point[0].scene.quantity[q];
            verdict v = {.series = i, .quantity = q};
            if (!equal_error_includes(&d->s, &d->t, q))
                continue;
            verdict_reach(&d->s, &d->t, &v);
            if (v.kind != VERDICT_BIASED && v.kind != VERDICT_WRONG_LIMIT &&
                v.kind != VERDICT_BIASED_AS_PREDICTED && v.kind != VERDICT_WRONG_AS_PREDICTED)
                continue;
            sentence_of_verdict(&v, wanted->least_order, text, sizeof text);
            const int at = printf("%s, %s: ", d->s.series[i].formulation.key, wanted->name);
            paragraph_write(stdout, at, 4, text);
        }
}

static void show(const error_comparison *d, const mesh_pair m[])
{
    char line[LINE] = "";
    fputs(d->note, stdout);
    table_omitted(stdout, &d->s.point[0]);
    for (int q = 0; q < d->s.point[0].scene.quantities; q++)
        if (equal_error_includes(&d->s, &d->t, q))
            snprintf(line + strlen(line), sizeof line - strlen(line), "%s%s",
                     line[0] != '\0' ? ", " : "", d->s.point[0].scene.quantity[q].name);
    const int at = printf("%s, ", d->s.point[0].type->name);
    paragraph_printf(stdout, at, 2,
                     "%s against %s, at equal error in each quantity (99.9 %% confidence): %s",
                     d->s.series[0].formulation.key, d->s.series[1].formulation.key, line);
    for (int i = 0; i < d->levels; i++)
        show_equal_error(d, d->level[i], &m[i]);
    if (d->levels > 0 && m[0].measured)
        compared_run_unranked(&m[0].one[0], &m[0].one[1]);
    show_defects(d);
}

static json_t *json_mesh(const error_comparison *d, const mesh_pair *m, int i)
{
    return m->at.mesh[i] >= 0 ? json_integer(d->s.series[i].mesh[m->at.mesh[i]]) : json_null();
}

static json_t *json_equal_error(const error_comparison *d, double level, const mesh_pair *m)
{
    json_t *one = m->measured ? compared_run_json(&m->one[0], &m->one[1], &m->times)
                              : json_pack("{s:s}", "outcome", "not reached");
    json_object_set_new(one, "error", json_real(level));
    json_object_set_new(one, "elements_a", json_mesh(d, m, 0));
    json_object_set_new(one, "elements_b", json_mesh(d, m, 1));
    if (m->measured) {
        json_object_set_new(one, "error_a", json_real(m->at.error[0]));
        json_object_set_new(one, "error_b", json_real(m->at.error[1]));
    }
    return one;
}

static void show_json(const error_comparison *d, const mesh_pair m[])
{
    json_t *list = json_array(), *names = json_array();
    for (int i = 0; i < d->levels; i++)
        json_array_append_new(list, json_equal_error(d, d->level[i], &m[i]));
    for (int q = 0; q < d->s.point[0].scene.quantities; q++)
        if (equal_error_includes(&d->s, &d->t, q))
            json_array_append_new(names, json_string(d->s.point[0].scene.quantity[q].name));
    json_t *root = json_pack("{s:s,s:s,s:s,s:o,s:o}", "case", d->s.point[0].type->name, "a",
                             d->s.series[0].formulation.key, "b", d->s.series[1].formulation.key,
                             "quantities", names, "comparisons", list);
    json_add_physics(root, &d->s.point[0]);
    json_dumpf(root, stdout, JSON_INDENT(1));
    putchar('\n');
    json_decref(root);
}

static int choose_levels(error_comparison *d, mesh_pair m[LEVELS])
{
    for (int i = 0; i < REACH_LEVELS && d->requested == 0; i++) {
        const equal_error here = equal_error_at(&d->s, &d->t, reach_level[i]);
        if (equal_error_met(&here))
            d->level[d->levels++] = reach_level[i];
    }
    for (int i = 0; i < d->levels; i++)
        m[i] = (mesh_pair){.at = equal_error_at(&d->s, &d->t, d->level[i])};
    return d->levels;
}

static status check(const error_comparison *d, const bench_options *r, fault *f)
{
    for (int i = 0; i < d->s.seriess; i++)
        if (d->s.series[i].missing[0] != '\0')
            return sweep_unsupported(d->s.series[i].formulation.key, d->s.series[i].missing,
                                     d->s.point[0].type->name, f);
    if (d->s.seriess != 2)
        return fault_set(f, STATUS_REFUSED,
                         "-k '%.100s' selects only one of the two formulations; remove the names "
                         "of formulations from it, so that it selects only quantities",
                         r->select);
    return equal_error_quantities(&d->s, &d->t) > 0
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "errors cannot be computed, because no quantity has a reference value, "
                           "or a limit on which formulations agree, that applies to both "
                           "formulations; give -n, such as -n 2, to compare meshes instead");
}

static status compare(error_comparison *d, const bench_options *r, fault *f)
{
    static mesh_pair m[LEVELS];
    TRY(check(d, r, f));
    if (choose_levels(d, m) == 0)
        return fault_set(f, STATUS_REFUSED,
                         "no error of 10, 1, 0.1 or 0.01 %% is achieved by both formulations; give "
                         "a larger error, such as --error 20%%, or meshes, such as -n 2");
    for (int i = 0; i < d->levels; i++)
        if (equal_error_met(&m[i].at))
            TRY(measure(d, r, m, i, &m[i], f));
    (r->format[0] == 'j' ? show_json : show)(d, m);
    return STATUS_OK;
}

/* REFUSED: one of the formulations solves another model, so its errors are not due to its
 * elements. */
static status check_models(const sweep *s, fault *f)
{
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].without.other)
            return fault_set(f, STATUS_REFUSED,
                             "%.60s solves a different model of %.60s, without %.100s, so its "
                             "errors cannot be compared; compare run times on meshes, such as -n 2",
                             s->series[i].formulation.key, s->point[s->series[i].point].type->name,
                             s->series[i].without.words);
    return STATUS_OK;
}

static status compare_at_errors(error_comparison *d, bench_options *r, const case_type *type,
                                fault *f)
{
    const sweep_request request = {.jobs = r->jobs,
                                   .progress = isatty(STDERR_FILENO) ? stderr : NULL};
    if (r->error != NULL)
        TRY(errors_parse(r->error, LEVELS, d->level, &d->levels, f));
    d->requested = d->levels;
    const defaults missing = compared_run_defaults(r, type);
    TRY(defaults_formulation(&missing, d->note, f));
    TRY(formulation_parse(r->against, &r->chosen.formulation[1], f));
    TRY(case_input_truths(&r->of, &r->truths, &d->t, f));
    TRY(plan_one(type, r->of.parameter, r->chosen.formulation, 2, NULL, 0, &d->s, f));
    TRY(check_models(&d->s, f));
    TRY(narrow_to(&d->s, r->select, f));
    TRY(run_sweep(&request, &d->s, f));
    TRY(families_add_truths(&d->s, 0, &d->t, f));
    return compare(d, r, f);
}

/* Compares two formulations at equal errors. The targets are those of --error, or those of
 * reach_level that both formulations meet. The quantities are those of -k, or all for which both
 * have a reference value or an agreement. REFUSED: the message gives the reason. */
static status against_error(bench_options *r, const case_type *type, fault *f)
{
    error_comparison d = {.levels = 0};
    const status outcome = compare_at_errors(&d, r, type, f);
    sweep_free(&d.s);
    truths_free(&d.t);
    return outcome;
}

static void show_pair(const bench_options *r, const sweep_point *p, const compared_run *a,
                      const compared_run *b, const against_times *v)
{
    if (r->format[0] != 'j') {
        table_omitted(stdout, p);
        compared_run_show(a, b, v);
        return;
    }
    json_t *root = compared_run_json(a, b, v);
    json_add_physics(root, p);
    json_dumpf(root, stdout, JSON_INDENT(1));
    putchar('\n');
    json_decref(root);
}

static sweep_point point_of(const bench_options *r, const case_type *type, const scene *s)
{
    sweep_point p = {.type = type, .scene = *s, .status = STATUS_OK};
    memcpy(p.parameter, r->of.parameter, sizeof p.parameter);
    return p;
}

static status against_program(const bench_options *r, const case_type *type, scene *s, fault *f)
{
    compared_run a, b;
    against_times times;
    TRY(cell_scene(type, r->of.parameter, NULL, s, f));
    compared_run_elsewhere(&a, r, "/proc/self/exe");
    compared_run_elsewhere(&b, r, r->against);
    TRY(compared_run_measure(&a, &b, &times, f));
    const sweep_point p = point_of(r, type, s);
    show_pair(r, &p, &a, &b, &times);
    return STATUS_OK;
}

static status compare_formulations(const bench_options *r, const case_type *type, scene *s,
                                   fault *f)
{
    compared_run a, b;
    formulation other;
    against_times times;
    TRY(formulation_parse(r->against, &other, f));
    TRY(cell_scene(type, r->of.parameter, NULL, s, f));
    compared_run_here(&a, r, s, &r->chosen.formulation[0], r->meshes.elements[0]);
    compared_run_here(&b, r, s, &other, r->meshes.elements[r->meshes.count - 1]);
    b.slowdown = 0.01 * r->slowdown;
    TRY(compared_run_measure(&a, &b, &times, f));
    const sweep_point p = point_of(r, type, s);
    show_pair(r, &p, &a, &b, &times);
    return STATUS_OK;
}

static status against_meshes(bench_options *r, const case_type *type, int is_program, fault *f)
{
    scene s = {0};
    char note[DEFAULTS_NOTE];
    const defaults missing = compared_run_defaults(r, type);
    TRY(defaults_fill(&missing, note, NULL, f));
    if (r->format[0] == 't')
        fputs(note, stdout);
    const status outcome = (is_program ? against_program : compare_formulations)(r, type, &s, f);
    scene_free(&s);
    return outcome;
}

static status against_other(bench_options *r, const case_type *type, fault *f)
{
    const int is_program = strchr(r->against, '/') != NULL;
    if (is_program && access(r->against, X_OK) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "program %.200s does not exist or is not executable; give the path of "
                         "beamwork in another build, such as --against ../before/build/beamwork",
                         r->against);
    if (is_program && (r->error != NULL || r->select != NULL))
        return fault_set(f, STATUS_REFUSED,
                         "another build of beamwork is compared on the same mesh, not at equal "
                         "errors; remove --error and -k");
    if (is_program && (r->slowdown > 0 || r->meshes.count > 1))
        return fault_set(f, STATUS_REFUSED,
                         "--inject-slowdown and a second mesh apply only to --against FORMULATION; "
                         "remove --inject-slowdown, and give one number with -n");
    if (r->meshes.count == 0 && !is_program)
        return against_error(r, type, f);
    if (r->error != NULL || r->select != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "-n gives the meshes, but --error and -k determine them; remove -n, or "
                         "remove --error and -k");
    return against_meshes(r, type, is_program, f);
}

int bench_against_run(bench_options *r)
{
    fault f = {""};
    if (r->of.line->arguments + (r->of.scene_path != NULL) != 1 || r->chosen.formulations > 1 ||
        r->meshes.count > 2)
        return message_fail(
            STATUS_REFUSED,
            "--against requires one case or --scene, at most one -f, and at most two numbers with "
            "-n, as in 'beamwork bench elastica -f beamw --against collocation -n 4,2'");
    if (r->output != NULL)
        return message_fail(STATUS_REFUSED,
                            "--against does not write a results file; remove -o, and redirect the "
                            "output if needed, as in --format json > times.json");
    if (r->format[0] == 'c')
        return message_fail(STATUS_REFUSED,
                            "--against does not support --format csv; give --format text or json");
    const case_type *type = case_input_find(&r->of);
    return type != NULL ? message_exit(against_other(r, type, &f), &f) : r->of.refusal;
}
