#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/algebra/team.h"
#include "harness/catalogue/registry.h"
#include "harness/cli/cli.h"

enum { KEY_USAGE = 256 };

/* An option of the verbs. member: of the request, takes it as it is: its text, or 1 where it has no
 * argument; 0: see take. */
typedef struct verb_option {
    const char *name;
    int key;
    const char *argument, *doc;
    size_t member;
} verb_option;

static const verb_option all_options[] = {
    {"formulation", 'f', "NAME[:KEY=VALUE,...]",
     "formulation and its options; again for another, 'all' for every one", 0},
    {"elements", 'n', "N[,N...]", "elements per member", 0},
    {"set", 's', "NAME=VALUE", "value of a case parameter (SI); again for another", 0},
    {"format", 'F', "text|json|csv", "form of the output (default text)", 0},
    {"output", 'o', "FILE", "write there instead of to standard output (verify: results as HDF5)",
     offsetof(cli_request, output)},
    {"keep-all", 'K', NULL, "leave nothing out: same answer, more work",
     offsetof(cli_request, keep_all)},
    {"steps", 'S', "N", "load steps between two stations of a path, to begin with", 0},
    {"select", 'k', "EXPRESSION",
     "words joined by and, or, not, in brackets where they belong together; looked for in "
     "case/parameters/formulation/quantity",
     offsetof(cli_request, select)},
    {"jobs", 'j', "N", "processes (default: one for each processor)", 0},
    {"time-limit", 'L', "SECONDS",
     "of one cell (default 120, 0: none); a cell that exceeds it is a failure of that name", 0},
    {"json", 'J', "FILE", "verdicts as JSON", offsetof(cli_request, json)},
    {"junit", 'U', "FILE", "verdicts as JUnit XML", offsetof(cli_request, junit)},
    {"threshold", 'h', "NAME=R[,NAME=R]",
     "changes that count (default error=0.01,floor=1e-8,work=0.02): of an error relative to "
     "itself, of a value relative to its truth, of a count relative to itself",
     offsetof(cli_request, threshold)},
    {"shapes", 'P', "STATES",
     "store centre lines, sections and resultants of at most so many states of a path (solve: all, "
     "and -o FILE becomes HDF5 for ParaView; verify: 5)",
     0},
    {"markdown", 'M', "FILE", "summary as Markdown, for a pull request",
     offsetof(cli_request, markdown)},
    {"against", 'A', "OTHER",
     "compare in alternation with another formulation, or with another program (a path with a '/')",
     offsetof(cli_request, against)},
    {"threads", 't', "N",
     "threads that share the loop over elements (default 1); results are the same", 0},
    {"dense", 'D', NULL, "time the published algorithm (newton=dense) beside every cell",
     offsetof(cli_request, dense)},
    {"plant", 'X', "PERCENT",
     "make the other slower by that much, to see whether the comparison finds it", 0},
    {"truths", 'T', "FILE",
     "packed truths (default: $BEAMWORK_TRUTHS, or truths.h5 beside the program)",
     offsetof(cli_request, truths)},
    {"scene", 'Y', "FILE",
     "a scene of your own in YAML, in the place of a case (verify: or a folder of them; again for "
     "another)",
     0},
    {"built-in", 'I', NULL, "the built-in cases beside those of --scene",
     offsetof(cli_request, built_in)},
    {"beside", 'B', "FILE",
     "what other programs found, stored by 'beamwork import': contestants that gate nothing",
     offsetof(cli_request, beside)},
    {"map", 'm', "FILE.yaml", "which columns of files without a header are which quantities",
     offsetof(cli_request, map)},
    {"doublings", 'N', "N",
     "so many more meshes of each series, each of twice the elements: do the verdicts stand?", 0},
    {"gate", 'G', NULL, "verdicts of --beside count as ours do", offsetof(cli_request, gate)},
    {"to", 'O', "calculix", "the program that the deck is for", offsetof(cli_request, to)},
    {"schema", 'H', NULL, "describe all keys of scene files as JSON Schema",
     offsetof(cli_request, schema)},
    {"keys", 'E', NULL, "list all keys of scene files", offsetof(cli_request, keys)},
    {"help", '?', NULL, "this list", 0},
    {"usage", KEY_USAGE, NULL, "the options in short", 0},
    {0},
};

