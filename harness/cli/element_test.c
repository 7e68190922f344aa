#include <stdio.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"

typedef struct element_test_request {
    chosen_formulations chosen;
    const char *output, *format, *json;
    int jobs, verbose, quiet;
} element_test_request;

/* Returns the first argument that is a file or a command, not a name; NULL: none. */
static const char *file_among(const command_line *l)
{
    for (int i = 0; i < l->arguments; i++) {
        const size_t length = strlen(l->argument[i]);
        if (strncmp(l->argument[i], "exec:", 5) == 0 || strchr(l->argument[i], '/') != NULL ||
            (length > 3 && strcmp(l->argument[i] + length - 3, ".so") == 0))
            return l->argument[i];
    }
    return NULL;
}

static void choose(const command_line *l, element_test_request *r)
{
    for (int i = 0; i < l->arguments; i++)
        named_add(&r->chosen, l->argument[i]);
    for (int i = 0; r->chosen.formulations == 0 && formulations_at(i) != NULL; i++)
        if (formulations_is_new(formulations_at(i)))
            named_add(&r->chosen, formulations_at(i)->name);
}

static status add_file(const void *context, const char *path, fault *f)
{
    return digest_add_file(*(digest *const *)context, path) == 0 ? STATUS_OK
                                                                 : fault_unreadable(f, path, errno);
}

/* Computes the hash of a formulation: of the element file; for a command, of the files in the
 * command, in their order; for a built-in formulation, of the program. */
static void hash_of(const element_type *t, char out[DIGEST_TEXT])
{
    const char *from = formulations_element(t);
    fault unread;
    digest all = digest_begin(), *to = &all;
    if (files_named(from != NULL ? from : "/proc/self/exe", add_file, &to, &unread) == STATUS_OK)
        digest_text(&all, out);
}

static status read_format(const verb_option *o, void *member, const char *value, fault *f)
{
    static const char *const forms[] = {"text", "json", "csv", "markdown", "latex"};
    (void)o;
    *(const char **)member = value;
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++)
        if (strcmp(value, forms[i]) == 0)
            return STATUS_OK;
    return fault_set(
        f, STATUS_REFUSED,
        "--format %.40s is not supported here; give text, json, csv, markdown or latex", value);
}

static status run(const command_line *l, const element_test_request *r, certificates *c, fault *f)
{
    const certificate_request what = {.chosen = r->chosen.formulation,
                                      .count = r->chosen.formulations,
                                      .jobs = r->jobs,
                                      .time_limit = r->chosen.time_limit,
                                      .hash = hash_of};
    if (r->chosen.formulations == 0)
        return fault_set(f, STATUS_REFUSED,
                         "element-test: name a formulation or 'all', or load yours with --element "
                         "./mine.so; 'beamwork list formulations' shows the names");
    const experiment_output to =
        experiment_output_of(r->output, r->format != NULL ? r->format : "text", r->json);
    TRY(files_check_results(l, to.results != NULL, NULL, f));
    return experiment_do(&experiment_element_test, &what, &to, c, f);
}

static int answer(const command_line *l, void *request)
{
    element_test_request *r = request;
    fault f = {""};
    const char *file = file_among(l);
    if (file != NULL) {
        fault_set(&f, STATUS_REFUSED,
                  "element-test: '%.150s' is not the name of a formulation; use --element '%.150s' "
                  "to load a file",
                  file, file);
        return message_fail(STATUS_REFUSED, f.text);
    }
    choose(l, r);
    certificates c = {.verbose = r->verbose, .quiet = r->quiet};
    const status outcome = run(l, r, &c, &f);
    int code = EXIT_AS_EXPECTED;
    for (int i = 0; i < c.count && c.all != NULL; i++)
        if (!certificate_holds(&c.all[i]))
            code = EXIT_DIFFERS;
    certificate_free(c.all, c.count);
    return outcome != STATUS_OK ? message_fail(outcome, f.text) : code;
}

#define IN(at) .member = offsetof(element_test_request, at)
static const verb_option own[] = {
    {"verbose", 'v', NULL, "show every check with its numbers", IN(verbose),
     .traits = OPTION_ASIDE},
    {"quiet", 'q', NULL, "violated requirements only", IN(quiet), .traits = OPTION_ASIDE},
    {"format", 0, "text|json|csv|markdown|latex",
     "form of the output (default text); markdown and latex: tables for a paper", IN(format),
     .traits = OPTION_ASIDE, .read = read_format},
    {0}};
static const verb_group shared[] = {SHARED(formulations, chosen), SHARED(time_limit, chosen),
                                    SHARED(results, output),      SHARED(json, json),
                                    SHARED(jobs, jobs),           {NULL, 0}};
const verb verb_element_test = {
    "element-test",
    "[FORMULATION...|all]",
    "checks a formulation against the interface requirements, and states what to correct",
    "Checks a formulation against the interface requirements (derivatives against finite "
    "differences, energy, symmetry, rigid motion, repeated calls, array bounds, mass), and states "
    "what to correct. It also measures errors in uniform and linear states, locking, orders of "
    "convergence, and strains after full turns and load cycles. With --element, no name is needed. "
    "A part that exceeds the time limit (60 s) fails. Exit status: 0 all requirements are "
    "satisfied; 1 a requirement is violated, a uniform or linear state has a wrong limit, or an "
    "order is below the declared order; 2 invalid input; 4 file, disk or memory.",
    "beamwork element-test collocation\n"
    "beamwork element-test --element ./mine.so\n"
    "beamwork element-test --element ./mine.so --format latex -o table.tex\n"
    "beamwork element-test all -o build/results.h5",
    shared,
    own,
    sizeof(element_test_request),
    .place = VERB_EVALUATE + 50,
    .answer = answer,
    .experiment = &experiment_element_test};
