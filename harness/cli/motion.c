#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/cli/named.h"
#include "harness/experiments/axis.h"
#include "harness/experiments/pace_json.h"
#include "harness/experiments/pace_judge.h"
#include "harness/experiments/pace_plan.h"
#include "harness/experiments/pace_table.h"
#include "harness/records/output.h"

typedef struct motion_request {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    const char *output, *format, *json;
    int jobs, verbose, no_errors;                        /* no_errors: without a reference */
    text_list vary;                                      /* one parameter */
    const char *integrators, *step_lengths, *tolerances; /* lists */
    const char *expected; /* table of verdicts, in the place of a case */
} motion_request;

/* Motions, and what is said of them. */
typedef struct motions {
    pace pace;
    pace_verdicts verdicts;
    int methods;
    pace_method method[PACE_LIST_MOST];
} motions;

/* All formulations that are asked for at one point. */
static status plan_point(const motion_request *r, motions *m, pace_plan_request *q, fault *f)
{
    TRY(pace_plan_usual(q, f));
    for (int i = 0; i < r->chosen.formulations; i++) {
        q->formulation = r->chosen.formulation[i];
        TRY(pace_plan_add(&m->pace, q, f));
    }
    return STATUS_OK;
}

/* All values of the parameter that varies; without one the point itself. */
static status plan_points(const motion_request *r, const case_type *type, motions *m,
                          const pace_plan_request *q, fault *f)
{
    pace_plan_request one = *q;
    if (r->vary.count == 0)
        return plan_point(r, m, &one, f);
    axis a;
    double value[CASE_MAX_PARAMETERS];
    TRY(axis_read(type, r->vary.text[0], &a, f));
    status outcome =
        a.count > 0 && r->vary.count == 1
            ? STATUS_OK
            : fault_set(f, STATUS_REFUSED, "motion takes one --vary, as NAME=A..B/N or NAME=A,B,C");
    memcpy(value, r->of.parameter, sizeof value);
    for (int i = 0; outcome == STATUS_OK && i < a.count; i++) {
        one = *q;
        one.parameter = value;
        value[a.index] = axis_value(&a, i);
        outcome = plan_point(r, m, &one, f);
    }
    axis_free(&a);
    return outcome;
}

static status plan(motion_request *r, motions *m, fault *f)
{
    const case_type *type = case_input_find(&r->of);
    if (type == NULL)
        return STATUS_REFUSED;
    if (r->chosen.formulations == 0)
        named_add(&r->chosen, "all");
    pace_plan_request q = {.type = type,
                           .parameter = r->of.parameter,
                           .elements = r->meshes.count > 0 ? r->meshes.elements[0] : 0,
                           .method = m->method,
                           .errors = !r->no_errors,
                           .whole = r->no_errors};
    if (r->meshes.count > 1)
        return fault_set(f, STATUS_REFUSED, "motion takes one mesh: give one number with -n");
    TRY(pace_method_read_list(r->integrators != NULL ? r->integrators : pace_method_all,
                              PACE_LIST_MOST, m->method, &m->methods, f));
    q.methods = m->methods;
    if (r->step_lengths != NULL)
        TRY(pace_list_read("step", r->step_lengths, 2, &q.steps, f));
    if (r->tolerances != NULL)
        TRY(pace_list_read("tolerance", r->tolerances, 100, &q.tolerances, f));
    return plan_points(r, type, m, &q, f);
}

static status write_form(FILE *to, const motion_request *r, const char *format, const motions *m,
                         fault *f)
{
    if (strcmp(format, "json") == 0)
        return pace_json(to, &m->pace, &m->verdicts, f);
    if (strcmp(format, "csv") == 0)
        pace_table_csv(to, &m->pace);
    else
        pace_table(to, &m->pace, &m->verdicts, r->expected == NULL || r->verbose);
    return STATUS_OK;
}

static status write_file(const motion_request *r, const char *path, const char *format,
                         const motions *m, fault *f)
{
    output file;
    TRY(output_open(path, &file, f));
    return output_finish(&file, write_form(file.stream, r, format, m, f), f);
}

