#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/extremes/extreme_json.h"
#include "harness/extremes/extreme_run.h"
#include "harness/extremes/extreme_table.h"
#include "harness/record/output.h"

static status write_format(const char *format, FILE *to, const extreme_sweep *s, fault *f)
{
    if (strcmp(format, "json") == 0)
        return extreme_json(to, s, f);
    (strcmp(format, "csv") == 0 ? extreme_table_csv : extreme_table)(to, s);
    return STATUS_OK;
}

static status write_file(const char *path, const char *format, const extreme_sweep *s, fault *f)
{
    output file;
    TRY(output_open(path, &file, f));
    const status outcome = write_format(format, file.stream, s, f);
    if (outcome == STATUS_OK)
        return output_close(&file, f);
    output_discard(&file);
    return outcome;
}

static status write_out(const cli_request *r, const extreme_sweep *s, fault *f)
{
    TRY(r->output != NULL ? write_file(r->output, r->format, s, f)
                          : write_format(r->format, stdout, s, f));
    if (fflush(stdout) != 0)
        return fault_set(f, STATUS_FAULT, "standard output cannot be written");
    return r->json != NULL ? write_file(r->json, "json", s, f) : STATUS_OK;
}

int cli_stress(int count, char **arguments)
{
    cli_request r;
    extreme_sweep s;
    fault f = {""};
    cli_parse("stress", "",
              "Drives every formulation to the extremes where numbers become unstable, and judges "
              "every answer: a value, coarse, a "
              "named failure, or wrong. Exit status: 0 all as expected, 1 one differs, 2 refused, "
              "3 nothing was tried, 4 file, disk "
              "or memory.",
              "fokjJFT", count, arguments, &r);
    if (r.case_name != NULL)
        return cli_fail(STATUS_REFUSED, "stress takes no case; select with -k");
    const extreme_request request = {.select = r.select,
                                     .jobs = r.jobs,
                                     .formulations = r.formulations,
                                     .formulation = r.formulation,
                                     .progress = isatty(STDERR_FILENO) ? stderr : NULL};
    status outcome = cli_check_files(&r, 0, cli_truths_path(&r), &f);
    if (outcome == STATUS_OK)
        outcome = extreme_run(&request, cli_truths_path(&r), &s, &f);
    if (outcome != STATUS_OK)
        return cli_fail(outcome, f.text);
    outcome = write_out(&r, &s, &f);
    const int code = outcome != STATUS_OK ? cli_fail(outcome, f.text) : extreme_sweep_exit(&s);
    if (outcome == STATUS_OK && code == EXIT_NOTHING)
        fprintf(stderr, "beamwork: nothing was tried; see 'beamwork list' and -k\n");
    extreme_sweep_free(&s);
    return code;
}
