#include "harness/import_export/import_export_impl.h"

#include "cases/scene/scene.h"

int export_is_static(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_STATIC)
            return i;
    return SCENE_NONE;
}

static int is_zero(const double v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

static status check_section(const scene *s, int member, fault *f)
{
    const section_spec *profile = &s->section[s->member[member].section];
    if (scene_member_tapers(&s->member[member]))
        return fault_set(f, STATUS_REFUSED,
                         "%s: a section that changes along the member cannot be written as solids; "
                         "give the member one section",
                         scene_called(s, SCENE_MEMBERS, member).text);
    brick mesh;
    fault why = {""};
    if (brick_init(&mesh, s, member, 1, 1, 1, &why) != STATUS_OK)
        return fault_set(f, STATUS_REFUSED, "%s: %.250s",
                         scene_called(s, SCENE_MEMBERS, member).text, why.text);
    const double poisson = profile->young / (2 * profile->shear_modulus) - 1;
    if (poisson > -1 && poisson < 0.5)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%s: Poisson's ratio E/(2 G) - 1 = %g is impossible for a solid; give moduli "
                     "with a ratio between -1 and 0.5",
                     scene_called(s, SCENE_MEMBERS, member).text, poisson);
}

static int ends_at_node(const scene *s, int node)
{
    int ends = 0;
    for (int i = 0; i < s->members; i++)
        ends += (s->member[i].p == node) + (s->member[i].q == node);
    return ends;
}

static status check_member(const scene *s, int member, fault *f)
{
    const scene_member *m = &s->member[member];
    const int end[2] = {m->p, m->q};
    if (!is_zero(m->curvature) || !is_zero(m->strain) || m->bow[0] != 0 || m->bow[1] != 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: initial curvature, strain and bow cannot be written as solids; "
                         "remove them from the member",
                         scene_called(s, SCENE_MEMBERS, member).text);
    for (int i = 0; i < 2; i++)
        if (ends_at_node(s, end[i]) > 1)
            return fault_set(
                f, STATUS_REFUSED,
                "%s: a node at which several members end cannot be written as solids; make the "
                "node a rigid body, and end each member at a node of its own with part_of",
                scene_called(s, SCENE_NODES, end[i]).text);
    if (m->release[0].count + m->release[1].count > 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: released ends cannot be written as solids; remove the release, and "
                         "use a node with its own rotation",
                         scene_called(s, SCENE_MEMBERS, member).text);
    if (scene_is_founded(m))
        return fault_set(f, STATUS_REFUSED,
                         "%s: a foundation cannot be written as solids; remove it",
                         scene_called(s, SCENE_MEMBERS, member).text);
    if (scene_is_beside(m, 0) || scene_is_beside(m, 1))
        return fault_set(f, STATUS_REFUSED,
                         "%s: eccentric ends of a member cannot be written as solids; remove the "
                         "eccentricity, and end the member at a node of its own with part_of",
                         scene_called(s, SCENE_MEMBERS, member).text);
    if (m->warp_p != SCENE_WARP_FIXED || m->warp_q != SCENE_WARP_FIXED)
        return fault_set(f, STATUS_REFUSED,
                         "%s: the ends of the member can warp, but the rigid end faces of solids "
                         "cannot; write warping: fixed in the member",
                         scene_called(s, SCENE_MEMBERS, member).text);
    return check_section(s, member, f);
}

static int held_rotations(const scene_node *n)
{
    int held = 0;
    for (int i = 0; i < 3; i++)
        held += n->angle[i] == SCENE_HELD;
    return held;
}

/* Checks the rotations of a node. In CalculiX, a rotation node has a rotation vector. Large
 * rotations about fixed axes are equivalent to this vector only if all three are free or if at
 * least two are fixed. */
static status check_node(const scene *s, int node, fault *f)
{
    const scene_node *n = &s->node[node];
    const int held = held_rotations(n), large = export_is_static(s) != SCENE_NONE;
    int driven = 0;
    double R[9];
    if (scene_node_axes(n, R))
        return fault_set(f, STATUS_REFUSED,
                         "%s: supports along rotated axes cannot be written as solids; fix the "
                         "node along the axes of the scene",
                         scene_called(s, SCENE_NODES, node).text);
    for (int i = 0; i < 3; i++)
        driven += n->angle[i] >= 0;
    if (n->rotation == SCENE_ROTATION_VECTOR || n->attached != SCENE_NONE ||
        rigid_single_axis(n) != SCENE_NONE)
        return STATUS_OK;
    if (n->rotation != SCENE_ROTATION_SPATIAL)
        return fault_set(f, STATUS_REFUSED,
                         "%s: sequences of rotations and forks cannot be written as solids; fix "
                         "all rotations of the node, or prescribe a rotation vector",
                         scene_called(s, SCENE_NODES, node).text);
    if (!large || held >= 2 || (held == 0 && driven == 0))
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%s: the rigid end faces of solids rotate by a rotation vector, of which one "
                     "component alone cannot be fixed; fix none, two or all rotations of the node",
                     scene_called(s, SCENE_NODES, node).text);
}

