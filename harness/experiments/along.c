/* Checks of loads along one element in linear theory. The expected values are those of the
 * Timoshenko beam (Przemieniecki, Theory of Matrix Structural Analysis, 1968, sec. 5 and 10). The
 * flexibilities in these values are measured on the element, with loads at its end. */
#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "harness/analysis/analysis.h"
#include "harness/model/model.h"

enum { SIX = 6, END = 1 };

static const double L = 0.7, force = 3, moment = 2; /* [m, N/m, N m/m] */
static const double rounding = 1e-8;

typedef enum support { CANTILEVER, CLAMPED, PROPPED, HINGED, SUPPORTS } support;
static const char *const support_name[SUPPORTS] = {
    "clamped at its first node", "clamped at both nodes",
    "clamped at one node and propped at the other", "hinged at both nodes"};
/* held[support][node]: bit c is set if component c of the node is fixed. */
static const unsigned held[SUPPORTS][2] = {{63, 0}, {63, 63}, {63, 15}, {15, 7}};

/* For each bending plane: index of the displacement, index of the rotation, and sign of the
 * rotation that corresponds to a positive slope. */
static const struct {
    int shift, turn, sign;
} planes[2] = {{1, 5, 1}, {2, 4, -1}};

/* Flexibilities of the section: axial 1/EA [1/N], twist 1/GIt [1/(N m^2)] and, for each bending
 * plane, bend 1/EI [1/(N m^2)] and shear 1/GA_s [1/N]. */
typedef struct softness {
    double axial, twist, bend[2], shear[2];
} softness;

/* For each node and component: the displacement or rotation or, if the component is fixed, the
 * reaction. */
typedef struct ends {
    double of[2][SIX];
} ends;

static void make_scene(support of, scene *s)
{
    const double y[3] = {0, 1, 0};
    section_spec spec = section_spec_rectangle(70e3, 27e3, 0.3, 0.2);
    spec.given.Iw = 0;
    spec.shear_factor[0] = 5.0 / 6;
    spec.shear_factor[1] = 0.4;
    scene_init(s, "along");
    const int profile = scene_add_section(s, &spec), from = scene_add_node(s, 0, 0, 0),
              to = scene_add_node(s, L, 0, 0);
    scene_add_member(s, from, to, profile, y);
    for (int node = 0; node < 2; node++)
        for (int c = 0; c < SIX; c++)
            if (held[of][node] >> c & 1)
                scene_hold(s, node, c, c);
    scene_omit(s, SCENE_OMITTABLE & ~(unsigned)(FEATURE_WARPING | FEATURE_SHEAR));
}

static void ask(scene *s, int analysis, int number, scene_extract what)
{
    char name[SCENE_NAME];
    snprintf(name, sizeof name, "v%d", number);
    scene_add_quantity(s, name, "1", analysis, what);
}

static status solve(const formulation *chosen, const scene *s, double value[], fault *f)
{
    const model_request what = {s, chosen->type, chosen->option, 1, 0, 0};
    const solve_options options = {.newton = formulation_newton(chosen)};
    solve_result found = {0};
    model *m = NULL;
    status outcome = scene_validate(s, f);
    if (outcome == STATUS_OK)
        outcome = model_alloc(&what, &m, f);
    if (outcome == STATUS_OK) {
        outcome = solve_scene(s, m, &options, &found, f);
        for (int i = 0; i < found.quantities && outcome == STATUS_OK; i++)
            value[i] = found.quantity[i].value;
        result_free(&found);
    }
    model_free(m);
    return outcome;
}

/* Returns the shear flexibility of the section in a plane [1/N]; 0: the formulation has no shear
 * deformation in this plane. */
static double shear_of(const formulation *chosen, const section *c, int plane)
{
    const int rigid = !(chosen->type->offers & FEATURE_SHEAR) ||
                      (plane == 0 && (chosen->type->lacks & LACKS_SHEAR_Y));
    return rigid ? 0 : c->F[4 * plane] / c->shear_modulus;
}

/* Measures the flexibilities of one element as a cantilever. REFUSED: the element is not exact for
 * forces and moments at its end. */
