#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/cli/extreme_work.h"
#include "harness/cli/named.h"
#include "harness/experiments/extreme_json.h"
#include "harness/experiments/extreme_table.h"
#include "harness/records/output.h"

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
    return output_finish(&file, write_format(format, file.stream, s, f), f);
}

static status write_out(const command_request *r, const extreme_sweep *s, fault *f)
{
    if (r->json != NULL) /* also where nobody reads the table */
        TRY(write_file(r->json, "json", s, f));
    return write_file(r->output, r->format, s, f);
}

/* With what cli_stress frees. */
static status run(const command_request *r, extreme_sweep *s, spread_end *end, fault *f)
{
    const extreme_request request = {.select = r->select,
                                     .jobs = r->jobs,
                                     .formulations = r->formulations,
                                     .formulation = r->formulation,
                                     .named = named_alone(r),
                                     .progress = isatty(STDERR_FILENO) ? stderr : NULL};
    TRY(files_check(r, 0, case_input_truths_path(r), f));
    TRY(extreme_work_run(r, &request, case_input_truths_path(r), s, end, f));
    if (end->ended)
        return STATUS_OK;
    TRY(write_out(r, s, f));
    if (extreme_sweep_exit(s) == EXIT_NOTHING)
        fprintf(stderr, "beamwork: nothing was tried; see 'beamwork list' and -k\n");
    return STATUS_OK;
}

int cli_stress(int count, char **arguments)
{
    command_request r;
    extreme_sweep s = {0};
    spread_end end = {.ended = 0};
    fault f = {""};
    command_parse(
        "stress", "",
        "Drives every formulation to the extremes where numbers become unstable, and judges "
        "every answer: a value, coarse, a "
        "named failure, or wrong. Exit status: 0 all as expected, 1 one differs, 2 refused, "
        "3 nothing was tried, 4 file, disk "
        "or memory, 5 batches are missing (--shard K/N --into FOLDER, 'beamwork merge')."
        "\vbeamwork stress -k \"thin_sheet and collocation\"",
        "fokjJFTZiCbw", count, arguments, &r);
    if (r.case_name != NULL)
        return message_fail(STATUS_REFUSED, "stress takes no case; select with -k");
    const status outcome = run(&r, &s, &end, &f);
    int code = end.ended ? end.code : extreme_sweep_exit(&s);
    if (outcome != STATUS_OK)
        code = message_fail(outcome, f.text);
    spread_free(&end);
    extreme_sweep_free(&s);
    return code;
}
