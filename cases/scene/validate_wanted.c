#include "cases/scene/validate_wanted.h"
#include "cases/scene/quantity_type.h"

#include <math.h>
#include <string.h>

#include "cases/scene/validate_motion.h"

static status check_continuation(const scene *s, int i, fault *f)
{
    const scene_control *c = &scene_continuation_of(&s->analysis[i])->control;
    if (!(c->step > 0) || !(c->step_max >= c->step))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: steps of %g to %g; the first must be positive, the largest not smaller",
            scene_called(s, SCENE_ANALYSES, i).text, c->step, c->step_max);
    return STATUS_OK;
}

static status check_path(const scene *s, const scene_analysis *a, int i, fault *f)
{
    const scene_path *path = scene_path_of(a);
    if (path->stations < 1)
        return fault_set(f, STATUS_REFUSED, "%s: a path needs a station; give one at least",
                         scene_called(s, SCENE_ANALYSES, i).text);
    if (a->kind != SCENE_CONTINUATION)
        for (int k = 1; k < path->stations; k++)
            if (!(path->value[k] > path->value[k - 1]))
                return fault_set(f, STATUS_REFUSED,
                                 "%s: its stations must ascend; sort them, without repetition",
                                 scene_called(s, SCENE_ANALYSES, i).text);
    return STATUS_OK;
}

static status check_compliance(const scene *s, const scene_analysis *a, int i, fault *f)
{
    if (a->follows != SCENE_NONE && scene_path_of(&s->analysis[a->follows]) == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "%s: a compliance follows a path or nothing; name a static analysis",
                         scene_called(s, SCENE_ANALYSES, i).text);
    return STATUS_OK;
}

/* What critical loads and frequencies may be about. */
static status check_about(const scene *s, const scene_analysis *a, int i, fault *f)
{
    const scene_analysis_kind about = s->analysis[a->follows].kind;
    if (about == SCENE_STATIC || (about == SCENE_LINEAR && a->kind == SCENE_MODAL))
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%s: %s about a state are about the last one of a static path%s, and %s "
                     "is a %s analysis; name a static one, or leave about out%s",
                     scene_called(s, SCENE_ANALYSES, i).text,
                     a->kind == SCENE_MODAL ? "frequencies" : "critical loads",
                     a->kind == SCENE_MODAL ? ", or about a linear analysis" : "",
                     scene_name(s, SCENE_ANALYSES, a->follows).text, scene_analysis_name(about),
                     about == SCENE_ROTATION && a->kind == SCENE_MODAL
                         ? ", or ask the rotation for its own frequencies"
                     : about == SCENE_CONTINUATION && a->kind == SCENE_BUCKLING
                         ? ", or ask the continuation for its critical points"
                         : "");
}

/* Does a quantity read it? */
static int is_asked(const scene *s, int analysis)
{
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].analysis == analysis)
            return 1;
    return 0;
}

status scene_validate_analysis(const scene *s, int i, fault *f)
{
    const scene_analysis *a = &s->analysis[i];
    if (a->follows != SCENE_NONE && (a->follows < 0 || a->follows >= i))
        return fault_set(f, STATUS_REFUSED,
                         "%s: it follows one that does not come before it; name an earlier one",
                         scene_called(s, SCENE_ANALYSES, i).text);
    if (a->follows != SCENE_NONE && a->kind != SCENE_MOTION &&
        s->analysis[a->follows].kind == SCENE_MOTION)
        return fault_set(f, STATUS_REFUSED,
                         "%s: it is about a motion, whose forces are not in balance without those "
                         "of inertia; follow a static path",
                         scene_called(s, SCENE_ANALYSES, i).text);
    if (a->follows != SCENE_NONE && (a->kind == SCENE_BUCKLING || a->kind == SCENE_MODAL))
        TRY(check_about(s, a, i, f));
    if (scene_path_of(a) != NULL)
        TRY(check_path(s, a, i, f));
    if (a->kind == SCENE_CONTINUATION)
        return check_continuation(s, i, f);
    if (a->kind == SCENE_MOTION)
        return scene_validate_motion(s, i, f);
    if (a->kind == SCENE_MODAL && is_asked(s, i))
        return scene_validate_mass(s, i, f);
    return a->kind == SCENE_COMPLIANCE ? check_compliance(s, a, i, f) : STATUS_OK;
}

