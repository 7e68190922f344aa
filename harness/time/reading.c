#include "harness/time/time_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "cases/scene/scene.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

typedef struct read_state {
    quantity_state as;
    const reading *from;
    inertia_resultants_motion motion;
    internal_state section;
    status *outcome; /* status of the first force whose computation failed; OK: none */
    fault *f;
} read_state;

static const read_state *of(const quantity_state *s)
{
    return (const read_state *)s;
}

static const model *model_of(const quantity_state *s)
{
    return of(s)->from->eq->m;
}

static double component_of(const quantity_state *s, int node, int component)
{
    return kinematics_component(model_of(s), of(s)->from->state, node, component);
}

static double relative_of(const quantity_state *s, int from, int node, int component)
{
    return kinematics_relative(model_of(s), of(s)->from->state, from, node, component);
}

static void frame_of(const quantity_state *s, int node, double place[3], double R[9])
{
    double turn[4];
    kinematics_frame(model_of(s), of(s)->from->state, node, place, turn);
    rotation_matrix(turn, R);
}

/* Returns a component of the velocity of a node, or of its angular velocity in the axes of the body
 * that moves the node. */
static double rate_of(const quantity_state *s, int node, int component)
{
    const model *m = model_of(s);
    const model_state *state = of(s)->from->state;
    const int moved_by = model_body(m, node);
    frame_rates body;
    forms_rates(m, state, moved_by, of(s)->from->v, NULL, &body);
    if (component >= SCENE_RX) {
        double own[3];
        mat3_transpose_mul_vec(body.R, body.w, own);
        return own[component - SCENE_RX];
    }
    double rho[3], carried[3];
    kinematics_offset(m, state, node, rho);
    vec3_cross(body.w, rho, carried);
    return body.v[component] + (moved_by == node ? 0 : carried[component]);
}

static double acceleration_of(const quantity_state *s, int node, int component)
{
    const reading *from = of(s)->from;
    frame_rates at;
    vertex_rates(model_of(s), from->state, node, from->v, from->a, &at);
    if (component < SCENE_RX)
        return at.a[component];
    double own[3];
    mat3_transpose_mul_vec(at.R, at.wd, own);
    return own[component - SCENE_RX];
}

static double driver_of(const quantity_state *s, int driver)
{
    return kinematics_driver_value(model_of(s), of(s)->from->state, driver);
}

static double released_of(const quantity_state *s, int member, int end, int component)
{
    return release_value(model_of(s), of(s)->from->state, member, end, component);
}

static double linear_component(const quantity_state *s, int node, int component)
{
    const double *x = of(s)->from->x;
    int index[6];
    double T[36], sum = 0;
    const int n = kinematics_node_jacobian(model_of(s), NULL, node, 6, index, T);
    for (int k = 0; k < n; k++)
        sum += T[component * n + k] * x[index[k]];
    return sum;
}

static double linear_released(const quantity_state *s, int member, int end, int component)
{
    const model *m = model_of(s);
    const scene_member *of_member = &model_scene(m)->member[member];
    double by[3];
    double value =
        release_linear_value(m, kinematics_rest(m), of(s)->from->x, member, end, component, by);
    for (int i = 0; i < 3; i++)
        if (by[i] != 0)
            value += by[i] * linear_component(s, end ? of_member->q : of_member->p, SCENE_RX + i);
    return value;
}

/* Returns the value if the outcome is OK. Otherwise stores the outcome, unless an earlier one is
 * stored. */
static double known(const quantity_state *s, status outcome, const double *value)
{
    if (outcome != STATUS_OK && *of(s)->outcome == STATUS_OK)
        *of(s)->outcome = outcome;
    return outcome == STATUS_OK ? *value : NAN;
}

static status reaction_in(const read_state *s, int node, int component, double *out, fault *f)
{
    const equations *eq = s->from->eq;
    double F[6], L[6];
    linearise_node_force(eq, s->section.s, s->section.sigma, node, F);
    loads_at_node(eq, s->section.s, s->section.path, node, L);
    if (s->section.moving != NULL) {
        TRY(inertia_resultants_node(eq->m, s->section.s, &s->motion, node, F, f));
        TRY(dashpots_at_node(eq->m, s->section.s, s->motion.v, node, F, f));
    }
    *out = loads_reaction(eq->m, node, component, F, L);
    return STATUS_OK;
}

static double reaction_of(const quantity_state *s, int node, int component)
{
    double out = NAN;
    return known(s, reaction_in(of(s), node, component, &out, of(s)->f), &out);
}

