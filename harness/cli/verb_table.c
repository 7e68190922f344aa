#include "harness/cli/verb_table.h"

#include <stdio.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/cli/cli.h"
#include "harness/cli/completion.h"
#include "harness/cli/help.h"
#include "harness/cli/manual.h"
#include "harness/cli/offer.h"
#include "harness/formulations/environment.h"
#include "harness/terminal/paragraph.h"

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
    {"sweep", cli_sweep, "one case over ranges of its parameters: where is an error kept?"},
    {"truth", cli_truth, "what is known of a case at a parameter point; derived on demand"},
    {"scene", cli_scene, "a case, or a structure of your own, written out as a scene file"},
    {"judge and compare", NULL, NULL},
    {"verify", cli_verify, "every formulation on every case, judged against stored truths"},
    {"bench", cli_bench, "error against run time: the cheapest way to an error"},
    {"stress", cli_stress, "every formulation at extremes: a value, or a named failure"},
    {"motion", cli_motion, "integrators side by side: error of time, energy, momenta, cost"},
    {"element-test", cli_element_test,
     "a formulation against the interface: what to mend, and what it can do"},
    {"merge", cli_merge, "what shards of verify, stress, converge or bench computed, as one run"},
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

static const manual_row examples[] = {
    {"beamwork list", "what there is"},
    {"beamwork solve elastica", "one answer, with its error"},
    {"beamwork converge c_column -k buckling_load", "formulations side by side"},
    {"beamwork explain \"wrong limit\"", "what a word means"},
    {NULL, NULL},
};
static const manual_row statuses[] = {
    {"0", "as expected"},
    {"1", "a verdict differs (solve: not converged or singular)"},
    {"2", "refused input"},
    {"3", "nothing was judged"},
    {"4", "file, disk or memory"},
    {"5", "incomplete: interrupted (what was judged is in *.partial.*), or parts are missing; the "
          "same command goes on"},
    {NULL, NULL},
};
static const manual_program about = {
    .summary = "verification and benchmark of three-dimensional beam finite elements",
    .question = "Which formulation, with how many elements, reaches my tolerance soonest, and can "
                "I believe it?",
    .examples = examples,
    .statuses = statuses,
    .of_compare = "compare, as diff: 0 the same, 1 different, 2 trouble.",
};

static int refuse(const char *name)
{
    char text[200];
    const char *near = choice_nearest(name, name_at, NULL);
    snprintf(text, sizeof text, "unknown verb '%.60s'%s%s%s; 'beamwork -h' shows them all", name,
             near != NULL ? ", did you mean '" : "", near != NULL ? near : "",
             near != NULL ? "'?" : "");
    return message_fail(STATUS_REFUSED, text);
}

static void write_statuses(void)
{
    paragraph text;
    const int at = printf("exit status:");
    FILE *to = paragraph_begin(&text, stdout);
    for (const manual_row *row = statuses; row->name != NULL; row++)
        fprintf(to, "%s %s%s ", row->name, row->text, row[1].name != NULL ? ";" : "");
    fprintf(to, "(%.*s)", (int)strlen(about.of_compare) - 1, about.of_compare);
    paragraph_end(&text, at, at + 1);
}

static int help(void)
{
    printf("beamwork: %s.\n", about.summary);
    paragraph_write(stdout, 0, 0, about.question);
    printf("\nusage: beamwork VERB [OPTION...]     beamwork help VERB (or VERB -h): its options\n");
    for (int i = 0; i < VERBS; i++)
        if (verbs[i].run == NULL)
            printf("\n%s\n", verbs[i].name);
        else
            printf("  %-12s  %s\n", verbs[i].name, verbs[i].summary);
    printf("\nto begin with\n");
    for (const manual_row *row = examples; row->name != NULL; row++)
        printf("  %-45s %s\n", row->name, row->text);
    printf("\n");
    write_statuses();
    printf("\nbeamwork --version: versions of the program and its libraries\n"
           "beamwork help --man: names of its manual pages; with one of them: that page\n");
    return EXIT_AS_EXPECTED;
}

