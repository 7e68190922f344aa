/* One cell of a case: asked for, chosen where nobody said, and solved. Command line and library
 * both ask through it. */
#ifndef BEAMWORK_SOLUTION_H
#define BEAMWORK_SOLUTION_H

#include "harness/study/study.h"

typedef struct solution_request {
    const case_type *type;
    const double *parameter; /* of the case */
    const char *select;      /* quantities that are asked for, as of harness/study/study.h; NULL:
                                all */
    formulation formulation; /* type NULL: to be chosen */
    int elements;            /* of each member; 0: to be chosen */
    int keep_all, steps, shapes, threads;
    int keep_ends; /* 1: of motions */
    int restarts;
    const outcome_end *restart; /* [restarts] that motions go on from; none where nothing is */
    int systems;                /* 1: the matrices of small motions about all states are kept */
    double error; /* change of values from mesh to mesh that counts as none, relative; 0: default */
} solution_request;

/* What was chosen, and why: one line each; "" where it was given. */
typedef struct solution_choice {
    char formulation[FAULT_TEXT], elements[FAULT_TEXT];
    double *change; /* of each quantity, from the mesh before; NULL: elements were given */
    int short_of;   /* 1: of the error that was asked for */
} solution_choice;
void solution_choice_free(solution_choice *);

/* Fills the formulation (harness/study/study.h), and the elements where they are wanted; rules
 * NULL: the ledger is not known. REFUSED: no formulation offers what the case needs.
 * solution_choice_free in any case. */
status solution_choose(solution_request *, const rule *rules, int count, int elements,
                       solution_choice *why, fault *f);
/* One point, series and mesh, not yet run, with the quantities that are selected; sweep_free frees
 * them, also after a failure. */
status solution_plan(const solution_request *, sweep *, fault *);
/* Solves the one cell in this process. A cell that is not solved is a result all the same: not
 * after REFUSED and FAULT. NOT_CONVERGED also where the choice is short of the error that was asked
 * for. */
status solution_run(const solution_request *, const solution_choice *, sweep *, fault *);

#endif
