/* formulations/: finds, loads and completes element types; finds cases by name; selections. */
#ifndef BEAMWORK_FORMULATIONS_H
#define BEAMWORK_FORMULATIONS_H

#include <stdint.h>
#include <stdio.h>

#include "cases/case.h"
#include "elements/element.h"
#include "elements/shared/parameter.h"
#include "elements/shared/status.h"

/* Sets *out to the complete interface of the same element, or to `given` if nothing is missing.
 * REFUSED: members of the type are inconsistent, or a number exceeds its limit. */
status adapters_complete(const element_type *given, const double options[], element_type *out,
                         fault *f);

/* Returns the number of values of the history of an element of the completed type. */
int adapters_history(const element_type *given, const double options[]);
enum { ADAPTERS_MOST_HISTORY = ELEMENT_MAX_HISTORY + 11 * 7 };

/* Returns the relative error of the stiffness due to finite differences, which was measured on
 * beams (test/adapters_test.c); 0: the type needs no finite differences. */
double adapters_error(const element_type *given);

/* Returns a list of everything that is computed by finite differences for the type; "": nothing. */
const char *adapters_words(const element_type *given);

/* Consecutive parameter tables, and the words with which error messages refer to them. */
typedef struct assignment_list {
    const parameter_type *part[PARAMETER_PARTS];
    const char *what;
    const char *owner;    /* name of the case or the formulation */
    const char *option;   /* option of `beamwork list` before this name: "--scene " or "" */
    const char *shown_by; /* argument of `beamwork list` that shows the parameters */
    char separator;       /* character between assignments */
} assignment_list;

enum { ASSIGNMENT_SHOWN = 256 };
/* Writes the arguments of `beamwork list` that show these parameters, with quotation marks for a
 * shell where necessary. */
void assignment_shown(const assignment_list *, char out[ASSIGNMENT_SHOWN]);

/* Writes " in UNIT, without the unit" for a parameter with a unit, and "" for one without. */
enum { PARAMETER_UNIT_WORDS = 80 };
void parameter_unit_words(const parameter_type *, char out[PARAMETER_UNIT_WORDS]);

enum { ASSIGNMENT_VALUE = 64 };

/* Sets "NAME=VALUE", where VALUE is a number in its range or the name of a choice. *index: receives
 * the index; may be NULL. If `any` is not NULL, a value "*" is skipped and marked in `any`.
 * REFUSED: the text has another form, NAME is unknown, or VALUE is not allowed; the message names
 * the text and, for an unknown name, the most similar name. */
status assignment_set(const assignment_list *, const char *text, double value[], int any[],
                      int *index, fault *f);
/* Sets the parameters of assignments "NAME=VALUE" with the separator of the list between them. Each
 * name may occur once. REFUSED: assignment_set rejects an assignment, an assignment is longer than
 * 127 characters, or a name occurs twice. */
status assignment_parse(const assignment_list *, const char *text, double value[], int any[],
                        fault *f);
/* Writes the parameters in the form that assignment_parse reads. Only values that differ from their
 * defaults are written, in the order of the tables. */
void assignment_text(const assignment_list *, const double value[], char *text, int size);

/* Sets *value to the index of the choice that the text names or, for a parameter without choices,
 * to the number in the text, which may be outside the range. Returns 0 if the text is neither. */
int assignment_value(const parameter_type *, const char *text, double *value);
/* Writes the shortest text that gives the same value when it is read, or the name of the choice. */
void assignment_value_text(const parameter_type *, double value, char *text, int size);

/* Returns the case with this name. Returns NULL for an unknown name; the message then gives the
 * most similar known name. */
const case_type *case_find(const char *name, fault *f);

/* Moves states of nodes by increments. The derivatives of element.h refer to such increments.
 * Positions and warping amplitudes are added; rotations are changed by R <- exp(dphi~) R. */

/* Moves x by step[7 nodes] (dr [m], dphi [rad], da [rad/m] of each node), followed by the changes
 * of the additional unknowns, step[scalars nodes]. */
void chart_move(const node_state x[], int nodes, int scalars, const double step[],
                node_state out[]);

/* Returns the size of a small step of coordinate c [m, rad, rad/m, 1] of an element with this
 * number of nodes. Steps are scaled such that the strains they cause do not depend on the length of
 * the beam. */
double chart_unit(int c, int nodes, double length);

/* Computes dexp(psi), row-major, in d(exp(psi)) exp(-psi) = dexp(psi) dpsi. dexp(psi) dpsi is the
 * spatial increment due to a change of the rotation vector. chart_dexp_inverse computes the inverse
 * for |psi| < 2 pi. */
void chart_dexp(const double psi[3], double T[9]);
void chart_dexp_inverse(const double psi[3], double T[9]);

typedef struct environment {
    const char *version,
        *released /* version of the program, and its date in the form 2026-11-21 */, *commit,
        *compiler, *flags;
    char libraries[256], processor[128], clock[32]; /* time of the computation, ISO 8601, UTC */
    int threads;
} environment;

