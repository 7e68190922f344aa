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

/* Verbs, their options, and command lines. A verb has its own options, groups of options that it
 * shares with other verbs, and a request struct. */

/* Largest number of arguments of a verb, and of values of a repeated option; largest number of
 * options on a command line. */
enum { COMMAND_MOST_WORDS = 64, COMMAND_MOST_GIVEN = 512 };

typedef struct verb_option verb_option;
/* Stores the value in the member. REFUSED: the message states why the value is invalid, and which
 * values are allowed. */
typedef status option_reader(const verb_option *, void *member, const char *value, fault *f);

enum {
    OPTION_REPEATS = 1, /* the option may be repeated; each path may be given once */
    OPTION_INPUT = 2,   /* the value is an input file, or exec:COMMAND */
    OPTION_OUTPUT = 4,  /* an output file */
    OPTION_HDF5 = 8,    /* the output is HDF5, so it cannot be a stream */
    OPTION_FOLDER = 16, /* the output is a new folder */
    OPTION_ASIDE =
        32, /* does not affect results, only their presentation or the process that computes them */
    OPTION_VERDICT = 64 /* affects verdicts but not cells */
};

/* An option and the member that it sets: int for a switch (1) or a number, text_list for an option
 * that may be repeated, const char * for other options. */
struct verb_option {
    const char *name;
    char letter; /* 0: no letter */
    const char *argument,
        *help;     /* argument NULL: the option is a switch; "[N]": the argument is optional */
    size_t member; /* offset of the member in the group or in the request of the verb */
    unsigned traits;
    /* range of an integer, or number of values; most 0: there is no range, and COMMAND_MOST_WORDS
     * values are allowed */
    long least, most;
    /* reader of the value; NULL: the default reader described above */
    option_reader *read;
};

/* Headings of the help. */
enum { VERB_LOOK = 100, VERB_COMPUTE = 200, VERB_EVALUATE = 300, VERB_EXCHANGE = 400 };

typedef struct verb verb;
typedef struct experiment_type experiment_type; /* harness/experiments/experiments.h */

typedef struct given_option {
    const verb_option *option;
    const char *value; /* NULL: a switch, or an option without its optional value */
} given_option;

/* A command line. The options are in the order in which they were given. */
typedef struct command_line {
    /* the verb; and all verbs (NULL-terminated), for messages about options of other verbs */
    const verb *verb, *const *verbs;
    const char *argument[COMMAND_MOST_WORDS];
    int arguments;
    /* one more entry for the option --scene of an example */
    given_option given[COMMAND_MOST_GIVEN + 1];
    int givens;
} command_line;

/* Options that several verbs share. */
typedef struct option_group {
    const verb_option *options;                 /* ends with name NULL */
    void (*begin)(void *group, command_line *); /* sets defaults that are not zero; NULL: none */
    status (*end)(void *group, command_line *,
                  fault *f); /* called when all options have been read; NULL: none */
    void (*close)(void *group);
} option_group;

typedef struct verb_group {
    const option_group *group;
    size_t member; /* offset of the group in the request */
} verb_group;

/* Initial values of a verb_group. */
#define SHARED(name, at) {&options_##name, IN(at)}

struct verb {
    const char *name;
    /* arguments in the usage line, for example "OLD [NEW]" (at most two) or "CASE..." (any
     * number) */
    const char *arguments;
    const char *summary; /* one line */
    const char *about, *examples;
    const verb_group *shared; /* ends with group NULL */
    const verb_option *own;   /* options, which end with name NULL; NULL: none */
    size_t request;
    int place; /* position in the help: a heading, and a number below the heading */
    int (*answer)(const command_line *,
                  void *request); /* runs the verb and returns the exit status; NULL: a heading */
    void (*before)(char **arguments); /* called before options are read; NULL: none */
    const experiment_type
        *experiment; /* experiment whose records the verb writes to a results file; NULL: none */
};

/* Returns option number i of a verb, in the order of the help; NULL after the last option. *at:
 * offset of the group in the request; may be NULL. */