/* Only places and rates are followed between the stations of a motion. */
static status check_passing(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_analysis *a = &s->analysis[q->analysis];
    const scene_passing *p = &q->passing;
    if (q->reduction < SCENE_LAST || q->reduction >= SCENE_REDUCTIONS)
        return fault_set(f, STATUS_REFUSED, "quantity %s: no such reduction", q->name);
    const int stations =
        scene_path_of(a) != NULL || (a->kind == SCENE_COMPLIANCE && a->follows != SCENE_NONE);
    if (q->reduction != SCENE_LAST && !stations)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: %s has one state and no stations; leave at and take out, or "
                         "ask for a static path",
                         q->name, scene_called(s, SCENE_ANALYSES, q->analysis).text);
    if (q->reduction > SCENE_CURVE && a->kind != SCENE_MOTION)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: times, crossings and means are those of a motion in time; "
                         "name one, or ask for a station or a curve",
                         q->name);
    if (q->reduction > SCENE_CURVE && !scene_is_passed(q, a->kind))
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: crossings, periods and means are those of places and "
                         "rates; ask for its largest or least value, or for a curve",
                         q->name);
    if (!scene_is_passed(q, a->kind))
        return STATUS_OK;
    if (!isfinite(p->level) || p->order < 0 || p->direction < SCENE_RISING ||
        p->direction > SCENE_EITHER || !(p->from >= 0) || !isfinite(p->until) ||
        (p->until != 0 && !(p->until > p->from)))
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: its window from %g to %g s, or its crossing, is none; give "
                         "a finite level, rising, falling or either, and a window that begins at "
                         "0 s or later and ends behind that",
                         q->name, p->from, p->until);
    return STATUS_OK;
}

/* The path whose stations the curve is of, and whether it has points of its own between them. */
static int path_of_curve(const scene *s, const scene_quantity *q, int *points)
{
    const scene_analysis *a = &s->analysis[q->analysis];
    *points = a->kind == SCENE_CONTINUATION &&
              (q->what.kind == SCENE_FACTOR_AT || q->what.kind == SCENE_COORDINATE);
    return a->kind == SCENE_COMPLIANCE && a->follows != SCENE_NONE ? a->follows : q->analysis;
}

static status check_abscissa(const scene *s, const scene_quantity *q, fault *f)
{
    int points, others;
    if (q->reduction != SCENE_CURVE || !q->x.is_quantity)
        return STATUS_OK;
    const int over = scene_abscissa_of(s, q);
    const scene_quantity *x = over != SCENE_NONE ? &s->quantity[over] : NULL;
    if (x == NULL || x == q || x->reduction != SCENE_CURVE)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: its curve is over %s, which is no other quantity with take: "
                         "curve; add take: curve there, or name one that has it",
                         q->name, q->x.name);
    if (x->analysis < 0 || x->analysis >= s->analyses ||
        path_of_curve(s, q, &points) != path_of_curve(s, x, &others) || points != others)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: its curve is over %s, which is of another path; name a "
                         "quantity of the same one",
                         q->name, x->name);
    return STATUS_OK;
}

status scene_validate_quantity(const scene *s, int i, fault *f)
{
    const scene_quantity *q = &s->quantity[i];
    for (int k = 0; k < i; k++)
        if (strcmp(s->quantity[k].name, q->name) == 0)
            return fault_set(f, STATUS_REFUSED, "quantity %s: two of that name; rename one",
                             q->name);
    if (!scene_gives(s->analysis[q->analysis].kind, q))
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: an analysis of this kind does not have it; name another one",
                         q->name);
    TRY(check_passing(s, q, f));
    TRY(check_abscissa(s, q, f));
    const quantity_type *type = quantity_type_of(q);
    return type->check != NULL ? type->check(s, q, f) : STATUS_OK;
}