environment environment_now(int threads);
/* returns the version of the program, for example "0.12.0" */
const char *environment_version(void);

/* A formulation with its options, as in -f name:key=value,... */

enum { FORMULATION_KEY = 128, FORMULATION_OPTIONS = ELEMENT_MAX_OPTIONS + 1 };

/* Form of Newton's method: mixed and condensed in each element; displacements only (for
 * comparison); or mixed and uncondensed, with dense elimination. */
typedef enum newton_form {
    NEWTON_MIXED,
    NEWTON_DISPLACEMENT,
    NEWTON_DENSE,
    NEWTON_FORMS
} newton_form;

typedef struct formulation {
    const element_type *type;
    /* values of the options of the type in the order of its table, followed by the common
     * options */
    double option[FORMULATION_OPTIONS];
    /* name, with the options that differ from their defaults */
    char key[FORMULATION_KEY];
} formulation;

/* Options that every formulation has. */
extern const parameter_type formulation_common[];
assignment_list formulation_options(const element_type *);
/* Returns the form of Newton's method. Instead of the mixed form, types that compute forces with a
 * history use the form with displacements, because they have no strains that could be unknowns. */
newton_form formulation_newton(const formulation *);
/* Reads a formulation in the form "NAME" or "NAME:OPTION=VALUE,...". REFUSED: the text is too long,
 * or the name or an option is unknown or invalid. */
status formulation_parse(const char *text, formulation *out, fault *f);
/* Finds the type for "name" or "name:key=value,..."; NULL: none. */
const element_type *formulation_find(const char *key);
void formulation_default(const element_type *type, formulation *out);
/* Makes the default formulation with choice `choice` of option `index`. Returns 0 if this choice
 * does not exist or is the default. */
int formulation_choice(const element_type *type, int index, int choice, formulation *out);
/* Returns the features that options with other values than the defaults affect (element_judged). */
unsigned formulation_bears_on(const formulation *chosen);

/* Adds a formulation in the form of the option -f, or all formulations if the text is "all".
 * REFUSED: formulation_parse rejects the text, the formulation is already in the list, or the list
 * would have more than `most` entries. */
status formulation_list_add(const char *text, int most, formulation list[], int *count, fault *f);

enum { FORMULATIONS_MOST_LOADED = 16 };

const element_type *formulations_at(int i);
/* Returns the element type with this name; NULL: none. */
const element_type *formulations_named(const char *name, size_t length);
int formulations_is_loaded(const element_type *t);
/* Returns 1 for a formulation that the project has not accepted: it was loaded at run time, or
 * formulations_accept was called, but not for this formulation. Verdicts on such a formulation
 * affect the exit status only if the user loaded or named it (sweep_gates). */
int formulations_is_new(const element_type *t);
/* Marks a formulation as accepted (reference/accepted.csv). An unknown name is ignored. */
void formulations_accept(const char *name);
/* Adds a type. REFUSED: its name is in use or is a word of the command line, adapters_complete
 * rejects it, or FORMULATIONS_MOST_LOADED types are already loaded. The caller keeps ownership of
 * the type and of `from`, the value of --element (NULL: none). */
status formulations_add(const element_type *t, const char *from, fault *f);
/* Returns the value of --element that loaded the type; NULL: the type was not loaded. */
const char *formulations_element(const element_type *t);

enum { PROCESS_MOST = 16 };

/* Returns 1 if another process computes this type. */
int process_serves(const element_type *);
/* Sets the time limit [s] of an answer, which is initially 120; 0: no limit. */
void process_limit(int seconds);

/* Largest accepted error of a scaled damping matrix: the difference of opposite entries, or the
 * magnitude of a negative eigenvalue. */
#define DAMPING_ROUNDING 1e-10

/* Computes B: the damping matrix V [n x n], scaled to diagonal entries of 1 or -1, so that large
 * and small entries count alike. C: stiffness at rest. If |V_ii| is below 1e-14 of C_ii times the
 * longest relaxation time max |V_kk|/C_kk, V_ii is scaled by this limit instead, so that round-off
 * is not scaled up. Returns n^2, or the index of the first entry of V that is NaN or Inf. */
int damping_scale(int n, const double C[], const double V[], double B[]);

/* Parameter points of a case: conversion between text and values. */

enum { PARAMETERS_TEXT = 512 };

assignment_list parameters_list(const case_type *c);
/* Like assignment_shown, for a case or a scene file. */
void parameters_shown(const case_type *c, char out[ASSIGNMENT_SHOWN]);
int parameters_count(const case_type *c);
void parameters_default(const case_type *c, double value[]);
/* Sets a parameter. assignment: "NAME=VALUE". REFUSED: the assignment is malformed, or the name or
 * the value is invalid. */
