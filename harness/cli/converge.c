#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/judge/families.h"
#include "harness/record/csv.h"
#include "harness/record/json.h"
#include "harness/record/json_convergence.h"
#include "harness/record/output.h"
#include "harness/record/reach_line.h"
#include "harness/study/plan.h"
#include "harness/study/run.h"
#include "harness/tables/table_convergence.h"

static void write_text(FILE *to, const sweep *s, const truths *t)
{
    table_convergence(to, s, t);
    fputc('\n', to);
    reach_line_write(to, s, t);
}

static status write_form(FILE *to, const char *format, const sweep *s, const truths *t, fault *f)
{
    if (strcmp(format, "json") == 0)
        return json_convergence_write(to, s, t, f);
    if (strcmp(format, "csv") == 0)
        csv_convergence(to, s, t);
    else
        write_text(to, s, t);
    return STATUS_OK;
}

static status write_out(const command_request *r, const sweep *s, const truths *t, fault *f)
{
    output file;
    TRY(output_open(r->output, &file, f));
    return output_finish(&file, write_form(file.stream, r->format, s, t, f), f);
}

/* With what converge_request frees. */
static status converge(const command_request *r, const case_type *type, sweep *s, truths *t,
                       fault *f)
{
    const sweep_request request = {.jobs = r->jobs,
                                   .progress = isatty(STDERR_FILENO) ? stderr : NULL};
    TRY(files_check(r, 0, case_input_truths_path(r), f));
    TRY(case_input_truths(r, t, f));
    TRY(plan_one(type, r->parameter, r->formulation, r->formulations, r->mesh, r->meshes, s, f));
    TRY(run_sweep(&request, s, f));
    TRY(families_add_truths(s, 0, t, f));
    return write_out(r, s, t, f);
}

static int converge_request(command_request *r)
{
    sweep s = {0};
    truths t = {0};
    fault f = {""};
    const case_type *type = case_input_find(r);
    if (type == NULL)
        return r->refusal;
    if (r->formulations == 0)
        return message_fail(
            STATUS_REFUSED,
            "which formulation? Give -f, or -f all; 'beamwork list formulations' shows them");
    const status outcome = converge(r, type, &s, &t, &f);
    const int nothing = sweep_cells(&s) == 0;
    sweep_free(&s);
    truths_free(&t);
    const int code = message_exit(outcome, &f);
    return code == EXIT_AS_EXPECTED && nothing ? EXIT_NOTHING : code;
}

int cli_converge(int count, char **arguments)
{
    return command_run(
        "converge", "CASE",
        "Solves one case on several meshes and shows errors, observed order and the limit."
        "\vbeamwork converge c_column -f beamw -f beamw_consistent -n 2,4,8,16,32",
        "fnsFojTY", count, arguments, converge_request);
}