static status check_load(const scene *s, int load, fault *f)
{
    const scene_load *l = &s->load[load];
    if (l->kind != SCENE_FORCE && l->kind != SCENE_MOMENT)
        return fault_set(f, STATUS_REFUSED,
                         "%s: weight and loads along members cannot be written as solids; apply "
                         "forces and moments to nodes",
                         scene_called(s, SCENE_LOADS, load).text);
    if (l->follower || l->axes != SCENE_AXES_FIXED || !is_zero(l->at))
        return fault_set(f, STATUS_REFUSED,
                         "%s: only dead loads at nodes, along fixed axes, can be written as "
                         "solids; change the load, or remove it",
                         scene_called(s, SCENE_LOADS, load).text);
    if (!rigid_moves(s, l->where))
        return fault_set(
            f, STATUS_REFUSED, "%s: no solid ends at %s; apply the load to the moving body",
            scene_called(s, SCENE_LOADS, load).text, scene_called(s, SCENE_NODES, l->where).text);
    if (l->kind == SCENE_MOMENT && export_is_static(s) != SCENE_NONE &&
        rigid_single_axis(&s->node[l->where]) == SCENE_NONE &&
        held_rotations(&s->node[l->where]) < 2)
        return fault_set(f, STATUS_REFUSED,
                         "%s: a moment on a node that can rotate about all axes differs from the "
                         "moment of a rotation vector; fix two rotations of the node",
                         scene_called(s, SCENE_LOADS, load).text);
    return STATUS_OK;
}

static status check_analysis(const scene *s, int analysis, fault *f)
{
    const scene_analysis *a = &s->analysis[analysis];
    if (a->kind != SCENE_LINEAR && a->kind != SCENE_STATIC && a->kind != SCENE_COMPLIANCE)
        return fault_set(f, STATUS_REFUSED,
                         "%s: an input deck supports only linear, static and compliance analyses, "
                         "not %s; remove the analysis and its quantities",
                         scene_called(s, SCENE_ANALYSES, analysis).text,
                         scene_analysis_name(a->kind));
    if (a->kind == SCENE_STATIC && (analysis != export_is_static(s) || scene_rotates(a)))
        return fault_set(f, STATUS_REFUSED,
                         "%s: an input deck supports only one load path, along axes that do not "
                         "rotate; remove this load path",
                         scene_called(s, SCENE_ANALYSES, analysis).text);
    if (a->kind == SCENE_COMPLIANCE && !rigid_moves(s, scene_compliance_of(a)->node))
        return fault_set(f, STATUS_REFUSED,
                         "%s: no solid ends at the node; request the value of the moving body",
                         scene_called(s, SCENE_ANALYSES, analysis).text);
    return STATUS_OK;
}

status export_support_check(const scene *s, fault *f)
{
    if (s->members == 0)
        return fault_set(
            f, STATUS_REFUSED,
            "the scene has no members, so there is nothing to write as solids; add a member");
    if (s->springs > 0)
        return fault_set(
            f, STATUS_REFUSED,
            "springs cannot be written as solids; remove them, or replace them with members");
    if (s->constraints > 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: a constraint cannot be written as solids; join the nodes to one body "
                         "by part_of, or remove the constraint",
                         scene_called(s, SCENE_CONSTRAINTS, 0).text);
    if (s->imperfections > 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: an imperfection cannot be written as solids; remove it",
                         scene_called(s, SCENE_IMPERFECTIONS, 0).text);
    for (int i = 0; i < s->members; i++)
        TRY(check_member(s, i, f));
    for (int i = 0; i < s->nodes; i++)
        TRY(check_node(s, i, f));
    for (int i = 0; i < s->drivers; i++)
        if (s->driver[i].condition_driver != SCENE_NONE)
            return fault_set(f, STATUS_REFUSED,
                             "motion '%s' is determined by a condition, which input decks cannot "
                             "express; give the motion by its values ('path' and 'value')",
                             s->driver[i].name);
    for (int i = 0; i < s->loads; i++)
        TRY(check_load(s, i, f));
    for (int i = 0; i < s->analyses; i++)
        TRY(check_analysis(s, i, f));
    return STATUS_OK;
}

static status refuse(const scene_quantity *q, const char *why, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "quantity '%s': %s", q->name, why);
}