status parameters_set(const case_type *c, const char *assignment, double value[], fault *f);
/* Sets the parameters in "NAME=VALUE;NAME=VALUE", and all other parameters to their defaults. A
 * value "*" means the default and is marked in any[]; "*" alone marks all parameters of the
 * original source. If `any` is NULL, nothing is marked, and only "*" alone is allowed. REFUSED:
 * assignment_parse rejects the text. */
status parameters_parse(const case_type *c, const char *text, double value[], int any[], fault *f);
/* Writes the parameters in the form that parameters_parse reads. Default values are omitted. */
void parameters_text(const case_type *c, const double value[], char *text, int size);
/* Like parameters_text, but writes only parameters of the original source. */
void parameters_source_text(const case_type *c, const double value[], char *text, int size);
/* returns the number of parameters of the original source, which come first in the table */
int parameters_of_source(const case_type *c);
/* Returns the FNV-1a hash of "name=%.17g;" for all parameters in the order of the table, except
 * those that the program has added and that are 0. For parameters marked in `any`, "name=*;" is
 * hashed. */
uint64_t parameters_hash(const case_type *c, const double value[], const int any[]);

/* Texts of the parameters of the previous point, which are reused. */
typedef struct parameters_words {
    int known; /* number of parameters whose texts are known */
    double value[CASE_MAX_PARAMETERS];
    int any[CASE_MAX_PARAMETERS];
    char text[CASE_MAX_PARAMETERS][128];
} parameters_words;

/* Like parameters_hash, for successive points of one case. before->known must be 0 for the first
 * point. */
uint64_t parameters_hash_next(const case_type *c, const double value[], const int any[],
                              parameters_words *before);

/* Loads a formulation, which remains loaded until the program ends. REFUSED: the message is one
 * line that names the file and the remedy. */
status plugin_load(const char *path, const element_type **out, fault *f);

/* Generated lists of all formulations in elements/ and of all cases in cases/, NULL-terminated. */

extern const element_type *const registry_formulations[];
extern const case_type *const registry_cases[];

/* Expressions that select runs, for example -k "c_column and not (beamw or beamw_first)". */

enum { SELECT_WORDS = 256, SELECT_WORD = 128, SELECT_DEPTH = 64 };

/* Evaluates an expression for a text. The expression consists of words with and, or, not and
 * brackets; words without an operator between them are joined by `and`. A word matches anywhere in
 * the text. =NAME matches a whole part between slashes. Returns 1 or 0; -1: the expression is
 * malformed. */
int select_matches(const char *expression, const char *text);
/* Returns 1 if the expression is true for every text in which `part` stands between slashes, or if
 * expression is NULL. Returns 0 for an expression with `not`. */
int select_covers(const char *expression, const char *part);

/* Records which words of an expression have matched a name. */
typedef struct select_words {
    char met[SELECT_WORDS];
} select_words;

/* Starts the record with the words that match a case or a formulation. An expression that is NULL
 * selects everything. REFUSED: the expression is malformed. */
status select_begin(const char *expression, select_words *, fault *);
void select_meet(const char *expression, const char *text, select_words *);
/* Returns 1 if a word has matched no name; word: the first such word. */
int select_unmet(const char *expression, const select_words *, char word[SELECT_WORD]);
/* Checks that all words have matched. REFUSED: a word matched no name; the message gives the first
 * such word and the most similar name. */
status select_all_met(const char *expression, const select_words *, fault *);

/* Central finite differences of sixth order, for functions whose arguments are of the order of
 * one. */

enum { STENCIL_MOST = ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES };

/* Step size h in units of the argument. The truncation error is h^6/140 times the seventh
 * derivative for the first derivative, and h^6/560 times the eighth derivative for the second
 * derivative. The rounding errors are eps/h and 4 eps/h^2. */
static const double stencil_first_step = 2e-3, stencil_second_step = 1e-3;

/* Computes values[count] with argument i moved by si units and argument j by sj units (if i == j,
 * by si + sj). Returns 0, or another number if the function has no value for these arguments. */
typedef int stencil_function(const void *context, int i, double si, int j, double sj,
                             double values[]);

/* Computes the derivatives of the values with respect to argument i, per unit. Returns 0, or the
 * nonzero number that the function returned. */
int stencil_first(stencil_function *f, const void *context, int count, int i, double out[]);
/* Computes the second derivatives with respect to arguments i and j, which are symmetric in i and
 * j. */
int stencil_second(stencil_function *f, const void *context, int count, int i, int j, double out[]);

/* Splits a command line into words. */

enum { WORDS_MOST = 63 };

/* Splits the command. Sets *words to a NULL-terminated list; one call of free() releases the list
 * and its words. Blanks separate words; the quotation marks ' and " protect blanks. REFUSED: no
 * command is given, a quotation mark is not closed, or there are more than WORDS_MOST words. FAULT:
 * out of memory. */
status words_split(const char *command, char ***words, fault *f);

/* Prints a word for a shell, with quotation marks if necessary. */
void words_quote(FILE *to, const char *word);
/* Like words_quote, into a string of at most `size` bytes. */
void words_quoted(const char *word, char *out, size_t size);

#endif
