/* Convergence of Newton's method. Corrections of motions and of stresses both converge
 * quadratically. In stiff elements, the relative error of stresses is larger by orders of
 * magnitude, so the motions alone are no sufficient test. */
#include "harness/newton/newton_impl.h"

#include <stdio.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

static const double small = 1e-8;
static const double many_elements =
    1e4; /* for more elements, `small` is proportional to their number */
/* Newton's method has also converged after a correction below `newton_convergence_near` if the
 * predicted size of the next correction is negligible. */
static const double newton_convergence_near = 1e-6, negligible = 1e-15;
static const double rounding = 1e-12;
/* Corrections above this limit need not converge quadratically. */
static const double quadratic = 0.1;
static const double same_tangent = 3e-11;

void newton_convergence_start(double criterion, int differences, int elements,
                              newton_convergence *a)
{
    *a = (newton_convergence){.criterion = criterion > 0 || !differences ? criterion : small,
                              .small = small * fmax(1, elements / many_elements),
                              .correction = INFINITY,
                              .before = INFINITY,
                              .contraction = NAN,
                              .remaining = NAN};
}

/* Records a correction and the resulting change of stresses. first 1: the first correction of a
 * step. Changes are relative to the largest stress on the path so far, because stresses may pass
 * through zero. */
static void newton_convergence_add(double correction, const advance_stress *stress, int first,
                                   newton_convergence *a)
{
    a->before = first ? INFINITY : a->correction;
    a->correction = correction;
    a->stress = fmax(a->stress, stress->largest);
    a->stress_change = stress->change > 0 ? stress->change / a->stress : 0;
    if (a->before <= quadratic && a->before > 0)
        a->contraction = fmax(correction, a->stress_change) / (a->before * a->before);
    a->remaining = a->contraction * correction * correction;
}

/* Returns 1 if the last correction is below the requested limit. Without a requested limit, returns
 * 1 if a further correction would not change the result. */
static int newton_converged(const newton_convergence *a)
{
    if (a->criterion > 0)
        return a->correction <= a->criterion;
    return a->correction <= rounding || (a->correction <= a->small && a->before <= a->small) ||
           (a->correction <= newton_convergence_near && a->remaining <= negligible);
}

int newton_convergence_tangent_stands(const newton_convergence *a)
{
    return a->correction <= same_tangent && a->stress_change <= same_tangent;
}

/* Computes the changes of stresses and inner unknowns due to the rotation of an element's frame,
 * for an element that includes loads along it in its equilibrium. */
static void follow_turn(const model *m, const double along[], const double local[], double sigma[],
                        double inner[])
{
    double turn[3], more[ELEMENT_MAX_STRAINS];
    dense_mul_vec(3, ELEMENT_ALONG_COORDINATES, along + SLOT_TURN, local, turn);
    dense_mul_vec(model_strains(m), 3, along + SLOT_MIXED, turn, more);
    for (int k = 0; k < model_strains(m); k++)
        sigma[k] += more[k];
    for (int k = 0; k < model_inner(m); k++)
        inner[k] += vec3_dot(along + slot_followed(m) + (ptrdiff_t)3 * k, turn);
}

/* Updates the strains, stresses and inner unknowns of an element. Returns the largest change of an
 * inner unknown. */
static double advance_element(const model *m, const linear_memory *memory, model_state *s, int i,
                              const double dx[], advance_stress *stress)
{
    const mesh_element *el = model_element(m, i);
    model_slot w = linearise_slot(m, memory, i);
    double local[ELEMENT_MAX_COORDINATES], de[ELEMENT_MAX_STRAINS], more[ELEMENT_MAX_STRAINS];
    double *e = &s->e[(size_t)i * (size_t)model_strains(m)],
           *sigma = &s->sigma[(size_t)i * (size_t)model_strains(m)];
    kinematics_local(m, s, el, dx, local);
    dense_mul_vec(model_strains(m), model_own_coordinates(m), w.J, local, de);
    dense_mul_vec(model_strains(m), model_strains(m), w.C, de, more);
    if (model_takes_loads(m) && w.along[SLOT_TAKES] != 0)
        follow_turn(m, w.along, local, more, &s->inner[(size_t)i * (size_t)model_inner(m)]);
    for (int k = 0; k < model_strains(m); k++) {
        const double next = w.sigma[k] + more[k], change = fabs(next - sigma[k]);
        stress->change = change > stress->change ? change : stress->change;
        stress->largest = fabs(next) > stress->largest ? fabs(next) : stress->largest;
        sigma[k] = next;
        de[k] += w.incompatibility[k];
        e[k] += de[k];
    }
    if (model_type(m)->update == NULL)
        return 0;
    return model_type(m)->update(model_kind(m, el->kind)->data, de, w.memory,
                                 &s->inner[(size_t)i * (size_t)model_inner(m)]);
}

