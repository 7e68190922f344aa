#include "harness/experiments/pace_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/pace_alone.h"
#include "harness/study/study.h"

enum {
    STATIONS_OF_ERROR = 20,
    USUAL_STEPS = 4,
    USUAL_TOLERANCES = 3,
    PARTS = 100 /* of a tolerance, from one to the next */
};
static const double usual_tolerance = 1e-4, same = 1e-9 /* of a step */;

static int motion_of(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            return i;
    return -1;
}

status pace_plan_usual(pace_plan_request *r, fault *f)
{
    scene s;
    status outcome = cell_scene(r->type, r->parameter, NULL, &s, f);
    const int analysis = outcome == STATUS_OK ? motion_of(&s) : -1;
    if (outcome == STATUS_OK && analysis < 0)
        outcome = fault_set(f, STATUS_REFUSED,
                            "%s is no motion in time; 'beamwork list' shows those that are",
                            r->type->name);
    if (outcome == STATUS_OK) {
        if (r->elements == 0)
            r->elements = s.meshes > 1 ? s.mesh[1] : 4;
        if (r->steps.count == 0 && r->tolerances.count == 0) {
            r->steps =
                pace_list_divided(2 * scene_motion_of(&s.analysis[analysis])->step, 2, USUAL_STEPS);
            r->tolerances = pace_list_divided(usual_tolerance, PARTS, USUAL_TOLERANCES);
        }
    }
    scene_free(&s);
    return outcome;
}

