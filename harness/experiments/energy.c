/* Compares the stress with finite differences of the energy, and the stiffness with finite
 * differences of the stress. Also checks the geometric stiffness. */
#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

enum { ENERGY_M = TEST_ELEMENT_STRAINS };

static const double moved_by = 0.02; /* size of the strains, in element lengths */

typedef struct energy_place {
    const test_element *s;
    const double *e, *inner;
} energy_place;

static double unit_of(const test_element *s)
{
    return s->request.length / 20;
}

/* Computes the stress after changes of strains i and j by si and sj units (unit_of). The inner
 * unknowns are converged. */
static status at_place(const energy_place *at, int i, double si, int j, double sj,
                       stress_output *out)
{
    double e[ENERGY_M], inner[TEST_ELEMENT_INNER];
    memcpy(e, at->e, (size_t)at->s->strains * sizeof *e);
    memcpy(inner, at->inner, (size_t)at->s->inner * sizeof *inner);
    e[i] += si * unit_of(at->s);
    e[j] += sj * unit_of(at->s);
    return test_element_converged(at->s, e, inner, out);
}

static int energy_at(const void *context, int i, double si, int j, double sj, double values[])
{
    return (int)at_place(context, i, si, j, sj, &(stress_output){.energy = values});
}

static int stress_at(const void *context, int i, double si, int j, double sj, double values[])
{
    return (int)at_place(context, i, si, j, sj, &(stress_output){.sigma = values});
}

/* Returns the scale of C[i][j]: the geometric mean of C[i][i] and C[j][j]. Diagonal entries below
 * 1e-9 times the largest one are replaced by this bound. */
static double size_of(const test_element *s, const double C[], int i, int j)
{
    const int m = s->strains;
    double largest = 0;
    for (int k = 0; k < m; k++)
        largest = fmax(largest, fabs(C[k * m + k]));
    return sqrt(fmax(fabs(C[i * m + i]), 1e-9 * largest) *
                fmax(fabs(C[j * m + j]), 1e-9 * largest));
}

static void check_gradient(const energy_place *at, const double sigma[], const double C[],
                           check_results *c)
{
    const test_element *s = at->s;
    check_result *one = checks_open(c, "stress is the gradient of the energy", 1e-6);
    for (int i = 0; i < s->strains; i++) {
        double found = NAN;
        const int outcome = stencil_first(energy_at, at, 1, i, &found);
        found /= unit_of(s);
        const double size =
            fmax(fabs(sigma[i]), size_of(s, C, i, i) * moved_by * s->request.length);
        checks_deviation(
            one, outcome == 0 ? checks_relative(fabs(sigma[i] - found), size) : NAN,
            "stress: sigma %d is %.6g, but the derivative of the energy with respect to "
            "strain %d is %.6g; correct the stress or the energy%s",
            i + 1, sigma[i], i + 1, found, s->words);
    }
}

static void check_stiffness(const energy_place *at, const double C[], check_results *c)
{
    const test_element *s = at->s;
    const int m = s->strains;
    check_result *derives = checks_open(c, "C is the derivative of the stress", 1e-7),
                 *symmetric = checks_open(c, "C is symmetric", 1e-9);
    for (int j = 0; j < m; j++) {
        double column[ENERGY_M] = {0};
        const int outcome = stencil_first(stress_at, at, m, j, column);
        for (int i = 0; i < m; i++) {
            const double size = size_of(s, C, i, j), found = column[i] / unit_of(s);
            checks_deviation(
                derives, outcome == 0 ? checks_relative(fabs(C[i * m + j] - found), size) : NAN,
                "C: the derivative of sigma %d with respect to strain %d is %.6g, but finite "
                "differences of the stress give %.6g; correct C or the stress%s",
                i + 1, j + 1, C[i * m + j], found, s->words);
            checks_deviation(symmetric, checks_relative(fabs(C[i * m + j] - C[j * m + i]), size),
                             "C: entry %d, %d is %.6g, but entry %d, %d is %.6g; derive the stress "
                             "from an energy, which makes C symmetric%s",
                             i + 1, j + 1, C[i * m + j], j + 1, i + 1, C[j * m + i], s->words);
        }
    }
}

