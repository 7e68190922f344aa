/* Internal declarations of cli/. */
#ifndef BEAMWORK_CLI_IMPL_H
#define BEAMWORK_CLI_IMPL_H

#include <jansson.h>
#include <stdio.h>

#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

/* Cells as the bytes of a batch. The part that enters the digest must be equal if the cells are
 * computed again. */

/* Writes the cells of a series and, if they were measured, the scatter on the finest mesh and the
 * times. The reproducible part is added to the digest. */
status cells_write(FILE *to, const sweep *s, int series, digest *content, fault *f);
status cells_read(FILE *from, sweep *s, int series, fault *f);
/* Resets the series to its planned state, without results. */
void cells_free_results(series *one);
/* Removes the series i for which keep[i] is 0; their cells count as unfinished. */
void cells_keep(sweep *s, const char keep[]);

/* bench --against: times two cells that run alternately. The second cell has another formulation or
 * another build of the program. */

typedef struct bench_options {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    truths_options truths;
    solver_options solver;
    const char *select, *output, *format, *error, *against;
    int jobs;
    int dense; /* 1: the published algorithm is also timed */
    /* slowdown: delay that is added to every run of the other cell, in percent of its time */
    int slowdown;
} bench_options;

/* Compares the two cells and returns the exit status. */
int bench_against_run(bench_options *r);

enum { CONTESTANT_ARGUMENTS = 12 + 2 * CASE_MAX_PARAMETERS };

typedef struct compared_run {
    char name[FORMULATION_KEY + 512];
    cell_request request;
    const char *program;                        /* NULL: in this process */
    const char *argument[CONTESTANT_ARGUMENTS]; /* arguments of the program, NULL-terminated */
    char elements[16];                          /* text for the argument of -n */
    int repeats;                                /* number of solutions in each lap */
    double slowdown; /* delay that is added to a lap, as a fraction of its time */
    int counts;
    const schema_field *counted[SCHEMA_MOST_FIELDS];
    double count[SCHEMA_MOST_FIELDS];
} compared_run;

/* Returns the request for the default choice of -f or -n. */
defaults compared_run_defaults(bench_options *r, const case_type *type);
/* Prepares a cell of the scene in this process. The result contains a pointer to the scene. */
void compared_run_here(compared_run *, const bench_options *r, const scene *s,
                       const formulation *chosen, int elements);
/* Prepares the cell of the request for another program. */
void compared_run_elsewhere(compared_run *, const bench_options *r, const char *program);
status compared_run_measure(compared_run *a, compared_run *b, against_times *out, fault *f);
/* compared_run_show prints both times, which cell is faster, and the difference of work.
 * compared_run_json returns these data as JSON, which the caller owns. */
void compared_run_show(const compared_run *a, const compared_run *b, const against_times *v);
json_t *compared_run_json(const compared_run *a, const compared_run *b, const against_times *v);
/* Prints a line for each cell whose times are not ranked, with the reason. */
void compared_run_unranked(const compared_run *a, const compared_run *b);

/* Pages of the manual, which are generated from tables of the program. */

typedef struct manual_row {
    const char *name, *text;
} manual_row;

/* Text about the program for the manual. Rows end with name NULL. */
typedef struct manual_program {
    const char *summary, *question;
    const verb *const *verbs; /* all verbs, NULL-terminated */
    const manual_row *examples, *statuses;
    const char *of_compare; /* exit statuses of `compare`, which are those of diff */
} manual_program;

typedef struct results_record {
    char place[64]; /* path that precedes the name of the table */
    const record_type *type;
} results_record;

/* Returns table number i, including tables of verbs. After the last table, the type of the result
 * is NULL. */
results_record results_record_at(const verb *const *verbs, int i);
extern const char *const results_about[]; /* paragraphs, NULL-terminated */
/* Type ("text *", "int", ...), displayed unit, and meaning of a field. */
typedef struct results_field {
    const char *kind, *unit;
    char text[1000];
} results_field;
results_field results_field_of(const schema_field *f);

/* Writes beamwork(1). */
void manual_write_program(FILE *to, const manual_program *p);
/* Writes beamwork-VERB(1). */
void manual_write_verb(FILE *to, const verb *v);
/* Writes beamwork-scene(5), the page on the keys of scene files. */
void manual_write_scene(FILE *to);
/* Writes beamwork-results(5), the page on the contents of results files. */
void manual_write_results(FILE *to, const verb *const *verbs);

/* Pages in mdoc(7). */
/* Writes running text in lines. The words do not change, so that hyphens, quotation marks and '^'
 * can be copied. */
void roff_text(FILE *to, const char *text);
/* References to other pages: names, each with its section, such as "beamwork 1 beamwork-scene
 * 5". */
typedef struct roff_reference {
    const char *name;
    int section;
} roff_reference;
void roff_see(FILE *to, const roff_reference list[], int count);

typedef struct spread_end {
    int ended;
    int code; /* exit status, if `ended` is 1 */
    int batches;
    char *taken; /* [batches] batches that a merge has read; spread_free frees this array */
    char processor[128];
} spread_end;

typedef struct shard_options {
    const command_line *line;
    int jobs;
    const char *shard, *into; /* K/N of the work, and folder for the batches */
    text_list from;           /* folders with batches, which are read instead of computed */
    int partial;              /* 1: missing cells are omitted */
    int quiet;
} shard_options;
extern const option_group options_shards; /* all options except jobs and quiet */

/* Sets *requested to 1 if --into, --shard or --from was given. REFUSED: the combination of options
 * is invalid. */
status shards_requested(const shard_options *, int *requested, fault *f);
status spread_work(const shard_options *, const shard_work *w, spread_end *out, fault *f);
void spread_free(spread_end *);

enum { IDENTITY_TEXT = 2000 };

typedef struct identity_texts {
    char build[400], request[IDENTITY_TEXT], plan[DIGEST_TEXT];
    char *origin; /* origin as JSON, which identity_free frees */
} identity_texts;

/* Collects the version, commit and digest of the program, the command line as text, and a digest of
 * every file that affects results. FAULT: a file cannot be read. */
status identity_make(const command_line *, identity_texts *out, digest *plan, fault *f);
void identity_add_sweep(digest *plan, const sweep *s);
/* Sets the members build, request, plan and origin of the work to these texts, which must outlive
 * it. Writes the digest of the plan to texts->plan. */
void identity_set(identity_texts *texts, const digest *plan, shard_work *w);
void identity_free(identity_texts *);

/* Computes a shard of a planned sweep, or reads the cells of --from. With --partial, missing cells
 * are removed and count as unfinished. */
status verification_work_run(const shard_options *, const sweep_request *, truths *, sweep *,
                             spread_end *, fault *);

#endif
