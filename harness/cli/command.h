/* What a command line asks for: its options as one record, and how they are read. */
#ifndef BEAMWORK_COMMAND_H
#define BEAMWORK_COMMAND_H

#include <argp.h>

#include "cases/format/scene_file.h"
#include "harness/formulations/formulation.h"
#include "harness/formulations/formulations.h"

enum {
    EXIT_AS_EXPECTED = 0,
    EXIT_DIFFERS = 1,
    EXIT_REFUSED = 2,
    EXIT_NOTHING = 3,
    EXIT_FAULT = 4,
    EXIT_INTERRUPTED = 5 /* or parts are missing */
};

enum { COMMAND_MAX_CASES = 64, COMMAND_MAX_FORMULATIONS = 64, COMMAND_MAX_MESHES = SCENE_MESHES };

/* What the verbs' options have in common. */
typedef struct command_request {
    const char *case_name, *second; /* arguments; a verb that takes two lists the key '2', ... */
    const char *cases[COMMAND_MAX_CASES]; /* ... one that takes several cases '+' */
    int most_arguments, case_count;
    double parameter[CASE_MAX_PARAMETERS];
    const char *assignment[CASE_MAX_PARAMETERS];
    int assignments;
    const char *element[FORMULATIONS_MOST_LOADED]; /* of --element */
    int elements;
    const char *named_formulation[COMMAND_MAX_FORMULATIONS]; /* as -f says them */
    int named_formulations;
    formulation formulation[COMMAND_MAX_FORMULATIONS];
    int formulations;
    int mesh[COMMAND_MAX_MESHES], meshes;
    const char *format, *output, *json, *junit, *markdown, *propose, *truths, *select, *threshold,
        *against, *error;
    const char *vary[CASE_MAX_PARAMETERS]; /* NAME=A..B/N ...: what a sweep is over */
    int varies, derive;         /* derive: 1: truths are solved for where none is stored */
    const char *design;         /* of its points; NULL: a grid */
    long points, seed;          /* of a design that is no grid; seed -1: not given */
    const char *follow;         /* NAME=A..B/N: modes over a parameter */
    const char *matrices;       /* folder for the matrices of all states */
    const char *ends, *restart; /* files: where motions stop is kept, and where they go on from */
    int jobs, keep_all, steps;
    int doublings;  /* of the finest mesh */
    int threads;    /* of the loop over elements */
    int dense;      /* 1: the dense reference is timed too */
    int time_limit; /* [s] of a cell; 0: none */
    int shapes;     /* states of a path whose shapes are stored; 0: none */
    char given[32]; /* keys of the options with one value that were given */
    int given_count;
    const char *scene_path[COMMAND_MAX_CASES]; /* --scene: in the place of a case */
    int scene_count, most_scenes;
    int built_in;      /* 1: the built-in cases beside --scene */
    scene_file *scene; /* what was read from the one; case_input_close frees it */
    int refusal;       /* exit code where there is no case */
    int reads_files;   /* 1: the arguments are files that are read */
    const char *beside[COMMAND_MAX_CASES]; /* stored imports: contestants of a run */
    int beside_count;
    const char *own_truths[COMMAND_MAX_CASES]; /* tables beside the packed truths */
    const char *findings[COMMAND_MAX_CASES];   /* tables beside the ledger */
    int own_truths_count, findings_count;
    int takes_tables;         /* 1: --truths may name tables too; the verb lists the key '.' */
    const char *map;          /* of columns without a header */
    int gate;                 /* 1: their verdicts count */
    int exit_zero;            /* 1: verdicts do not change the exit status */
    const char *tolerance;    /* in the place of those of the cases */
    const char *former;       /* results that this run may not be worse than */
    const char *to;           /* program that a deck is for */
    int schema, keys;         /* 1: describe the keys of scene files as JSON Schema, as a list */
    const char *shard, *into; /* K/N of the work, into which folder */
    int plan;                 /* how long so many shards take; 0: not asked */
    const char *from[COMMAND_MAX_CASES]; /* folders with batches, taken instead of computing */
    int from_count, partial;             /* 1: what is missing is left out */
    int hash;                            /* 1: of stored runs */
    const char *integrators, *step_lengths, *tolerances; /* lists of a judged motion */
    const char *expected; /* table of verdicts, in the place of a case */
    int no_errors;        /* 1: without a reference */
    int verbose, quiet;   /* 1: every limit, only what is unexpected */
    double plant;         /* share of its time that is added to every run of the other */
} command_request;

/* Options shared by the verbs; a verb lists the keys it takes, and '+' when it takes several cases.
 * Errors are printed and end the program with EXIT_REFUSED. */
void command_parse(const char *verb, const char *arguments_doc, const char *doc, const char *keys,
                   int count, char **arguments, command_request *out);
/* What a verb does with its request; its exit code. */
typedef int command_answer(command_request *r);
/* command_parse, the answer, case_input_close. */
int command_run(const char *verb, const char *arguments_doc, const char *doc, const char *keys,
                int count, char **arguments, command_answer *answer);

#endif