static status measure(const formulation *chosen, softness *out, fault *f)
{
    double C[SIX * SIX];
    section c = {0};
    scene s;
    make_scene(CANTILEVER, &s);
    const int analysis = scene_add_compliance(&s, SCENE_NONE, (scene_compliance){.node = END});
    for (int i = 0; i < SIX * SIX; i++)
        ask(&s, analysis, i, scene_compliance_entry(i / SIX, i % SIX));
    status outcome = solve(chosen, &s, C, f);
    if (outcome == STATUS_OK)
        outcome = scene_constants(&s, 0, &c, f);
    scene_free(&s);
    TRY(outcome);
    out->axial = C[0] / L;
    out->twist = C[3 * SIX + 3] / L;
    for (int k = 0; k < 2; k++) {
        const int v = planes[k].shift, t = planes[k].turn;
        const double tip = C[t * SIX + t] * L * L / 3, cross = planes[k].sign * C[v * SIX + t];
        out->bend[k] = C[t * SIX + t] / L;
        out->shear[k] = shear_of(chosen, &c, k);
        const double shift = C[v * SIX + v] / (tip + out->shear[k] * L) - 1,
                     slope = cross / (out->bend[k] * L * L / 2) - 1;
        if (!(fabs(shift) < rounding && fabs(slope) < rounding))
            return fault_set(f, STATUS_REFUSED,
                             "one element is not exact under a force along %c at its end "
                             "(errors relative to a beam with its flexibility in pure bending "
                             "and the shear flexibility of the section: displacement %.2g, "
                             "rotation %.2g)",
                             "yz"[k], shift, slope);
    }
    return STATUS_OK;
}

static void exact_along(support of, double soft, double load, int c, ends *out)
{
    const int both = held[of][END] >> c & 1;
    out->of[END][c] = both ? -load * L / 2 : load * L * L / 2 * soft;
    out->of[0][c] = both ? -load * L / 2 : -load * L;
}

/* Computes the exact displacements and reactions in bending plane k by the force method. along,
 * turning: uniform force [N/m] and moment [N m/m]. The redundants R and M are the force and the
 * moment of the support at the end of the cantilever. If both ends are hinged, the root of the
 * cantilever rotates as well. */
static void exact_across(support of, const softness *soft, int k, double along, double turning,
                         ends *out)
{
    const double bend = soft->bend[k], shear = soft->shear[k],
                 vv = L * L * L / 3 * bend + shear * L, vt = L * L / 2 * bend, tt = L * bend,
                 sign = planes[k].sign,
                 v = along * (L * L * L * L / 8 * bend + L * L / 2 * shear) +
                     turning * L * L * L / 3 * bend,
                 t = along * L * L * L / 6 * bend + turning * L * L / 2 * bend;
    double R = 0, M = 0, root = 0;
    if (of == CLAMPED) {
        const double det = vv * tt - vt * vt;
        R = -(tt * v - vt * t) / det;
        M = -(vv * t - vt * v) / det;
    } else if (of == PROPPED) {
        R = -v / vv;
    } else if (of == HINGED) {
        R = -(along * L / 2 + turning);
        root = -(v + vv * R) / L;
    }
    double *begin = out->of[0], *end = out->of[END];
    const int y = planes[k].shift, z = planes[k].turn;
    begin[y] = -(along * L + R);
    begin[z] = sign * (of == HINGED ? root : -(along * L * L / 2 + turning * L + R * L + M));
    end[y] = of == CANTILEVER ? v : R;
    end[z] = sign * (of == CLAMPED ? M : t + vt * R + root);
}

static ends exact_ends(support of, const softness *soft, const double q[SIX])
{
    ends out;
    exact_along(of, soft->axial, q[0], 0, &out);
    exact_along(of, soft->twist, q[3], 3, &out);
    for (int k = 0; k < 2; k++)
        exact_across(of, soft, k, q[planes[k].shift], planes[k].sign * q[planes[k].turn], &out);
    return out;
}

static status found_ends(const formulation *chosen, support of, const double q[SIX], ends *out,
                         fault *f)
{
    scene s;
    make_scene(of, &s);
    scene_add_load(&s, SCENE_DISTRIBUTED, 0, q[0], q[1], q[2]);
    scene_add_load(&s, SCENE_DISTRIBUTED_MOMENT, 0, q[3], q[4], q[5]);
    const int analysis = scene_add_linear(&s);
    for (int i = 0; i < 2 * SIX; i++)
        ask(&s, analysis, i,
            held[of][i / SIX] >> i % SIX & 1 ? scene_reaction(i / SIX, i % SIX)
                                             : scene_coordinate(i / SIX, i % SIX));
    const status outcome = solve(chosen, &s, out->of[0], f);
    scene_free(&s);
    return outcome;
}

/* Returns the magnitude of a displacement or reaction of a cantilever under the loads `force` and
 * `moment`. Errors are relative to this magnitude. */