static void refuse(const char *text)
{
    exit(cli_fail(STATUS_REFUSED, text));
}

static int whole_number(const char *text, const char *what, long least, long most)
{
    char *end, message[160];
    errno = 0;
    const long value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || value < least || value > most) {
        snprintf(message, sizeof message, "%s '%.40s': give a whole number from %ld to %ld", what,
                 text, least, most);
        refuse(message);
    }
    return (int)value;
}

static void add_meshes(cli_request *r, char *list)
{
    for (char *one = strsep(&list, ","); one != NULL; one = strsep(&list, ",")) {
        if (r->meshes == CLI_MAX_MESHES)
            refuse("too many meshes; give at most 24");
        r->mesh[r->meshes++] = whole_number(one, "number of elements", 1, 10000000);
    }
}

static void add_formulation(cli_request *r, const char *text)
{
    fault f;
    if (strcmp(text, "all") == 0) {
        for (int i = 0; registry_formulations[i] != NULL && r->formulations < CLI_MAX_FORMULATIONS;
             i++)
            formulation_default(registry_formulations[i], &r->formulation[r->formulations++]);
        return;
    }
    if (r->formulations == CLI_MAX_FORMULATIONS)
        refuse("too many formulations");
    if (formulation_parse(text, &r->formulation[r->formulations], &f) != STATUS_OK)
        refuse(f.text);
    for (int i = 0; i < r->formulations; i++)
        if (strcmp(r->formulation[i].key, r->formulation[r->formulations].key) == 0)
            refuse("a formulation is given twice; give it once");
    r->formulations++;
}

static void add_assignment(cli_request *r, const char *text)
{
    const size_t name = strcspn(text, "=");
    char message[160];
    if (r->assignments == CASE_MAX_PARAMETERS)
        refuse("too many parameters");
    for (int i = 0; i < r->assignments; i++)
        if (strcspn(r->assignment[i], "=") == name && strncmp(r->assignment[i], text, name) == 0) {
            snprintf(message, sizeof message, "--set %.*s is given twice; give it one value",
                     (int)(name < 60 ? name : 60), text);
            refuse(message);
        }
    r->assignment[r->assignments++] = text;
}

/* An option that takes one value has it once; lists (-f, -n, --set) and switches may be given
 * again. */
static void refuse_again(cli_request *r, int key, const struct argp_state *state)
{
    const struct argp_option *o = state->root_argp->options;
    char message[160];
    while (o->name != NULL && o->key != key)
        o++;
    if (o->name == NULL || o->arg == NULL || strchr("fnsY", key) != NULL)
        return;
    for (int i = 0; i < r->given_count; i++)
        if (r->given[i] == key) {
            snprintf(message, sizeof message, "--%s is given twice; give it one value", o->name);
            refuse(message);
        }
    r->given[r->given_count++] = (char)key;
}

/* As argp's own, but an output that cannot be written is told. */
static void show_help(const struct argp_state *state, unsigned what)
{
    argp_state_help(state, stdout, what & ~(unsigned)(ARGP_HELP_EXIT_OK | ARGP_HELP_EXIT_ERR));
    exit(cli_finish(EXIT_AS_EXPECTED));
}

static void add_case(cli_request *r, const char *name)
{
    if (r->case_count == r->most_arguments)
        refuse("too many arguments; 'beamwork --help' shows the usage");
    r->cases[r->case_count++] = name;
    r->case_name = r->cases[0];
    r->second = r->cases[1];
}

static void add_scene(cli_request *r, const char *path)
{
    if (r->scene_count == r->most_scenes)
        refuse(r->most_scenes == 1 ? "--scene is given twice; give it one value"
                                   : "too many --scene; give a folder");
    for (int i = 0; i < r->scene_count; i++)
        if (strcmp(r->scene_path[i], path) == 0)
            refuse("--scene is given twice with one path; give it once");
    r->scene_path[r->scene_count++] = path;
}

