#include "harness/cli/command.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/case_input.h"
#include "harness/cli/help.h"
#include "harness/cli/message.h"
#include "harness/cli/named.h"
#include "harness/cli/option_check.h"
#include "harness/cli/option_table.h"
#include "harness/experiments/meshes.h"
#include "harness/experiments/shard.h"
#include "harness/newton/shapes.h"
#include "harness/numerics/team.h"

static int whole_number(const char *text, const char *what, long least, long most)
{
    char *end, message[160];
    errno = 0;
    const long value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || value < least || value > most) {
        snprintf(message, sizeof message, "%s '%.40s': give a whole number from %ld to %ld", what,
                 text, least, most);
        message_refuse(message);
    }
    return (int)value;
}

static void add_meshes(command_request *r, const char *list)
{
    fault f;
    if (meshes_parse(list, COMMAND_MAX_MESHES, r->mesh, &r->meshes, &f) != STATUS_OK)
        message_refuse(f.text);
}

static void add_assignment(command_request *r, const char *text)
{
    const size_t name = strcspn(text, "=");
    char message[160];
    if (r->assignments == CASE_MAX_PARAMETERS)
        message_refuse("too many parameters");
    for (int i = 0; i < r->assignments; i++)
        if (strcspn(r->assignment[i], "=") == name && strncmp(r->assignment[i], text, name) == 0) {
            snprintf(message, sizeof message, "--set %.*s is given twice; give it one value",
                     (int)(name < 60 ? name : 60), text);
            message_refuse(message);
        }
    r->assignment[r->assignments++] = text;
}

/* An option that takes one value has it once; lists (-f, -n, --set) and switches may be given
 * again. */
static void refuse_again(command_request *r, int key, const struct argp_state *state)
{
    const struct argp_option *o = state->root_argp->options;
    char message[160];
    while (o->name != NULL && o->key != key)
        o++;
    if (o->name == NULL || o->arg == NULL || strchr("fxnsYBTWyb", key) != NULL)
        return;
    for (int i = 0; i < r->given_count; i++)
        if (r->given[i] == key) {
            snprintf(message, sizeof message, "--%s is given twice; give it one value", o->name);
            message_refuse(message);
        }
    r->given[r->given_count++] = (char)key;
}

/* As argp's own, but an output that cannot be written is told. */
static void show_usage(const struct argp_state *state)
{
    argp_state_help(state, stdout, ARGP_HELP_USAGE & ~(unsigned)ARGP_HELP_EXIT_ERR);
    exit(message_finish(EXIT_AS_EXPECTED));
}

/* state->name: "beamwork VERB". */
static void show_help(const struct argp_state *state)
{
    const struct argp *a = state->root_argp;
    const help_subject s = {strchr(state->name, ' ') + 1, a->args_doc, a->doc, a->options};
    help_write(stdout, &s);
    exit(message_finish(EXIT_AS_EXPECTED));
}

static void add_case(command_request *r, const char *name)
{
    if (r->case_count == r->most_arguments)
        message_refuse("too many arguments; 'beamwork --help' shows the usage");
    r->cases[r->case_count++] = name;
    r->case_name = r->cases[0];
    r->second = r->cases[1];
}

/* One more path of an option that may be given again, each once. */
static void add_path(const char *path, int most, const char *list[], int *count)
{
    if (*count == most)
        message_refuse(most == 1 ? "--scene is given twice; give it one value"
                                 : "too many files of one option; give a folder, join tables");
    for (int i = 0; i < *count; i++)
        if (strcmp(list[i], path) == 0)
            message_refuse("an option is given twice with one path; give it once");
    list[(*count)++] = path;
}

/* Tables stand beside the packed truths, of which there is one file. */
static void add_truths(command_request *r, const char *path)
{
    const size_t length = strlen(path);
    if (r->takes_tables && length > 4 && strcmp(path + length - 4, ".csv") == 0)
        add_path(path, COMMAND_MAX_CASES, r->own_truths, &r->own_truths_count);
    else if (r->truths != NULL)
        message_refuse(
            "--truths is given twice with packed truths; give one, and tables (.csv) beside");
    else
        r->truths = path;
}

