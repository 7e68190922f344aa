#include "harness/cli/cli.h"

#include <errno.h>
#include <glob.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"
#include "harness/records/records.h"

/* Letters of version 0.1, which the next version will not accept. */
static const struct {
    char letter;
    const char *name;
} former[] = {{'x', "element"},    {'F', "format"},         {'K', "all-dofs"},
              {'S', "steps"},      {'L', "time-limit"},     {'J', "json"},
              {'U', "junit"},      {'c', "threshold"},      {'P', "shapes"},
              {'V', "follow"},     {'y', "vary"},           {'d', "design"},
              {'z', "points"},     {'r', "seed"},           {'g', "compute-references"},
              {'R', "matrices"},   {'4', "save-state"},     {'5', "restart"},
              {'M', "markdown"},   {'A', "against"},        {'e', "error"},
              {'t', "threads"},    {'D', "dense"},          {'X', "inject-slowdown"},
              {'T', "truths"},     {'W', "deviations"},     {'Y', "scene"},
              {'I', "built-in"},   {'B', "imported"},       {'m', "map"},
              {'N', "refine"},     {'0', "exit-zero"},      {'6', "tolerance"},
              {'l', "tolerance"},  {'7', "not-worse-than"}, {'G', "imported-must-pass"},
              {'O', "to"},         {'H', "schema"},         {'E', "keys"},
              {'Z', "shard"},      {'i', "into"},           {'b', "from"},
              {'w', "partial"},    {'Q', "hash"},           {'p', "propose-deviations"},
              {'u', "integrator"}, {'a', "step"},           {'3', "conservation-only"},
              {'1', "expected"}};

/* Names of version 0.2, which the next version will not accept. */
static const struct {
    const char *was, *name;
} renamed[] = {{"keep-all", "all-dofs"},           {"beside", "imported"},
               {"gate", "imported-must-pass"},     {"findings", "deviations"},
               {"propose", "propose-deviations"},  {"doublings", "refine"},
               {"plant", "inject-slowdown"},       {"derive", "compute-references"},
               {"no-errors", "conservation-only"}, {"ends", "save-state"}};

const verb_option verb_help[] = {
    {"help", 'h', NULL, "this list", .traits = OPTION_ASIDE},
    {"usage", 0, NULL, "a short list of the options", .traits = OPTION_ASIDE},
    {0}};

/* Returns option *i of an array. If *i is too large, subtracts the number of options from it and
 * returns NULL. */
static const verb_option *among(const verb_option *list, int *i)
{
    for (; list != NULL && list->name != NULL; list++)
        if ((*i)-- == 0)
            return list;
    return NULL;
}

const verb_option *verb_option_at(const verb *v, int i, size_t *at)
{
    size_t here;
    size_t *const where = at != NULL ? at : &here;
    for (const verb_group *g = v->shared; g->group != NULL; g++) {
        const verb_option *o = among(g->group->options, &i);
        *where = g->member;
        if (o != NULL)
            return o;
    }
    *where = 0;
    const verb_option *o = among(v->own, &i);
    return o != NULL ? o : among(verb_help, &i);
}

const char *verb_former_name(const verb_option *o)
{
    for (size_t i = 0; i < sizeof renamed / sizeof renamed[0]; i++)
        if (strcmp(renamed[i].name, o->name) == 0)
            return renamed[i].was;
    return NULL;
}

/* Returns 2 if `name` equals the text of this length, 1 if `name` starts with the text, and 0
 * otherwise. */
static int match_name(const char *name, const char *text, size_t length)
{
    if (name == NULL || strncmp(name, text, length) != 0)
        return 0;
    return name[length] == '\0' ? 2 : 1;
}

static const verb_option *find_long(const verb *v, const char *name, size_t length, int *begun)
{
    const verb_option *o, *found = NULL;
    *begun = 0;
    for (int i = 0; (o = verb_option_at(v, i, NULL)) != NULL; i++) {
        const int now = match_name(o->name, name, length),
                  was = match_name(verb_former_name(o), name, length);
        if (now == 0 && was == 0)
            continue;
        found = o;
        ++*begun;
        if (now == 2 || was == 2) {
            *begun = 1;
            break;
        }
    }
    return *begun == 1 ? found : NULL;
}

