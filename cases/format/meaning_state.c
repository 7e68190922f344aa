/* Of which states of which analysis a quantity is. */
#include <math.h>

#include "cases/format/meaning_impl.h"

/* [rad/s] at path parameter 1. */
static double speed(const scene_analysis *a)
{
    const double *omega = scene_walk_of(a)->frame.omega;
    return sqrt(omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2]);
}

static const char *path_name(const scene_analysis *a)
{
    if (a->kind == SCENE_MOTION)
        return "motion";
    return a->kind == SCENE_CONTINUATION ? "path of the load factor" : "static path";
}

/* The analysis along whose path stations are counted, or NULL: there is no path. */
static const scene_analysis *path_of(const scene *s, const scene_analysis *a)
{
    const scene_analysis *walked =
        scene_path_of(a) == NULL && a->follows != SCENE_NONE ? &s->analysis[a->follows] : a;
    return scene_path_of(walked) != NULL ? walked : NULL;
}

/* Where on the path: its last station, or the value of its parameter. */
static void at_station(FILE *to, const scene *s, const scene_quantity *q, const scene_analysis *a)
{
    const scene_path *path = scene_path_of(a);
    const double last = path->value[path->stations - 1],
                 at = q->reduction == SCENE_AT ? q->at : last;
    if (a->kind == SCENE_ROTATION && speed(a) * last == 0) {
        fputs(", at rest", to);
    } else if (a->kind == SCENE_ROTATION) {
        fprintf(to, ", turning at %.10g rad/s", speed(a) * at);
    } else if (a->kind == SCENE_CONTINUATION) {
        const scene_control *control = &scene_continuation_of(a)->control;
        fputs(", where the ", to);
        meaning_coordinate(to, s, control->node, control->component);
        fprintf(to, " is %.10g m", at);
    } else if (a->kind == SCENE_MOTION) {
        fprintf(to, ", %.10g s after the start of the motion", at);
    } else if (q->reduction != SCENE_AT) {
        fputs(", at the end of the static path", to);
    } else {
        fprintf(to, ", at %.10g on the static path (0 to %.10g)", at, last);
    }
}

/* Of a motion, between its stations. */
static void passing(FILE *to, const scene_quantity *q)
{
    static const char *const way[] = {"rises through", "falls through", "passes"};
    const scene_passing *p = &q->passing;
    if (q->reduction == SCENE_MEAN)
        fputs(", mean over time", to);
    else if (q->reduction == SCENE_MAX_TIME || q->reduction == SCENE_MIN_TIME)
        fprintf(to, ", time at which it is %s",
                q->reduction == SCENE_MAX_TIME ? "largest" : "least");
    else if (q->reduction == SCENE_CROSSING)
        fprintf(to, ", time at which it %s %.10g, number %d", way[p->direction], p->level,
                p->order + 1);
    else
        fprintf(to, ", %s at which it %s %.10g",
                q->reduction == SCENE_PERIOD ? "period" : "frequency", way[p->direction], p->level);
    if (p->from > 0 || p->until > 0)
        fprintf(to, ", from %.10g s on", p->from);
    if (p->until > 0)
        fprintf(to, " until %.10g s", p->until);
}

static void along_path(FILE *to, const scene *s, const scene_quantity *q, const scene_analysis *a)
{
    const char *name = a->kind == SCENE_ROTATION ? "speeds at which the axes turn" : path_name(a);
    switch (q->reduction) {
    case SCENE_LAST:
    case SCENE_AT:
        at_station(to, s, q, a);
        break;
    case SCENE_MAX:
        fprintf(to, ", largest value along the %s", name);
        break;
    case SCENE_MIN:
        fprintf(to, ", least value along the %s", name);
        break;
    case SCENE_CURVE:
        fprintf(to, ", along the %s, over %s [%s]", name, q->x.name, q->x.unit);
        break;
    case SCENE_MAX_TIME:
    case SCENE_MIN_TIME:
    case SCENE_CROSSING:
    case SCENE_PERIOD:
    case SCENE_PER_SECOND:
    case SCENE_MEAN:
    case SCENE_REDUCTIONS:
        passing(to, q);
        break;
    }
}

void meaning_state(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_analysis *a = &s->analysis[q->analysis], *path = path_of(s, a);
    if (path != NULL)
        along_path(to, s, q, path);
    else if (a->kind == SCENE_LINEAR)
        fputs(", small displacements", to);
    else if (a->follows != SCENE_NONE)
        fputs(", of the structure under its loads, small displacements", to);
    else
        fputs(", of the undeformed structure", to);
    if (path != NULL && path->kind == SCENE_STATIC && scene_rotates(path))
        fprintf(to, ", while the axes turn at %.10g rad/s", speed(path));
    if (a->kind == SCENE_COMPLIANCE && scene_compliance_of(a)->moments != SCENE_MOMENTS_SPATIAL)
        fprintf(to, ", moments %s", scene_moments_name(scene_compliance_of(a)->moments));
}
