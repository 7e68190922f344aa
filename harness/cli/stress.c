#include <stdio.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"

typedef struct stress_request {
    chosen_formulations chosen;
    truths_options truths;
    const char *select, *output, *format, *json;
    int jobs;
} stress_request;

/* The caller answer() frees *s, even after a failure. */
static status run(const command_line *l, const stress_request *r, extreme_sweep *s, fault *f)
{
    const extreme_request request = {.truths = user_tables_packed(&r->truths),
                                     .select = r->select,
                                     .jobs = r->jobs,
                                     .formulations = r->chosen.formulations,
                                     .formulation = r->chosen.formulation,
                                     .named = named_alone(&r->chosen),
                                     .progress = isatty(STDERR_FILENO) ? stderr : NULL};
    const experiment_output to = experiment_output_of(r->output, r->format, r->json);
    TRY(files_check_results(l, to.results != NULL, request.truths, f));
    TRY(experiment_do(&experiment_stress, &request, &to, s, f));
    if (extreme_sweep_exit(s) == EXIT_NOTHING)
        fprintf(stderr, "beamwork: nothing was run; see 'beamwork list' and -k\n");
    return STATUS_OK;
}

static int answer(const command_line *l, void *request)
{
    const stress_request *r = request;
    extreme_sweep s = {0};
    fault f = {""};
    if (l->arguments > 0)
        return message_fail(
            STATUS_REFUSED,
            "stress accepts no case as an argument; select cases with -k, such as -k elastica");
    const status outcome = run(l, r, &s, &f);
    int code = extreme_sweep_exit(&s);
    if (outcome != STATUS_OK)
        code = message_fail(outcome, f.text);
    extreme_sweep_free(&s);
    return code;
}

#define IN(at) .member = offsetof(stress_request, at)
static const verb_group shared[] = {SHARED(formulations, chosen), SHARED(select, select),
                                    SHARED(truths, truths),       SHARED(results, output),
                                    SHARED(format, format),       SHARED(json, json),
                                    SHARED(jobs, jobs),           {NULL, 0}};
const verb verb_stress = {
    "stress",
    "",
    "runs every formulation at extremes: is each result accurate, or a reported failure?",
    "Runs every formulation at extremes where numerical errors become critical, and classifies "
    "every result: accurate, under-resolved, a reported failure, or wrong. Exit status: 0 all "
    "results as expected, 1 a result differs, 2 invalid input, 3 nothing was run, 4 file, disk or "
    "memory.",
    "beamwork stress -k \"thin_sheet and collocation\"",
    shared,
    NULL,
    sizeof(stress_request),
    .place = VERB_EVALUATE + 30,
    .answer = answer,
    .experiment = &experiment_stress};