int verb_is_letter(const verb_option *o, char letter)
{
    if (o->letter == letter)
        return 1;
    for (size_t i = 0; i < sizeof former / sizeof former[0]; i++)
        if (former[i].letter == letter && strcmp(former[i].name, o->name) == 0)
            return 1;
    return 0;
}

char verb_former_letter(const verb_option *o, int index)
{
    for (size_t i = 0; i < sizeof former / sizeof former[0]; i++)
        if (strcmp(former[i].name, o->name) == 0 && index-- == 0)
            return former[i].letter;
    return 0;
}

const verb_option *verb_letter(const verb *v, char letter, size_t *at)
{
    const verb_option *o;
    for (int i = 0; (o = verb_option_at(v, i, at)) != NULL; i++)
        if (verb_is_letter(o, letter))
            return o;
    return NULL;
}

int verb_optional(const verb_option *o)
{
    return o->argument != NULL && o->argument[0] == '[';
}

const verb_option *verb_word(const verb *v, const char *word, const char **value, int *begun)
{
    const verb_option *o = NULL;
    const char *letter = word + 1;
    const size_t length = strcspn(word, "=");
    *value = word[length] == '=' ? word + length + 1 : NULL;
    if (word[1] == '-')
        return find_long(v, word + 2, length - 2, begun);
    while (*letter != '\0' && (o = verb_letter(v, *letter, NULL)) != NULL && o->argument == NULL)
        letter++;
    *begun = o != NULL;
    *value = o == NULL ? letter : letter[0] != '\0' && letter[1] != '\0' ? letter + 1 : NULL;
    return o;
}

const verb *verb_find(const verb *const *verbs, const char *name)
{
    for (; *verbs != NULL; verbs++)
        if ((*verbs)->answer != NULL && strcmp((*verbs)->name, name) == 0)
            return *verbs;
    return NULL;
}

int verb_most_arguments(const char *arguments)
{
    int most = 1;
    for (const char *at = arguments; *at != '\0'; at++)
        most += *at == ' ';
    return strstr(arguments, "...") != NULL ? COMMAND_MOST_WORDS : most;
}

const char *given_value(const command_line *l, const char *name)
{
    for (int i = l->givens - 1; i >= 0; i--)
        if (strcmp(l->given[i].option->name, name) == 0)
            return l->given[i].value != NULL ? l->given[i].value : "";
    return NULL;
}

const given_option *given_next(const command_line *l, unsigned traits, int *i)
{
    while (*i < l->givens)
        if ((l->given[(*i)++].option->traits & traits) != 0)
            return &l->given[*i - 1];
    return NULL;
}

static status add_text(const verb_option *o, text_list *list, const char *value, fault *f)
{
    const int most = o->most > 0 ? (int)o->most : COMMAND_MOST_WORDS;
    for (int i = 0; (o->traits & (OPTION_INPUT | OPTION_ASIDE)) != 0 && i < list->count; i++)
        if (strcmp(list->text[i], value) == 0)
            return fault_set(f, STATUS_REFUSED, "--%s %.200s is given twice; give it only once",
                             o->name, value);
    if (list->count == most)
        return fault_set(f, STATUS_REFUSED, "--%s is given too often; give it at most %d times",
                         o->name, most);
    list->text[list->count++] = value;
    return STATUS_OK;
}

static status read_whole(const verb_option *o, int *out, const char *text, fault *f)
{
    char *end;
    errno = 0;
    const long value = text != NULL ? strtol(text, &end, 10) : o->most;
    *out = (int)value;
    return text != NULL && (end == text || *end != '\0' || errno != 0 || value < o->least ||
                            value > o->most)
               ? fault_set(f, STATUS_REFUSED,
                           "--%s '%.40s' is not valid; give a whole number from %ld to %ld",
                           o->name, text, o->least, o->most)
               : STATUS_OK;
}