const verb_option *verb_option_at(const verb *, int i, size_t *at);
/* Returns the name of an option in version 0.2; NULL: the name has not changed. */
const char *verb_former_name(const verb_option *);
/* Finds the option in a word. In "--name=VALUE", the name is a full name, a former name or a unique
 * abbreviation. In "-xyVALUE", the option is that of the first letter that takes a value or, if
 * there is none, of the last letter. *value: the value in the word, or NULL. *begun: number of
 * options that match. Returns NULL if this number is not 1. After an unknown letter, *value points
 * to this letter. */
const verb_option *verb_word(const verb *, const char *word, const char **value, int *begun);
/* Returns 1 if the letter selects the option in this or an earlier version. */
int verb_is_letter(const verb_option *, char letter);
/* Returns a letter that selected the option in an earlier version; 0: there is none with this
 * index. */
char verb_former_letter(const verb_option *, int index);
const verb_option *verb_letter(const verb *, char letter, size_t *at);
/* help and usage, which are added to each verb */
extern const verb_option verb_help[];
/* Returns 1 if the value of the option is optional. */
int verb_optional(const verb_option *);
/* Finds a verb by name; NULL: none. */
const verb *verb_find(const verb *const *verbs, const char *name);
/* Returns the largest number of arguments according to a description such as "OLD [NEW]". */
int verb_most_arguments(const char *arguments);

/* Returns the last value given for the option, "" if it has no value; NULL: the option was not
 * given. */
const char *given_value(const command_line *, const char *name);
/* Returns the next given option with one of the traits, from index *i on, and sets *i to the index
 * after it; NULL: there is none. */
const given_option *given_next(const command_line *, unsigned traits, int *i);

typedef struct text_list {
    int count;
    const char *text[COMMAND_MOST_WORDS];
} text_list;

/* Stores a value. value NULL: the option is a switch, or its optional value was omitted; in the
 * latter case, the largest allowed number is stored. */
status option_take(const verb_option *, void *member, const char *value, fault *f);
option_reader option_error; /* type double: one relative error, "1%" or "0.01" */
/* Reads relative errors between 0 and 1, such as "1%,0.1%" or "0.01", into level[most]. *count:
 * their number. REFUSED: a value is invalid, or there are more than `most`. */
status errors_parse(const char *text, int most, double level[], int *count, fault *f);

extern const option_group options_output;  /* member const char *: -o FILE, text */
extern const option_group options_results; /* member const char *: -o FILE, text or HDF5 results */
extern const option_group options_format;  /* member const char *: text, json or csv */
extern const option_group options_record;  /* member const char *: text or json */
extern const option_group options_table;   /* member const char *: text or csv */
extern const option_group options_select;  /* const char * */
extern const option_group options_jobs;    /* member int, initially the number of processors */
extern const option_group options_json;    /* const char * */

typedef struct mesh_list {
    int count;
    int elements[SCENE_MESHES];
} mesh_list;
extern const option_group options_meshes; /* mesh_list: -n */

/* --json, --junit, --markdown and --propose-deviations */
typedef struct report_options {
    const char *json, *junit, *markdown, *propose;
} report_options;
extern const option_group options_reports;

/* Options of the solution that do not change its results. */
typedef struct solver_options {
    int keep_all;
    int threads; /* threads for the loop over elements; 0: one thread */
} solver_options;
extern const option_group options_solver;

typedef struct truths_options {
    const char *packed; /* file of --truths FILE; NULL: not given */
    text_list own;      /* --truths FILE.csv */
} truths_options;
extern const option_group options_truths;      /* --truths FILE */
extern const option_group options_user_truths; /* like options_truths, but also accepts FILE.csv */

/* Returns the path of the packed reference values: that of --truths, or the default
 * (harness/study/study.h). */
const char *user_tables_packed(const truths_options *);
/* Adds the reference values of --truths FILE.csv. only: the case to which values are added; NULL:
 * all cases. run: cases of the run, NULL-terminated. REFUSED: the message gives the first error as
 * file:line:column, and the number of errors. */
status user_tables_truths(const truths_options *, const case_type *const run[],
                          const case_type *only, truths *t, fault *f);
/* Adds the known deviations in the tables. */
status user_tables_deviations(const text_list *tables, const case_type *const run[], truths *t,
                              fault *f);