static void check_rest(const test_element *s, check_results *c)
{
    const double none[ENERGY_M] = {0};
    double inner[TEST_ELEMENT_INNER], sigma[ENERGY_M], C[ENERGY_M * ENERGY_M], energy = NAN;
    check_result *one = checks_open(c, "the undeformed element has no stress", 1e-12);
    test_element_rest(s, inner);
    if (test_element_converged(s, none, inner,
                               &(stress_output){.energy = &energy, .sigma = sigma, .C = C}) !=
        STATUS_OK)
        return;
    const double scale = size_of(s, C, 0, 0) * s->request.length * s->request.length;
    checks_deviation(one, fabs(energy) / scale,
                     "stress: the undeformed element has an energy of %.3g J; define the energy as "
                     "zero in that state%s",
                     energy, s->words);
    for (int i = 0; i < s->strains; i++)
        checks_deviation(one, fabs(sigma[i]) / (size_of(s, C, i, i) * s->request.length),
                         "stress: sigma %d of the undeformed element is %.3g N; define it as zero "
                         "in that state%s",
                         i + 1, sigma[i], s->words);
}

static void check_geometric(const test_element *s, const double C[], check_results *c)
{
    const int m = s->strains;
    double a[ENERGY_M], b[ENERGY_M], both[ENERGY_M], Ga[ENERGY_M * ENERGY_M],
        Gb[ENERGY_M * ENERGY_M], Gs[ENERGY_M * ENERGY_M];
    if (s->type.geometric == NULL)
        return;
    check_result *symmetric = checks_open(c, "G is symmetric", 1e-9),
                 *linear = checks_open(c, "G is linear in the prestress", 1e-9);
    test_element_numbers(m, 17, a);
    test_element_numbers(m, 18, b);
    for (int i = 0; i < m; i++) {
        const double size = size_of(s, C, i, i) * moved_by * s->request.length;
        a[i] *= size;
        b[i] *= size;
        both[i] = 2 * a[i] - 3 * b[i];
    }
    checks_current(c, "geometric%s", s->words);
    s->type.geometric(s->data, a, Ga);
    s->type.geometric(s->data, b, Gb);
    s->type.geometric(s->data, both, Gs);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) {
            const int ij = i * m + j, ji = j * m + i;
            const double size = size_of(s, C, i, j) * moved_by;
            checks_deviation(
                symmetric, checks_relative(fabs(Ga[ij] - Ga[ji]), size),
                "geometric: entry %d, %d of G is %.6g, but entry %d, %d is %.6g; make G "
                "symmetric%s",
                i + 1, j + 1, Ga[ij], j + 1, i + 1, Ga[ji], s->words);
            checks_deviation(linear, checks_relative(fabs(Gs[ij] - 2 * Ga[ij] + 3 * Gb[ij]), size),
                             "geometric: entry %d, %d of G for the prestress 2 a - 3 b is %.6g, "
                             "but 2 G(a) - 3 G(b) is %.6g; make G linear in the prestress%s",
                             i + 1, j + 1, Gs[ij], 2 * Ga[ij] - 3 * Gb[ij], s->words);
        }
}