status option_take(const verb_option *o, void *member, const char *value, fault *f)
{
    if (o->read != NULL)
        return o->read(o, member, value, f);
    if ((o->traits & OPTION_REPEATS) != 0)
        return add_text(o, member, value, f);
    if (o->most > 0)
        return read_whole(o, member, value, f);
    if (o->argument != NULL)
        *(const char **)member = value;
    else
        *(int *)member = 1;
    return STATUS_OK;
}

/* Reads one entry of the list. Returns the position after the entry; NULL: the entry is invalid. */
static const char *parse_one(const char *at, double *out)
{
    char *end;
    *out = strtod(at, &end);
    if (end == at)
        return NULL;
    if (*end == '%') {
        *out /= 100;
        end++;
    }
    return (*end == ',' || *end == '\0') && *out > 0 && *out < 1 ? end : NULL;
}

status errors_parse(const char *text, int most, double level[], int *count, fault *f)
{
    const char *at = text;
    *count = 0;
    do {
        at = *count < most ? parse_one(at, &level[*count]) : NULL;
        if (at == NULL)
            return fault_set(f, STATUS_REFUSED,
                             "--error '%.60s' is not valid; give at most %d values above 0 and "
                             "below 100 %%, such as 1%%,0.1%%",
                             text, most);
        ++*count;
    } while (*at++ == ',');
    return STATUS_OK;
}

status option_error(const verb_option *o, void *member, const char *value, fault *f)
{
    const char *end = parse_one(value, member);
    return end != NULL && *end == '\0' ? STATUS_OK
                                       : fault_set(f, STATUS_REFUSED,
                                                   "--%s '%.60s' is not valid; give a value above "
                                                   "0 and below 100 %%, such as 1%%",
                                                   o->name, value);
}

static status read_format(const verb_option *o, void *member, const char *value, fault *f)
{
    (void)o;
    *(const char **)member = value;
    return strcmp(value, "text") == 0 || strcmp(value, "json") == 0 || strcmp(value, "csv") == 0
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "--format %.40s is not supported here; give text, json or csv", value);
}

static status read_record(const verb_option *o, void *member, const char *value, fault *f)
{
    if (strcmp(value, "text") != 0 && strcmp(value, "json") != 0)
        return fault_set(f, STATUS_REFUSED,
                         "--format %.40s is not supported here; give text or json", value);
    return read_format(o, member, value, f);
}

static status read_table(const verb_option *o, void *member, const char *value, fault *f)
{
    if (strcmp(value, "text") != 0 && strcmp(value, "csv") != 0)
        return fault_set(f, STATUS_REFUSED,
                         "--format %.40s is not supported here; give text or csv", value);
    return read_format(o, member, value, f);
}

static status read_meshes(const verb_option *o, void *member, const char *value, fault *f)
{
    (void)o;
    mesh_list *list = member;
    return meshes_parse(value, SCENE_MESHES, list->elements, &list->count, f);
}

static void begin_format(void *group, command_line *l)
{
    (void)l;
    *(const char **)group = "text";
}

static void begin_jobs(void *group, command_line *l)
{
    (void)l;
    *(int *)group = (int)sysconf(_SC_NPROCESSORS_ONLN);
}

static const verb_option output_option[] = {{"output", 'o', "FILE",
                                             "write to this file instead of standard output",
                                             .traits = OPTION_OUTPUT},
                                            {0}};
static const verb_option cli_options_results[] = {
    {"output", 'o', "FILE",
     "write to this file instead of standard output; NAME.h5: to this results file, next to the "
     "results of other experiments",
     .traits = OPTION_OUTPUT},
    {0}};
static const verb_option format[] = {{"format", 0, "text|json|csv",
                                      "format of the output (default text)", .traits = OPTION_ASIDE,
                                      .read = read_format},
                                     {0}};
static const verb_option record[] = {{"format", 0, "text|json",
                                      "format of the output (default text)", .traits = OPTION_ASIDE,
                                      .read = read_record},
                                     {0}};
static const verb_option table[] = {{"format", 0, "text|csv", "format of the output (default text)",
                                     .traits = OPTION_ASIDE, .read = read_table},
                                    {0}};
