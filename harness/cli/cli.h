/* cli/: verbs, options, help, manual, completion. */
#ifndef BEAMWORK_CLI_H
#define BEAMWORK_CLI_H

#include <stddef.h>
#include <stdio.h>

#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "elements/shared/status.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

/* Verbs, their options, and the command lines that give them. A verb is an array of its own options
 * beside groups that it shares with others; its request is a struct of its own. The groups of a
 * topic stand with it: case_input, named, spread. */

/* Arguments of a verb, values of an option that may be given again; options in all. */
enum { COMMAND_MOST_WORDS = 64, COMMAND_MOST_GIVEN = 512 };

typedef struct verb_option verb_option;
/* Into the member. REFUSED: what the value is not, what to give. */
typedef status option_reader(const verb_option *, void *member, const char *value, fault *f);

enum {
    OPTION_REPEATS = 1, /* paths: each once */
    OPTION_INPUT = 2,   /* a file that is read, or exec:COMMAND */
    OPTION_OUTPUT = 4,  /* a file that is written */
    OPTION_HDF5 = 8,    /* that file is never a stream ... */
    OPTION_FOLDER = 16, /* ... or it is a folder, a new one */
    OPTION_ASIDE = 32,  /* no answer depends on it: how answers look, who computes them */
    OPTION_VERDICT = 64 /* verdicts depend on it, cells do not */
};

/* Member that an option reads: a switch int, 1; a number int; else const char *; an option that may
 * be repeated text_list. */
struct verb_option {
    const char *name;
    char letter;                 /* 0: none */
    const char *argument, *help; /* argument NULL: a switch; "[N]": optional */
    size_t member;               /* of the group, or of the verb's request */
    unsigned traits;
    long least, most;    /* of a whole number, or that many values; 0: text, COMMAND_MOST_WORDS */
    option_reader *read; /* NULL: as above */
};

typedef struct verb verb;
typedef struct experiment_type experiment_type; /* harness/experiments/experiments.h */

typedef struct given_option {
    const verb_option *option;
    const char *value; /* NULL: of a switch, or not given */
} given_option;

/* A command line as it was given, in its order. */
typedef struct command_line {
    const verb *verb, *const *verbs; /* this one; all, and NULL: for what another one takes */
    const char *argument[COMMAND_MOST_WORDS];
    int arguments;
    given_option given[COMMAND_MOST_GIVEN + 1]; /* and --scene of an example */
    int givens;
} command_line;

/* Options that verbs share. NULL: nothing to do. */
typedef struct option_group {
    const verb_option *options;                           /* ends with a name of NULL */
    void (*begin)(void *group, command_line *);           /* defaults, where these are not zero */
    status (*end)(void *group, command_line *, fault *f); /* once all options are known */
    void (*close)(void *group);
} option_group;

typedef struct verb_group {
    const option_group *group;
    size_t member; /* of the verb's request */
} verb_group;

/* A group of a verb's request; IN(at), which each verb defines: ".member = offsetof(..., at)". */
#define SHARED(name, at) {&options_##name, IN(at)}

struct verb {
    const char *name;
    const char *arguments;        /* "OLD [NEW]": two at most, "CASE...": any number */
    const char *summary;          /* one line */
    const char *about, *examples; /* examples: a line each */
    const verb_group *shared;     /* ends with a group of NULL */
    const verb_option *own;       /* ends with a name of NULL; NULL: none */
    size_t request;
    int (*answer)(const command_line *, void *request); /* the exit code; NULL: a heading */
    void (*before)(char **arguments);                   /* before these are read; NULL: nothing */
    const experiment_type *experiment; /* whose records it leaves in a group; NULL: none */
};

/* The i-th option of a verb, in the order of its help; NULL after the last. at: where its group is
 * in the request; NULL: not needed. */
const verb_option *verb_option_at(const verb *, int i, size_t *at);
/* The name that an option had in version 0.2; NULL where it has not changed. */
const char *verb_former_name(const verb_option *);
/* Parses a word: "--name=VALUE", by its whole name, a former one or a unique beginning of it;
 * "-xyVALUE": the first letter that takes a value, else the last. *value: NULL: not in this word.
 * Returns NULL: the letter at *value is no option, or *begun options begin so. */
