/* Whether a step has ended, goes on or leads nowhere; whether the state it ends in is one that the
 * formulation follows. */
#include <math.h>

#include "cases/scene/names.h"
#include "elements/math/dense.h"
#include "elements/math/pi.h"
#include "harness/model/kinematics.h"
#include "harness/model/model_impl.h"
#include "harness/model/release.h"
#include "harness/model/turns.h"
#include "harness/solver/newton.h"

static status judge_twist(const model *m, const model_state *s, fault *f)
{
    int index;
    const double twist = kinematics_largest_twist(m, s, &index);
    if (twist < PI / 4)
        return STATUS_OK;
    const int member = m->element[index].member, first = m->first_element[member];
    return fault_set(
        f, STATUS_NOT_CONVERGED,
        "element %d of %d of %s is twisted by %.3g rad, more than the eighth of a turn "
        "up to which the torque of %s grows, at path %g: use more elements or smaller "
        "steps",
        index - first + 1, m->first_element[member + 1] - first,
        scene_called(m->scene, SCENE_MEMBERS, member).text, twist, m->type->name, s->path);
}

/* The element's own turn [rad]: between neighbouring nodes, and for sines against the chord. */
static status judge_elements(const model *m, const model_state *s, fault *f)
{
    const int quarter = (m->type->limits & LIMIT_QUARTER_TURN) != 0;
    int index;
    const double turn = kinematics_largest_turn(m, s, quarter, &index);
    if (turn < (quarter ? PI / 2 : PI))
        return STATUS_OK;
    const int member = m->element[index].member, first = m->first_element[member];
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "element %d of %d of %s is turned by %.3g rad, more than the %s turn that %s "
                     "follows, at path %g: use more elements or smaller steps",
                     index - first + 1, m->first_element[member + 1] - first,
                     scene_called(m->scene, SCENE_MEMBERS, member).text, turn,
                     quarter ? "quarter" : "half", m->type->name, s->path);
}

/* Does this end of a member turn freely about all axes across it? */
static int swings(const model *m, const mesh_element *el, int node)
{
    const mesh_release *r = release_of(m, el->vertex[node]);
    const double *triad = el->triad[node], x[3] = {triad[0], triad[3], triad[6]};
    const double across = 1e-6;
    if (r == NULL || r->turns < 2)
        return 0;
    return r->turns == 3 ||
           (fabs(vec3_dot(r->turn[0], x)) < across && fabs(vec3_dot(r->turn[1], x)) < across);
}

/* Elements longer than the axial force in them allows; bars that nothing bends are never. */
static status judge_tension(const model *m, const model_state *s, fault *f)
{
    int worst = 0;
    double most = 0;
    for (int i = 0; i < m->elements; i++) {
        const double by = m->type->tension(m->kind[m->element[i].kind].data,
                                           s->sigma + (size_t)i * (size_t)m->strains);
        const mesh_element *el = &m->element[i];
        if (by <= most || (swings(m, el, 0) && swings(m, el, el->nodes - 1)))
            continue;
        worst = i;
        most = by;
    }
    if (most < 1)
        return STATUS_OK;
    const int member = m->element[worst].member, first = m->first_element[member],
              count = m->first_element[member + 1] - first;
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "element %d of %d of %s is too long for the axial force in it, by a factor of "
                     "%.4g, at path %g: %s loses its stiffness across it; use %.0f elements (for "
                     "four times the force twice as many) or another formulation",
                     worst - first + 1, count, scene_called(m->scene, SCENE_MEMBERS, member).text,
                     most, s->path, m->type->name, floor(count * most) + 1);
}

status newton_judge_rest(const model *m, fault *f)
{
    const double most = 2;
    int index;
    if (!(m->type->limits & LIMIT_FLAT_ARC))
        return STATUS_OK;
    const double rise = kinematics_largest_rise(m, &index);
    if (rise < most)
        return STATUS_OK;
    const int member = m->element[index].member, first = m->first_element[member],
              count = m->first_element[member + 1] - first;
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "the arc of element %d of %d of %s rises by %.3g radii of gyration of its "
                     "section, and %s is right below %g: use %.0f elements or another formulation",
                     index - first + 1, count, scene_called(m->scene, SCENE_MEMBERS, member).text,
                     rise, m->type->name, most, floor(count * sqrt(rise / most)) + 1);
}

