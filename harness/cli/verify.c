#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/record/json.h"
#include "harness/record/junit.h"
#include "harness/record/markdown.h"
#include "harness/record/output.h"
#include "harness/record/store.h"
#include "harness/record/table.h"
#include "harness/study/noise.h"

enum { PICTURED_STATES = 5 };

static status write_json(const char *path, const sweep *s, const judgement *j, const environment *e, fault *f)
{
    output file;
    status outcome = output_open(path, &file, f);
    if (outcome != STATUS_OK)
        return outcome;
    outcome = json_write_verdicts(file.stream, s, j, e, f);
    if (outcome == STATUS_OK)
        return output_close(&file, f);
    output_discard(&file);
    return outcome;
}

static status write_junit(const char *path, const sweep *s, const judgement *j, fault *f)
{
    output file;
    const status opened = output_open(path, &file, f);
    if (opened != STATUS_OK)
        return opened;
    junit_write(file.stream, s, j);
    return output_close(&file, f);
}

static status write_markdown(const char *path, const sweep *s, const judgement *j, const environment *e, fault *f)
{
    output file;
    const status opened = output_open(path, &file, f);
    if (opened != STATUS_OK)
        return opened;
    markdown_write(file.stream, s, j, e);
    return output_close(&file, f);
}

static status write_all(const cli_request *r, const sweep *s, const judgement *j, fault *f)
{
    const environment e = environment_now(r->jobs);
    status outcome = STATUS_OK;
    if (r->output != NULL)
        outcome = store_write(r->output, s, j, &e, f);
    if (outcome == STATUS_OK && r->json != NULL)
        outcome = write_json(r->json, s, j, &e, f);
    if (outcome == STATUS_OK && r->junit != NULL)
        outcome = write_junit(r->junit, s, j, f);
    if (outcome == STATUS_OK && r->markdown != NULL)
        outcome = write_markdown(r->markdown, s, j, &e, f);
    return outcome;
}

/* The finest meshes again where the verdicts may turn on their noise. */
static status measure_noise(const sweep_request *request, const truths *t, sweep *s, fault *f)
{
    char *wanted = malloc((size_t)s->seriess + 1);
    if (wanted == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for noise");
    judge_doubts(s, t, wanted);
    const status outcome = noise_measure(request, wanted, s, f);
    free(wanted);
    return outcome;
}

int cli_verify(int count, char **arguments)
{
    cli_request r;
    sweep s = {0};
    truths t;
    judgement j = {0};
    fault f = {""};
    cli_parse("verify", "",
              "Judges every formulation on every case and parameter point that has a truth. Exit status: 0 every verdict as "
              "expected, 1 one differs, 2 refused, "
              "3 nothing was checked, 4 file, disk or memory.",
              "fokjJUMLPT", count, arguments, &r);
    if (r.case_name != NULL)
        return cli_fail(STATUS_REFUSED, "verify takes no case; select with -k");
    status outcome = output_try(r.output, &f);
    if (outcome == STATUS_OK)
        outcome = output_try(r.json, &f);
    if (outcome == STATUS_OK)
        outcome = output_try(r.junit, &f);
    if (outcome == STATUS_OK)
        outcome = output_try(r.markdown, &f);
    if (outcome == STATUS_OK)
        outcome = truths_read(cli_truths_path(&r), &t, &f);
    if (outcome != STATUS_OK)
        return cli_fail(outcome, f.text);
    const sweep_request request = {.select = r.select,
                                   .jobs = r.jobs,
                                   .time_limit = r.time_limit,
                                   .formulations = r.formulations,
                                   .formulation = r.formulation,
                                   .shapes = r.shapes < PICTURED_STATES ? r.shapes : PICTURED_STATES,
                                   .progress = isatty(STDERR_FILENO) ? stderr : NULL};
    outcome = sweep_plan(&request, &t, &s, &f);
    if (outcome == STATUS_OK)
        outcome = sweep_run(&request, &s, &f);
    if (outcome == STATUS_OK)
        outcome = measure_noise(&request, &t, &s, &f);
    if (outcome == STATUS_OK)
        outcome = judge(&s, &t, r.select == NULL && r.formulations == 0, &j, &f);
    if (outcome == STATUS_OK) {
        table_verdicts(stdout, &s, &j, &t);
        outcome =
            fflush(stdout) == 0 ? write_all(&r, &s, &j, &f) : fault_set(&f, STATUS_FAULT, "standard output cannot be written");
    }
    const int code = outcome != STATUS_OK ? cli_fail(outcome, f.text) : judgement_exit(&j);
    if (outcome == STATUS_OK && code == EXIT_NOTHING)
        fprintf(stderr, "beamwork: nothing was checked: no verdict against a truth; see 'beamwork list' and -k\n");
    judgement_free(&j);
    sweep_free(&s);
    truths_free(&t);
    return code;
}