static const verb_option selection[] = {
    {"select", 'k', "EXPRESSION",
     "words joined by and, or, not and parentheses; each word is matched against "
     "case/parameters/formulation/quantity and may be a part of a name; =NAME matches only the "
     "whole name",
     .traits = 0},
    {0}};
static const verb_option jobs[] = {{"jobs", 'j', "N",
                                    "number of processes (default: one for each processor)",
                                    .traits = OPTION_ASIDE, .least = 1, .most = 64},
                                   {0}};
static const verb_option json[] = {{"json", 0, "FILE", "verdicts as JSON", .traits = OPTION_OUTPUT},
                                   {0}};
static const verb_option meshes[] = {{"elements", 'n', "N[,N...]",
                                      "number of elements per member, or per piece of a member if "
                                      "loads begin, end or act within the member",
                                      .traits = OPTION_REPEATS, .read = read_meshes},
                                     {0}};
static const verb_option reports[] = {
    {"junit", 0, "FILE", "verdicts as JUnit XML", offsetof(report_options, junit), OPTION_OUTPUT,
     .read = NULL},
    {"markdown", 0, "FILE", "summary as Markdown, for a pull request",
     offsetof(report_options, markdown), OPTION_OUTPUT, .read = NULL},
    {"propose-deviations", 0, "FILE",
     "known deviations that new formulations would require, as rows of CSV",
     offsetof(report_options, propose), OPTION_OUTPUT, .read = NULL},
    {0}};
static const verb_option solver[] = {
    {"all-dofs", 0, NULL, "keep all degrees of freedom; this gives the same results with more work",
     .member = offsetof(solver_options, keep_all)},
    {"threads", 0, "N",
     "number of threads that share the loop over elements (default 1); it does not affect the "
     "results",
     .member = offsetof(solver_options, threads), .least = 1, .most = THREAD_POOL_MOST},
    {0}};

const option_group options_output = {output_option, NULL, NULL, NULL};
const option_group options_results = {cli_options_results, NULL, NULL, NULL};
const option_group options_format = {format, begin_format, NULL, NULL};
const option_group options_record = {record, begin_format, NULL, NULL};
const option_group options_table = {table, begin_format, NULL, NULL};
const option_group options_select = {selection, NULL, NULL, NULL};
const option_group options_jobs = {jobs, begin_jobs, NULL, NULL};
const option_group options_json = {json, NULL, NULL, NULL};
const option_group options_meshes = {meshes, NULL, NULL, NULL};
const option_group options_reports = {reports, NULL, NULL, NULL};
const option_group options_solver = {solver, NULL, NULL, NULL};

enum { OUTPUTS = 7 };

typedef struct named_place {
    char option[40];
    const char *path;
    file_place where;
} named_place;

static status check_input(const void *context, const char *input, fault *f)
{
    const named_place *out = context;
    file_place in;
    if (input != NULL && input[0] != '\0' && place_find(input, &in, NULL) == STATUS_OK &&
        place_same(&in, &out->where))
        return fault_set(
            f, STATUS_REFUSED,
            "%s %.100s would overwrite %.100s, which is an input; give the output another name",
            out->option, out->path, input);
    return STATUS_OK;
}

static status check_pair(const named_place *a, const named_place *b, fault *f)
{
    if (!place_same(&a->where, &b->where) || a->where.shared)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%s %.100s and %s %.100s are the same file; give two different names",
                     a->option, a->path, b->option, b->path);
}

static status find_scenes(const char *folder, glob_t *found, fault *f)
{
    char *pattern = malloc(2 * strlen(folder) + sizeof "/*.yaml"), *at = pattern;
    if (pattern == NULL)
        return fault_memory(f, "scene files");
    for (const char *c = folder; *c != '\0'; c++) {
        if (strchr("\\*?[", *c) != NULL)
            *at++ = '\\';
        *at++ = *c;
    }
    memcpy(at, "/*.yaml", sizeof "/*.yaml");
    const int failed = glob(pattern, 0, NULL, found);
    free(pattern);
    if (failed == GLOB_NOMATCH)
        return fault_set(f, STATUS_REFUSED,
                         "%.200s: the folder contains no *.yaml files; give a scene file, such as "
                         "leaf.yaml, or a folder that contains some",
                         folder);
    return failed == 0 ? STATUS_OK
                       : fault_set(f, STATUS_FAULT,
                                   "%.200s: the folder cannot be read; make it readable (chmod "
                                   "u+rx), or give a scene file",
                                   folder);
}

