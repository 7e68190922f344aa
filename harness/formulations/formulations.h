/* formulations/: element types found, loaded, completed; cases by name, selections. */
#ifndef BEAMWORK_FORMULATIONS_H
#define BEAMWORK_FORMULATIONS_H

#include <stdint.h>
#include <stdio.h>

#include "cases/case.h"
#include "elements/element.h"
#include "elements/shared/parameter.h"
#include "elements/shared/status.h"

/* Completes the interface of a formulation: derivatives by differences, strains and stresses from a
 * force or an energy. */

/* *out: the whole interface for the same beam: `given` itself where nothing is missing. REFUSED:
 * the type is inconsistent. */
status adapters_complete(const element_type *given, const double options[], element_type *out,
                         fault *f);

/* Relative error of its stiffness by differences, as measured on beams (test/adapters_test.c); 0:
 * it needs no differences. */
double adapters_error(const element_type *given);

/* Names what is computed by differences for the type; "": nothing. */
const char *adapters_words(const element_type *given);

/* NAME=VALUE: the one text form of what a user chooses, parameters of a case as well as options of
 * a formulation. */

/* Tables, one after the other, and the words of error messages. */
typedef struct assignment_list {
    const parameter_type *part[PARAMETER_PARTS];
    const char *what;     /* "parameter" */
    const char *owner;    /* the case or the formulation */
    const char *option;   /* of `beamwork list`, before the next: "--scene " or "" */
    const char *shown_by; /* argument of `beamwork list` that shows them */
    char separator;       /* between assignments */
} assignment_list;

enum { ASSIGNMENT_SHOWN = 256 };
/* Arguments of `beamwork list` that show them, quoted for a shell. */
void assignment_shown(const assignment_list *, char out[ASSIGNMENT_SHOWN]);

enum { ASSIGNMENT_VALUE = 64 };

/* "NAME=VALUE" (value: a number in its range, or the name of a choice), returning the index in
 * *index (may be NULL). any (may be NULL): a value "*" is skipped and marked there.  REFUSED names
 * the culprit, with the nearest known name. */
status assignment_set(const assignment_list *, const char *text, double value[], int any[],
                      int *index, fault *f);
/* "NAME=VALUE;NAME=VALUE", each name once; what is not named keeps its value.  "": nothing. */
status assignment_parse(const assignment_list *, const char *text, double value[], int any[],
                        fault *f);
/* The same, written: values that differ from their defaults, in the order of the tables. */
void assignment_text(const assignment_list *, const double value[], char *text, int size);

/* The number, or the index of the choice, that a text is, of any size; 0: it is neither. */
int assignment_value(const parameter_type *, const char *text, double *value);
/* The shortest text that gives the same value, or the choice's name. */
void assignment_value_text(const parameter_type *, double value, char *text, int size);

/* Cases by their names. */

const case_type *case_find(const char *name, fault *f); /* NULL: unknown, f names the nearest */

/* Node states moved by increments, as defined for the derivatives of element.h: positions and
 * warping amplitudes are added, rotations R <- exp(dphi~) R. */

/* out = x moved by step[7 nodes] (dr [m], dphi [rad], da [rad/m] of each node). */
void chart_move(const node_state x[], int nodes, const double step[], node_state out[]);

/* The size of a small step of coordinate c that means the same for beams of every length [m, rad,
 * rad/m]. */
double chart_unit(int c, double length);

/* d(exp(psi)) exp(-psi) = dexp(psi) dpsi: spatial increment of a rotation vector's rotation, row
 * major; and its inverse, |psi| < 2 pi. */
void chart_dexp(const double psi[3], double T[9]);
void chart_dexp_inverse(const double psi[3], double T[9]);

/* Program, machine and libraries that computed a result. */

typedef struct environment {
    const char *version, *released /* 2026-11-21 */, *commit, *compiler, *flags;
    char libraries[256], processor[128], clock[32]; /* ISO 8601, UTC */
    int threads;
} environment;

environment environment_now(int threads);
const char *environment_version(void); /* of the program, "0.12.0" */

/* -f name:key=value,...: a formulation with its options. */

