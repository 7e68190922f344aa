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

/* What is asked, and what answers it; converge frees it. */
typedef struct study {
    const bw_scene *scene;
    double level;
    const char *select;
    json_t *kept;
    formulation formulation[CONTESTANTS_MOST];
    int formulations, mesh[SCENE_MESHES], meshes, jobs, stop;
    truths truths;
    sweep sweep;
} study;

static status read_truths(study *s, fault *f)
{
    const scene_file *file = source_file(s->scene->from);
    return file != NULL ? scene_truths_add(file, s->scene->parameter, &s->truths, f)
                        : known_read(source_case(s->scene->from), &s->truths, f);
}

static status prepare(study *s, const char *names, const char *meshes, const char *options,
                      fault *f)
{
    const call_option table[] = {{"error", OPTION_SHARE, &s->level, 0, 0},
                                 {"select", OPTION_WORDS, &s->select, 0, 0},
                                 {"jobs", OPTION_WHOLE, &s->jobs, 1, WORKERS_MOST},
                                 {"stop", OPTION_FILE, &s->stop, 1, INT_MAX},
                                 {.name = NULL}};
    TRY(options_read(options, table, &s->kept, f));
    TRY(contestants_parse(names, s->formulation, &s->formulations, NULL, f));
    if (s->formulations == 0)
        TRY(formulation_list_add("all", CONTESTANTS_MOST, s->formulation, &s->formulations, f));
    if (meshes != NULL)
        TRY(meshes_parse(meshes, SCENE_MESHES, s->mesh, &s->meshes, f));
    TRY(read_truths(s, f));
    TRY(plan_one(source_case(s->scene->from), s->scene->parameter, s->formulation, s->formulations,
                 s->mesh, s->meshes, &s->sweep, f));
    return narrow_to(&s->sweep, s->select, f);
}

static status write_study(study *s, char **json, fault *f)
{
    const sweep_request request = {.jobs = s->jobs, .stop = s->stop};
    document_text t;
    TRY(run_sweep(&request, &s->sweep, f));
    TRY(contestants_finished(&s->sweep, f));
    TRY(families_add_truths(&s->sweep, 0, &s->truths, f));
    TRY(text_begin(&t, f));
    return text_end(&t, json_convergence_write(t.to, &s->sweep, &s->truths, s->level, f), json, f);
}

static status converge(const bw_scene *from, const char *names, const char *meshes,
                       const char *options, char **json, fault *f)
{
    study s = {.scene = from, .level = REACH_LINE_LEVEL, .jobs = contestants_jobs()};
    if (json != NULL)
        *json = NULL;
    if (from == NULL || json == NULL)
        return fault_set(f, STATUS_REFUSED, "bw_converge: give a scene and a place for the text");
    status outcome = prepare(&s, names, meshes, options, f);
    if (outcome == STATUS_OK)
        outcome = write_study(&s, json, f);
    sweep_free(&s.sweep);
    truths_free(&s.truths);
    json_decref(s.kept);
    return outcome;
}

bw_status bw_converge(const bw_scene *from, const char *formulations, const char *meshes,
                      const char *options, char **json, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, converge(from, formulations, meshes, options, json, &c.fault));
}