static status visit_folder(const char *folder, file_visit *visit, const void *context, fault *f)
{
    glob_t found;
    status outcome = find_scenes(folder, &found, f);
    TRY(outcome);
    for (size_t i = 0; i < found.gl_pathc && outcome == STATUS_OK; i++)
        outcome = visit(context, found.gl_pathv[i], f);
    globfree(&found);
    return outcome;
}

static status visit_command(const char *command, file_visit *visit, const void *context, fault *f)
{
    char **word;
    struct stat there;
    if (words_split(command, &word, NULL) != STATUS_OK)
        return STATUS_OK;
    status outcome = STATUS_OK;
    for (int i = 0; word[i] != NULL && outcome == STATUS_OK; i++)
        if (stat(word[i], &there) == 0 && S_ISREG(there.st_mode))
            outcome = visit(context, word[i], f);
    free(word);
    return outcome;
}

status files_named(const char *input, file_visit *visit, const void *context, fault *f)
{
    static const char exec[] = "exec:";
    struct stat there;
    if (strncmp(input, exec, sizeof exec - 1) == 0)
        return visit_command(input + sizeof exec - 1, visit, context, f);
    return stat(input, &there) == 0 && S_ISDIR(there.st_mode)
               ? visit_folder(input, visit, context, f)
               : visit(context, input, f);
}

static status check_arguments(const named_place *out, const command_line *l, fault *f)
{
    const int read =
        strstr(l->verb->arguments, "FILE") != NULL || strstr(l->verb->arguments, "OLD") != NULL;
    for (int i = 0; read && i < l->arguments; i++)
        TRY(check_input(out, l->argument[i], f));
    return STATUS_OK;
}

static status check_inputs(const named_place *out, const command_line *l, const char *truths_path,
                           fault *f)
{
    const given_option *g;
    TRY(check_input(out, truths_path, f));
    TRY(check_input(out, "/proc/self/exe", f));
    for (int i = 0; (g = given_next(l, OPTION_INPUT, &i)) != NULL;)
        TRY(files_named(g->value, check_input, out, f));
    return check_arguments(out, l, f);
}

static void name_place(const given_option *g, named_place *out)
{
    const verb_option *o = g->option;
    *out = (named_place){.path = g->value};
    if (o->letter != 0)
        snprintf(out->option, sizeof out->option, "-%c", o->letter);
    else
        snprintf(out->option, sizeof out->option, "--%s", o->name);
}

static status try_place(const given_option *g, int whole_file, named_place *out, fault *f)
{
    const unsigned traits = g->option->traits;
    const int whole = (traits & OPTION_HDF5) != 0 || (whole_file && g->option->letter == 'o');
    name_place(g, out);
    return (traits & OPTION_FOLDER) != 0
               ? output_folder_try(out->path, &out->where, f)
               : output_try(out->path, whole ? OUTPUT_WHOLE_FILE : OUTPUT_TEXT, &out->where, f);
}

status files_check(const command_line *l, int whole_file, const char *truths_path, fault *f)
{
    named_place out[OUTPUTS];
    const given_option *g;
    int count = 0;
    for (int i = 0; (g = given_next(l, OPTION_OUTPUT, &i)) != NULL && count < OUTPUTS; count++) {
        TRY(try_place(g, whole_file, &out[count], f));
        TRY(check_inputs(&out[count], l, truths_path, f));
        for (int k = 0; k < count; k++)
            TRY(check_pair(&out[k], &out[count], f));
    }
    return STATUS_OK;
}

status files_check_results(const command_line *l, int stored, const char *truths_path, fault *f)
{
    const char *results = given_value(l, "output");
    TRY(files_check(l, stored, truths_path, f));
    return stored && results != NULL ? kept_check(results, f) : STATUS_OK;
}
