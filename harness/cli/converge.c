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
#include "harness/record/table.h"
#include "harness/study/plan.h"
#include "harness/study/run.h"

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

static status write_out(const cli_request *r, const sweep *s, const truths *t, fault *f)
{
    output file;
    if (r->output == NULL) {
        const status written = write_form(stdout, r->format, s, t, f);
        return written != STATUS_OK || fflush(stdout) == 0
                   ? written
                   : fault_set(f, STATUS_FAULT, "standard output cannot be written");
    }
    TRY(output_open(r->output, &file, f));
    const status outcome = write_form(file.stream, r->format, s, t, f);
    if (outcome == STATUS_OK)
        return output_close(&file, f);
    output_discard(&file);
    return outcome;
}

static int converge_request(cli_request *r)
{
    sweep s;
    truths t;
    fault f = {""};
    const case_type *type = cli_case(r);
    if (type == NULL)
        return r->refusal;
    if (r->formulations == 0)
        return cli_fail(
            STATUS_REFUSED,
            "which formulation? Give -f, or -f all; 'beamwork list formulations' shows them");
    status outcome = cli_check_files(r, 0, cli_truths_path(r), &f);
    if (outcome == STATUS_OK)
        outcome = cli_truths_read(r, &t, &f);
    if (outcome != STATUS_OK)
        return cli_fail(outcome, f.text);
    outcome =
        plan_one(type, r->parameter, r->formulation, r->formulations, r->mesh, r->meshes, &s, &f);
    if (outcome != STATUS_OK) {
        truths_free(&t);
        return cli_fail(outcome, f.text);
    }
    const sweep_request request = {.jobs = r->jobs,
                                   .progress = isatty(STDERR_FILENO) ? stderr : NULL};
    outcome = run_sweep(&request, &s, &f);
    if (outcome == STATUS_OK)
        outcome = families_add_truths(&s, 0, &t, &f);
    if (outcome == STATUS_OK)
        outcome = write_out(r, &s, &t, &f);
    const int nothing = sweep_cells(&s) == 0;
    sweep_free(&s);
    truths_free(&t);
    if (outcome != STATUS_OK)
        return cli_fail(outcome, f.text);
    return nothing ? EXIT_NOTHING : EXIT_AS_EXPECTED;
}

int cli_converge(int count, char **arguments)
{
    cli_request r;
    cli_parse("converge", "CASE",
              "Solves one case on several meshes and shows errors, observed order and the limit.",
              "fnsFojTY", count, arguments, &r);
    const int code = converge_request(&r);
    cli_close(&r);
    return code;
}
