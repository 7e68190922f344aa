#include <stdio.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"

typedef struct motion_options {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    const char *output, *format, *json;
    int jobs, verbose, conservation_only; /* conservation_only 1: no reference is computed */
    text_list vary;                       /* the parameter that varies */
    const char *integrators, *step_lengths, *tolerances; /* lists of values */
    const char *expected; /* table of expected verdicts, which replaces a case */
} motion_options;

/* Fills the request. REFUSED without text: the messages have already been printed. */
static status ask(motion_options *r, motion_request *out, fault *f)
{
    out->type = case_input_find(&r->of);
    if (out->type == NULL)
        return STATUS_REFUSED;
    if (r->chosen.formulations == 0)
        named_add(&r->chosen, "all");
    out->formulation = r->chosen.formulation;
    out->formulations = r->chosen.formulations;
    if (r->meshes.count > 1)
        return fault_set(
            f, STATUS_REFUSED,
            "motion accepts only one number of elements; give a single number, such as -n 4");
    return r->vary.count < 2
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED, "motion accepts only one --vary; remove the others");
}

static status run(motion_options *r, motions *m, fault *f)
{
    motion_request requested = {.expected = r->expected,
                                .parameter = r->of.parameter,
                                .vary = r->vary.count > 0 ? r->vary.text[0] : NULL,
                                .elements = r->meshes.count > 0 ? r->meshes.elements[0] : 0,
                                .integrators = r->integrators,
                                .steps = r->step_lengths,
                                .tolerances = r->tolerances,
                                .conservation_only = r->conservation_only,
                                .each = r->expected == NULL || r->verbose,
                                .cells = {.jobs = r->jobs,
                                          .time_limit = r->chosen.time_limit,
                                          .progress = isatty(STDERR_FILENO) ? stderr : NULL,
                                          .things = "motions"}};
    const experiment_output to = experiment_output_of(r->output, r->format, r->json);
    TRY(files_check_results(r->of.line, to.results != NULL, NULL, f));
    if (r->expected == NULL)
        TRY(ask(r, &requested, f));
    return experiment_do(&experiment_motion, &requested, &to, m, f);
}

static int has_any(const integrators *p)
{
    int found = 0;
    for (int i = 0; i < p->runs; i++)
        found |= p->run[i].status == STATUS_OK;
    return found;
}

static int answer(const command_line *l, void *request)
{
    motion_options *r = request;
    (void)l;
    motions m = {.each = 0};
    fault f = {""};
    const status outcome = run(r, &m, &f);
    int code = f.text[0] == '\0' && outcome == STATUS_REFUSED ? r->of.refusal : 0;
    if (code == 0)
        code = message_exit(outcome, &f);
    if (code == EXIT_AS_EXPECTED && m.integrators.runs == 0)
        code = EXIT_NOTHING;
    else if (code == EXIT_AS_EXPECTED && (m.verdicts.unexpected > 0 || !has_any(&m.integrators)))
        code = EXIT_DIFFERS;
    motions_free(&m);
    return code;
}

#define IN(at) .member = offsetof(motion_options, at)
static const verb_option own[] = {
    {"vary", 0, "NAME=A..B/N|A,B,C",
     "parameter to vary: NAME=A..B/N for N equal parts (N + 1 values), NAME=A..B/N:log for equal "
     "ratios, or a list of values or words",
     IN(vary), .traits = OPTION_REPEATS},
    {"integrator", 0, "NAME[,NAME...]",
     "alpha, alpha:rho=R, hht, hht:alpha=A, trapezoidal, conserving, radau, explicit (default: six "
     "of them)",
     IN(integrators)},
    {"step", 0, "H[,H...]|H..H",
     "time steps [s]; in a range A..B, the step is halved from A to B (default: the step of the "
     "motion times 2, 1, 1/2 and 1/4)",
     IN(step_lengths)},
    {"tolerance", 0, "R[,R...]|R..R",
     "tolerance for the error of a step, for integrators that estimate the error; in a range A..B, "
     "the tolerance is divided by 100 from A to B",
     IN(tolerances)},
    {"conservation-only", 0, NULL,
     "check only the energy and the momenta, without a reference solution and without halved steps",
     IN(conservation_only)},
    {"expected", 0, "FILE.csv", "table of expected verdicts, instead of a case", IN(expected),
     .traits = OPTION_INPUT},
    {"verbose", 'v', NULL, "with --expected: print every motion", IN(verbose),
     .traits = OPTION_ASIDE},
    {0}};
static const verb_group shared[] = {
    SHARED(case, of),           SHARED(formulations, chosen), SHARED(meshes, meshes),
    SHARED(time_limit, chosen), SHARED(results, output),      SHARED(format, format),
    SHARED(json, json),         SHARED(jobs, jobs),           {NULL, 0}};
const verb verb_motion = {
    "motion",
    "[CASE]",
    "compares integrators: time-integration error, energy, momenta, cost",
    "Runs a transient analysis with several integrators and several steps or tolerances. Prints "
    "for each run the time-integration error (relative to radau with tolerance 1e-10 on the same "
    "mesh) and its order, the changes of the energy and the momenta, and the cost. "
    "--conservation-only runs long motions with large steps and reports whether the energy grows "
    "or a step fails. --expected compares the verdicts with a table. Exit status: 0 as expected, 1 "
    "a verdict differs or no motion reaches its end, 2 invalid input, 3 nothing was run, 4 file, "
    "disk or memory.",
    "beamwork motion free_flight_space -f collocation -n 8 --integrator alpha,radau "
    "--step 0.1..0.0125\n"
    "beamwork motion --expected harness/experiments/expected.csv",
    shared,
    own,
    sizeof(motion_options),
    .place = VERB_EVALUATE + 40,
    .answer = answer,
    .experiment = &experiment_motion};
