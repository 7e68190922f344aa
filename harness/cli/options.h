/* Verbs, their options, and the command lines that give them. A verb is an array of its own options
 * beside groups that it shares with others; its request is a struct of its own. The groups of a
 * topic stand with it: case_input, named, spread. */
#ifndef BEAMWORK_OPTIONS_H
#define BEAMWORK_OPTIONS_H

#include <stddef.h>

#include "cases/scene/scene.h"

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

/* What it reads: a switch int, 1; a number int; else const char *; what repeats text_list. */
struct verb_option {
    const char *name;
    char letter;                 /* 0: none */
    const char *argument, *help; /* argument NULL: a switch; "[N]": may be left out */
    size_t member;               /* of the group, or of the verb's request */
    unsigned traits;
    long least, most;    /* of a whole number, or so many values; 0: text, COMMAND_MOST_WORDS */
    option_reader *read; /* NULL: as above */
};

typedef struct verb verb;
typedef struct experiment_type experiment_type; /* harness/experiments/experiments.h */

typedef struct given_option {
    const verb_option *option;
    const char *value; /* NULL: of a switch, or left out */
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

/* The i-th option of a verb, in the order of its help; NULL behind the last. at: where its group is
 * in the request; NULL: not wanted. */
const verb_option *verb_option_at(const verb *, int i, size_t *at);
/* Of a word: "--name=VALUE", by its whole name or the beginning of one only; "-xyVALUE", the first
 * letter that takes a value, else the last. *value: NULL: not in this word. NULL: the letter at
 * *value is no option, or *begun options begin so. */
const verb_option *verb_word(const verb *, const char *word, const char **value, int *begun);
/* By its letter, also by one of former versions; NULL: none. */
int verb_is_letter(const verb_option *, char letter);
const verb_option *verb_letter(const verb *, char letter, size_t *at);
/* help, usage: at the end of each verb. */
extern const verb_option verb_help[];
/* May its value be left out? */
int verb_optional(const verb_option *);
/* Of the verb, by its name; NULL: none. */
const verb *verb_find(const verb *const *verbs, const char *name);
/* So many arguments at most. */
int verb_most_arguments(const char *arguments);

/* The last value that was given, "" of a switch; NULL: it was not. */
const char *given_value(const command_line *, const char *name);
/* The i-th option given that has one of the traits, from *i on, which goes on; NULL: no more. */
const given_option *given_next(const command_line *, unsigned traits, int *i);

/* Values of an option that may be given again. */
typedef struct text_list {
    int count;
    const char *text[COMMAND_MOST_WORDS];
} text_list;

/* Reads a value, NULL of a switch or where it is left out, which is the largest number then. */
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

#endif