typedef struct case_options {
    const char *name;                      /* name of the case; NULL: none */
    const char *scene_path;                /* file of --scene, which is used instead of a name */
    text_list set;                         /* NAME=VALUE */
    double parameter[CASE_MAX_PARAMETERS]; /* values of the parameters, set by case_input_find */
    scene_file *scene;                     /* contents of scene_path */
    int refusal;                           /* exit status after an error */
    command_line *line;
} case_options;
extern const option_group options_case;  /* --scene, --set */
extern const option_group options_scene; /* --scene alone */

/* If the name is a scene file (*.yaml, *.yml), uses it as the value of --scene. If it is that of an
 * example (cases/examples/NAME.yaml) and not of a built-in case, uses the file of the example. */
void case_input_example(case_options *);
/* Returns the case of the request, with its parameters; NULL: an error message has been printed. */
const case_type *case_input_find(case_options *);
/* Returns the case of --scene FILE; NULL: all errors of the file have been printed. */
const case_type *case_input_scene(case_options *);
/* Writes the name of the scene in the form that `import` reads: the case or the full path of the
 * scene file, with the parameters that differ from their defaults. */
void case_input_name(const case_options *, const case_type *, char *text, size_t size);
/* Reads a scene file. Returns EXIT_AS_EXPECTED or, after printing error messages, another exit
 * status. */
int case_input_read(const command_line *, const char *path, scene_file **out);
/* Reads the reference values of the run: the stored values or, for a scene file, those in the file
 * at the parameters of the request. */
status case_input_truths(const case_options *, const truths_options *, truths *t, fault *f);
/* Prints a line on stderr if the numbers of a scene file suggest other units. Does nothing if
 * `file` is NULL. */
void case_input_report_units(const scene_file *, const double parameter[]);
/* If the scene file has no analysis, prints a line on stderr that names the default analysis. */
void case_input_report_analysis(const case_options *, const scene *s);

/* Solves the case on the meshes (none: those of the case) with other programs, "NAME" or
 * "NAME:ELEMENT" separated by commas, and writes their results as an import to the file `to`.
 * *found: 1 if they give values, otherwise 0. */
status peers_solve(const case_options *, const case_type *, const mesh_list *, const char *peers,
                   const char *to, int *found, fault *f);

enum { SCENES_MOST = 64 };

typedef struct scenes_options {
    text_list scene; /* files, folders */
    int built_in;    /* 1: built-in cases are requested as well */
    truths_options truths;
    text_list deviations; /* tables to be added to the list of known deviations */
} scenes_options;

typedef struct scenes {
    int count;
    char *path[SCENES_MOST]; /* [count] paths of all files, including files in folders */
    scene_file *file[SCENES_MOST];
    const case_type *type[2 * SCENES_MOST +
                          1]; /* types of the files, and of built-in cases if these are requested */
} scenes;

/* Reads all files that --scene gives: single files, and every *.yaml of a folder in the order of
 * names. Adds the built-in cases if they are requested, or if --scene is not given. Two cases with
 * the same name are an error. Returns EXIT_AS_EXPECTED or, after printing error messages, another
 * exit status. */
int scenes_read(const command_line *, const scenes_options *, scenes *out);
void scenes_free(scenes *);
/* Reads the reference values of each file, the list of known deviations, user tables and, if
 * built-in cases are requested, the built-in reference values. */
status scenes_truths(const scenes *, const scenes_options *, truths *t, fault *f);

enum {
    EXIT_AS_EXPECTED = 0,
    EXIT_DIFFERS = 1,
    EXIT_REFUSED = 2,
    EXIT_NOTHING = 3,
    EXIT_FAULT = 4,
    EXIT_INTERRUPTED = 5 /* interrupted, or parts are missing */
};

/* Parses a command line. request: memory of verb->request bytes. */
void command_parse(const verb *, const verb *const *verbs, int count, char **arguments,
                   command_line *line, void *request);
int command_run(const verb *, const verb *const *verbs, int count, char **arguments);

/* Writes the help page of a verb within PARAGRAPH_WIDTH columns: usage, description, options,
 * examples. */
void help_write(FILE *to, const verb *v);