enum { FORMULATION_KEY = 128, FORMULATION_OPTIONS = ELEMENT_MAX_OPTIONS + 1 };

/* The mixed Newton condensed element by element; for comparison, in displacements only, and
 * uncondensed with dense elimination. */
typedef enum newton_form {
    NEWTON_MIXED,
    NEWTON_DISPLACEMENT,
    NEWTON_DENSE,
    NEWTON_FORMS
} newton_form;

typedef struct formulation {
    const element_type *type;
    double option[FORMULATION_OPTIONS]; /* its own, in table order, then the common ones */
    /* name, and the options that differ from their defaults */
    char key[FORMULATION_KEY];
} formulation;

/* Options that every formulation has, after its own. */
extern const parameter_type formulation_common[];
/* The options of a type and those that every formulation takes. */
assignment_list formulation_options(const element_type *);
newton_form formulation_newton(const formulation *);
status formulation_parse(const char *text, formulation *out, fault *f);
/* The type that "name" or "name:key=value,..." means, or NULL. */
const element_type *formulation_find(const char *key);
void formulation_default(const element_type *type, formulation *out);
/* The default with choice `choice` of option `index`; 0 when there is no such choice, or it is the
 * default itself. */
int formulation_choice(const element_type *type, int index, int choice, formulation *out);
/* Features on which the options that differ from their defaults bear (element_judged). */
unsigned formulation_bears_on(const formulation *chosen);

/* Formulations side by side. */

/* Adds one, in the form of -f, or "all"; each once. REFUSED: unknown, given twice, or beyond the
 * room of `most`. */
status formulation_list_add(const char *text, int most, formulation list[], int *count, fault *f);

/* All formulations: those of elements/, then those that were loaded. */

enum { FORMULATIONS_MOST_LOADED = 16 };

/* Number i, or NULL after the last one. */
const element_type *formulations_at(int i);
/* Returns the element type of this name, or NULL. */
const element_type *formulations_named(const char *name, size_t length);
/* Was it loaded from outside? */
int formulations_is_loaded(const element_type *t);
/* 1: the project has not accepted it: it was loaded, or it is not among those that
 * formulations_accept names; until that names any, all of the tree's are accepted. Its verdicts
 * count towards the exit status if the user loaded or named it (sweep_gates). */
int formulations_is_new(const element_type *t);
/* Marks one as accepted (reference/accepted.csv); an unknown name is ignored. */
void formulations_accept(const char *name);
/* Adds one; refuses a name that is there, and words that mean more than one (all). The type stays
 * the caller's, and so does `from`: what --element calls it, or NULL. */
status formulations_add(const element_type *t, const char *from, fault *f);
/* Returns the value of --element that loaded the type, or NULL where it was not loaded. */
const char *formulations_element(const element_type *t);

/* Formulations in separate processes: --element 'exec:COMMAND'. */

enum { PROCESS_MOST = 16 };

/* The type that the command says it is. It and its process stay until this process ends. Each
 * process that uses it starts one of its own. REFUSED: no such command, or not the first line of
 * the protocol (protocol.md). */
status process_load(const char *command, const element_type **out, fault *f);
/* Is it computed by another process? */
int process_serves(const element_type *);
/* Seconds that an answer may take, from now on (120); 0: any time. */
void process_limit(int seconds);

/* Parameter points of a case: text <-> values. */

enum { PARAMETERS_TEXT = 512 };

assignment_list parameters_list(const case_type *c);
int parameters_count(const case_type *c);
void parameters_default(const case_type *c, double value[]);
/* assignment: "NAME=VALUE". */
status parameters_set(const case_type *c, const char *assignment, double value[], fault *f);
/* "NAME=VALUE;NAME=VALUE": values other than the default; a value "*" is skipped and marked in
 * any[] (may be NULL); "*" alone: any of those of the source. */
status parameters_parse(const case_type *c, const char *text, double value[], int any[], fault *f);
/* The same, written: empty for the defaults. */
void parameters_text(const case_type *c, const double value[], char *text, int size);
/* The same of those that the source of a case knows, as programs that derive values are asked. */
void parameters_source_text(const case_type *c, const double value[], char *text, int size);
int parameters_of_source(const case_type *c); /* their number: the first ones */
/* FNV-1a of "name=%.17g;" over all parameters in table order, choices by index, "name=*;" where
 * any. */