/* VERB -h in other words. */
static int help_of(char *program, char *name)
{
    char option[] = "--help";
    char *arguments[] = {program, name, option, NULL};
    const verb *v = find(name);
    return v != NULL ? v->run(2, arguments + 1) : refuse(name);
}

static int write_program_page(void)
{
    manual_row rows[VERBS + 1] = {{NULL, NULL}};
    manual_program whole = about;
    for (int i = 0; i < VERBS; i++)
        rows[i] = (manual_row){verbs[i].name, verbs[i].summary};
    whole.verbs = rows;
    manual_write_program(stdout, &whole);
    return EXIT_AS_EXPECTED;
}

/* Not a verb: a page about files. */
static void (*file_page(const char *name))(FILE *)
{
    if (strcmp(name, "beamwork-scene.5") == 0)
        return manual_write_scene;
    return strcmp(name, "beamwork-results.5") == 0 ? manual_write_results : NULL;
}

static int list_pages(void)
{
    printf("beamwork.1\nbeamwork-scene.5\nbeamwork-results.5\n");
    for (int i = 0; name_at(NULL, i) != NULL; i++)
        if (find(name_at(NULL, i)) != NULL)
            printf("beamwork-%s.1\n", name_at(NULL, i));
    return EXIT_AS_EXPECTED;
}

/* "beamwork.1", "beamwork-scene.5", "beamwork-solve.1" or "solve". */
static int write_page(char *first, const char *name)
{
    char bare[80];
    if (strcmp(name, "beamwork.1") == 0)
        return write_program_page();
    if (file_page(name) != NULL)
        return file_page(name)(stdout), EXIT_AS_EXPECTED;
    const char *from = strncmp(name, "beamwork-", 9) == 0 ? name + 9 : name;
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(from, "."), from);
    const verb *v = find(bare);
    const manual_row row = {v != NULL ? v->name : NULL, v != NULL ? v->summary : NULL};
    if (v != NULL)
        help_use(manual_write_verb, &row);
    return help_of(first, bare);
}

/* The verb itself, and what is none. */
static void complete_verb(const char *begun, int others)
{
    const offer o = {stdout, begun, 0, begun};
    for (int i = 0; i < VERBS; i++)
        if (verbs[i].run != NULL)
            offer_text(&o, verbs[i].name, verbs[i].summary);
    if (others) {
        offer_text(&o, "help", "of a verb");
        offer_text(&o, "--help", "all verbs");
        offer_text(&o, "--version", "versions of the program and its libraries");
    }
}

/* What may stand in the place of the last word; shells ask (harness/cli). */
static int complete(char *first, int count, char **words)
{
    const completion_line line = {count - 1, words + 1};
    const verb *v = count > 1 ? find(words[0]) : NULL;
    if (count == 1)
        complete_verb(words[0], 1);
    else if (count == 2 && strcmp(words[0], "help") == 0)
        complete_verb(words[1], 0);
    if (v == NULL)
        return EXIT_AS_EXPECTED;
    help_use(completion_write, &line);
    return help_of(first, words[0]);
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
    if (strcmp(first, "help") == 0 && count > 2 && strcmp(arguments[2], "--man") == 0)
        return count > 3 ? write_page(arguments[0], arguments[3]) : list_pages();
    if (strcmp(first, "help") == 0 && count > 3 && strcmp(arguments[2], "--complete") == 0)
        return complete(arguments[0], count - 3, arguments + 3);
    if (strcmp(first, "help") == 0 && count > 2)
        return help_of(arguments[0], arguments[2]);
    if (strcmp(first, "help") == 0 || strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
        return help();
    if (strcmp(first, "--version") == 0)
        return version();
    const verb *v = find(first);
    return v != NULL ? v->run(count - 1, arguments + 1) : refuse(first);
}