int advance_is_free(const model *m, int index)
{
    const mesh_vertex *v = model_vertex(m, index);
    const int node = index < model_scene(m)->nodes;
    if (v->body != index || v->angles > 0 || v->led || (node && v->leader != NONE))
        return 0;
    for (int c = SCENE_UX; c <= SCENE_UZ; c++)
        if (c != scene_normal(model_scene(m)) &&
            (v->coordinate[c] == NONE || v->coordinate[c] >= model_unknowns(m) ||
             (node && model_tie(m, index, c) != NULL)))
            return 0;
    return 1;
}

int advance_on_arcs(const equations *eq)
{
    const model *m = eq->m;
    if (eq->loading.in_time || model_driven(m) == 0 || model_first_release(m) < model_vertices(m))
        return 0;
    for (int i = 0; i < model_elements(m); i++)
        for (int k = 0; k < model_element(m, i)->nodes; k++) {
            const int vertex = model_element(m, i)->vertex[k], body = model_vertex(m, vertex)->body;
            if (body != vertex && advance_is_free(m, body))
                return 1;
        }
    return 0;
}

static double advance_vertex(const model *m, model_state *s, int index, int on_arcs,
                             const double dx[])
{
    const mesh_vertex *v = model_vertex(m, index);
    double d[6], q[4], largest = 0;
    for (int c = 0; c < 6; c++)
        d[c] = v->coordinate[c] == NONE ? 0 : dx[v->coordinate[c]];
    kinematics_to_fixed(v, d);
    if (v->led) {
        double by[3];
        kinematics_swing(m, s, index, d[3], by);
        for (int c = 0; c < 3; c++)
            d[c] += by[c];
    }
    for (int c = 0; c < 3; c++)
        largest = larger(largest, larger(fabs(d[c]) / model_length(m), fabs(d[3 + c])));
    if (on_arcs && advance_is_free(m, index)) {
        double arc[3];
        arc_at(d + 3, d, 1, arc, q);
        memcpy(d, arc, sizeof arc);
    }
    for (int c = 0; c < 3; c++) {
        s->u[3 * index + c] += d[c];
        s->angle[3 * index + c] += d[3 + c];
    }
    if (v->angles == 0) {
        rotation_exp(d + 3, q);
        rotation_compose(q, &s->q[4 * index], &s->q[4 * index]);
        rotation_normalise(&s->q[4 * index]);
    }
    return largest;
}

double advance_state(const equations *eq, const linear_memory *memory, model_state *s,
                     const double dx[], double path, advance_stress *stress)
{
    const model *m = eq->m;
    const int on_arcs = advance_on_arcs(eq);
    double largest = 0;
    advance_stress of_elements = {0, 0};
    for (int i = 0; i < model_elements(m); i++)
        largest = larger(largest, advance_element(m, memory, s, i, dx, &of_elements));
    if (stress != NULL)
        *stress = of_elements;
    phases_lap(&eq->run->phases, PHASE_ELEMENTS);
    for (int i = 0; i < model_vertices(m); i++)
        if (model_vertex(m, i)->body == i)
            largest = larger(largest, advance_vertex(m, s, i, on_arcs, dx));
    for (int i = model_first_release(m); i < model_vertices(m); i++)
        largest = larger(largest, release_advance(m, s, i, dx));
    for (int i = 0; i < model_warps(m); i++) {
        s->warp[i] += dx[model_warp(m, i)];
        largest = larger(largest, fabs(dx[model_warp(m, i)]) * model_warp_length(m, i));
    }
    for (int d = 0; d < model_scene(m)->drivers; d++)
        if (model_driver_coordinate(m, d) != NONE)
            s->driver[d] += dx[model_driver_coordinate(m, d)];
        else if (model_scene(m)->driver[d].value != NULL)
            s->driver[d] = loads_driver_value(eq, &model_scene(m)->driver[d], path);
    kinematics_follow(m, s);
    s->path = path;
    return largest;
}

