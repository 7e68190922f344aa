#include <stdio.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

typedef struct compare_request {
    const char *output, *select, *threshold, *experiment;
    int hash;
} compare_request;

/* Exit statuses, as for diff. */
enum { SAME = 0, DIFFERS = 1, TROUBLE = 2 };

static int trouble(const fault *f)
{
    message_fail(STATUS_FAULT, f->text);
    return TROUBLE;
}

static status write_table(const char *path, const stored_results *r, fault *f)
{
    output file;
    TRY(output_open(path, &file, f));
    results_table_write(file.stream, r);
    return output_close(&file, f);
}

static void print_sums(const comparison *c)
{
    printf("%d %s in both:", c->pairs, c->whole ? "runs" : "series");
    for (int k = 0; k < COMPARISON_KINDS; k++)
        printf("%s %d %s", k > 0 ? "," : "", c->count[k], comparison_kind_names[k]);
    if (c->swept) {
        printf("\ncost: %.4g s -> %.4g s\n", c->cost[0], c->cost[1]);
        return;
    }
    printf("\nwork:");
    for (int k = 0; k < RESULTS_WORKS; k++)
        printf("%s %s %.0f -> %.0f", k > 0 ? "," : "", results_work_names[k], c->work[0][k],
               c->work[1][k]);
    putchar('\n');
}

static void print_left(const command_line *l, const stored_results *run[2], const comparison *c)
{
    const char *const path[] = {l->argument[0], l->argument[1]};
    for (int i = 0; i < 2; i++) {
        if (c->outside[i] > 0)
            printf("%d series of %s %s outside the selection of %s\n", c->outside[i], path[i],
                   c->outside[i] == 1 ? "is" : "are", path[1 - i]);
        if (c->fresh[i] == 0)
            continue;
        printf("%d series of new formulations, which do not affect the exit status, %s only in %s:",
               c->fresh[i], c->fresh[i] == 1 ? "is" : "are", path[i]);
        for (const char *at = run[i]->part.fresh; *at != '\0'; at += *at == '\n') {
            printf(" %.*s", (int)strcspn(at, "\n"), at);
            at += strcspn(at, "\n");
        }
        putchar('\n');
    }
}

static void print_partial(const comparison *c)
{
    if (c->partial > 0)
        printf("%d series %s compared only by limits, because some quantities were not computed\n",
               c->partial, c->partial == 1 ? "is" : "are");
}

static void meet(const char *selection, const stored_results *r, select_words *words)
{
    for (int i = 0; i < r->cells; i++)
        select_meet(selection, r->cell[i].name, words);
    for (int i = 0; i < r->seriess; i++)
        select_meet(selection, r->series[i].name, words);
}

static int compare(const command_line *l, const compare_request *r, const stored_results *before,
                   const stored_results *after, const comparison_limits *limits, fault *f)
{
    comparison c;
    comparison_run(stdout, before, after, limits, r->select, &c);
    print_sums(&c);
    print_left(l, (const stored_results *[]){before, after}, &c);
    print_partial(&c);
    if (output_flush(f) != STATUS_OK)
        return trouble(f);
    if (c.pairs > 0)
        return comparison_differs(&c) ? DIFFERS : SAME;
    fault_set(f, STATUS_FAULT,
              "nothing was compared, because %.80s and %.80s have no %s%s in common; give results "
              "of the same cases and formulations%s",
              l->argument[0], l->argument[1], r->select != NULL ? "selected " : "",
              c.whole ? "run" : "series", r->select != NULL ? ", or change -k" : "");
    return trouble(f);
}

static status check_sweeps(const command_line *l, const stored_results *before,
                           const stored_results *after, fault *f)
{
    if (l->argument[1] == NULL && before->swept)
        return fault_set(f, STATUS_REFUSED,
                         "%.80s contains a sweep, for which there is no short table; to write its "
                         "values, repeat the sweep with --format csv -o FILE.csv",
                         l->argument[0]);
    if (l->argument[1] == NULL || before->swept == after->swept)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%.80s contains a sweep, but %.80s does not; compare two sweeps or two runs "
                     "of verify (add --experiment sweep if a file contains both)",
                     before->swept ? l->argument[0] : l->argument[1],
                     before->swept ? l->argument[1] : l->argument[0]);
}