static error_t take_plain(int key, const char *value, cli_request *r)
{
    const verb_option *o = all_options;
    while (o->name != NULL && o->key != key)
        o++;
    void *member = (char *)r + o->member;
    if (o->member == 0)
        return ARGP_ERR_UNKNOWN;
    if (o->argument != NULL)
        *(const char **)member = value;
    else
        *(int *)member = 1;
    return 0;
}

static error_t take(int key, char *value, struct argp_state *state)
{
    cli_request *r = state->input;
    refuse_again(r, key, state);
    switch (key) {
    case '?':
    case KEY_USAGE:
        show_help(state, key == '?' ? ARGP_HELP_STD_HELP : ARGP_HELP_USAGE);
        return 0;
    case ARGP_KEY_ARG:
        add_case(r, value);
        return 0;
    case 'f':
        add_formulation(r, value);
        return 0;
    case 'n':
        add_meshes(r, value);
        return 0;
    case 's':
        add_assignment(r, value);
        return 0;
    case 'Y':
        add_scene(r, value);
        return 0;
    case 'F':
        if (strcmp(value, "text") != 0 && strcmp(value, "json") != 0 && strcmp(value, "csv") != 0)
            refuse("--format: give text, json or csv");
        r->format = value;
        return 0;
    case 'S':
        r->steps = whole_number(value, "number of steps", 1, 1000000);
        return 0;
    case 'j':
        r->jobs = whole_number(value, "number of processes", 1, 64);
        return 0;
    case 'L':
        r->time_limit = whole_number(value, "time limit", 0, 1000000);
        return 0;
    case 't':
        r->threads = whole_number(value, "number of threads", 1, TEAM_MOST);
        return 0;
    case 'P':
        r->shapes =
            value != NULL ? whole_number(value, "number of states", 1, SHAPES_ALL) : SHAPES_ALL;
        return 0;
    case 'X':
        r->plant = 0.01 * whole_number(value, "planted percentage", 0, 1000);
        return 0;
    case 'N':
        r->doublings = whole_number(value, "number of doublings", 1, 10);
        return 0;
    default:
        return take_plain(key, value, r);
    }
}

static int most_arguments(const char *keys)
{
    if (strchr(keys, '+') != NULL)
        return CLI_MAX_CASES;
    return strchr(keys, '2') != NULL ? 2 : 1;
}

void cli_parse(const char *verb, const char *arguments_doc, const char *doc, const char *keys,
               int count, char **arguments, cli_request *out)
{
    struct argp_option chosen[sizeof all_options / sizeof all_options[0]] = {{0}};
    char name[64];
    int n = 0;
    for (const verb_option *o = all_options; o->name != NULL; o++) {
        const int always = o->key == '?' || o->key == KEY_USAGE;
        if (always || strchr(keys, o->key) != NULL)
            chosen[n++] = (struct argp_option){o->name,     o->key,
                                               o->argument, o->key == 'P' ? OPTION_ARG_OPTIONAL : 0,
                                               o->doc,      always ? -1 : 0};
    }
    const struct argp parser = {
        .options = chosen, .parser = take, .args_doc = arguments_doc, .doc = doc};
    memset(out, 0, sizeof *out);
    out->time_limit = 120;
    out->refusal = EXIT_REFUSED;
    out->format = "text";
    out->most_arguments = most_arguments(keys);
    out->most_scenes = strchr(keys, 'I') != NULL ? CLI_MAX_CASES : 1;
    out->jobs = (int)sysconf(_SC_NPROCESSORS_ONLN);
    snprintf(name, sizeof name, "beamwork %s", verb);
    arguments[0] = name;
    argp_err_exit_status = EXIT_REFUSED;
    argp_parse(&parser, count, arguments, ARGP_NO_HELP, NULL, out);
}