static void check(const test_element *s, check_results *c)
{
    double e[ENERGY_M], sigma[ENERGY_M], C[ENERGY_M * ENERGY_M], inner[TEST_ELEMENT_INNER], energy,
        residual = NAN;
    node_state x[ELEMENT_MAX_NODES];
    const energy_place at = {.s = s, .e = e, .inner = inner};
    test_element_state(s, moved_by, 11, x);
    checks_current(c, "stress%s", s->words);
    s->type.strain(s->data, x, &(strain_output){.e = e, .history = s->history});
    test_element_rest(s, inner);
    const status outcome = test_element_converged(
        s, e, inner,
        &(stress_output){.energy = &energy, .sigma = sigma, .C = C, .residual = &residual});
    checks_require(checks_open(c, "moderate strains have stresses", 0), outcome == STATUS_OK,
                   "stress: strains of a few hundredths of the length give the status '%s'; "
                   "compute their stresses%s",
                   status_name(outcome), s->words);
    if (outcome != STATUS_OK)
        return;
    checks_deviation(checks_open(c, "the internal equations are solved", 1e-9), fabs(residual),
                     "update: after %d corrections, the residual of the internal unknowns is %.1e; "
                     "correct 'memory' or 'update'%s",
                     30, residual, s->words);
    check_gradient(&at, sigma, C, c);
    check_stiffness(&at, C, c);
    check_rest(s, c);
    check_geometric(s, C, c);
    own_damping_check(s, C, c);
}

void checks_energy(const formulation *chosen, check_results *out)
{
    if (chosen->type->force != NULL) {
        checks_not_made(out, "stress is the gradient of the energy",
                        "the element provides forces instead of stresses");
        return;
    }
    test_elements_each(chosen, out, check);
    if (chosen->type->geometric == NULL)
        checks_not_made(out, "G is symmetric", "the element has no internal geometric stiffness");
}

enum { N = TEST_ELEMENT_COORDINATES };

static const element_rotating_frame turning = {.omega = {31.3, -17.9, 23.7},
                                               .centre = {0.213, -0.147, 0.089}};

static int potential_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const test_element_stencil *at = context;
    node_state x[ELEMENT_MAX_NODES];
    test_element_moved(at, i, si, j, sj, x);
    return (int)at->s->type.inertia(at->s->data, x, &turning,
                                    &(inertia_output){.potential = values});
}

static int force_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const test_element_stencil *at = context;
    node_state x[ELEMENT_MAX_NODES];
    test_element_moved(at, i, si, j, sj, x);
    return (int)at->s->type.inertia(at->s->data, x, &turning, &(inertia_output){.force = values});
}

static void check_force(const test_element_stencil *at, const double force[], check_result *one)
{
    const test_element *s = at->s;
    char where[TEST_ELEMENT_WORDS];
    double size = 0;
    for (int i = 0; i < s->coordinates; i++)
        size = fmax(size, fabs(force[i]) * test_element_unit(s, i));
    for (int i = 0; i < s->coordinates; i++) {
        const double unit = test_element_unit(s, i);
        double found = NAN;
        stencil_first(potential_at, at, 1, i, &found);
        checks_deviation(
            one, checks_relative(fabs(force[i] * unit + found), size),
            "inertia: the centrifugal force in coordinate %d (%s) is %.6g, but minus the "
            "derivative of the potential is %.6g; correct the force or the potential%s",
            i + 1, test_element_coordinate(s, i, where), force[i], -found / unit, s->words);
    }
}

static void rotating_check_stiffness(const test_element_stencil *at, const double stiffness[],
                                     check_results *c)
{
    const test_element *s = at->s;
    const int n = s->coordinates;
    char first[TEST_ELEMENT_WORDS], other[TEST_ELEMENT_WORDS];
    double column[N][N], size = 0;
    check_result *derives = checks_open(c, "N is minus the derivative of the force", 1e-9),
                 *symmetric = checks_open(c, "N is symmetric", 1e-12);
    for (int j = 0; j < n; j++) {
        const double unit = test_element_unit(s, j);
        stencil_first(force_at, at, n, j, column[j]);
        size = fmax(size, fabs(stiffness[j * n + j]) * unit * unit);
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            const double ui = test_element_unit(s, i), uj = test_element_unit(s, j),
                         a = stiffness[i * n + j], b = stiffness[j * n + i],
                         found = -(column[j][i] * ui + column[i][j] * uj) / 2;
            checks_deviation(derives, checks_relative(fabs(a * ui * uj - found), size),
                             "inertia: entry %d, %d (%s, %s) of N is %.6g, but finite differences "
                             "of the centrifugal force give %.6g; correct N or the force%s",
                             i + 1, j + 1, test_element_coordinate(s, i, first),
                             test_element_coordinate(s, j, other), a, found / (ui * uj), s->words);
            checks_deviation(symmetric, checks_relative(fabs(a - b) * ui * uj, size),
                             "inertia: entry %d, %d of N is %.6g, but the transposed entry is "
                             "%.6g; make N symmetric%s",
                             i + 1, j + 1, a, b, s->words);
        }
}

