#include <stdio.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/cli/named.h"
#include "harness/experiments/certificate_json.h"
#include "harness/experiments/certificate_text.h"
#include "harness/formulations/formulations.h"
#include "harness/records/output.h"

typedef struct found {
    certificate *all;
    int count;
} found;

static status write_format(const command_request *r, const char *format, FILE *to, const found *c,
                           fault *f)
{
    if (strcmp(format, "json") == 0)
        return certificate_json(to, c->all, c->count, f);
    certificate_text(to, screen_of(to), c->all, c->count, r->verbose, r->quiet);
    return STATUS_OK;
}

static status write_file(const command_request *r, const char *path, const char *format,
                         const found *c, fault *f)
{
    output file;
    TRY(output_open(path, &file, f));
    return output_finish(&file, write_format(r, format, file.stream, c, f), f);
}

/* A file, or a command, in the place of a name; NULL: none. */
static const char *file_among(const command_request *r)
{
    for (int i = 0; i < r->case_count; i++) {
        const size_t length = strlen(r->cases[i]);
        if (strncmp(r->cases[i], "exec:", 5) == 0 || strchr(r->cases[i], '/') != NULL ||
            (length > 3 && strcmp(r->cases[i] + length - 3, ".so") == 0))
            return r->cases[i];
    }
    return NULL;
}

/* Those that are named; else those that were loaded. */
static void choose(command_request *r)
{
    for (int i = 0; i < r->case_count; i++)
        named_add(r, r->cases[i]);
    for (int i = 0; r->formulations == 0 && formulations_at(i) != NULL; i++)
        if (formulations_is_new(formulations_at(i)))
            named_add(r, formulations_at(i)->name);
}

/* With what cli_element_test frees. */
static status run(const command_request *r, found *c, fault *f)
{
    const certificate_request what = {.chosen = r->formulation,
                                      .count = r->formulations,
                                      .jobs = r->jobs,
                                      .time_limit = r->time_limit};
    if (strcmp(r->format, "csv") == 0)
        return fault_set(f, STATUS_REFUSED, "element-test: give --format text or json");
    if (r->formulations == 0)
        return fault_set(
            f, STATUS_REFUSED,
            "element-test: name a formulation, 'all' for every one, or load yours with "
            "--element ./mine.so; 'beamwork list formulations' shows them");
    TRY(files_check(r, 0, NULL, f));
    TRY(certificate_find(&what, &c->all, f));
    TRY(write_file(r, r->output, r->format, c, f));
    return r->json != NULL ? write_file(r, r->json, "json", c, f) : STATUS_OK;
}

static int answer(command_request *r)
{
    fault f = {""};
    const char *file = file_among(r);
    if (file != NULL) {
        fault_set(&f, STATUS_REFUSED,
                  "element-test: '%.150s' is no name of a formulation; --element '%.150s' loads it",
                  file, file);
        return message_fail(STATUS_REFUSED, f.text);
    }
    choose(r);
    found c = {.count = r->formulations};
    const status outcome = run(r, &c, &f);
    int code = EXIT_AS_EXPECTED;
    for (int i = 0; i < c.count && c.all != NULL; i++)
        if (!certificate_holds(&c.all[i]))
            code = EXIT_DIFFERS;
    certificate_free(c.all, c.count);
    return outcome != STATUS_OK ? message_fail(outcome, f.text) : code;
}

int cli_element_test(int count, char **arguments)
{
    return command_run(
        "element-test", "[FORMULATION...|all]",
        "Holds a formulation against the interface: derivatives against differences, energy, "
        "symmetry, rigid motion, calls without memory, bounds, mass; each failure says what to "
        "mend. "
        "And measures what a paper should print of it: uniform and linear states, locking, orders "
        "of "
        "convergence. Of a formulation of your own (--element) it needs no name. It is written as "
        "text "
        "or json. A part that takes longer than the time limit (60 s) fails. Exit status: 0 "
        "the contract is "
        "kept, "
        "1 it is broken, 2 refused, 4 file, disk or memory."
        "\vbeamwork element-test collocation\n"
        "beamwork element-test --element ./mine.so\n"
        "beamwork element-test all --format json -o elements.json",
        "+foFJLjvq", count, arguments, answer);
}
