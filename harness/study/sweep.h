/* All cells of a verification: series of meshes for every case, parameter point and formulation,
 * run by several processes. */
#ifndef BEAMWORK_SWEEP_H
#define BEAMWORK_SWEEP_H

#include <stdio.h>

#include "harness/formulations/formulations.h"
#include "harness/study/cell.h"
#include "harness/study/imported.h"
#include "harness/study/omission.h"
#include "harness/study/truths.h"

enum { SERIES_MAX_MESHES = SCENE_MESHES };

typedef struct sweep_point {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    char text[PARAMETERS_TEXT]; /* differences from the defaults */
    char name[16];              /* "default" or the first digits of the hash */
    scene_edit edit;            /* that was made to the scene */
    int steps;                  /* load steps between stations; 0: the scene's */
    int condition;              /* 1: estimate the condition of the tangents */
    int shapes;      /* most states whose centre lines are kept of all its cells; 0: none */
    int whole_steps; /* 1: steps in time are not halved */
    scene scene;     /* of all its cells, with their quantities */
    status status;   /* of building the scene */
    char reason[FAULT_TEXT];
} sweep_point;

typedef struct series {
    int point;
    formulation formulation;
    /* what it cannot do without and the formulation does not offer; empty: it runs, ... */
    char missing[200];
    omission without; /* ... without this, as another model where that matters */
    int meshes, mesh[SERIES_MAX_MESHES];
    cell_result *cell; /* [meshes]; their scenes are empty: the point has it */
    /* [quantities] relative, of the finest mesh (harness/study/noise.h); NULL: not measured */
    double *noise;
    struct cell_timing *timing; /* [meshes] of a benchmark (harness/study); else NULL */
    imported *imported;         /* another program's: its cells were not run here; else NULL */
} series;

typedef struct sweep {
    /* of the request: what it leaves out is not judged either; NULL: nothing is left out */
    const char *select;
    /* of the request, as they live there: its cases (NULL: it was planned by hand), and its
     * formulations where it is restricted to some */
    const case_type *const *cases;
    const formulation *given;
    int givens;
    int named;        /* of the request */
    double tolerance; /* of the request */
    int shapes;       /* of the request */
    int whole_only;   /* 1: what a formulation does not offer keeps it from running */
    int values_only;  /* 1: what only curves and matrices show is not computed */
    int doublings;    /* of the request */
    int threads;      /* of the loop over elements in every cell; 0, 1: one */
    int unfinished;   /* cells that an interrupted run left; series that need them are gone */
    int partial;      /* 1: nobody interrupted it, they are of batches that are missing */
    int points, seriess;
    sweep_point *point;
    series *series;
} sweep;

/* Who follows a run while it goes on: both are asked in the process that runs it, between two
 * results. */
typedef struct sweep_follower {
    void *context;
    /* 1: the finest mesh of this series, whose cells are all done, is run again for its noise
     * (noise.h). NULL: none is. */
    int (*doubts)(void *context, const sweep *, int series_index);
    /* Told of every series once, in their order, when it and all before it are done and their noise
     * is measured; what it fails with ends the run. An interrupted run takes out the series that
     * are not done: their places are those of the next ones. NULL: nobody is told. */
    status (*whole)(void *context, const sweep *, int series_index, fault *);
} sweep_follower;

typedef struct sweep_request {
    const char *select; /* expression over "case/point/formulation/quantity", or NULL */
    int jobs;           /* processes, >= 1 */
    int whole_only;     /* of the sweep */
    int share;      /* 1: cells that are known to have the same answers are solved once: they have
              the same times, too */
    int time_limit; /* [s] of one cell, measured by its process and from outside; 0: none */
    int together;   /* 1: a worker that somebody else kills (SIGKILL) takes this process along: what
                       it has is not to be taken for an answer. 0: its cell has crashed */
    int interruptible; /* 1: who asks to end (Ctrl-C) ends the run, and what is finished is kept */
    int stop;          /* likewise once this descriptor can be read; 0: none */
    const case_type *const *cases; /* NULL-terminated; NULL: all that there are */
    int doublings;    /* so many meshes beyond the scene's finest, each of twice the elements */
    int formulations; /* restrict to these, or 0: all */
    const formulation *formulation;
    int named; /* 1: these were asked for by name: they affect the exit status, also where the
                  project has not accepted them yet */
    /* relative, in the place of those of the cases: who is within it passes; 0: those of the cases
     */
    double tolerance;
    /* most states of a path whose centre lines are kept, of the finest mesh at the defaults; 0:
     * none */
    int shapes;
    const sweep_follower *follower; /* NULL: none */
    FILE *progress;                 /* NULL: quiet */
    const char *things;             /* what the cells are called there; NULL: cells */
} sweep_request;

/* What a selection is asked about: case/parameters/formulation/quantity. */
enum { SWEEP_TEXT = PARAMETERS_TEXT + FORMULATION_KEY + 2 * FAULT_TEXT };
void sweep_text(const sweep_point *, const formulation *, const char *quantity,
                char text[SWEEP_TEXT]);
/* Does the sweep's selection hold for a quantity? */
int sweep_selects(const sweep *s, const sweep_point *p, const formulation *chosen,
                  const char *quantity);

/* Do the verdicts of a series count? Those of formulations that are accepted, that somebody named
 * or loaded, and of other programs where that was asked. */
int sweep_gates(const sweep *, const series *);
/* What running one mesh of a series means. */
cell_request sweep_cell(const sweep *s, int series_index, int mesh);
int sweep_cells(const sweep *s); /* that are run here */
void sweep_series_free(series *);
void sweep_free(sweep *s);

#endif