static double size_of(const softness *soft, int component, int reaction)
{
    const ends of =
        exact_ends(CANTILEVER, soft, (const double[]){force, force, force, moment, moment, moment});
    const int turns = component >= 3;
    if (reaction)
        return turns ? force * L * L / 2 + moment * L : force * L + moment;
    return fabs(of.of[END][component]);
}

static void compare(const formulation *chosen, support of, const softness *soft,
                    const double q[SIX], check_result *one)
{
    ends found;
    fault f = {""};
    const ends right = exact_ends(of, soft, q);
    if (found_ends(chosen, of, q, &found, &f) != STATUS_OK) {
        checks_require(one, 0,
                       "distributed loads: one element %s has no solution (%s); correct the "
                       "functions of the element",
                       support_name[of], f.text);
        return;
    }
    for (int i = 0; i < 2 * SIX; i++) {
        const int node = i / SIX, c = i % SIX, reaction = held[of][node] >> c & 1;
        const double a = found.of[node][c], b = right.of[node][c];
        char words[TEST_ELEMENT_WORDS];
        checks_deviation(
            one, fabs(a - b) / size_of(soft, c, reaction),
            "distributed loads: in one element %s, the %s%s is %.9g instead of %.9g; if a check of "
            "'states' fails, correct the stiffness that it names; otherwise compute the strains "
            "from r and R of node_state, with the x axis along the undeformed element",
            support_name[of], reaction ? "reaction to the " : "",
            test_element_coordinate(&(const test_element){.nodes = 2}, NODE_COORDINATES * node + c,
                                    words),
            a, b);
    }
}

enum { X = ELEMENT_ALONG_COORDINATES, M = TEST_ELEMENT_STRAINS, RELAXATIONS = 40, FINER = 50 };

typedef struct taken {
    const test_element *s;
    const node_state *x;
    double q[3 * ELEMENT_ALONG_POINTS];
    double *inner;
} taken;

static status forces_under(const taken *of, const node_state x[], double F[X], double K[X * X])
{
    const test_element *s = of->s;
    const element_data *data = s->data;
    const double none[M] = {0};
    double e[M], J[M * X], sigma[M], C[M * M], mixed[3 * M], H[X * X], cross[M * X], both[X * X],
        inner[TEST_ELEMENT_INNER], memory[TEST_ELEMENT_MEMORY], work[M * X];
    along_output out = {.force = of->q,
                        .e = e,
                        .inner = inner,
                        .sigma = sigma,
                        .C = C,
                        .memory = s->memory > 0 ? memory : NULL,
                        .mixed = mixed,
                        .H = H};
    status outcome = STATUS_OK;
    s->type.strain(data, x, &(strain_output){.e = e, .J = J, .history = s->history});
    memcpy(inner, of->inner, (size_t)s->inner * sizeof *inner);
    for (int i = 0; i < RELAXATIONS; i++) {
        s->type.along(1, &data, x, &out, &outcome);
        if (outcome != STATUS_OK || s->inner == 0 || s->type.update == NULL ||
            s->type.update(data, none, memory, inner) < 1e-15)
            break;
    }
    TRY(outcome);
    s->type.along(1, &data, x, &out, &outcome);
    memset(F, 0, X * sizeof *F);
    dense_add_transpose_mul(X, s->strains, 1, J, sigma, F);
    dense_add_transpose_mul(X, 3, 1, out.turn, out.moment, F);
    for (int i = 0; i < X; i++)
        F[i] -= out.ends[i];
    if (K == NULL)
        return outcome;
    memcpy(of->inner, inner, (size_t)s->inner * sizeof *inner);
    s->type.strain(data, x, &(strain_output){.s = sigma, .H = K, .history = s->history});
    dense_add_congruence(s->strains, X, J, C, K, work);
    dense_add_congruence(3, X, out.turn, out.second, K, work);
    memset(both, 0, sizeof both);
    dense_mul(s->strains, 3, X, mixed, out.turn, cross);
    dense_add_transpose_mul(X, s->strains, X, J, cross, both);
    for (int i = 0; i < X; i++)
        for (int j = 0; j < X; j++)
            K[i * X + j] += H[i * X + j] + both[i * X + j] + both[j * X + i];
    return outcome;
}

static int forces_of(const void *context, int i, double si, int j, double sj, double values[])
{
    const taken *of = context;
    node_state x[ELEMENT_MAX_NODES];
    test_element_moved(&(test_element_stencil){of->s, of->x}, i, si / FINER, j, sj / FINER, x);
    return (int)forces_under(of, x, values, NULL);
}