void advance_settle(const model *m, const linear_memory *memory, const model_state *s)
{
    const size_t n = (size_t)model_strains(m);
    for (int i = 0; i < model_elements(m); i++) {
        const model_slot w = linearise_slot(m, memory, i);
        memcpy(w.sigma, &s->sigma[(size_t)i * n], n * sizeof *w.sigma);
        memset(w.incompatibility, 0, n * sizeof *w.incompatibility);
    }
}

static status check_twist(const model *m, const model_state *s, fault *f)
{
    int index;
    const double twist = kinematics_largest_twist(m, s, &index);
    if (twist < PI / 4)
        return STATUS_OK;
    const int member = model_element(m, index)->member, first = model_first_element(m, member);
    return fault_set(
        f, STATUS_NOT_CONVERGED,
        "element %d of %d of %s is twisted by %.3g rad, more than the eighth of a turn up to which "
        "the torque of %s increases, at path %g; use more elements or smaller steps",
        index - first + 1, model_first_element(m, member + 1) - first,
        scene_called(model_scene(m), SCENE_MEMBERS, member).text, twist, model_type(m)->name,
        s->path);
}

/* Checks the rotation [rad] within an element: between its ends, and relative to the chord if the
 * formulation uses sines. */
static status check_elements(const model *m, const model_state *s, fault *f)
{
    const int quarter = (model_type(m)->limits & LIMIT_QUARTER_TURN) != 0;
    int index;
    const double turn = kinematics_largest_turn(m, s, quarter, &index);
    if (turn < (quarter ? PI / 2 : PI))
        return STATUS_OK;
    const int member = model_element(m, index)->member, first = model_first_element(m, member);
    return fault_set(
        f, STATUS_NOT_CONVERGED,
        "element %d of %d of %s has a relative rotation of %.3g rad at path %g, but %s is valid "
        "only below a %s turn per element; use more elements or smaller steps",
        index - first + 1, model_first_element(m, member + 1) - first,
        scene_called(model_scene(m), SCENE_MEMBERS, member).text, turn, s->path,
        model_type(m)->name, quarter ? "quarter" : "half");
}

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

static status check_tension_limit(const model *m, const model_state *s, fault *f)
{
    int worst = 0;
    double most = 0;
    for (int i = 0; i < model_elements(m); i++) {
        const double by = model_type(m)->tension(model_kind_of(m, i)->data,
                                                 s->sigma + (size_t)i * (size_t)model_strains(m));
        const mesh_element *el = model_element(m, i);
        if (by <= most || (swings(m, el, 0) && swings(m, el, el->nodes - 1)))
            continue;
        worst = i;
        most = by;
    }
    if (most < 1)
        return STATUS_OK;
    const int member = model_element(m, worst)->member, first = model_first_element(m, member),
              count = model_first_element(m, member + 1) - first;
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "element %d of %d of %s is too long for the axial force in it, by a factor of "
                     "%.4g, at path %g: %s loses its transverse stiffness; use %.0f elements "
                     "(twice as many for four times the force) or another formulation",
                     worst - first + 1, count,
                     scene_called(model_scene(m), SCENE_MEMBERS, member).text, most, s->path,
                     model_type(m)->name, floor(count * most) + 1);
}