/* Instants that all steps of all runs meet, as far as they divide the first. */
static status stations_of(double spacing, double end, scene_path *out, fault *f)
{
    const int before = (int)ceil(end / spacing * (1 - same)) - 1;
    double *value = malloc((size_t)(before + 1) * sizeof *value);
    if (value == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the stations of a motion");
    for (int i = 0; i < before; i++)
        value[i] = (i + 1) * spacing;
    value[before] = end;
    free(out->value);
    *out = (scene_path){before + 1, value};
    return STATUS_OK;
}

/* The point that was added last becomes that motion. */
static status set_motion(pace *p, const pace_group *g, const pace_run *r, double spacing, fault *f)
{
    sweep_point *at = &p->sweep.point[p->sweep.points - 1];
    scene_motion *how = &at->scene.analysis[g->analysis].of.motion;
    how->scheme = r->method.scheme;
    if (how->mass == SCENE_MASS_USUAL) /* errors are those of time: all have the same mass */
        how->mass = SCENE_LUMPED;
    how->alpha = r->method.alpha;
    how->step = r->step;
    how->tolerance = r->tolerance;
    return stations_of(spacing, g->end, &how->path, f);
}

/* So many that all steps meet them, as far as the spacing divides the time. */
static int frames_of(const pace_group *g, double spacing)
{
    const int parts = (int)ceil(g->end / spacing * (1 - same));
    return 1 + parts * (parts < SHAPES_FEW ? SHAPES_FEW : 1);
}

/* A series of one mesh, of a point of its own. */
static status add_motion(pace *p, const pace_group *g, const pace_plan_request *q, pace_run *r,
                         double spacing, fault *f)
{
    p->sweep.whole_only = 1;
    TRY(plan_add(&p->sweep, q->type, q->parameter, NULL, &g->elements, 1, f));
    sweep_point *at = &p->sweep.point[p->sweep.points - 1];
    if (at->status != STATUS_OK)
        return fault_set(f, at->status, "%s", at->reason);
    at->shapes = q->errors ? frames_of(g, spacing) : 0;
    at->whole_steps = q->whole;
    TRY(set_motion(p, g, r, spacing, f));
    TRY(plan_extend(&p->sweep, &q->formulation, 1, f));
    r->series = p->sweep.seriess - 1;
    return STATUS_OK;
}

/* Between stations: errors are looked at where all steps end, which is where a whole number of the
 * coarsest ones divides the time. */
static double spacing_of(const pace_group *g, const pace_plan_request *q)
{
    const double coarsest = q->steps.count > 0 ? q->steps.value[0] : g->step,
                 all = g->end / coarsest, wanted = ceil(all / STATIONS_OF_ERROR * (1 - same));
    if (!q->errors)
        return g->end;
    if (fabs(all - round(all)) > same * all)
        return fmin(g->end, coarsest * wanted);
    int steps = (int)wanted;
    while (steps > 1 && (int)round(all) % steps != 0)
        steps--;
    return fmin(g->end, coarsest * steps);
}

static status add_run(pace *p, const pace_plan_request *q, const pace_run *what, fault *f)
{
    pace_run *more = realloc(p->run, (size_t)(p->runs + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for motions");
    p->run = more;
    pace_group *g = &p->group[p->groups - 1];
    pace_run *r = &p->run[p->runs];
    *r = *what;
    r->group = p->groups - 1;
    TRY(add_motion(p, g, q, r, spacing_of(g, q), f));
    p->runs++;
    g->runs++;
    return STATUS_OK;
}

/* Where energies are read, a step of its own leads to every station: the reference is not one that
 * is read between steps. */
static void read_exactly(scene *s, int analysis)
{
    scene_set_curve(scene_add_quantity(s, "energy at all stations", "J", analysis,
                                       scene_balance_of(SCENE_ENERGY)),
                    "time", "s", 1, 0);
}

/* With its checks behind it. */
static status add_reference(pace *p, pace_group *g, const pace_plan_request *q, fault *f)
{
    pace_run r = {.step = g->step};
    TRY(pace_method_read("radau", (int)strlen("radau"), &r.method, f));
    g->reference = p->sweep.seriess;
    for (int i = 0; i <= PACE_CHECKS; i++) {
        r.tolerance = pace_reference[i];
        TRY(add_motion(p, g, q, &r, spacing_of(g, q), f));
        scene *s = &p->sweep.point[p->sweep.points - 1].scene;
        read_exactly(s, g->analysis);
        if (s->out_of_memory)
            return fault_set(f, STATUS_FAULT, "out of memory for a motion");
    }
    return STATUS_OK;
}

static status add_runs(pace *p, const pace_plan_request *q, fault *f)
{
    const double step = p->group[p->groups - 1].step;
    for (int m = 0; m < q->methods; m++) {
        pace_run r = {.method = q->method[m]};
        for (int i = 0; i < q->steps.count; i++) {
            r.step = q->steps.value[i];
            r.tolerance = 0;
            TRY(add_run(p, q, &r, f));
        }
        for (int i = 0; i < q->tolerances.count && r.method.estimate; i++) {
            r.step = step;
            r.tolerance = q->tolerances.value[i];
            TRY(add_run(p, q, &r, f));
        }
    }
    return STATUS_OK;
}

/* The structure is looked at once, for its motion. */
static status look(pace_group *g, const pace_plan_request *q, fault *f)
{
    scene s;
    const status outcome = cell_scene(q->type, q->parameter, NULL, &s, f);
    g->analysis = outcome == STATUS_OK ? motion_of(&s) : -1;
    if (g->analysis >= 0) {
        const scene_motion *how = scene_motion_of(&s.analysis[g->analysis]);
        g->step = how->step;
        g->end = how->path.value[how->path.stations - 1];
        g->from = pace_alone_from(&s);
    }
    scene_free(&s);
    return outcome;
}

status pace_plan_add(pace *p, const pace_plan_request *q, fault *f)
{
    pace_group *more = realloc(p->group, (size_t)(p->groups + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for motions");
    p->group = more;
    pace_group *g = &p->group[p->groups];
    *g = (pace_group){.type = q->type,
                      .formulation = q->formulation,
                      .elements = q->elements,
                      .first = p->runs,
                      .reference = -1,
                      .uncertainty = NAN};
    memcpy(g->parameter, q->parameter, sizeof g->parameter);
    TRY(look(g, q, f));
    if (g->analysis < 0)
        return fault_set(f, STATUS_REFUSED, "%s is no motion in time", q->type->name);
    p->groups++;
    if (q->errors)
        TRY(add_reference(p, g, q, f));
    return add_runs(p, q, f);
}
