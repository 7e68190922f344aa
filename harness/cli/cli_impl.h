/* The inside of cli/. */
#ifndef BEAMWORK_CLI_IMPL_H
#define BEAMWORK_CLI_IMPL_H

#include <jansson.h>
#include <stdio.h>

#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

/* Cells as bytes of a batch, and what of them must be the same when they are computed again. */

/* 1: its cells are run here. */
int cells_runs(const sweep *s, int series);
/* Cost of a series' cells, in evaluations of an element. */
double cells_expense(const sweep *s, int series);
/* Its cells, the noise of its finest mesh and its times, as far as they were measured. */
status cells_write(FILE *to, const sweep *s, int series, digest *content, fault *f);
status cells_read(FILE *from, sweep *s, int series, fault *f);
/* As they were planned: without results. */
void cells_forget(series *one);
/* Takes out the series that keep[seriess] has no 1 for; their cells are counted as unfinished. */
void cells_keep(sweep *s, const char keep[]);

/* bench --against: one cell in alternation with another formulation, or with the same cell of
 * another program. */

typedef struct bench_options {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    truths_options truths;
    solver_options solver;
    const char *select, *output, *format, *error, *against;
    int jobs;
    int dense;    /* 1: the dense reference is timed too */
    int slowdown; /* percentage of its time that is added to every run of the other */
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
    double slowdown;                            /* share of its time added to every lap */
    int counts;
    const schema_field *counted[SCHEMA_MOST_FIELDS]; /* size and work: what a cell counts */
    double count[SCHEMA_MOST_FIELDS];
} contestant;

/* Defaults for a missing -f or -n. */
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

/* The pages of the manual, from the tables that the program itself works with. */

/* A line of the program's help. */
typedef struct manual_row {
    const char *name, *text;
} manual_row;

/* Program's text in the manual. Rows end with a name of NULL. */
typedef struct manual_program {
    const char *summary, *question; /* one line each */
    const verb *const *verbs;       /* all, and NULL */
    const manual_row *examples, *statuses;
    const char *of_compare; /* exit status of the verb that is as diff */
} manual_program;

/* Structure of a result file. */
typedef struct results_record {
    char place[64]; /* before the name of its table */
    const record_type *type;
} results_record;

/* Number i, of the verbs too, or a type of NULL after the last one. */
results_record results_record_at(const verb *const *verbs, int i);
extern const char *const results_about[]; /* paragraphs, ending with NULL */
/* "text *", "int", ...; the unit as it is shown; what it is, with its words. */
typedef struct results_field {
    const char *kind, *unit;
    char text[1000];
} results_field;
results_field results_field_of(const schema_field *f);

/* beamwork(1). */
void manual_write_program(FILE *to, const manual_program *p);
/* beamwork-VERB(1). */
void manual_write_verb(FILE *to, const verb *v);
/* beamwork-scene-file(5): what may stand in a scene file. */
void manual_write_scene(FILE *to);
/* beamwork-results(5): what a result file consists of. */
void manual_write_results(FILE *to, const verb *const *verbs);

/* Pages as mdoc(7): what a text means is in macros, what it says in lines that no formatter
 * takes for one. */
/* Running text: lines of its words, each as it is written: hyphens, quotes and '^' can be copied.
 */
void roff_text(FILE *to, const char *text);
/* Behind a macro: one argument, a blank before it, whatever it says. */
void roff_argument(FILE *to, const char *text);
/* A line inside .Bd -literal. */
void roff_literal(FILE *to, const char *line, size_t length);
/* The head of a page: ".Dd" to ".Nd". name: "beamwork-solve"; about: one line. */
void roff_page(FILE *to, const char *name, int chapter, const char *about);
/* "See also": names with their sections, "beamwork 1 beamwork-scene 5". */
typedef struct roff_reference {
    const char *name;
    int section;
} roff_reference;
void roff_see(FILE *to, const roff_reference list[], int count);

/* Work of a verb that is computed as a shard, or taken from batches, as the command line asks. */

/* How it ended. */
typedef struct spread_end {
    int ended; /* 1: there is nothing to judge, and this is ... */
    int code;  /* ... the exit status */
    int batches;
    char *taken;         /* [batches] of a merge; spread_free releases it */
    char processor[128]; /* that the batches were computed on; empty: they were not merged */
} spread_end;

typedef struct shard_options {
    const command_line *line;
    int jobs;
    const char *shard, *into; /* K/N of the work, into which folder */
    text_list from;           /* folders with batches, taken instead of computing */
    int partial;              /* 1: missing cells are omitted */
    int quiet;
} shard_options;
extern const option_group options_shards; /* all but jobs and quiet */

/* 1: --into, --shard or --from were given. REFUSED: what does not go together. */
status spread_asked(const shard_options *, int *asked, fault *f);
/* Computes the shard and says what became of it, or takes the batches. */
status spread_work(const shard_options *, const shard_work *w, spread_end *out, fault *f);
/* Environment of a result: of this machine, or of that which computed the batches. */
environment spread_environment(const spread_end *, int threads);
void spread_free(spread_end *);

enum { IDENTITY_TEXT = 2000 };

typedef struct identity_texts {
    char build[400], request[IDENTITY_TEXT], plan[DIGEST_TEXT];
    char *origin; /* JSON; identity_free releases it */
} identity_texts;

/* Version, commit, and the digest of the program itself; the command line in words; a digest of
 * every file that answers depend on, to which the plan adds itself. FAULT: a file that cannot be
 * read. */
status identity_make(const command_line *, identity_texts *out, digest *plan, fault *f);
/* Points, formulations and meshes. */
void identity_add_sweep(digest *plan, const sweep *s);
/* Into a work that the texts outlive; no more is added to the plan. */
void identity_set(identity_texts *texts, const digest *plan, shard_work *w);
void identity_free(identity_texts *);

/* `verify` as a shard, or from batches: as the command line asks. */

/* Computes a shard of a planned sweep, or takes the cells of --from: with --partial, missing cells
 * are removed and counted as unfinished. A batch is consecutive series, with the cells that measure
 * their scatter. */
status verification_work_run(const shard_options *, const sweep_request *, truths *, sweep *,
                             spread_end *, fault *);

#endif