status newton_check_rest(const model *m, fault *f)
{
    const double most = 2;
    int index;
    if (!(model_type(m)->limits & LIMIT_FLAT_ARC))
        return STATUS_OK;
    const double rise = kinematics_largest_rise(m, &index);
    if (rise < most)
        return STATUS_OK;
    const int member = model_element(m, index)->member, first = model_first_element(m, member),
              count = model_first_element(m, member + 1) - first;
    return fault_set(
        f, STATUS_NOT_CONVERGED,
        "the arc of element %d of %d of %s rises by %.3g radii of gyration of its section, but %s "
        "is accurate only below %g; use %.0f elements or another formulation",
        index - first + 1, count, scene_called(model_scene(m), SCENE_MEMBERS, member).text, rise,
        model_type(m)->name, most, floor(count * sqrt(rise / most)) + 1);
}

/* Returns 1 if the rotation of a spring is near a full revolution and its moment has a component
 * normal to the rotation axis, whose effect is then unbounded. */
static int across(const mesh_discrete *d, const double turn[3])
{
    const double near = 1e-3, size = vec3_norm(turn);
    const double e[SPRING_STRAINS] = {0, 0, 0, turn[0], turn[1], turn[2]};
    double sigma[SPRING_STRAINS], aside[3];
    const double *moment = sigma + 3;
    if (!turns_full(size, near))
        return 0;
    spring_law(d->spring, e, sigma, NULL);
    vec3_cross(turn, moment, aside);
    return vec3_norm(aside) > 1e-6 * size * vec3_norm(moment);
}

static status check_springs(const model *m, const model_state *from, const model_state *s, fault *f)
{
    for (int i = 0; i < model_springs(m); i++) {
        const double *turn = turns_of_spring(m, s, i);
        if (turns_swung(turns_of_spring(m, from, i), turn) ||
            across(model_discrete(m, model_discretes(m) - model_springs(m) + i), turn))
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "%s has rotated by %.4g rad at path %g: after a full turn about a "
                             "changing axis, or under a moment perpendicular to its rotation, its "
                             "rotation vector has no defined direction; fix the other rotations, "
                             "use smaller steps, or put two springs in series",
                             model_spring_called(m, i).text, vec3_norm(turn), s->path);
    }
    return STATUS_OK;
}

static double driven_by(const model *m, const model_state *from, const model_state *s, int node)
{
    const mesh_vertex *v = model_vertex(m, node);
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        const int driver =
            v->vector_driver[0] != NONE ? v->vector_driver[k] : model_scene(m)->node[node].angle[k];
        if (driver >= 0)
            largest = fmax(largest, fabs(s->driver[driver] - from->driver[driver]));
    }
    return largest;
}

static status check_rotations(const model *m, const model_state *from, const model_state *s,
                              fault *f)
{
    for (int i = 0; i < model_scene(m)->nodes; i++) {
        const double most = model_vertex(m, i)->vector_driver[0] != NONE ? PI : 2 * PI,
                     step = driven_by(m, from, s, i);
        if (!(step < most * (1 + 1e-9)))
            return fault_set(f, STATUS_NOT_CONVERGED,
                             "%s is driven by %.3g rad in one step at path %g; use smaller steps",
                             scene_called(model_scene(m), SCENE_NODES, i).text, step, s->path);
    }
    return STATUS_OK;
}

status newton_accept(const model *m, const model_state *from, model_state *s, fault *f)
{
    TRY(check_elements(m, s, f));
    if (model_type(m)->limits & LIMIT_EIGHTH_TWIST)
        TRY(check_twist(m, s, f));
    if (model_type(m)->limits & LIMIT_TENSION)
        TRY(check_tension_limit(m, s, f));
    TRY(check_springs(m, from, s, f));
    TRY(check_rotations(m, from, s, f));
    turns_lose(m, from, s);
    return STATUS_OK;
}

typedef struct correction_sizes {
    double last, first, largest; /* largest: largest correction after the first one */
    int growing;                 /* number of successive growing corrections */
} correction_sizes;

/* Limits of a correction (rotations in rad, translations relative to model_length) above which a
 * step ends as NOT_CONVERGED. too_large_at_first applies to the first corrections of a step.
 * GROWING successive growing corrections also end the step. */
