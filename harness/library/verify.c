#include <limits.h>

#include "harness/experiments/experiments.h"
#include "harness/library/call.h"
#include "harness/library/contestants.h"
#include "harness/library/known.h"
#include "harness/library/options.h"
#include "harness/library/source.h"
#include "harness/library/text.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

enum { TIME_LIMIT = 120 /* [s] of a cell */, LONGEST = 1000000, DOUBLINGS = 10, PICTURES = 5 };

/* What is asked, and what answers it; verify frees it. */
typedef struct verify_trial {
    const bw_scene *scene;
    const char *results;
    sweep_request request;
    const case_type *type[2];
    formulation formulation[CONTESTANTS_MOST];
    json_t *kept;
    const char *former_path; /* of results that this run may not be worse than; NULL: none */
    stored_results former;
    truths truths;
    sweep sweep;
    judgement judgement;
} verify_trial;

static status verify_read_truths(verify_trial *v, fault *f)
{
    if (v->scene == NULL)
        return known_read_all(&v->truths, f);
    const scene_file *file = source_file(v->scene->from);
    TRY(known_read(file == NULL ? source_case(v->scene->from) : NULL, &v->truths, f));
    return file != NULL ? scene_truths_add_all(file, &v->truths, f) : STATUS_OK;
}

static status read_former(verify_trial *v, fault *f)
{
    known_lock();
    const status outcome = results_read(v->former_path, &v->former, f);
    known_unlock();
    return outcome;
}

static status verify_prepare(verify_trial *v, const char *names, const char *options, fault *f)
{
    sweep_request *r = &v->request;
    const call_option table[] = {{"jobs", OPTION_WHOLE, &r->jobs, 1, WORKERS_MOST},
                                 {"time_limit", OPTION_WHOLE, &r->time_limit, 0, LONGEST},
                                 {"doublings", OPTION_WHOLE, &r->doublings, 0, DOUBLINGS},
                                 {"shapes", OPTION_WHOLE, &r->shapes, 0, PICTURES},
                                 {"stop", OPTION_FILE, &r->stop, 1, INT_MAX},
                                 {"tolerance", OPTION_SHARE, &r->tolerance, 0, 0},
                                 {"not_worse_than", OPTION_WORDS, &v->former_path, 0, 0},
                                 {.name = NULL}};
    file_place where;
    TRY(options_read(options, table, &v->kept, f));
    TRY(contestants_parse(names, v->formulation, &r->formulations, &r->named, f));
    r->formulation = v->formulation;
    if (v->scene != NULL) {
        v->type[0] = source_case(v->scene->from);
        r->cases = v->type;
    }
    if (v->former_path != NULL)
        TRY(read_former(v, f));
    if (v->results != NULL) {
        TRY(output_try(v->results, OUTPUT_WHOLE_FILE, &where, f));
        TRY(kept_check(v->results, f));
    }
    return verify_read_truths(v, f);
}

static status judge(verify_trial *v, fault *f)
{
    const sweep_request *r = &v->request;
    const int whole = r->select == NULL && r->formulations == 0 && v->scene == NULL;
    TRY(plan_sweep(r, &v->truths, &v->sweep, f));
    TRY(verification_run(r, whole, NULL, &v->truths, &v->sweep, &v->judgement, f));
    TRY(contestants_finished(&v->sweep, f));
    if (v->former_path == NULL)
        return STATUS_OK;
    known_lock();
    const status outcome =
        regressions_find(&v->former, v->former_path, &v->sweep, &v->judgement, f);
    known_unlock();
    return outcome;
}

static status keep(const verify_trial *v, const environment *e, fault *f)
{
    if (v->results == NULL)
        return STATUS_OK;
    known_lock();
    const status outcome = store_write(v->results, NULL, &v->sweep, &v->judgement, e, f);
    known_unlock();
    return outcome;
}

static status answer(verify_trial *v, char **json, fault *f)
{
    document_text t;
    TRY(judge(v, f));
    const environment e = environment_now(v->request.jobs);
    TRY(keep(v, &e, f));
    TRY(text_begin(&t, f));
    return text_end(&t, json_write_verdicts(t.to, &v->sweep, &v->judgement, &e, NULL, f), json, f);
}

static status verify(verify_trial *v, const char *names, const char *options, char **json, fault *f)
{
    if (json == NULL)
        return fault_set(f, STATUS_REFUSED, "bw_verify: give a place for the text");
    *json = NULL;
    status outcome = verify_prepare(v, names, options, f);
    if (outcome == STATUS_OK)
        outcome = answer(v, json, f);
    judgement_free(&v->judgement);
    results_free(&v->former);
    sweep_free(&v->sweep);
    truths_free(&v->truths);
    json_decref(v->kept);
    return outcome;
}

bw_status bw_verify(const bw_scene *from, const char *formulations, const char *select,
                    const char *options, const char *into, char **json, char **why)
{
    call c;
    call_begin(&c, why);
    verify_trial v = {
        .scene = from,
        .results = into,
        .request = {.select = select, .jobs = contestants_jobs(), .time_limit = TIME_LIMIT}};
    return call_end(&c, verify(&v, formulations, options, json, &c.fault));
}