static void check_skew(const test_element *s, const double G[], check_result *one)
{
    const int n = s->coordinates;
    double size = 0;
    for (int i = 0; i < n * n; i++)
        size = fmax(size, fabs(G[i]) * test_element_unit(s, i / n) * test_element_unit(s, i % n));
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++)
            checks_deviation(one,
                             checks_relative(fabs(G[i * n + j] + G[j * n + i]) *
                                                 test_element_unit(s, i) * test_element_unit(s, j),
                                             size),
                             "inertia: entry %d, %d of G is %.6g, but the transposed entry is "
                             "%.6g; make G skew-symmetric%s",
                             i + 1, j + 1, G[i * n + j], G[j * n + i], s->words);
}

/* For the velocity v of the rotating frame, checks that G v = -2 F, where F is the centrifugal
 * force, and, with rotary inertia, that the kinetic energy 1/2 v^T M v is -V, where V is the
 * centrifugal potential. */
static void own_motion(const test_element *s, const node_state x[], const inertia_output *out,
                       check_results *c)
{
    const int n = s->coordinates;
    double v[N] = {0}, Mv[N], Gv[N], largest = 0;
    char where[TEST_ELEMENT_WORDS];
    for (int k = 0; k < s->nodes; k++) {
        double r[3];
        for (int i = 0; i < 3; i++)
            r[i] = x[k].r[i] - turning.centre[i];
        vec3_cross(turning.omega, r, v + NODE_COORDINATES * k);
        memcpy(v + NODE_COORDINATES * k + 3, turning.omega, sizeof turning.omega);
    }
    dense_mul_vec(n, n, out->M, v, Mv);
    dense_mul_vec(n, n, out->G, v, Gv);
    if (s->section.matrices || s->made.features & FEATURE_ROTARY_INERTIA)
        checks_deviation(
            checks_open(c, "the potential is minus the kinetic energy of the frame motion", 1e-11),
            fabs(dense_dot(n, v, Mv) / 2 / -*out->potential - 1),
            "inertia: the potential is %.6g J, but -1/2 v^T M v for the velocities v of the frame "
            "is %.6g J; correct the potential or M%s",
            *out->potential, -dense_dot(n, v, Mv) / 2, s->words);
    for (int i = 0; i < n; i++)
        largest = fmax(largest, fabs(out->force[i]) * test_element_unit(s, i));
    for (int i = 0; i < n; i++)
        checks_deviation(
            checks_open(c, "the Coriolis force is twice the centrifugal force", 1e-11),
            fabs(Gv[i] + 2 * out->force[i]) * test_element_unit(s, i) / largest,
            "inertia: in coordinate %d (%s), G v for the velocities v of the frame is %.6g, but "
            "minus twice the centrifugal force is %.6g; correct G or the force%s",
            i + 1, test_element_coordinate(s, i, where), Gv[i], -2 * out->force[i], s->words);
}

static void in_frame(const test_element *s, check_results *c)
{
    double V, F[N], M[N * N], stiffness[N * N], G[N * N];
    inertia_output out = {.M = M, .potential = &V, .force = F, .N = stiffness, .G = G};
    node_state x[ELEMENT_MAX_NODES];
    const test_element_stencil at = {s, x};
    test_element_state(s, 0.05, 31, x);
    checks_current(c, "inertia in a rotating frame%s", s->words);
    const status outcome = s->type.inertia(s->data, x, &turning, &out);
    checks_require(checks_open(c, "the inertia can be computed in a rotating frame", 0),
                   outcome == STATUS_OK,
                   "inertia: the status in a rotating frame is '%s'; compute the potential, its "
                   "force, N and G%s",
                   status_name(outcome), s->words);
    if (outcome != STATUS_OK)
        return;
    check_force(&at, F, checks_open(c, "the centrifugal force derives from its potential", 1e-9));
    rotating_check_stiffness(&at, stiffness, c);
    check_skew(s, G, checks_open(c, "G is skew", 1e-12));
    own_motion(s, x, &out, c);
}

