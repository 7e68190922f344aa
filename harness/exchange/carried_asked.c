/* What is asked of a scene, as far as a deck of solids answers it. */
#include "harness/exchange/carried.h"
#include "harness/exchange/rigid.h"

static status refuse(const scene_quantity *q, const char *why, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "quantity '%s': %s", q->name, why);
}

static status check_component(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_component *c = scene_component_of(q);
    const scene_node *n = &s->node[c->node];
    if (!rigid_moves(s, c->node))
        return refuse(q, "no solid ends at its node; ask for the body that moves", f);
    if (q->what.kind != SCENE_REACTION || c->component < SCENE_RX ||
        rigid_single_axis(n) == c->component - SCENE_RX)
        return STATUS_OK;
    for (int i = 0; i < 3; i++)
        if (n->angle[i] != SCENE_HELD)
            return refuse(q, "a moment on a node that turns is not printed for solids", f);
    return STATUS_OK;
}

/* CalculiX forgets a state behind a linear step about it: one at the end of the path. */
static status check_last(const scene *s, const scene_quantity *q, fault *f)
{
    const int about = s->analysis[q->analysis].follows;
    if (about == SCENE_NONE)
        return STATUS_OK;
    const scene_path *path = scene_path_of(&s->analysis[about]);
    if (q->reduction == SCENE_CURVE ||
        (q->reduction == SCENE_AT && q->at != path->value[path->stations - 1]))
        return refuse(q,
                      "of a loaded state, only that of the last station is written; end the "
                      "path there",
                      f);
    for (const scene_quantity *other = s->quantity; other < q; other++)
        if ((other->what.kind == SCENE_COMPLIANCE_ENTRY ||
             other->what.kind == SCENE_STIFFNESS_ENTRY) &&
            s->analysis[other->analysis].follows != SCENE_NONE)
            return refuse(q,
                          "a deck has one stiffness of a loaded state; ask for the others in "
                          "scenes of their own",
                          f);
    return STATUS_OK;
}

/* About a loaded state a rotation vector's stiffness is that of no convention of moments. */
static status check_entry(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_entry *e = scene_entry_of(q);
    if (s->analysis[q->analysis].follows != SCENE_NONE &&
        (e->row >= SCENE_RX || e->column >= SCENE_RX))
        return refuse(q, "rotations about a loaded state are not written for solids", f);
    return check_last(s, q, f);
}

static status check_quantity(const scene *s, const scene_quantity *q, fault *f)
{
    if (q->reduction == SCENE_MAX || q->reduction == SCENE_MIN)
        return refuse(q,
                      "the largest and least of a path are not written for solids; ask at a "
                      "value of it",
                      f);
    if (scene_abscissa_of(s, q) != SCENE_NONE)
        return refuse(q, "a curve over another quantity is not written for solids; leave x out", f);
    switch (q->what.kind) {
    case SCENE_COORDINATE:
    case SCENE_REACTION:
        return check_component(s, q, f);
    case SCENE_COMPLIANCE_ENTRY:
    case SCENE_STIFFNESS_ENTRY:
        return check_entry(s, q, f);
    default:
        return refuse(q, "of its kind nothing is printed for solids", f);
    }
}

status carried_asked_check(const scene *s, fault *f)
{
    if (s->quantities == 0)
        return fault_set(f, STATUS_REFUSED, "a scene without quantities asks nothing of a solid");
    for (int i = 0; i < s->quantities; i++)
        TRY(check_quantity(s, &s->quantity[i], f));
    return STATUS_OK;
}