static const int value_of[SCENE_RESULTANTS] = {[SCENE_N] = SPAN_N,
                                               [SCENE_QY] = SPAN_QY,
                                               [SCENE_QZ] = SPAN_QZ,
                                               [SCENE_MX] = SPAN_MX,
                                               [SCENE_MY] = SPAN_MY,
                                               [SCENE_MZ] = SPAN_MZ,
                                               [SCENE_BIMOMENT] = SPAN_BIMOMENT,
                                               [SCENE_MX_SAINT_VENANT] = SPAN_MX_SAINT_VENANT,
                                               [SCENE_MX_WARPING] = SPAN_MX_WARPING,
                                               [SCENE_MX_WAGNER] = SPAN_MX_WAGNER};

typedef struct chosen_resultants {
    scene_resultant resultant;
    double sign;
} chosen_resultants;

static double measured(void *context, int element, double x, const double resultants[])
{
    (void)element;
    (void)x;
    const chosen_resultants *what = context;
    const double value = resultants[value_of[what->resultant]];
    return what->sign != 0 ? what->sign * value : fabs(value);
}

static status resultant_in(const equations *eq, const scene_internal *what, const internal_state *s,
                           double *out, fault *f)
{
    double all[SPAN_VALUES];
    if (what->along != SCENE_ALONG_PLACE) {
        static const double sign[] = {
            [SCENE_ALONG_MAX] = 1, [SCENE_ALONG_MIN] = -1, [SCENE_ALONG_LARGEST] = 0};
        chosen_resultants of = {what->resultant, sign[what->along]};
        TRY(internal_largest(eq, s, what->member, measured, &of, out, f));
        *out *= of.sign < 0 ? -1 : 1;
        return STATUS_OK;
    }
    if ((what->place == 0 || what->place == 1) && what->resultant <= SCENE_BIMOMENT)
        internal_at_end(eq, s, what->member, what->place == 1, all);
    else
        TRY(internal_at(eq, s, &(internal_place){what->member, what->place, what->before}, all, f));
    *out = all[value_of[what->resultant]];
    return STATUS_OK;
}

static double internal_in(const quantity_state *s, const scene_internal *what)
{
    double out = NAN;
    return known(s, resultant_in(of(s)->from->eq, what, &of(s)->section, &out, of(s)->f), &out);
}

static double stress_in(const quantity_state *s, const scene_stress *what)
{
    static const stress_measure measure[] = {[SCENE_VON_MISES] = STRESS_VON_MISES,
                                             [SCENE_NORMAL_MAX] = STRESS_NORMAL_MAX,
                                             [SCENE_NORMAL_MIN] = STRESS_NORMAL_MIN};
    const equations *eq = of(s)->from->eq;
    const internal_place at = {what->member, what->place, what->before};
    double out = NAN;
    const status outcome =
        what->whole
            ? internal_stress_largest(eq, &of(s)->section, what->member, measure[what->measure],
                                      &out, of(s)->f)
            : internal_stress_at(eq, &of(s)->section, &at, measure[what->measure], &out, of(s)->f);
    return known(s, outcome, &out);
}

static double deflection_in(const quantity_state *s, const scene_deflection *what)
{
    double moved[6];
    const status outcome = internal_moved(of(s)->from->eq, &of(s)->section, what->member,
                                          what->place, moved, of(s)->f);
    return known(s, outcome, &moved[what->component]);
}

static double balance_in(const quantity_state *s, scene_balance what)
{
    return of(s)->from->balance[what];
}

static double compliance_in(const quantity_state *s, int row, int column)
{
    return of(s)->from->compliance[6 * row + column];
}

static void inertia_at_ends(const void *context, int element, double ends[2][7])
{
    const read_state *s = context;
    inertia_resultants_ends(s->from->eq->m, s->from->state, &s->motion, element, ends);
}

static void inertia_along(const void *context, int element, double density[ELEMENT_MAX_NODES][6])
{
    const read_state *s = context;
    inertia_resultants_along(s->from->eq->m, s->from->state, &s->motion, element, density);
}

int reading_is_kinematic(const scene_quantity *q)
{
    return quantity_type_of(q)->read != NULL && !scene_reads_forces(q) &&
           q->what.kind != SCENE_BALANCE;
}

int reading_is_slope(const scene_quantity *q)
{
    return q->what.kind == SCENE_RATE && q->what.of.rated.rate == SCENE_JERK;
}

/* Returns the size of the positions whose rounding errors affect the rates of a node. turns 1:
 * rotation [rad]; 0: displacement of the frame that moves the node plus its rotation times the arm
 * [m]. */
