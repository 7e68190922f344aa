#include "harness/cli/spread.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/command.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"

static void begin(void *group, command_line *l)
{
    ((shard_options *)group)->line = l;
}

status spread_asked(const shard_options *r, int *asked, fault *f)
{
    char folder[2 * FAULT_TEXT];
    int index, count, first = 0;
    const int writes = given_next(r->line, OPTION_OUTPUT, &first) != NULL;
    *asked = r->into != NULL || r->shard != NULL || r->from.count > 0;
    if (r->from.count > 0 && (r->into != NULL || r->shard != NULL))
        return fault_set(f, STATUS_REFUSED, "--from takes batches, --into computes them: give one");
    if (r->shard != NULL && r->into == NULL)
        return fault_set(f, STATUS_REFUSED, "--shard %.40s: into which folder? Give --into FOLDER",
                         r->shard);
    if (r->partial && r->from.count == 0)
        return fault_set(f, STATUS_REFUSED, "--partial is of --from, and of 'beamwork merge'");
    if (r->into == NULL || !writes)
        return r->shard != NULL ? shard_parse(r->shard, &index, &count, f) : STATUS_OK;
    words_quoted(r->into, folder, sizeof folder);
    return fault_set(f, STATUS_REFUSED,
                     "--into writes batches; results are written by 'beamwork merge %.100s -o "
                     "FILE': leave other outputs away",
                     folder);
}

/* What became of the shard, in one line. */
static int tell_shard(const shard_options *r, const shard_request *q, const shard_outcome *o)
{
    const int left = o->mine - o->before - o->done;
    if (left > 0) {
        fprintf(
            stderr, "beamwork: %s: %d of %d batches of shard %d/%d are missing; start it again\n",
            o->interrupted ? "interrupted" : "incomplete", left, o->mine, q->index + 1, q->count);
        return EXIT_INTERRUPTED;
    }
    if (!r->quiet)
        printf("shard %d/%d: %d %s in %s, %d computed now (%.3g s)\n", q->index + 1, q->count,
               o->mine, o->mine == 1 ? "batch" : "batches", r->into, o->done, o->seconds);
    return EXIT_AS_EXPECTED;
}

static status compute(const shard_options *r, const shard_work *w, spread_end *out, fault *f)
{
    shard_request q = {.count = 1,
                       .into = r->into,
                       .jobs = r->jobs,
                       .progress = isatty(STDERR_FILENO) && !r->quiet ? stderr : NULL,
                       .tell = stderr};
    shard_outcome done;
    if (r->shard != NULL)
        TRY(shard_parse(r->shard, &q.index, &q.count, f));
    out->ended = 1;
    TRY(shard_run(w, &q, &done, f));
    out->code = tell_shard(r, &q, &done);
    return output_flush(f);
}

/* All kinds that there are. */
static void name_processors(const stock *s, spread_end *out)
{
    size_t at = 0;
    for (int i = 0; i < s->kinds && at < sizeof out->processor; i++)
        at += (size_t)snprintf(out->processor + at, sizeof out->processor - at, "%s%s (%s)",
                               i > 0 ? "; " : "", s->kind[i].node.processor, s->kind[i].node.host);
}

environment spread_environment(const spread_end *end, int threads)
{
    environment e = environment_now(threads);
    if (end->processor[0] != '\0')
        memcpy(e.processor, end->processor, sizeof e.processor);
    return e;
}

static status take(const shard_options *r, const shard_work *w, const stock *s, spread_end *out,
                   fault *f)
{
    char missing[600];
    stock_missing(s, w, missing, sizeof missing);
    if (s->there < s->batches) {
        fprintf(stderr, "beamwork: incomplete: %s%s\n", missing,
                r->partial ? "" : "; compute them, or look at the rest with --partial");
        out->code = EXIT_INTERRUPTED;
        out->ended = !r->partial;
        if (out->ended)
            return STATUS_OK;
    }
    stock_tell_kinds(s, stderr);
    name_processors(s, out);
    for (int i = 0; i < s->batches; i++)
        out->taken[i] = s->where[i] >= 0;
    return merge_take(w, s, f);
}

static status merge(const shard_options *r, const shard_work *w, spread_end *out, fault *f)
{
    stock s = {0};
    out->batches = w->batches;
    out->taken = calloc((size_t)w->batches + 1, 1);
    if (out->taken == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for batches");
    status outcome = stock_take(w, r->from.text, r->from.count, NULL, stderr, &s, f);
    if (outcome == STATUS_OK)
        outcome = take(r, w, &s, out, f);
    stock_free(&s);
    return outcome;
}

status spread_work(const shard_options *r, const shard_work *w, spread_end *out, fault *f)
{
    return r->from.count > 0 ? merge(r, w, out, f) : compute(r, w, out, f);
}

void spread_free(spread_end *out)
{
    free(out->taken);
    out->taken = NULL;
}

static const verb_option shards[] = {
    {"shard", 0, "K/N",
     "compute the K-th of N shards only, each batch into a file below --into; a restart computes "
     "only "
     "missing batches",
     .member = offsetof(shard_options, shard), .traits = OPTION_ASIDE},
    {"into", 0, "FOLDER", "folder of the batches of --shard (without it: of all); it is created",
     .member = offsetof(shard_options, into), .traits = OPTION_ASIDE},
    {"from", 0, "FOLDER",
     "take the batches that are there instead of computing, as 'beamwork merge' does; may be "
     "repeated",
     .member = offsetof(shard_options, from), .traits = OPTION_REPEATS | OPTION_ASIDE},
    {"partial", 0, NULL, "continue without the batches that are missing",
     .member = offsetof(shard_options, partial), .traits = OPTION_ASIDE},
    {0}};
const option_group options_shards = {shards, begin, NULL, NULL};
