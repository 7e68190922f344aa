/* bench --against: one cell in alternation with another formulation, or with the same cell of
 * another program. */
#ifndef BEAMWORK_CONTEST_H
#define BEAMWORK_CONTEST_H

#include <jansson.h>

#include "harness/cli/case_input.h"
#include "harness/cli/named.h"
#include "harness/experiments/experiments.h"
#include "harness/records/records.h"

typedef struct bench_options {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    truths_options truths;
    solver_options solver;
    const char *select, *output, *format, *error, *against;
    int jobs;
    int dense; /* 1: the dense reference is timed too */
    int plant; /* percentage of its time that is added to every run of the other */
} bench_options;

/* The exit code. */
int contest_run(bench_options *r);

enum { CONTESTANT_ARGUMENTS = 12 + 2 * CASE_MAX_PARAMETERS };

typedef struct contestant {
    char name[FORMULATION_KEY + 512];
    cell_request request;
    const char *program;                        /* NULL: in this process */
    const char *argument[CONTESTANT_ARGUMENTS]; /* of the program, NULL-terminated */
    char elements[16];                          /* one of them */
    int repeats;                                /* in one lap */
    double plant;                               /* share of its time added to every lap */
    int counts;
    const schema_field *counted[SCHEMA_MOST_FIELDS]; /* size and work: what a cell counts */
    double count[SCHEMA_MOST_FIELDS];
} contestant;

/* What stands for a missing -f or -n. */
defaults contestant_defaults(bench_options *r, const case_type *type);
/* A cell of the scene, which it keeps a pointer to. */
void contestant_here(contestant *, const bench_options *r, const scene *s,
                     const formulation *chosen, int elements);
/* The one cell of the request, by another program. It points to itself: it is not copied. */
void contestant_elsewhere(contestant *, const bench_options *r, const char *program);
/* In alternation, on one processor, for a few seconds; counts what the cells count. */
status contestant_compete(contestant *a, contestant *b, contest_clock *out, fault *f);
/* Both times, which is faster, and how their work differs; the same as JSON, which the caller owns.
 */
void contestant_show(const contestant *a, const contestant *b, const contest_clock *v);
json_t *contestant_json(const contestant *a, const contestant *b, const contest_clock *v);
/* A line for each of them whose times rank nothing, and why. */
void contestant_unranked(const contestant *a, const contestant *b);

#endif