const verb_option *verb_word(const verb *, const char *word, const char **value, int *begun);
/* By its letter, also by one of former versions; NULL: none. */
int verb_is_letter(const verb_option *, char letter);
const verb_option *verb_letter(const verb *, char letter, size_t *at);
/* help, usage: at the end of each verb. */
extern const verb_option verb_help[];
/* 1: its value is optional. */
int verb_optional(const verb_option *);
/* Finds the verb of that name; NULL: none. */
const verb *verb_find(const verb *const *verbs, const char *name);
/* that many arguments at most. */
int verb_most_arguments(const char *arguments);

/* The last value that was given, "" of a switch; NULL: it was not. */
const char *given_value(const command_line *, const char *name);
/* The next option given, from *i on, that has one of the traits; advances *i. NULL: none left. */
const given_option *given_next(const command_line *, unsigned traits, int *i);

/* Values of an option that may be given again. */
typedef struct text_list {
    int count;
    const char *text[COMMAND_MOST_WORDS];
} text_list;

/* Reads a value. value NULL (a switch, or an optional value that is not given): the largest
 * number. */
status option_take(const verb_option *, void *member, const char *value, fault *f);
option_reader option_error; /* double, of one error: "1%" or "0.01" */
/* Errors, "1%,0.1%" or "0.01": relative, between 0 and 1, into level[most]; *count: how many. */
status errors_parse(const char *text, int most, double level[], int *count, fault *f);

extern const option_group options_output;  /* const char *: -o FILE, text */
extern const option_group options_results; /* const char *: -o FILE, text, or results in HDF5 */
extern const option_group options_format;  /* const char *: text, json or csv */
extern const option_group options_select;  /* const char * */
extern const option_group options_jobs;    /* int, at first the processors there are */
extern const option_group options_json;    /* const char * */

typedef struct mesh_list {
    int count;
    int elements[SCENE_MESHES];
} mesh_list;
extern const option_group options_meshes; /* mesh_list: -n */

/* Beside options_json, which is of the first member. */
typedef struct report_options {
    const char *json, *junit, *markdown, *propose;
} report_options;
extern const option_group options_reports;

/* How cells are solved: the same answer. */
typedef struct solver_options {
    int keep_all;
    int threads; /* of the loop over elements; 0: one */
} solver_options;
extern const option_group options_solver;

/* The case of a run, built in or a scene file, its parameters, and the reference values that belong
 * to it. */

typedef struct truths_options {
    const char *packed; /* --truths FILE; NULL: not given */
    text_list own;      /* --truths FILE.csv */
} truths_options;
extern const option_group options_truths;     /* --truths FILE */
extern const option_group options_own_truths; /* FILE.csv as well */

/* The packed truths: --truths, or their place (harness/study/study.h). */
const char *own_tables_packed(const truths_options *);
/* Adds the reference values of --truths FILE.csv, of one case where only is not NULL. run: the
 * cases of the run, NULL after the last. REFUSED: the first mistake, as file:line:column, and their
 * number. */
status own_tables_truths(const truths_options *, const case_type *const run[],
                         const case_type *only, truths *t, fault *f);
/* Adds the rules of tables; where there is such a table, new formulations count towards the exit
 * status. */
status own_tables_findings(const text_list *tables, const case_type *const run[], truths *t,
                           fault *f);

typedef struct case_options {
    const char *name;                      /* the argument; NULL: none */
    const char *scene_path;                /* --scene: in its place */
    text_list set;                         /* NAME=VALUE */
    double parameter[CASE_MAX_PARAMETERS]; /* ... from case_input_find on */
    scene_file *scene;                     /* what was read from scene_path */
    int refusal;                           /* exit code without a case */
    command_line *line;
} case_options;
extern const option_group options_case;  /* --scene, --set */
extern const option_group options_scene; /* --scene alone */

/* A name that is no built-in case but that of an example (cases/examples/NAME.yaml) becomes --scene
 * of that file. */