/* Near a full turn, with a moment across the turn: that knows no bounds there. */
static int across(const mesh_discrete *d, const double turn[3])
{
    const double near = 1e-3, size = vec3_norm(turn);
    double moment[3] = {0}, aside[3];
    if (!turns_full(size, near))
        return 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            moment[i] += d->spring->stiffness[6 * (3 + i) + 3 + k] * turn[k];
    vec3_cross(turn, moment, aside);
    return vec3_norm(aside) > 1e-6 * size * vec3_norm(moment);
}

static status judge_springs(const model *m, const model_state *from, const model_state *s, fault *f)
{
    for (int i = 0; i < m->springs; i++) {
        const double *turn = turns_of_spring(m, s, i);
        if (turns_swung(turns_of_spring(m, from, i), turn) ||
            across(&m->discrete[m->discretes - m->springs + i], turn))
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "%s is turned by %.4g rad at path %g: on a full turn about a changing "
                             "axis, or with a moment across its turn, its rotation vector has no "
                             "direction; hold its other turns, use smaller steps, or put two in "
                             "series",
                             scene_called(m->scene, SCENE_SPRINGS, i).text, vec3_norm(turn),
                             s->path);
    }
    return STATUS_OK;
}

/* Largest change of what turns a node by prescribed angles [rad]. */
static double driven_by(const model *m, const model_state *from, const model_state *s, int node)
{
    const mesh_vertex *v = &m->vertex[node];
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        const int driver =
            v->vector_driver[0] != NONE ? v->vector_driver[k] : m->scene->node[node].angle[k];
        if (driver >= 0)
            largest = fmax(largest, fabs(s->driver[driver] - from->driver[driver]));
    }
    return largest;
}

static status judge_steps(const model *m, const model_state *from, const model_state *s, fault *f)
{
    for (int i = 0; i < m->scene->nodes; i++) {
        const double most = m->vertex[i].vector_driver[0] != NONE ? PI : 2 * PI,
                     step = driven_by(m, from, s, i);
        if (!(step < most * (1 + 1e-9)))
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "%s is driven by %.3g rad in one step at path %g: use smaller steps",
                             scene_called(m->scene, SCENE_NODES, i).text, step, s->path);
    }
    return STATUS_OK;
}

status newton_accept(const model *m, const model_state *from, model_state *s, fault *f)
{
    TRY(judge_elements(m, s, f));
    if (m->type->limits & LIMIT_EIGHTH_TWIST)
        TRY(judge_twist(m, s, f));
    if (m->type->limits & LIMIT_TENSION)
        TRY(judge_tension(m, s, f));
    TRY(judge_springs(m, from, s, f));
    TRY(judge_steps(m, from, s, f));
    turns_lose(m, from, s);
    return STATUS_OK;
}

status newton_judge(const newton *n, newton_watch *w, double path, double correction, int *done,
                    fault *f)
{
    const double wild = 4; /* a correction of several radians or lengths leads nowhere */
    const double astray = 0.5, behind_first = 2;
    *done = arrival_reached(&n->arrival);
    w->first = w->iteration == 0 ? correction : w->first;
    w->largest = w->iteration == 0 ? 0 : fmax(w->largest, correction);
    if (*done) {
        TRY(newton_accept(n->c->model, n->backup, n->state, f));
        if (w->largest > astray && w->largest > behind_first * w->first)
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "at path %g Newton strayed by %.2g rad or lengths and may have found "
                             "another equilibrium: use smaller steps, or follow a continuation",
                             path, w->largest);
        return STATUS_OK;
    }
    w->growing = correction > w->last && w->iteration > 1 ? w->growing + 1 : 0;
    w->last = correction;
    w->iteration++;
    if (correction > wild * 4 || (w->iteration > 3 && correction > wild) || w->growing >= 4)
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "Newton diverged at path %g: correction %.1e in iteration %d", path,
                         correction, w->iteration);
    if (w->iteration == n->max_iterations)
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "Newton did not converge in %d iterations at path %g: correction %.1e",
                         n->max_iterations, path, correction);
    return STATUS_OK;
}
