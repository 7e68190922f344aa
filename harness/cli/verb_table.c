#include "harness/cli/cli_impl.h"

#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/terminal/terminal.h"

#include "verbs.h"

#define VERB_DECLARED(name) extern const verb verb_##name;
VERB_TYPES(VERB_DECLARED)

static const verb look = {.name = "look", .place = VERB_LOOK};
static const verb compute = {.name = "compute", .place = VERB_COMPUTE};
static const verb evaluate = {.name = "evaluate and compare", .place = VERB_EVALUATE};
static const verb exchange = {.name = "exchange", .place = VERB_EXCHANGE};
#define VERB_OF(name) &verb_##name,
/* verbs.h contains the identifiers of all verbs in cli/, in any order */
static const verb *verbs[] = {&look, &compute, &evaluate, &exchange, VERB_TYPES(VERB_OF) NULL};
enum { COUNT = sizeof verbs / sizeof verbs[0] - 1 };

static void arrange(void)
{
    for (int i = 1; i < COUNT; i++)
        for (int k = i; k > 0 && verbs[k]->place < verbs[k - 1]->place; k--) {
            const verb *const later = verbs[k - 1];
            verbs[k - 1] = verbs[k];
            verbs[k] = later;
        }
}

static const char *name_at(const void *context, int i)
{
    int left = i;
    (void)context;
    for (int k = 0; k < COUNT; k++)
        if (verbs[k]->answer != NULL && left-- == 0)
            return verbs[k]->name;
    return left == 0 ? "help" : NULL;
}

static const manual_row examples[] = {
    {"beamwork list", "look up"},
    {"beamwork solve elastica", "solve a case, with its error"},
    {"beamwork converge c_column -k buckling_load", "compare formulations"},
    {"beamwork explain \"wrong limit\"", "explain a term"},
    {NULL, NULL},
};
static const manual_row statuses[] = {
    {"0", "as expected"},
    {"1", "a verdict differs (solve: not converged or singular)"},
    {"2", "invalid input"},
    {"3", "no verdict was assigned"},
    {"4", "file, disk or memory"},
    {"5",
     "incomplete: interrupted (the verdicts so far are in *.partial.*), or batches are missing; "
     "the same command continues the run"},
    {NULL, NULL},
};
static const manual_program about = {
    .verbs = verbs,
    .summary = "verification and benchmarking of three-dimensional beam finite elements",
    .question = "Which formulation reaches my tolerance at the lowest cost, with how many "
                "elements, and what is its verdict?",
    .examples = examples,
    .statuses = statuses,
    .of_compare = "compare, like diff: 0 no change, 1 changes, 2 an error.",
};

static int refuse(const char *name)
{
    char text[200];
    const char *near = choice_nearest(name, name_at, NULL);
    snprintf(text, sizeof text, "unknown verb '%.60s'%s%s%s'beamwork -h' shows all verbs", name,
             near != NULL ? "; did you mean '" : "", near != NULL ? near : "",
             near != NULL ? "'? " : "; ");
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
    printf("\nusage: beamwork VERB [OPTION...]     beamwork help VERB (or VERB -h): options of the "
           "verb\n");
    for (int i = 0; i < COUNT; i++)
        if (verbs[i]->answer == NULL)
            printf("\n%s\n", verbs[i]->name);
        else
            printf("  %-12s  %s\n", verbs[i]->name, verbs[i]->summary);
    printf("\nto begin with\n");
    for (const manual_row *row = examples; row->name != NULL; row++)
        printf("  %-45s %s\n", row->name, row->text);
    printf("\n");
    write_statuses();
    printf("\nbeamwork --version: versions of the program and its libraries\nbeamwork help --man: "
           "names of the manual pages; with a name: that page\n");
    return EXIT_AS_EXPECTED;
}

static int help_of(const char *name, void write(FILE *, const verb *))
{
    const verb *v = verb_find(verbs, name);
    if (v == NULL)
        return refuse(name);
    write(stdout, v);
    return EXIT_AS_EXPECTED;
}

static void write_results(FILE *to)
{
    manual_write_results(to, verbs);
}

/* Returns the function that writes a page about a file format; NULL: none. */
static void (*file_page(const char *name))(FILE *)
{
    if (strcmp(name, "beamwork-scene.5") == 0)
        return manual_write_scene;
    return strcmp(name, "beamwork-results.5") == 0 ? write_results : NULL;
}

static int list_manual_pages(void)
{
    printf("beamwork.1\nbeamwork-scene.5\nbeamwork-results.5\n");
    for (int i = 0; name_at(NULL, i) != NULL; i++)
        if (verb_find(verbs, name_at(NULL, i)) != NULL)
            printf("beamwork-%s.1\n", name_at(NULL, i));
    return EXIT_AS_EXPECTED;
}

/* Writes the manual page `name`: "beamwork.1", "beamwork-scene.5", "beamwork-results.5", or the
 * page of a verb, such as "beamwork-solve.1" or "solve". */
static int write_page(const char *name)
{
    char bare[80];
    if (strcmp(name, "beamwork.1") == 0)
        return manual_write_program(stdout, &about), EXIT_AS_EXPECTED;
    if (file_page(name) != NULL)
        return file_page(name)(stdout), EXIT_AS_EXPECTED;
    const char *from = strncmp(name, "beamwork-", 9) == 0 ? name + 9 : name;
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(from, "."), from);
    return help_of(bare, manual_write_verb);
}

static void complete_verb(const char *begun, int others)
{
    const offer o = {stdout, begun, 0, begun};
    for (int i = 0; i < COUNT; i++)
        if (verbs[i]->answer != NULL)
            offer_text(&o, verbs[i]->name, verbs[i]->summary);
    if (others) {
        offer_text(&o, "help", "of a verb");
        offer_text(&o, "--help", "all verbs");
        offer_text(&o, "--version", "versions of the program and its libraries");
    }
}

static int complete(int count, char **words)
{
    const verb *v = verb_find(verbs, words[0]);
    if (count == 1)
        complete_verb(words[0], 1);
    else if (count == 2 && strcmp(words[0], "help") == 0)
        complete_verb(words[1], 0);
    else if (v != NULL)
        completion_write(stdout, v, count - 1, words + 1);
    return EXIT_AS_EXPECTED;
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
    arrange();
    if (strcmp(first, "help") == 0 && count > 2 && strcmp(arguments[2], "--man") == 0)
        return count > 3 ? write_page(arguments[3]) : list_manual_pages();
    if (strcmp(first, "help") == 0 && count > 3 && strcmp(arguments[2], "--complete") == 0)
        return complete(count - 3, arguments + 3);
    if (strcmp(first, "help") == 0 && count > 2)
        return help_of(arguments[2], help_write);
    if (strcmp(first, "help") == 0 || strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
        return help();
    if (strcmp(first, "--version") == 0)
        return version();
    const verb *v = verb_find(verbs, first);
    return v != NULL ? command_run(v, verbs, count - 1, arguments + 1) : refuse(first);
}
