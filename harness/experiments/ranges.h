/* A sweep over parameters: which points, formulations, meshes and quantities, and how it is cut
 * into batches. It depends on the request and the build only. */
#ifndef BEAMWORK_RANGES_H
#define BEAMWORK_RANGES_H

#include "cases/format/scene_file.h"
#include "cases/scene/omission.h"
#include "harness/experiments/design.h"
#include "harness/experiments/rows.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

enum { RANGES_FORMULATIONS = 64, RANGES_QUANTITIES = 64 };

/* What is asked for. */
typedef struct ranges_request {
    const case_type *type;
    const scene_file *file; /* that the case is read from; NULL: a built-in one */
    const double *base;     /* values of its parameters where they do not vary */
    int varies;
    const char *const *vary; /* [varies] as --vary says them */
    design_kind design;
    long points; /* of what is no grid */
    unsigned long seed;
    int formulations;
    const formulation *formulation; /* 0: every one that runs */
    int meshes;
    const int *mesh; /* 0: those of the scene */
    const char *select;
    double tolerance;     /* relative error */
    int time_limit;       /* [s] of a cell; 0: none */
    const char *derive;   /* program of reference/derive that solves for truths; NULL: none */
    const truths *truths; /* stored, of a built-in case; NULL: none */
} ranges_request;

typedef struct ranges_quantity {
    char name[SCENE_NAME], unit[SCENE_UNIT];
} ranges_quantity;

enum { RANGES_ASSUMED = 2048 };
typedef struct parameter_ranges {
    ranges_request request;
    double base[CASE_MAX_PARAMETERS];
    sweep_axis axis[CASE_MAX_PARAMETERS];
    design design;
    int formulations, meshes, quantities;
    formulation formulation[RANGES_FORMULATIONS];
    int mesh[SERIES_MAX_MESHES]; /* ascending */
    ranges_quantity quantity[RANGES_QUANTITIES];
    char left_out[FAULT_TEXT]; /* formulations that run at no point that was looked at, in words */
    char
        omitted[SCENE_OMISSION_WORDS]; /* physics that the scene leaves out, at the first of them */
    char assumed[RANGES_ASSUMED];      /* of its sections (harness/records/records.h), there */
    long points_in_batch;              /* but for the last one */
    int batches;
    double point_cost; /* [s] about, of all cells of a point */
} parameter_ranges;

/* Nothing is solved. REFUSED: the culprit and the remedy. ranges_free frees it, also after a
 * failure. The request must outlive it. */
status ranges_make(const ranges_request *request, parameter_ranges *out, fault *f);
void ranges_free(parameter_ranges *);
rows_shape ranges_shape(const parameter_ranges *);
/* Points of a batch: *first, and how many. */
int ranges_batch(const parameter_ranges *, int batch, long *first);

#endif
