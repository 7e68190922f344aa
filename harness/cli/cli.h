/* The verbs of the command line. Each returns an exit code. */
#ifndef BEAMWORK_CLI_H
#define BEAMWORK_CLI_H

#include <argp.h>

#include "harness/catalogue/formulation.h"
#include "harness/scene_file/scene_file.h"
#include "harness/truth/truths.h"

enum {
    EXIT_AS_EXPECTED = 0,
    EXIT_DIFFERS = 1,
    EXIT_REFUSED = 2,
    EXIT_NOTHING = 3,
    EXIT_FAULT = 4,
    EXIT_INTERRUPTED = 5
};

enum { CLI_MAX_CASES = 64, CLI_MAX_FORMULATIONS = 64, CLI_MAX_MESHES = SCENE_MESHES };

/* What the verbs' options have in common. */
typedef struct cli_request {
    const char *case_name, *second;   /* arguments; a verb that takes two lists the key '2', ... */
    const char *cases[CLI_MAX_CASES]; /* ... one that takes several cases '+' */
    int most_arguments, case_count;
    double parameter[CASE_MAX_PARAMETERS];
    const char *assignment[CASE_MAX_PARAMETERS];
    int assignments;
    formulation formulation[CLI_MAX_FORMULATIONS];
    int formulations;
    int mesh[CLI_MAX_MESHES], meshes;
    const char *format, *output, *json, *junit, *markdown, *truths, *select, *threshold, *against;
    const char *follow;   /* NAME=A..B/N: modes over a parameter */
    const char *matrices; /* folder for the matrices of all states */
    int jobs, keep_all, steps;
    int doublings;  /* of the finest mesh */
    int threads;    /* of the loop over elements */
    int dense;      /* 1: the dense reference is timed too */
    int time_limit; /* [s] of a cell; 0: none */
    int shapes;     /* states of a path whose shapes are stored; 0: none */
    char given[32]; /* keys of the options with one value that were given */
    int given_count;
    const char *scene_path[CLI_MAX_CASES]; /* --scene: in the place of a case */
    int scene_count, most_scenes;
    int built_in;                      /* 1: the built-in cases beside --scene */
    scene_file *scene;                 /* what was read from the one; cli_close frees it */
    int refusal;                       /* exit code where there is no case */
    int reads_files;                   /* 1: the arguments are files that are read */
    const char *beside[CLI_MAX_CASES]; /* stored imports: contestants of a run */
    int beside_count;
    const char *map;  /* of columns without a header */
    int gate;         /* 1: their verdicts count */
    const char *to;   /* program that a deck is for */
    int schema, keys; /* 1: describe the keys of scene files as JSON Schema, as a list */
    double plant;     /* share of its time that is added to every run of the other */
} cli_request;

typedef int cli_verb(int count, char **arguments);
cli_verb cli_list, cli_solve, cli_verify, cli_converge, cli_bench, cli_stress, cli_compare,
    cli_truth, cli_schema, cli_scene, cli_import, cli_export;

/* Options shared by the verbs; a verb lists the keys it takes, and '+' when it takes several cases.
 * Errors are printed and end the program with EXIT_REFUSED. */
void cli_parse(const char *verb, const char *arguments_doc, const char *doc, const char *keys,
               int count, char **arguments, cli_request *out);
/* The case of the request with its parameters, or NULL after a message. */
const case_type *cli_case(cli_request *r);
/* Frees what cli_case has read. */
void cli_close(cli_request *r);
/* What a verb does with its request; its exit code. */
typedef int cli_answer(cli_request *r);
/* cli_parse, the answer, cli_close. */
int cli_run(const char *verb, const char *arguments_doc, const char *doc, const char *keys,
            int count, char **arguments, cli_answer *answer);
/* The case of --scene FILE, or NULL after messages: all its mistakes. */
const case_type *cli_scene_case(cli_request *r);
/* Reads one scene file; EXIT_AS_EXPECTED, or an exit code after messages. */
int cli_scene_read(const cli_request *r, const char *path, scene_file **out);
/* Truths of the run: those stored, or, of a scene file, its own at the parameters of the request.
 */
status cli_truths_read(const cli_request *r, truths *t, fault *f);
/* Every output can be written and is a file of its own, and none is an input: looked at before the
 * work begins. whole_file: -o is HDF5. truths_path: NULL where no truths are read. */
status cli_check_files(const cli_request *r, int whole_file, const char *truths_path, fault *f);
/* The same of a further input, alone. */
status cli_check_input(const cli_request *r, const char *path, fault *f);
/* Two contestants in alternation (bench --against). */
int cli_against(cli_request *r);
/* Default place of the packed truths: BEAMWORK_TRUTHS, or truths.h5 beside the program. */
const char *cli_truths_path(const cli_request *r);
/* At the end of the program: the exit code, or EXIT_FAULT when standard output could not be
 * written. */
int cli_finish(int code);
/* One line on stderr; the exit code that belongs to a status. */
int cli_fail(status s, const char *text);
/* EXIT_AS_EXPECTED, or cli_fail with what is wrong. */
int cli_exit(status s, const fault *f);

#endif