void case_input_example(case_options *);
/* The case of the request with its parameters, or NULL after a message. */
const case_type *case_input_find(case_options *);
/* The case of --scene FILE, or NULL after messages: all its mistakes. */
const case_type *case_input_scene(case_options *);
/* Reads one scene file; EXIT_AS_EXPECTED, or an exit code after messages. */
int case_input_read(const command_line *, const char *path, scene_file **out);
/* Truths of the run: those stored, or, of a scene file, its own at the parameters of the request.
 */
status case_input_truths(const case_options *, const truths_options *, truths *t, fault *f);
/* One line on stderr where the numbers of a scene file look like other units; NULL: none. */
void case_input_tell_units(const scene_file *, const double parameter[]);
/* One line on stderr: which analysis was made up where the scene file states none. */
void case_input_tell_analysis(const case_options *, const scene *s);

enum { SCENES_MOST = 64 };

typedef struct scenes_options {
    text_list scene; /* files, folders */
    int built_in;    /* 1: the built-in cases beside them */
    truths_options truths;
    text_list findings; /* tables added to the list of known deviations */
} scenes_options;

typedef struct scenes {
    int count;
    char *path[SCENES_MOST]; /* [count] of each file, folders looked into */
    scene_file *file[SCENES_MOST];
    const case_type *type[2 * SCENES_MOST + 1]; /* the built-in ones too where they are wanted */
} scenes;

/* All that --scene names: files, and of a folder every *.yaml in the order of their names; type
 * ends in NULL. Not EXIT_AS_EXPECTED: an exit code, after messages; no two are of one name. */
int scenes_read(const command_line *, const scenes_options *, scenes *out);
void scenes_free(scenes *);
/* The built-in reference values where those cases are requested, the list of known deviations, the
 * reference values of each file, and the tables of your own project. */
status scenes_truths(const scenes *, const scenes_options *, truths *t, fault *f);

/* For one minor version: prints a line where the supports of members fix their warping at ends that
 * were free before, and the results of this formulation depend on it, as shown by a mesh of two
 * elements for each member. Built-in cases: none. */
void supports_told(const scene_file *, const double parameter[], const formulation *,
                   const scene *);

/* A command line as a verb reads and answers it; exit codes. */

enum {
    EXIT_AS_EXPECTED = 0,
    EXIT_DIFFERS = 1,
    EXIT_REFUSED = 2,
    EXIT_NOTHING = 3,
    EXIT_FAULT = 4,
    EXIT_INTERRUPTED = 5 /* or parts are missing */
};

/* request: of verb->request bytes. Errors are printed and end the program with EXIT_REFUSED. */
void command_parse(const verb *, const verb *const *verbs, int count, char **arguments,
                   command_line *line, void *request);
/* Reads, answers; the exit code. arguments[0]: the verb. */
int command_run(const verb *, const verb *const *verbs, int count, char **arguments);

/* Help page of a verb: usage, description, options, examples, within PARAGRAPH_WIDTH columns. */
void help_write(FILE *to, const verb *v);

/* The files of a command line, examined before the work begins. */

/* Every output can be written and is a file of its own, and none is an input. whole_file: -o is
 * HDF5. truths_path: NULL where no truths are read. */
status files_check(const command_line *, int whole_file, const char *truths_path, fault *f);
/* The same; stored: -o is a file of results, which other experiments may have written into. */
status files_check_results(const command_line *, int stored, const char *truths_path, fault *f);
/* A file, every *.yaml of a folder in the order of their names, the files that exec:COMMAND
 * names. */
typedef status file_visit(const void *context, const char *path, fault *f);
status files_named(const char *input, file_visit *visit, const void *context, fault *f);

/* How the program says that something went wrong, and with which exit status it ends. */

/* At the end of the program: the exit code, or EXIT_FAULT when standard output could not be
 * written. */
int message_finish(int code);
/* One line on stderr; the exit code that belongs to a status. */
int message_fail(status s, const char *text);
/* Prints the line and ends the program: invalid input. */
_Noreturn void message_refuse(const char *text);
/* EXIT_AS_EXPECTED, or message_fail with what is wrong. */
int message_exit(status s, const fault *f);

/* Ends that are not its own: signals, crashes, libraries that call exit(). */
/* A formulation from outside that runs in this process: when it crashes or does not come back,
 * the program ends with one line that names it. From now on; seconds: 0 for no limit. Does nothing
 * for formulations of the program's own. */