static double place_size(const model *m, const model_state *s, int node, int turns)
{
    const int body = model_body(m, node);
    const mesh_vertex *v = model_vertex(m, body);
    double moved = 0, turned = 0, rho[3];
    for (int k = 0; k < 3; k++) {
        const int free[2] = {v->coordinate[k], v->coordinate[SCENE_RX + k]};
        if (free[0] != NONE && free[0] < model_unknowns(m))
            moved = hypot(moved, s->u[3 * body + k]);
        if (free[1] != NONE && free[1] < model_unknowns(m))
            turned = hypot(turned, v->angles > 0 ? s->angle[3 * body + k] : s->q[4 * body + 1 + k]);
    }
    if (turns)
        return turned;
    kinematics_offset(m, s, node, rho);
    return moved + (node != body ? vec3_norm(rho) * turned : 0);
}

double reading_rounding(const model *m, const scene_quantity *q, const model_state *s, double h)
{
    if (q->what.kind != SCENE_RATE || q->what.of.rated.rate == SCENE_SPEED)
        return 0;
    const scene_component *of = scene_component_of(q);
    const int third = q->what.of.rated.rate == SCENE_JERK;
    /* derivatives of the polynomial's rates with respect to the increment are at most 6/h^2 and
     * 60/h^3 */
    return (third ? 60 : 6) * DBL_EPSILON * place_size(m, s, of->node, of->component >= SCENE_RX) /
           pow(h, third ? 3 : 2);
}

static quantity_state places_of(const reading *from)
{
    const int linear = from->x != NULL, moves = from->v != NULL;
    return (quantity_state){.component = linear ? linear_component : component_of,
                            .relative = linear ? NULL : relative_of,
                            .frame = linear ? NULL : frame_of,
                            .rate = moves ? rate_of : NULL,
                            .acceleration = moves ? acceleration_of : NULL,
                            .driver = driver_of,
                            .released = linear ? linear_released : released_of};
}

double reading_of(const model *m, const scene_quantity *q, const model_state *s, const double v[],
                  const double a[])
{
    const equations eq = {.m = m};
    const reading from = {.eq = &eq, .state = s, .v = v, .a = a};
    const read_state state = {.as = places_of(&from), .from = &from};
    return quantity_type_of(q)->read(q, &state.as);
}

/* Reads a quantity. a: accelerations plus forces of mass-proportional damping divided by the
 * mass. */
static status read_whole(const reading *from, const scene_quantity *q, const double a[],
                         double *out, fault *f)
{
    status outcome = STATUS_OK;
    const int moves = from->v != NULL;
    const double at = from->x != NULL       ? 1
                      : from->state != NULL ? kinematics_state_path(from->state)
                                            : NAN,
                 path = from->before ? discontinuities_before(from->eq->m, at) : at;
    read_state s = {.as = places_of(from),
                    .from = from,
                    .motion = {from->v, a, moves && model_spreads(from->eq->m, q->analysis)},
                    .section = {from->state, from->sigma, from->x, path, NULL},
                    .outcome = &outcome,
                    .f = f};
    const internal_inertia inertia = {inertia_at_ends, inertia_along, &s};
    s.section.moving = moves ? &inertia : NULL;
    if (moves && scene_reads_forces(q))
        feedback_take(from->eq, from->state, from->v, path);
    s.as.path = path;
    s.as.reaction = scene_reads_forces(q) ? reaction_of : NULL;
    s.as.internal = scene_reads_forces(q) ? internal_in : NULL;
    s.as.stress = scene_reads_forces(q) ? stress_in : NULL;
    s.as.deflection = scene_reads_forces(q) ? deflection_in : NULL;
    s.as.balance = from->balance != NULL ? balance_in : NULL;
    s.as.compliance = from->compliance != NULL ? compliance_in : NULL;
    *out = quantity_type_of(q)->read(q, &s.as);
    return outcome;
}

status reading_whole(const reading *from, const scene_quantity *q, double *out, fault *f)
{
    const model *m = from->eq->m;
    const double damping = model_scene(m)->analysis[q->analysis].damping.mass;
    if (from->v == NULL || from->a == NULL || damping == 0 || !scene_reads_forces(q))
        return read_whole(from, q, from->a, out, f);
    const int all = model_all_coordinates(m);
    double *a = malloc(((size_t)all + 1) * sizeof *a);
    if (a == NULL)
        return fault_memory(f, "the forces of a state");
    for (int k = 0; k < all; k++)
        a[k] = from->a[k] + damping * from->v[k];
    const status outcome = read_whole(from, q, a, out, f);
    free(a);
    return outcome;
}
