#include "harness/analysis/compliance_walk.h"

#include <stdlib.h>

#include "harness/analysis/compliance.h"
#include "harness/analysis/extract_path.h"
#include "harness/newton/newton.h"

typedef struct follower {
    int analysis;
    node_tangent tangent;
} follower;

struct compliance_walk {
    const scene_path *path;
    int count;
    follower of[];
};

static int follows(const analysis_context *c, int analysis, int path)
{
    const scene_analysis *a = &c->scene->analysis[analysis];
    return a->kind == SCENE_COMPLIANCE && a->follows == path && context_runs(c, analysis);
}

static status add(newton_run *n, int analysis, compliance_walk *w, fault *f)
{
    analysis_context *c = n->c;
    outcome_compliance *o = &c->outcomes[analysis].left.compliance;
    follower *of = &w->of[w->count++];
    of->analysis = analysis;
    TRY(tangent_alloc(c, scene_compliance_of(&c->scene->analysis[analysis]), n->condensed,
                      &of->tangent, f));
    if (of->tangent.border.count > 0 && n->condensed == NULL)
        TRY(newton_keep_driven(n, f));
    o->taken = calloc((size_t)w->path->stations + 1, sizeof *o->taken);
    return o->taken == NULL ? fault_set(f, STATUS_FAULT, "out of memory for a compliance")
                            : STATUS_OK;
}

status compliance_walk_begin(newton_run *n, int path, compliance_walk **out, fault *f)
{
    const scene *s = n->c->scene;
    int count = 0;
    *out = NULL;
    for (int i = 0; i < s->analyses; i++)
        count += follows(n->c, i, path);
    if (count == 0 || n->c->options->newton == NEWTON_DENSE || scene_rotates(&s->analysis[path]))
        return STATUS_OK;
    compliance_walk *w = calloc(1, sizeof *w + (size_t)count * sizeof w->of[0]);
    if (w == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a compliance");
    *out = w;
    w->path = &scene_walk_of(&s->analysis[path])->path;
    for (int i = 0; i < s->analyses; i++)
        if (follows(n->c, i, path))
            TRY(add(n, i, w, f));
    return STATUS_OK;
}

status compliance_walk_take(compliance_walk *w, const newton_run *n, int station, fault *f)
{
    analysis_context *c = n->c;
    /* the states of many elements are not kept for later */
    if (w == NULL || (n->condensed == NULL && !arrival_tangent_stands(&n->arrival)))
        return STATUS_OK;
    for (int i = 0; i < w->count; i++) {
        follower *of = &w->of[i];
        if (!extract_path_wants(c, of->analysis, w->path->stations, w->path->value, station))
            continue;
        station_matrices *out = &c->outcomes[of->analysis].left.compliance.taken[station];
        fault why = {""};
        const status outcome = compliance_take(c, of->analysis, n, &of->tangent, out, &why);
        if (outcome == STATUS_FAULT)
            return fault_set(f, outcome, "%s", why.text);
        out->known = outcome == STATUS_OK;
    }
    return STATUS_OK;
}

void compliance_walk_end(compliance_walk *w)
{
    for (int i = 0; w != NULL && i < w->count; i++)
        tangent_free(&w->of[i].tangent);
    free(w);
}
