/* The formulations of a command line: those that -f names and those that --element loads, which may
 * stand behind the -f that names them. */
#ifndef BEAMWORK_NAMED_H
#define BEAMWORK_NAMED_H

#include "harness/cli/case_input.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"

enum { COMMAND_MAX_FORMULATIONS = 64 };

typedef struct chosen_formulations {
    text_list element, named; /* as --element and -f say them */
    formulation formulation[COMMAND_MAX_FORMULATIONS];
    int formulations;
    int time_limit; /* [s] of a cell, and of a process that says what it is; 0: none */
} chosen_formulations;
extern const option_group options_formulations; /* -f, --element */
extern const option_group options_element;      /* --element alone */
extern const option_group options_time_limit;   /* behind one of these, of the same member */

/* 1: every formulation of the request was asked for by its name; 0: all were, or none. */
int named_alone(const chosen_formulations *);
/* One more of the request's formulations, or "all". What is refused ends the program. */
void named_add(chosen_formulations *, const char *text);

enum { DEFAULTS_NOTE = 2 * FAULT_TEXT + 200 };

/* The one cell that is asked for, where its -f and -n may be missing. */
typedef struct defaults {
    solution_request wanted;
    chosen_formulations *chosen;
    mesh_list *meshes;
    const truths_options *truths;
} defaults;

/* Fills what is missing of -f and -n for one cell of the case at its parameters. note: a line for
 * each choice and why; "" where both were given. why: solution_choice_free in any case; NULL: not
 * wanted. REFUSED: no formulation offers what the case needs, or --error is none. */
status defaults_fill(const defaults *, char note[DEFAULTS_NOTE], solution_choice *why, fault *f);
/* The same of -f alone. */
status defaults_formulation(const defaults *, char note[DEFAULTS_NOTE], fault *f);
/* The first of each, if there are any. */
solution_request defaults_request(const defaults *);

#endif