/* Returns the centrifugal potential [J] of a uniformly twisted element. Its warping amplitudes
 * equal the twist rate. */
static double twisted_energy(const test_element *s, double angle)
{
    const double ys = s->section.ys, zs = s->section.zs;
    double d[N] = {0}, V = NAN;
    node_state straight[ELEMENT_MAX_NODES], x[ELEMENT_MAX_NODES];
    for (int k = 0; k < s->nodes; k++) {
        const double turn = angle * s->place[k];
        double *node = d + NODE_COORDINATES * k;
        node[1] = ys * (1 - cos(turn)) + zs * sin(turn);
        node[2] = zs * (1 - cos(turn)) - ys * sin(turn);
        node[3] = turn;
        node[6] = sin(angle) / s->request.length;
    }
    test_element_state(s, 0, 1, straight);
    chart_move(straight, s->nodes, s->scalars, d, x);
    s->type.inertia(s->data, x, &turning, &(inertia_output){.potential = &V});
    return V;
}

/* Checks the effect of warping on the centrifugal potential: -1/2 int rho (omega a)^2 |Omega x
 * e_x|^2 dV, with the warping function omega, the warping amplitude a and the angular velocity
 * Omega. */
static void warping(const test_element *s, check_result *one)
{
    const double angle = 0.005, *w = turning.omega;
    test_element_request what = s->made;
    test_element plain;
    fault f = {""};
    what.features &= ~(unsigned)FEATURE_WARPING;
    if (test_element_make(&what, &plain, &f) == STATUS_OK) {
        const double l = s->request.length, a = sin(angle) / l,
                     found = twisted_energy(s, angle) - twisted_energy(&plain, angle),
                     expected = -s->section.density * s->section.Iw * l * a * a *
                                (w[1] * w[1] + w[2] * w[2]) / 2;
        checks_deviation(one, fabs(found / expected - 1),
                         "inertia: the centrifugal potential of warping is %.6g J instead of -1/2 "
                         "rho Iw l a^2 (Oy^2 + Oz^2) = %.6g J; correct the potential%s",
                         found, expected, s->words);
    }
    test_element_free(&plain);
}

static void rotating_check(const test_element *s, check_results *c)
{
    const unsigned warps = FEATURE_WARPING | FEATURE_ROTARY_INERTIA;
    in_frame(s, c);
    if ((s->made.features & warps) == warps && !s->section.matrices && s->made.curvature[0] == 0 &&
        s->made.form == PROFILES_UNSYMMETRIC)
        warping(s, checks_open(c, "centrifugal energy of warping", 2e-4));
}

static void check_all(const test_element *s, check_results *c)
{
    static const unsigned without[] = {FEATURE_ROTARY_INERTIA, FEATURE_WARPING,
                                       FEATURE_WARPING | FEATURE_SHEAR};
    rotating_check(s, c);
    for (size_t k = 0; k < sizeof without / sizeof without[0]; k++) {
        test_element_request what = s->made;
        test_element other;
        fault f = {""};
        what.features &= ~without[k];
        if (what.features == s->made.features)
            continue;
        if (test_element_make(&what, &other, &f) == STATUS_OK)
            in_frame(&other, c);
        test_element_free(&other);
    }
}

void checks_rotating(const formulation *chosen, check_results *out)
{
    if (!(chosen->type->offers & FEATURE_MASS) || chosen->type->inertia == NULL) {
        checks_not_made(out, "G is skew",
                        chosen->type->offers & FEATURE_MASS ? "beamwork computes its inertia"
                                                            : "does not support mass");
        return;
    }
    test_elements_each(chosen, out, check_all);
}