static status read_runs(const command_line *l, const compare_request *r, comparison_limits *limits,
                        stored_results *before, stored_results *after, fault *f)
{
    select_words words;
    if (r->threshold != NULL)
        TRY(comparison_limits_parse(r->threshold, limits, f));
    TRY(select_begin(r->select, &words, f));
    TRY(files_check(l, 0, NULL, f));
    TRY(results_read_any(l->argument[0], r->experiment, before, f));
    if (l->argument[1] != NULL)
        TRY(results_read_any(l->argument[1], r->experiment, after, f));
    TRY(check_sweeps(l, before, after, f));
    meet(r->select, before, &words);
    meet(r->select, after, &words);
    TRY(select_all_met(r->select, &words, f));
    return l->argument[1] == NULL ? write_table(r->output, before, f) : STATUS_OK;
}

/* Prints one line for each run, with the hash of the run. Returns DIFFERS if two runs have
 * different hashes, and TROUBLE after a failure. */
static int print_hashes(const command_line *l, const compare_request *r)
{
    results_hash h[2] = {{.values = 0}};
    fault f = {""};
    if (r->output != NULL || r->threshold != NULL || r->select != NULL || r->experiment != NULL)
        return message_fail(
            STATUS_REFUSED,
            "--hash applies to whole files; remove -o, -k, --threshold and --experiment");
    for (int i = 0; i < l->arguments; i++) {
        if (results_hash_of(l->argument[i], &h[i], &f) != STATUS_OK)
            return trouble(&f);
        printf("%s %ld %s\n", h[i].text, h[i].values, l->argument[i]);
    }
    if (output_flush(&f) != STATUS_OK)
        return trouble(&f);
    return l->arguments == 2 && strcmp(h[0].text, h[1].text) != 0 ? DIFFERS : SAME;
}

static int answer(const command_line *l, void *request)
{
    const compare_request *r = request;
    comparison_limits limits = comparison_limits_default;
    stored_results before = {0}, after = {0};
    fault f = {""};
    if (r->hash && l->arguments > 0)
        return print_hashes(l, r);
    if (l->argument[0] == NULL || (l->argument[1] == NULL) != (r->output != NULL))
        return message_fail(STATUS_REFUSED,
                            "compare requires two results files, such as 'beamwork compare old.h5 "
                            "new.h5', or one results file and -o FILE.csv for its short table");
    const status outcome = read_runs(l, r, &limits, &before, &after, &f);
    int code = SAME;
    if (outcome != STATUS_OK)
        code = trouble(&f);
    else if (l->argument[1] != NULL)
        code = compare(l, r, &before, &after, &limits, &f);
    results_free(&before);
    results_free(&after);
    return code;
}

#define IN(at) .member = offsetof(compare_request, at)
static const verb_option own[] = {
    {"threshold", 0, "NAME=R[,NAME=R]",
     "smallest changes that are reported (default error=0.01,floor=1e-8,work=0.02). error: of an "
     "error, relative to the error; floor: of a value, relative to its reference value or, without "
     "one, to the value; work: of a work count or cost, relative to it",
     IN(threshold)},
    {"experiment", 0, "NAME",
     "experiment to compare if a file contains several: verify, bench or sweep (default: the first "
     "of these in the file)",
     IN(experiment)},
    {"hash", 0, NULL,
     "print one line for each run: hash of its values, number of values, name of the file",
     IN(hash)},
    {0}};
static const verb_group shared[] = {SHARED(output, output), SHARED(select, select), {NULL, 0}};
const verb verb_compare = {
    "compare",
    "OLD [NEW]",
    "compares two stored runs: changes for better or worse",
    "Compares errors and work counts of two runs stored by 'verify -o' (HDF5), run by run. If one "
    "of them is a short table, mesh series and the limits at the default parameters are compared. "
    "Two files of 'sweep -o' are compared at equal points: errors, values, reference values (lines "
    "'.../reference'), statuses and costs. Points, formulations and meshes of only one file are "
    "listed. Results that only one run requested (verify -k, -f, --scene) and new formulations are "
    "counted, but are not reported as changes. With OLD alone, -o writes its short table. --hash "
    "prints the SHA-256 of all values, without times, machines and versions; runs with equal "
    "hashes have equal results. Exit status: 0 no change above the thresholds, 1 a result is "
    "better, worse, changed, missing or new, 2 an error (file, command line, nothing in common).",
    "beamwork compare old.h5 new.h5\n"
    "beamwork compare old_sweep.h5 new_sweep.h5\n"
    "beamwork compare harness/baseline.csv build/results.h5 --threshold error=0.1",
    shared,
    own,
    sizeof(compare_request),
    .place = VERB_EVALUATE + 70,
    .answer = answer};