static status run(motion_request *r, motions *m, fault *f)
{
    const sweep_request request = {.jobs = r->jobs,
                                   .time_limit = r->chosen.time_limit,
                                   .progress = isatty(STDERR_FILENO) ? stderr : NULL,
                                   .things = "motions"};
    TRY(files_check(r->of.line, 0, NULL, f));
    TRY(r->expected != NULL ? pace_verdict_plan(r->expected, &m->pace, &m->verdicts, f)
                            : plan(r, m, f));
    TRY(pace_judge(&m->pace, &request, f));
    pace_verdict_reach(&m->pace, &m->verdicts);
    TRY(write_file(r, r->output, r->format, m, f));
    return r->json != NULL ? write_file(r, r->json, "json", m, f) : STATUS_OK;
}

/* Did any motion reach its end? */
static int has_any(const pace *p)
{
    int found = 0;
    for (int i = 0; i < p->runs; i++)
        found |= p->run[i].status == STATUS_OK;
    return found;
}

static int answer(const command_line *l, void *request)
{
    motion_request *r = request;
    (void)l;
    motions m = {.methods = 0};
    fault f = {""};
    const status outcome = run(r, &m, &f);
    int code = f.text[0] == '\0' && outcome == STATUS_REFUSED ? r->of.refusal : 0;
    if (code == 0)
        code = message_exit(outcome, &f);
    if (code == EXIT_AS_EXPECTED && m.pace.runs == 0)
        code = EXIT_NOTHING;
    else if (code == EXIT_AS_EXPECTED && (m.verdicts.unexpected > 0 || !has_any(&m.pace)))
        code = EXIT_DIFFERS;
    pace_verdict_free(&m.verdicts);
    pace_free(&m.pace);
    return code;
}

#define IN(at) .member = offsetof(motion_request, at)
static const verb_option own[] = {
    {"vary", 0, "NAME=A..B/N|A,B,C",
     "one parameter: N equal parts (N + 1 values), with ':log' behind equal ratios; a list of "
     "values or words",
     IN(vary), .traits = OPTION_REPEATS},
    {"integrator", 0, "NAME[,NAME...]",
     "alpha, alpha:rho=R, hht, hht:alpha=A, trapezoidal, conserving, radau, explicit (default: six "
     "of them)",
     IN(integrators)},
    {"step", 0, "H[,H...]|H..H",
     "steps of integration [s]; a range is halved from the first to the last (default: 2, 1, 1/2 "
     "and 1/4 of that of the motion)",
     IN(step_lengths)},
    {"tolerance", 0, "R[,R...]|R..R",
     "errors of a step by which it is chosen, of integrators that estimate it; a range goes by "
     "hundredths",
     IN(tolerances)},
    {"no-errors", 0, NULL,
     "no reference is computed, and no step is halved: energy and momenta alone", IN(no_errors)},
    {"expected", 0, "FILE.csv", "verdicts that are expected, in the place of a case", IN(expected),
     .traits = OPTION_INPUT},
    {"verbose", 'v', NULL, "with --expected: every motion", IN(verbose), .traits = OPTION_ASIDE},
    {0}};
static const verb_group shared[] = {
    SHARED(case, of),           SHARED(formulations, chosen), SHARED(meshes, meshes),
    SHARED(time_limit, chosen), SHARED(output, output),       SHARED(format, format),
    SHARED(json, json),         SHARED(jobs, jobs),           {NULL, 0}};
const verb verb_motion = {
    "motion",
    "[CASE]",
    "integrators side by side: error of time, energy, momenta, cost",
    "Integrates a motion in time by several integrators with several steps or tolerances, and "
    "shows for each the error of time (against radau at 1e-10 on the same mesh), its order, what "
    "becomes of energy and momenta, and what it costs. With --no-errors long motions of large "
    "steps: does the energy grow, does a step fail? With --expected the verdicts of a table. Exit "
    "status: 0 as expected, 1 a verdict differs or no motion reaches its end, 2 refused, 3 nothing "
    "was run, 4 file, disk or memory.",
    "beamwork motion free_flight_space -f collocation -n 8 --integrator alpha,radau "
    "--step 0.1..0.0125\n"
    "beamwork motion --expected harness/experiments/expected.csv",
    shared,
    own,
    sizeof(motion_request),
    .answer = answer};