void guard_formulation(const formulation *chosen, int seconds);
/* Called once, before any file is opened. Standard streams that are closed are opened on /dev/null,
 * which refuses writing: no file is mistaken for one of them. Signals that end the program
 * (SIGTERM, SIGHUP, SIGINT) and crashes first delete unfinished output files; a crash, or an exit()
 * of a library or an element, is reported in one line. */
void ending_begin(void);

/* The verbs of the command line. */

/* In the order of help, below headings. A new verb is its file and a line here. */
#define VERBS(HEADING, VERB)                                                                       \
    HEADING(look)                                                                                  \
    VERB(list)                                                                                     \
    VERB(explain)                                                                                  \
    HEADING(compute)                                                                               \
    VERB(solve)                                                                                    \
    VERB(converge)                                                                                 \
    VERB(sweep)                                                                                    \
    VERB(truth)                                                                                    \
    VERB(scene)                                                                                    \
    HEADING(judge_and_compare)                                                                     \
    VERB(verify)                                                                                   \
    VERB(bench)                                                                                    \
    VERB(stress)                                                                                   \
    VERB(motion)                                                                                   \
    VERB(element_test)                                                                             \
    VERB(merge)                                                                                    \
    VERB(compare)                                                                                  \
    HEADING(exchange)                                                                              \
    VERB(export)                                                                                   \
    VERB(import)                                                                                   \
    VERB(schema)
#define VERB_DECLARED(name) extern const verb verb_##name;
#define NO_HEADING(name)
VERBS(NO_HEADING, VERB_DECLARED)

/* `beamwork VERB ...`, `beamwork help [VERB]`, --help, --version: the exit code. arguments[0] is
 * the program. */
int verb_table_run(int count, char **arguments);

/* The word that is being written: `before` of it stays as it is, `begun` is to be completed. */
typedef struct offer {
    FILE *to;
    const char *before;
    int length; /* of before */
    const char *begun;
} offer;

/* Prints a line "WORD<tab>SUMMARY" if the text begins with `begun`; WORD is `before` and the text.
 * A WORD that ends in '=' or ':' may be continued; ":files" and ":folders" are completed by the
 * shell. */
void offer_text(const offer *o, const char *text, const char *summary);

/* The words after the verb up to the cursor; the last one, which may be empty, is begun. */
void completion_write(FILE *to, const verb *v, int count, char *const *word);

/* The formulations of a command line: those that -f names and those that --element loads, which may
 * are after the -f that names them. */

enum { COMMAND_MAX_FORMULATIONS = 64 };

typedef struct chosen_formulations {
    text_list element, named; /* as --element and -f say them */
    formulation formulation[COMMAND_MAX_FORMULATIONS];
    int formulations;
    int time_limit; /* [s] of a cell, and of a process that says what it is; 0: none */
} chosen_formulations;
extern const option_group options_formulations; /* -f, --element */
extern const option_group options_element;      /* --element alone */
extern const option_group options_time_limit;   /* after one of these, of the same member */

/* 1: every formulation of the request was requested by its name; 0: all were, or none. */
int named_alone(const chosen_formulations *);
/* One more of the request's formulations, or "all". What is refused ends the program. */
void named_add(chosen_formulations *, const char *text);

enum { DEFAULTS_NOTE = 2 * FAULT_TEXT + 200 };

/* The one cell that is requested, where its -f and -n may be missing. */
typedef struct defaults {
    solution_request wanted;
    chosen_formulations *chosen;
    mesh_list *meshes;
    const truths_options *truths;
} defaults;

/* Fills missing -f and -n for one cell of the case at its parameters. note: a line for each choice
 * and its reason; "" where both were given. why: solution_choice_free in any case; may be NULL.
 * REFUSED: no formulation supports what the case needs, or --error is not a valid number. */
status defaults_fill(const defaults *, char note[DEFAULTS_NOTE], solution_choice *why, fault *f);
/* The same of -f alone. */
status defaults_formulation(const defaults *, char note[DEFAULTS_NOTE], fault *f);
/* The first of each, if there are any. */
solution_request defaults_request(const defaults *);

#endif