static void check_taken(const test_element *s, check_results *c)
{
    static const double turn[3] = {0.5, -0.6, 0.7};
    const double l = s->request.length;
    double K[X * X], F[X], found[X][X], none[M] = {0}, inner[TEST_ELEMENT_INNER], C[M * M],
                                        size = 0;
    node_state bent[ELEMENT_MAX_NODES], x[ELEMENT_MAX_NODES];
    taken of = {.s = s, .x = x, .inner = inner};
    if (s->type.along == NULL || s->nodes != 2)
        return;
    checks_current(c, "along%s", s->words);
    test_element_rest(s, inner);
    if (test_element_converged(s, none, inner, &(stress_output){.C = C}) != STATUS_OK)
        return;
    for (int i = 0; i < s->strains && i < SIX; i++)
        size = size > 0 ? fmin(size, C[i * (s->strains + 1)]) : C[i * (s->strains + 1)];
    for (int i = 0; i < 3 * ELEMENT_ALONG_POINTS; i++)
        of.q[i] = 0.01 * size * cos(1 + 2.3 * i);
    test_element_state(s, 0.0002, 5, bent);
    test_element_rigid_motion(s, turn, bent, x);
    check_result *derives = checks_open(
                     c, "K is the derivative of the forces under a distributed load", 1e-7),
                 *sums = checks_open(c, "the nodal forces add up to the distributed load", 1e-9);
    test_element_rest(s, inner);
    status outcome = forces_under(&of, x, F, K);
    for (int a = 0; a < X && outcome == STATUS_OK; a++)
        outcome = stencil_first(forces_of, &of, X, a, found[a]) ? STATUS_NOT_CONVERGED : STATUS_OK;
    checks_require(derives, outcome == STATUS_OK,
                   "along: the status under a small load is '%s'; correct 'along' or 'update'%s",
                   status_name(outcome), s->words);
    for (int a = 0; a < X && outcome == STATUS_OK; a++)
        for (int b = 0; b < X; b++) {
            const double ua = test_element_unit(s, a), ub = test_element_unit(s, b),
                         change = (found[a][b] * ub + found[b][a] * ua) * FINER / 2,
                         scale = sqrt(fabs(K[a * (X + 1)] * K[b * (X + 1)]));
            checks_deviation(
                derives, fabs(K[a * X + b] - change / (ua * ub)) / fmax(scale, size * l * l),
                "along: the derivative of nodal force %d with respect to coordinate %d is %.6g, "
                "but finite differences give %.6g; correct C, mixed, H or second%s",
                a + 1, b + 1, K[a * X + b], change / (ua * ub), s->words);
        }
    double point[ELEMENT_ALONG_POINTS], weight[ELEMENT_ALONG_POINTS];
    quadrature_points(ELEMENT_ALONG_POINTS, point, weight);
    for (int i = 0; i < 3 && outcome == STATUS_OK; i++) {
        double load = 0;
        for (int j = 0; j < ELEMENT_ALONG_POINTS; j++)
            load += l * weight[j] * of.q[3 * j + i];
        checks_deviation(sums, fabs(F[i] + F[NODE_COORDINATES + i] + load) / (size * l),
                         "along: the nodal forces along %c add up to %.6g instead of the load "
                         "%.6g; correct 'along'%s",
                         "xyz"[i], -F[i] - F[NODE_COORDINATES + i], load, s->words);
    }
}

void checks_along(const formulation *chosen, check_results *out)
{
    test_elements_each(chosen, out, check_taken);
    test_elements_each(chosen, out, own_line_check);
    static const struct {
        const char *name;
        double q[SIX];
    } load[] = {
        {"uniformly distributed force and torque on one element", {force, force, force, moment}},
        {"uniformly distributed bending moments on one element", {0, 0, 0, 0, moment, moment}}};
    softness soft = {0};
    fault f = {""};
    checks_current(out, "one element as a cantilever");
    const status outcome =
        chosen->type->line != NULL
            ? fault_set(&f, STATUS_REFUSED,
                        "the element defines its motion between the nodes with 'line'")
            : measure(chosen, &soft, &f);
    for (size_t i = 0; i < sizeof load / sizeof load[0]; i++) {
        if (outcome != STATUS_OK) {
            checks_not_made(out, load[i].name, f.text);
            continue;
        }
        for (support of = 0; of < SUPPORTS; of++) {
            checks_current(out, "one element %s under distributed loads", support_name[of]);
            compare(chosen, of, &soft, load[i].q, checks_open(out, load[i].name, rounding));
        }
    }
}
