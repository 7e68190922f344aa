#include "harness/experiments/verification.h"

#include <stdio.h>
#include <string.h>

#include "harness/experiments/certificate.h"
#include "harness/formulations/formulations.h"
#include "harness/numerics/numerics.h"
#include "harness/study/study.h"

typedef struct verification {
    truths *truths;
    judgement *judgement;
    const verification_reader *reader; /* NULL: none */
    int judged;                        /* series that are */
} verification;

static int doubts(void *context, const sweep *s, int series_index)
{
    const verification *v = context;
    return judgement_doubts(s, v->truths, series_index);
}

static const case_type *case_of(const sweep *s, int series_index)
{
    return s->point[s->series[series_index].point].type;
}

/* Hands over the case of a series, if none of it comes behind. */
static void hand_over(verification *v, const sweep *s, int series_index)
{
    const case_type *type = case_of(s, series_index);
    if (v->reader == NULL)
        return;
    for (int i = series_index + 1; i < s->seriess; i++)
        if (case_of(s, i) == type)
            return;
    v->reader->judged(v->reader->context, type);
}

/* Judges the series up to that one, all of whose points are done. */
static status judge_to(verification *v, const sweep *s, int end, fault *f)
{
    int of = -1;
    for (int i = v->judged; i < end; i++) {
        if (s->series[i].point != of)
            TRY(families_add_point(s, s->series[i].point, 1, v->truths, f));
        of = s->series[i].point;
        TRY(judgement_add(s, v->truths, i, v->judgement, f));
    }
    v->judged = end;
    return STATUS_OK;
}

/* Those of a point are judged together: where formulations agree depends on all of them. */
static status whole(void *context, const sweep *s, int series_index, fault *f)
{
    verification *v = context;
    const int here = s->series[series_index].point;
    if (v->judged < series_index && s->series[v->judged].point != here)
        TRY(judge_to(v, s, series_index, f)); /* the rest of that point was not run */
    if (series_index + 1 < s->seriess && s->series[series_index + 1].point == here)
        return STATUS_OK;
    TRY(judge_to(v, s, series_index + 1, f));
    hand_over(v, s, series_index);
    return STATUS_OK;
}

enum { MOST_OWN = 64 };

/* Formulations that somebody named or loaded, each once. */
static int find_own(const sweep *s, formulation out[MOST_OWN])
{
    int count = 0;
    for (int i = 0; i < s->seriess; i++) {
        const formulation *one = &s->series[i].formulation;
        int known = s->series[i].imported != NULL ||
                    !(s->named || formulations_is_loaded(one->type)) || count == MOST_OWN;
        for (int k = 0; k < count; k++)
            known |= strcmp(out[k].key, one->key) == 0;
        if (!known)
            out[count++] = *one;
    }
    return count;
}

static status add_breach(const certificate *c, judgement *out, fault *f)
{
    const claim *broken = certificate_broken(c);
    breach one;
    if (broken == NULL)
        return STATUS_OK;
    snprintf(one.formulation, sizeof one.formulation, "%s", c->chosen.key);
    snprintf(one.why, sizeof one.why, "%s: %.240s", broken->name, broken->sentence);
    return memory_append(&out->breach, &out->breaches, &one, sizeof one, "broken contracts", f);
}

/* They are held against the interface before anything is run: what they give is worth nothing if
 * they break it. */
static status hold_contracts(const sweep *s, int jobs, int time_limit, judgement *out, fault *f)
{
    formulation own[MOST_OWN];
    certificate *found = NULL;
    const certificate_request what = {.chosen = own,
                                      .count = find_own(s, own),
                                      .jobs = jobs,
                                      .time_limit = time_limit,
                                      .contract_only = 1};
    if (what.count == 0)
        return STATUS_OK;
    status outcome = certificate_find(&what, &found, f);
    for (int i = 0; i < what.count && outcome == STATUS_OK; i++)
        outcome = add_breach(&found[i], out, f);
    certificate_free(found, what.count);
    return outcome;
}

static status begin(verification *v, const sweep *s, int jobs, int time_limit, fault *f)
{
    memset(v->judgement, 0, sizeof *v->judgement);
    TRY(families_reserve(s, 1, v->truths, f));
    TRY(judgement_begin(s, v->truths, v->judgement, f));
    return hold_contracts(s, jobs, time_limit, v->judgement, f);
}

/* With the series that are not judged yet: of a point that an interrupted run did not end. */
static status end(verification *v, const sweep *s, int everything, fault *f)
{
    TRY(judge_to(v, s, s->seriess, f));
    judgement_end(s, v->truths, everything && s->unfinished == 0, v->judgement);
    return STATUS_OK;
}

status verification_run(const sweep_request *request, int everything,
                        const verification_reader *reader, truths *t, sweep *s, judgement *out,
                        fault *f)
{
    verification v = {.truths = t, .judgement = out, .reader = reader};
    const sweep_follower follower = {.context = &v, .doubts = doubts, .whole = whole};
    sweep_request followed = *request;
    followed.follower = &follower;
    TRY(begin(&v, s, request->jobs, request->time_limit, f));
    TRY(run_sweep(&followed, s, f));
    return end(&v, s, everything, f);
}

status verification_cells(const sweep_request *request, truths *t, sweep *s, fault *f)
{
    verification v = {.truths = t};
    const sweep_follower follower = {.context = &v, .doubts = doubts};
    sweep_request followed = *request;
    followed.follower = &follower;
    return run_sweep(&followed, s, f);
}

status verification_judge(const sweep_request *request, int everything, truths *t, const sweep *s,
                          judgement *out, fault *f)
{
    verification v = {.truths = t, .judgement = out};
    TRY(begin(&v, s, request->jobs, request->time_limit, f));
    return end(&v, s, everything, f);
}