static const double too_large = 4, too_large_at_first = 16;
enum { AT_FIRST = 3, GROWING = 4, MOST_IN_TIME = 20 };

static status give_up(const newton_use *use, const newton_correction *one, const char *why,
                      int iteration, fault *f)
{
    char at[40];
    snprintf(at, sizeof at, use->on == NULL ? "%g s" : "path %g", one->at);
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "Newton's method %s at %s: correction %.1e in iteration %d; use %s", why, at,
                     one->size, iteration,
                     use->on == NULL
                         ? "a smaller step or tolerance"
                         : "smaller steps, or a continuation if the load passes a maximum");
}

static void add_correction(correction_sizes *w, double correction, int iteration)
{
    if (iteration == 1)
        w->first = correction;
    else
        w->largest = fmax(w->largest, correction);
    w->growing = correction > w->last && iteration > 2 ? w->growing + 1 : 0;
    w->last = correction;
}

static status check_corrections(const newton_use *use, const correction_sizes *w,
                                const newton_correction *one, int iteration, fault *f)
{
    if (!isfinite(w->last))
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "the corrections of Newton's method are NaN or Inf; use smaller steps");
    if (w->last > too_large_at_first || (iteration > AT_FIRST && w->last > too_large) ||
        w->growing >= GROWING)
        return give_up(use, one, "diverged", iteration, f);
    return iteration == use->most ? give_up(use, one, "did not converge", iteration, f) : STATUS_OK;
}

static status check_largest_correction(const newton_use *use, const correction_sizes *w,
                                       double path, fault *f)
{
    const double largest_reliable = 0.5, behind_first = 2;
    if (use->on == NULL || w->largest <= largest_reliable || w->largest <= behind_first * w->first)
        return STATUS_OK;
    return fault_set(
        f, STATUS_NOT_CONVERGED,
        "at path %g the corrections of Newton's method reached %.2g rad or lengths, so another "
        "equilibrium may have been found; use smaller steps or a continuation",
        path, w->largest);
}

static status accept(const newton_use *use, fault *f)
{
    if (use->on != NULL)
        TRY(newton_accept(use->on->c->model, use->on->backup, use->on->state, f));
    return use->accept != NULL ? use->accept(use->of, f) : STATUS_OK;
}

newton_use newton_on_path(newton_run *n, void *of,
                          status (*correct)(void *, int, newton_correction *, step_record *,
                                            fault *))
{
    return (newton_use){.of = of, .on = n, .most = n->max_iterations, .correct = correct};
}

newton_use newton_in_time(const analysis_context *c, void *of,
                          status (*correct)(void *, int, newton_correction *, step_record *,
                                            fault *),
                          void (*prepare)(void *, int, double))
{
    const int requested = c->options->max_iterations;
    return (newton_use){.of = of,
                        .most = requested > 0 ? requested : MOST_IN_TIME,
                        .correct = correct,
                        .prepare = prepare};
}

status newton_iterate(analysis_context *c, const newton_use *use, newton_convergence *a,
                      step_record *record, fault *f)
{
    correction_sizes w = {INFINITY, INFINITY, 0, 0};
    for (int iteration = 1;; iteration++) {
        newton_correction one = {.energy = NAN};
        TRY(stop_check(f));
        TRY(use->correct(use->of, iteration, &one, record, f));
        c->run->counters.iterations++;
        newton_convergence_add(one.size, &one.stress, iteration == 1, a);
        record->remaining = a->remaining;
        const iteration_record kept = {.correction = one.size,
                                       .incompatibility = record->incompatibility};
        TRY(history_add_iteration(c->result, record, &kept, one.energy, f));
        add_correction(&w, one.size, iteration);
        if (newton_converged(a) && iteration >= use->least) {
            TRY(accept(use, f));
            return check_largest_correction(use, &w, one.at, f);
        }
        TRY(check_corrections(use, &w, &one, iteration, f));
        if (use->prepare != NULL)
            use->prepare(use->of, iteration, one.size);
    }
}
