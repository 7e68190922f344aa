#include "harness/cli/verb_table.h"

#include <stdio.h>
#include <string.h>

#include "harness/catalogue/choice.h"
#include "harness/catalogue/environment.h"
#include "harness/cli/cli.h"

typedef struct verb {
    const char *name;
    cli_verb *run; /* NULL: a heading */
    const char *summary;
} verb;

static const verb verbs[] = {
    {"look", NULL, NULL},
    {"list", cli_list, "cases and formulations; of one: parameters, quantities, orders, findings"},
    {"explain", cli_explain, "what a word means: verdicts, theories, physics, rules of the ledger"},
    {"compute", NULL, NULL},
    {"solve", cli_solve, "one case, one formulation, one mesh: every quantity with its error"},
    {"converge", cli_converge, "one case on several meshes: errors, order, limit"},
    {"truth", cli_truth, "what is known of a case at a parameter point; derived on demand"},
    {"scene", cli_scene, "a case, or a structure of your own, written out as a scene file"},
    {"judge and compare", NULL, NULL},
    {"verify", cli_verify, "every formulation on every case, judged against stored truths"},
    {"bench", cli_bench, "error against run time: the cheapest way to an error"},
    {"stress", cli_stress, "every formulation at extremes: a value, or a named failure"},
    {"compare", cli_compare, "two stored runs: what became worse or better"},
    {"exchange", NULL, NULL},
    {"export", cli_export, "a structure as solids, as an input deck of another program"},
    {"import", cli_import, "what other programs found, for 'verify --beside'"},
    {"schema", cli_schema, "what the result file consists of: tables, columns, units"},
};
enum { VERBS = sizeof verbs / sizeof verbs[0] };

/* NULL: there is none. */
static const verb *find(const char *name)
{
    for (int i = 0; i < VERBS; i++)
        if (verbs[i].run != NULL && strcmp(verbs[i].name, name) == 0)
            return &verbs[i];
    return NULL;
}

static const char *name_at(const void *context, int i)
{
    int left = i;
    (void)context;
    for (int k = 0; k < VERBS; k++)
        if (verbs[k].run != NULL && left-- == 0)
            return verbs[k].name;
    return left == 0 ? "help" : NULL;
}

static int refuse(const char *name)
{
    char text[200];
    const char *near = choice_nearest(name, name_at, NULL);
    snprintf(text, sizeof text, "unknown verb '%.60s'%s%s%s; 'beamwork -h' shows them all", name,
             near != NULL ? ", did you mean '" : "", near != NULL ? near : "",
             near != NULL ? "'?" : "");
    return message_fail(STATUS_REFUSED, text);
}

static int help(void)
{
    printf("beamwork: verification and benchmark of three-dimensional beam finite elements.\n"
           "Which formulation, with how many elements, reaches my tolerance soonest, and can I\n"
           "believe it?\n\n"
           "usage: beamwork VERB [OPTION...]     beamwork help VERB (or VERB -h): its options\n");
    for (int i = 0; i < VERBS; i++)
        if (verbs[i].run == NULL)
            printf("\n%s\n", verbs[i].name);
        else
            printf("  %-10s %s\n", verbs[i].name, verbs[i].summary);
    printf("\nto begin with\n"
           "  beamwork list                         what there is\n"
           "  beamwork solve elastica               one answer, with its error\n"
           "  beamwork converge c_column -k buckling_load   formulations side by side\n"
           "  beamwork explain \"wrong limit\"        what a word means\n"
           "\nexit status: 0 as expected; 1 a verdict differs (solve: not converged or singular);\n"
           "  2 refused input; 3 nothing was checked; 4 file, disk or memory; 5 interrupted: what\n"
           "  was judged is in *.partial.* (compare, as diff: 0 the same, 1 different, 2 trouble)\n"
           "\nbeamwork --version: versions of the program and its libraries\n");
    return EXIT_AS_EXPECTED;
}

/* VERB -h in other words; a verb may start the program anew with what stands before its name. */
static int help_of(char *program, char *name)
{
    char option[] = "--help";
    char *arguments[] = {program, name, option, NULL};
    const verb *v = find(name);
    return v != NULL ? v->run(2, arguments + 1) : refuse(name);
}

static int version(void)
{
    const environment e = environment_now(1);
    printf("beamwork %s (%s)\n%s, flags %s\n%s\n", e.version, e.commit, e.compiler, e.flags,
           e.libraries);
    return EXIT_AS_EXPECTED;
}

int verb_table_run(int count, char **arguments)
{
    const char *first = count > 1 ? arguments[1] : "help";
    if (strcmp(first, "help") == 0 && count > 2)
        return help_of(arguments[0], arguments[2]);
    if (strcmp(first, "help") == 0 || strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
        return help();
    if (strcmp(first, "--version") == 0)
        return version();
    const verb *v = find(first);
    return v != NULL ? v->run(count - 1, arguments + 1) : refuse(first);
}