static status check_component(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_component *c = scene_component_of(q);
    const scene_node *n = &s->node[c->node];
    if (!rigid_moves(s, c->node))
        return refuse(q, "no solid ends at the node; request the moving body", f);
    if (q->what.kind != SCENE_REACTION || c->component < SCENE_RX ||
        rigid_single_axis(n) == c->component - SCENE_RX)
        return STATUS_OK;
    for (int i = 0; i < 3; i++)
        if (n->angle[i] != SCENE_HELD)
            return refuse(
                q, "the moment on a rotating node is not printed for solids; remove the quantity",
                f);
    return STATUS_OK;
}

/* CalculiX loses the state after a linear step, so a step about a loaded state must be the last
 * one. REFUSED: the value is not that at the end of the path, or a value about a loaded state comes
 * before it. */
static status check_last(const scene *s, const scene_quantity *q, fault *f)
{
    const int about = s->analysis[q->analysis].follows;
    if (about == SCENE_NONE)
        return STATUS_OK;
    const scene_path *path = scene_path_of(&s->analysis[about]);
    if (q->reduction == SCENE_CURVE ||
        (q->reduction == SCENE_AT && q->at != path->value[path->stations - 1]))
        return refuse(q,
                      "about a loaded state, only the value at the last station can be written; "
                      "end the load path at the requested station",
                      f);
    for (const scene_quantity *other = s->quantity; other < q; other++)
        if ((other->what.kind == SCENE_COMPLIANCE_ENTRY ||
             other->what.kind == SCENE_STIFFNESS_ENTRY) &&
            s->analysis[other->analysis].follows != SCENE_NONE)
            return refuse(q,
                          "an input deck contains one stiffness of a loaded state; request the "
                          "others in separate scenes",
                          f);
    return STATUS_OK;
}

/* Checks an entry of a matrix. REFUSED: the entry belongs to a rotation about a loaded state, where
 * the stiffness of a rotation vector corresponds to no convention for moments; or check_last
 * rejects it. */
static status check_entry(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_entry *e = scene_entry_of(q);
    if (s->analysis[q->analysis].follows != SCENE_NONE &&
        (e->row >= SCENE_RX || e->column >= SCENE_RX))
        return refuse(q,
                      "stiffnesses and compliances of rotations about a loaded state are not "
                      "supported for solids; remove the quantity",
                      f);
    return check_last(s, q, f);
}

static status check_quantity(const scene *s, const scene_quantity *q, fault *f)
{
    if (q->reduction == SCENE_MAX || q->reduction == SCENE_MIN)
        return refuse(q,
                      "the maximum and the minimum over a path are not supported for solids; "
                      "request the value at a station with 'at'",
                      f);
    if (q->envelope != SCENE_ENVELOPE_NONE)
        return refuse(q,
                      "an envelope is not supported for solids; request each combination that may "
                      "govern as a separate quantity",
                      f);
    if (scene_abscissa_of(s, q) != SCENE_NONE)
        return refuse(q,
                      "a curve over another quantity is not supported for solids; remove 'x' from "
                      "the quantity",
                      f);
    switch (q->what.kind) {
    case SCENE_COORDINATE:
    case SCENE_REACTION:
        return check_component(s, q, f);
    case SCENE_COMPLIANCE_ENTRY:
    case SCENE_STIFFNESS_ENTRY:
        return check_entry(s, q, f);
    default:
        return refuse(q, "quantities of this kind are not printed for solids; remove the quantity",
                      f);
    }
}

status export_support_requests(const scene *s, fault *f)
{
    if (s->quantities == 0)
        return fault_set(f, STATUS_REFUSED,
                         "the scene has no quantities to request from solids; add one, such as a "
                         "displacement of a node");
    for (int i = 0; i < s->quantities; i++)
        TRY(check_quantity(s, &s->quantity[i], f));
    return STATUS_OK;
}

int rigid_body(const scene *s, int node)
{
    while (s->node[node].attached != SCENE_NONE)
        node = s->node[node].attached;
    return node;
}

int rigid_moves(const scene *s, int node)
{
    int ends = 0;
    for (int i = 0; i < s->members; i++)
        ends += rigid_body(s, s->member[i].p) == node || rigid_body(s, s->member[i].q) == node;
    return ends > 0 && s->node[node].attached == SCENE_NONE;
}

static int rigid_is_zero(const double v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

int rigid_single_axis(const scene_node *n)
{
    if (n->rotation != SCENE_ROTATION_SEQUENCE || !rigid_is_zero(n->axis[1]))
        return SCENE_NONE;
    for (int i = 0; i < 3; i++)
        if (n->axis[0][i] > 0 && n->axis[0][(i + 1) % 3] == 0 && n->axis[0][(i + 2) % 3] == 0)
            return i;
    return SCENE_NONE;
}