/* Checks, before the work starts, that every output can be written and that all outputs and inputs
 * are different files. whole_file: the output of -o is HDF5. truths_path NULL: no reference values
 * are read. */
status files_check(const command_line *, int whole_file, const char *truths_path, fault *f);
/* Like files_check. stored: the output of -o is a results file, which may contain results of other
 * experiments. */
status files_check_results(const command_line *, int stored, const char *truths_path, fault *f);
/* Visits a file, every *.yaml of a folder in the order of names, or the files in exec:COMMAND. */
typedef status file_visit(const void *context, const char *path, fault *f);
status files_named(const char *input, file_visit *visit, const void *context, fault *f);

/* Completes the output at the end of the program. Returns the exit status, or EXIT_FAULT if
 * standard output cannot be written. */
int message_finish(int code);
/* Prints one line on stderr, and returns the exit status for a status. */
int message_fail(status s, const char *text);
/* Prints one line on stderr and ends the program with EXIT_REFUSED. */
_Noreturn void message_refuse(const char *text);
/* Returns EXIT_AS_EXPECTED if the status is OK. Otherwise prints the error and returns the exit
 * status for it. */
int message_exit(status s, const fault *f);

/* Protects against errors of a formulation that was loaded into this process. If it crashes or
 * exceeds `seconds` (0: no limit), the program ends with one line that contains its name. Does
 * nothing for built-in formulations. */
void formulation_start_guard(const formulation *chosen, int seconds);
/* Prepares for abnormal ends. A crash, or a call of exit() by a library or an element, is reported
 * in one line. */
void ending_begin(void);

/* Runs `beamwork VERB ...`, `beamwork help [VERB]`, --help and --version. Returns the exit status.
 * arguments[0]: name of the program. */
int verb_table_run(int count, char **arguments);

/* A word to be completed: `before` remains, and `begun` is completed. */
typedef struct offer {
    FILE *to;
    const char *before;
    int length; /* length of `before` */
    const char *begun;
} offer;

/* If the text starts with `begun`, prints "WORD<tab>SUMMARY", where WORD is `before` followed by
 * the text. After a WORD that ends with '=' or ':', completion continues. For ":files" and
 * ":folders", the shell completes file names. */
void offer_text(const offer *o, const char *text, const char *summary);

/* Writes the completions. word[count]: words after the verb up to the cursor; the last word, which
 * may be empty, is completed. */
void completion_write(FILE *to, const verb *v, int count, char *const *word);

enum { COMMAND_MAX_FORMULATIONS = 64 };

typedef struct chosen_formulations {
    text_list element, named; /* values of --element and -f */
    formulation formulation[COMMAND_MAX_FORMULATIONS];
    int formulations;
    /* [s] time limit of a cell, and of the first answer of a process; 0: no limit */
    int time_limit;
} chosen_formulations;
extern const option_group options_formulations; /* -f, --element */
extern const option_group options_element;      /* --element alone */
extern const option_group options_time_limit; /* this group must follow one of the two groups above,
                                                 with the same member */

/* Returns 1 if all formulations were requested by name. Returns 0 after -f all, or without -f. */
int named_alone(const chosen_formulations *);
/* Adds a formulation, or all formulations for "all". After an error, ends the program. */
void named_add(chosen_formulations *, const char *text);

enum { DEFAULTS_NOTE = 2 * FAULT_TEXT + 200 };

typedef struct defaults {
    solution_request wanted;
    chosen_formulations *chosen;
    mesh_list *meshes;
    const truths_options *truths;
    const truths *known; /* reference values that were read already; NULL: none */
} defaults;

/* Chooses a missing -f or -n, or both, for a cell of the case with its parameters. note: one line
 * for each choice, with the reason; "" if both were given. why: may be NULL; otherwise call
 * solution_choice_free, even after a failure. REFUSED: the message gives the reason. */
status defaults_fill(const defaults *, char note[DEFAULTS_NOTE], solution_choice *why, fault *f);
/* Like defaults_fill, but chooses only a missing formulation. */
status defaults_formulation(const defaults *, char note[DEFAULTS_NOTE], fault *f);
/* Returns the request with the first given formulation and the first given mesh. */
solution_request defaults_request(const defaults *);

#endif