uint64_t parameters_hash(const case_type *c, const double value[], const int any[]);

/* The words of the point before: neighbours in a table have most of them in common. */
typedef struct parameters_words {
    int known; /* 0: none yet */
    double value[CASE_MAX_PARAMETERS];
    int any[CASE_MAX_PARAMETERS];
    char text[CASE_MAX_PARAMETERS][128];
} parameters_words;

/* The same for points of one case, one after the other. */
uint64_t parameters_hash_next(const case_type *c, const double value[], const int any[],
                              parameters_words *before);

/* A formulation from outside: a shared object with the symbol beamwork_element, or exec:COMMAND, a
 * process (harness/formulations). */

/* Loads one; it stays for the life of the program. Refuses what is no shared object, has no such
 * symbol or is no command, was written for another interface (ABI, size) or says too little of
 * itself, with one line that names the file and the remedy. */
status plugin_load(const char *path, const element_type **out, fault *f);

/* The two generated lists: what exists in elements/ and cases/. NULL-terminated. */

extern const element_type *const registry_formulations[];
extern const case_type *const registry_cases[];

/* Expressions that choose cells: -k "c_column and not (beamw or beamw_first)". */

/* Words of an expression, their length, and brackets and nots inside each other. */
enum { SELECT_WORDS = 256, SELECT_WORD = 128, SELECT_DEPTH = 64 };

/* Does an expression (words joined by and, or, not, in brackets where they belong together; a word
 * is searched for in text, =NAME is one of its parts between slashes) hold? -1: malformed. */
int select_matches(const char *expression, const char *text);
/* Does it hold of every text that this one is a part of? Of an expression with a not: 0. NULL: all
 * is chosen. */
int select_covers(const char *expression, const char *part);

/* Which words of an expression anything is called by: a misspelt one would skip cells in
 * silence. */
typedef struct select_words {
    char met[SELECT_WORDS];
} select_words;

/* STATUS_REFUSED: malformed. Names of cases and formulations are met, whether there are cells of
 * them or not. expression NULL: all is chosen. */
status select_begin(const char *expression, select_words *, fault *);
void select_meet(const char *expression, const char *text, select_words *);
/* The first word that was never met; 0: all were. */
int select_unmet(const char *expression, const select_words *, char word[SELECT_WORD]);
/* STATUS_REFUSED: the first word that was never met, and the nearest name. */
status select_all_met(const char *expression, const select_words *, fault *);

/* Central differences of sixth order, of functions of arguments near one. */

enum { STENCIL_MOST = 576 }; /* values of a function */

/* Step size h in units. Truncation error: h^6/140 times the seventh derivative, h^6/560 times the
 * eighth; round-off: eps/h and 4 eps/h^2. */
static const double stencil_first_step = 2e-3, stencil_second_step = 1e-3;

/* values[count] where arguments i and j are moved by si and sj units (i == j: by si + sj); returns
 * 0, or another number where there is none. */
typedef int stencil_function(const void *context, int i, double si, int j, double sj,
                             double values[]);

/* d values/d argument i per unit; 0, or what the function returned. */
int stencil_first(stencil_function *f, const void *context, int count, int i, double out[]);
/* d2 values/d argument i d argument j, as it is symmetric. */
int stencil_second(stencil_function *f, const void *context, int count, int i, int j, double out[]);

/* A command line as words. */

enum { WORDS_MOST = 63 };

/* *words: NULL-terminated, to be freed at once with what they point to. Blanks part words; quotes '
 * and " keep blanks. REFUSED: none, too many, a quote that does not end; FAULT: memory. */
status words_split(const char *command, char ***words, fault *f);

/* A word as a shell reads it: as it is, or in quotes where it needs them. */
void words_quote(FILE *to, const char *word);
/* The same as a text, as far as there is room. */
void words_quoted(const char *word, char *out, size_t size);

#endif