static error_t take_plain(int key, const char *value, command_request *r)
{
    const verb_option *o = option_table;
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
    command_request *r = state->input;
    refuse_again(r, key, state);
    switch (key) {
    case '?':
    case KEY_HELP:
        show_help(state);
        return 0;
    case KEY_USAGE:
        show_usage(state);
        return 0;
    case ARGP_KEY_ARG:
        add_case(r, value);
        return 0;
    case 'f':
        named_formulation(r, value);
        return 0;
    case 'x':
        named_element(r, value);
        return 0;
    case ARGP_KEY_END:
        named_load(r);
        return 0;
    case 'n':
        add_meshes(r, value);
        return 0;
    case 's':
        add_assignment(r, value);
        return 0;
    case 'y':
        if (r->varies == CASE_MAX_PARAMETERS)
            message_refuse("too many --vary; give fewer");
        r->vary[r->varies++] = value;
        return 0;
    case 'z':
        r->points = whole_number(value, "number of points", 1, 1000000000);
        return 0;
    case 'r':
        r->seed = whole_number(value, "seed", 0, 2147483647);
        return 0;
    case 'B':
        add_path(value, COMMAND_MAX_CASES, r->beside, &r->beside_count);
        return 0;
    case 'Y':
        add_path(value, r->most_scenes, r->scene_path, &r->scene_count);
        return 0;
    case 'b':
        add_path(value, COMMAND_MAX_CASES, r->from, &r->from_count);
        return 0;
    case 'T':
        add_truths(r, value);
        return 0;
    case 'W':
        add_path(value, COMMAND_MAX_CASES, r->findings, &r->findings_count);
        return 0;
    case 'F':
        if (strcmp(value, "text") != 0 && strcmp(value, "json") != 0 && strcmp(value, "csv") != 0)
            message_refuse("--format: give text, json or csv");
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
    case 'C':
        r->plan = whole_number(value, "number of shards", 1, SHARD_MOST);
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
        return COMMAND_MAX_CASES;
    return strchr(keys, '2') != NULL ? 2 : 1;
}

void command_parse(const char *verb, const char *arguments_doc, const char *doc, const char *keys,
                   int count, char **arguments, command_request *out)
{
    struct argp_option chosen[OPTION_MOST + 1] = {{0}};
    char name[64];
    fault f;
    int n = 0;
    for (const verb_option *o = option_table; o->name != NULL; o++) {
        const int always = o->key == KEY_HELP || o->key == KEY_USAGE;
        const int taken =
            strchr(keys, o->key) != NULL || (o->key == 'x' && strchr(keys, 'f') != NULL);
        if (always || taken)
            chosen[n++] = (struct argp_option){o->name,     o->key,
                                               o->argument, o->key == 'P' ? OPTION_ARG_OPTIONAL : 0,
                                               o->doc,      always ? -1 : 0};
    }
    if (option_check(verb, chosen, count, arguments, &f) != STATUS_OK)
        message_refuse(f.text);
    chosen[n] = (struct argp_option){.key = '?', .flags = OPTION_HIDDEN | OPTION_ALIAS};
    const struct argp parser = {
        .options = chosen, .parser = take, .args_doc = arguments_doc, .doc = doc};
    memset(out, 0, sizeof *out);
    out->time_limit = strcmp(verb, "element-test") == 0 ? 60 : 120;
    out->refusal = EXIT_REFUSED;
    out->seed = -1;
    out->format = "text";
    out->most_arguments = most_arguments(keys);
    out->takes_tables = strchr(keys, '.') != NULL;
    out->most_scenes = strchr(keys, 'I') != NULL ? COMMAND_MAX_CASES : 1;
    out->jobs = (int)sysconf(_SC_NPROCESSORS_ONLN);
    snprintf(name, sizeof name, "beamwork %s", verb);
    arguments[0] = name;
    argp_err_exit_status = EXIT_REFUSED;
    argp_parse(&parser, count, arguments, ARGP_NO_HELP, NULL, out);
}

int command_run(const char *verb, const char *arguments_doc, const char *doc, const char *keys,
                int count, char **arguments, command_answer *answer)
{
    command_request r;
    command_parse(verb, arguments_doc, doc, keys, count, arguments, &r);
    const int code = answer(&r);
    case_input_close(&r);
    return code;
}
