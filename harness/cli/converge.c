#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"
#include "harness/records/records.h"

typedef struct converge_request {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    truths_options truths;
    text_list imported; /* stored results of other programs */
    const char *select, *output, *format, *peers;
    double error;
    int jobs, verbose;
} converge_request;

static void report(const converge_request *r, const sweep *s)
{
    if (s->points == 0)
        return;
    case_input_report_analysis(&r->of, &s->point[0].scene);
}

typedef struct peers_folder {
    char folder[32], file[48];
} peers_folder;

/* Solves the case with other programs, and adds the file with their results to those of
 * --imported. The caller answer() removes the folder. */
static status add_peers(converge_request *r, const case_type *type, peers_folder *at, fault *f)
{
    int found = 0;
    if (r->peers == NULL)
        return STATUS_OK;
    snprintf(at->folder, sizeof at->folder, "/tmp/beamwork-XXXXXX");
    if (mkdtemp(at->folder) == NULL) {
        at->folder[0] = '\0';
        return fault_set(f, STATUS_FAULT,
                         "a temporary folder for the results of --peers cannot be created; make "
                         "/tmp writable, and free space there");
    }
    snprintf(at->file, sizeof at->file, "%s/peers.h5", at->folder);
    TRY(peers_solve(&r->of, type, &r->meshes, r->peers, at->file, &found, f));
    if (found && r->imported.count == COMMAND_MOST_WORDS)
        return fault_set(f, STATUS_REFUSED,
                         "too many files are given with --imported; give fewer, or remove --peers");
    if (found)
        r->imported.text[r->imported.count++] = at->file;
    return STATUS_OK;
}

static void remove_peers(const peers_folder *at)
{
    if (at->folder[0] == '\0')
        return;
    unlink(at->file);
    rmdir(at->folder);
}

/* Plans and runs the convergence study. The caller answer() frees *c, even after a failure. */
static status converge(converge_request *r, const case_type *type, convergence *c, fault *f)
{
    const convergence_request requested = {
        .type = type,
        .parameter = r->of.parameter,
        .mesh = r->meshes.elements,
        .meshes = r->meshes.count,
        .level = r->error > 0 ? r->error : REACH_LINE_LEVEL,
        .verbose = r->verbose,
        .imported = r->imported.text,
        .importeds = r->imported.count,
        .cells = {.select = r->select,
                  .jobs = r->jobs,
                  .formulations = r->chosen.formulations,
                  .formulation = r->chosen.formulation,
                  .progress = isatty(STDERR_FILENO) ? stderr : NULL}};
    const experiment_output to = experiment_output_of(r->output, r->format, NULL);
    TRY(files_check_results(r->of.line, to.results != NULL, user_tables_packed(&r->truths), f));
    TRY(case_input_truths(&r->of, &r->truths, &c->truths, f));
    TRY(experiment_plan(&experiment_converge, &requested, c, f));
    report(r, &c->sweep);
    return experiment_run(&experiment_converge, &requested, &to, c, f);
}

static int has_solution(const sweep *s)
{
    int found = 0;
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; s->series[i].missing[0] == '\0' && k < s->series[i].meshes; k++)
            found |= cell_values(&s->series[i].cell[k]) > 0;
    return found;
}

static int answer(const command_line *l, void *request)
{
    converge_request *r = request;
    (void)l;
    convergence c = {.verbose = 0};
    fault f = {""};
    const case_type *type = case_input_find(&r->of);
    if (type == NULL)
        return r->of.refusal;
    if (r->chosen.formulations == 0)
        named_add(&r->chosen, "all");
    peers_folder at = {"", ""};
    status outcome = add_peers(r, type, &at, &f);
    if (outcome == STATUS_OK)
        outcome = converge(r, type, &c, &f);
    remove_peers(&at);
    const int nothing = sweep_cells(&c.sweep) == 0, solved = has_solution(&c.sweep);
    convergence_free(&c);
    const int code = message_exit(outcome, &f);
    if (code == EXIT_AS_EXPECTED && nothing)
        return EXIT_NOTHING;
    return code == EXIT_AS_EXPECTED && !solved ? EXIT_DIFFERS : code;
}

#define IN(at) .member = offsetof(converge_request, at)
static const verb_option own[] = {
    {"imported", 0, "FILE",
     "results of other programs, stored by 'beamwork import'; may be repeated", IN(imported),
     .traits = OPTION_REPEATS | OPTION_INPUT},
    {"peers", 0, "NAMES",
     "also solve the case with other programs: NAME or NAME:ELEMENT, separated by commas "
     "(docs/howto/peers.md)",
     IN(peers)},
    {"error", 0, "R", "requested error (default 1%)", IN(error), .read = option_error},
    {"verbose", 'v', NULL, "print values, times and limits of each formulation separately",
     IN(verbose), .traits = OPTION_ASIDE},
    {0}};
static const verb_group shared[] = {
    SHARED(case, of),       SHARED(formulations, chosen), SHARED(meshes, meshes),
    SHARED(select, select), SHARED(user_truths, truths),  SHARED(results, output),
    SHARED(format, format), SHARED(jobs, jobs),           {NULL, 0}};
const verb verb_converge = {
    "converge",
    "CASE",
    "solves one case on several meshes: errors, order and limit",
    "Solves one case on several meshes and prints errors, observed order and limit, in one table "
    "for each quantity. With one formulation, or with -v, it prints a table for each formulation, "
    "with values and times. Defaults: all formulations that support the case (-f), and the meshes "
    "of the case (-n). After the tables, it lists the formulations that achieve an error "
    "of 1 % (--error), with their numbers of elements.",
    "beamwork converge c_column -k buckling_load\n"
    "beamwork converge c_column -f beamw -f beamw_consistent -n 2,4,8,16,32",
    shared,
    own,
    sizeof(converge_request),
    .place = VERB_COMPUTE + 20,
    .answer = answer};
