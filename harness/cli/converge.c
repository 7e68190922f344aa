#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/case_input.h"
#include "harness/cli/cli.h"
#include "harness/cli/named.h"
#include "harness/records/csv.h"
#include "harness/records/json.h"
#include "harness/records/json_convergence.h"
#include "harness/records/output.h"
#include "harness/records/reach_line.h"
#include "harness/study/families.h"
#include "harness/study/narrow.h"
#include "harness/study/plan.h"
#include "harness/study/run.h"
#include "harness/terminal/paragraph.h"
#include "harness/terminal/table_beside.h"
#include "harness/terminal/table_convergence.h"

typedef struct converge_request {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    truths_options truths;
    const char *select, *output, *format;
    double error; /* 0: not given */
    int jobs, verbose;
} converge_request;

/* How many of the formulations run. */
static int running(const sweep *s)
{
    int count = 0;
    for (int i = 0; i < s->seriess; i++)
        count += s->series[i].missing[0] == '\0';
    return count;
}

/* What it comes to, in lines of words. */
static void write_answer(FILE *to, double level, const sweep *s, const truths *t)
{
    paragraph words;
    reach_line_write(paragraph_begin(&words, to), s, t, level);
    paragraph_end(&words, 0, 0);
}

static void write_text(FILE *to, const converge_request *r, double level, const sweep *s,
                       const truths *t)
{
    if (r->verbose || running(s) == 1) {
        table_convergence(to, s, t);
        fputc('\n', to);
    } else if (running(s) > 1)
        table_beside(to, s, t);
    write_answer(to, level, s, t);
}

static status write_form(FILE *to, const converge_request *r, double level, const sweep *s,
                         const truths *t, fault *f)
{
    if (strcmp(r->format, "json") == 0)
        return json_convergence_write(to, s, t, level, f);
    if (strcmp(r->format, "csv") == 0)
        csv_convergence(to, s, t);
    else
        write_text(to, r, level, s, t);
    return STATUS_OK;
}

static status write_out(const converge_request *r, double level, const sweep *s, const truths *t,
                        fault *f)
{
    output file;
    TRY(output_open(r->output, &file, f));
    return output_finish(&file, write_form(file.stream, r, level, s, t, f), f);
}

/* As far as the first formulation tells that is run. */
static void tell_supports(const converge_request *r, const sweep *s)
{
    int i = 0;
    while (i < s->seriess - 1 && s->series[i].missing[0] != '\0')
        i++;
    if (s->seriess > 0)
        supports_told(r->of.scene, r->of.parameter, &s->series[i].formulation, &s->point[0].scene);
}

/* With what answer frees. */
static status converge(converge_request *r, const case_type *type, sweep *s, truths *t, fault *f)
{
    const sweep_request request = {.jobs = r->jobs,
                                   .progress = isatty(STDERR_FILENO) ? stderr : NULL};
    const double level = r->error > 0 ? r->error : REACH_LINE_LEVEL;
    TRY(files_check(r->of.line, 0, own_tables_packed(&r->truths), f));
    TRY(case_input_truths(&r->of, &r->truths, t, f));
    TRY(plan_one(type, r->of.parameter, r->chosen.formulation, r->chosen.formulations,
                 r->meshes.elements, r->meshes.count, s, f));
    TRY(narrow_to(s, r->select, f));
    if (s->points > 0) {
        case_input_tell_analysis(&r->of, &s->point[0].scene);
        tell_supports(r, s);
    }
    TRY(run_sweep(&request, s, f));
    TRY(families_add_truths(s, 0, t, f));
    return write_out(r, level, s, t, f);
}

/* Has any cell one? */
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
    sweep s = {0};
    truths t = {0};
    fault f = {""};
    const case_type *type = case_input_find(&r->of);
    if (type == NULL)
        return r->of.refusal;
    if (r->chosen.formulations == 0)
        named_add(&r->chosen, "all");
    const status outcome = converge(r, type, &s, &t, &f);
    const int nothing = sweep_cells(&s) == 0, solved = has_solution(&s);
    sweep_free(&s);
    truths_free(&t);
    const int code = message_exit(outcome, &f);
    if (code == EXIT_AS_EXPECTED && nothing)
        return EXIT_NOTHING;
    return code == EXIT_AS_EXPECTED && !solved ? EXIT_DIFFERS : code;
}

#define IN(at) .member = offsetof(converge_request, at)
static const verb_option own[] = {
    {"error", 0, "R", "error that is asked for (default 1%)", IN(error), .read = option_error},
    {"verbose", 'v', NULL, "values, times and limits of each formulation by itself", IN(verbose),
     .traits = OPTION_ASIDE},
    {0}};
static const verb_group shared[] = {
    SHARED(case, of),       SHARED(formulations, chosen), SHARED(meshes, meshes),
    SHARED(select, select), SHARED(own_truths, truths),   SHARED(output, output),
    SHARED(format, format), SHARED(jobs, jobs),           {NULL, 0}};
const verb verb_converge = {
    "converge",
    "CASE",
    "one case on several meshes: errors, order, limit",
    "Solves one case on several meshes and shows errors, observed order and limit: of several "
    "formulations side by side, a table for each quantity; of one, or with -v of each, with values "
    "and times. Without -f: all formulations that offer what the case needs; without -n: the "
    "case's own meshes. The last line says which formulation reaches 1 % with how many elements, "
    "or the error given by --error.",
    "beamwork converge c_column -k buckling_load\n"
    "beamwork converge c_column -f beamw -f beamw_consistent -n 2,4,8,16,32",
    shared,
    own,
    sizeof(converge_request),
    .answer = answer};
