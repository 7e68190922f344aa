/* Batches of shards put together: the verb that they are of is asked again, to take them. */
#include <string.h>

#include "harness/cli/again.h"
#include "harness/cli/cli.h"

static const struct {
    const char *name;
    cli_verb *run;
} verbs[] = {{"verify", cli_verify},
             {"converge", cli_converge},
             {"bench", cli_bench},
             {"stress", cli_stress},
             {"sweep", cli_sweep}};

static int ask(const again *a)
{
    char text[120];
    for (size_t i = 0; i < sizeof verbs / sizeof verbs[0]; i++)
        if (strcmp(verbs[i].name, a->argument[1]) == 0)
            return verbs[i].run(a->count - 1, a->argument + 1);
    snprintf(text, sizeof text, "batches of '%.40s' are of another version of the program",
             a->argument[1]);
    return message_fail(STATUS_REFUSED, text);
}

static int merge_request(command_request *r)
{
    again a = {.count = 0};
    fault f = {""};
    if (r->case_count == 0)
        return message_fail(STATUS_REFUSED,
                            "merge: which folders? Give those of --shard K/N --into FOLDER");
    const status outcome = again_make(r, &a, &f);
    const int code = outcome == STATUS_OK ? ask(&a) : message_fail(outcome, f.text);
    again_free(&a);
    return code;
}

int cli_merge(int count, char **arguments)
{
    return command_run(
        "merge", "FOLDER...",
        "Puts together the batches that shards of verify, stress, converge, bench or sweep wrote "
        "with "
        "--into, and writes what the verb would have written in one run. The verb, its "
        "options and its files are those of the shards. Exit status: that of the verb; 2 batches "
        "of another request, build or input, or two that differ; 5 batches are missing, which are "
        "listed: nothing is written, or with --partial what there is, in files named .partial"
        "\vbeamwork merge parts -o results.h5\n"
        "beamwork merge first/parts second/parts -o results.h5 --junit junit.xml",
        "+oFJUMpvqw", count, arguments, merge_request);
}
