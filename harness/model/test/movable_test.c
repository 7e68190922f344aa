/* The spaces of possible motions must have the dimensions that exact axes give, despite round-off
 * in the axes and for any unit of length. Also tests masses at nodes, and strains of springs with
 * their derivatives. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/shared/masses.h"
#include "elements/test/kit.h"
#include "harness/experiments/experiments.h"
#include "harness/model/model.h"

static int fill(uint64_t *state, int shifts, int turns, int in_plane, double length, double T[36])
{
    const int columns = shifts + turns;
    double normal[3], offset[3], axis[3];
    memset(T, 0, 36 * sizeof *T);
    for (int i = 0; i < 3; i++) {
        normal[i] = random_number(state);
        offset[i] = shifts == 0 ? length * random_number(state) : 0;
    }
    for (int k = 0; k < shifts; k++)
        T[k * columns + k] = 1;
    for (int k = 0; k < turns; k++) {
        double any[3] = {random_number(state), random_number(state), random_number(state)},
               moved[3];
        vec3_cross(normal, any, axis);
        const double *turn = in_plane ? axis : any, size = vec3_norm(turn);
        vec3_cross(turn, offset, moved);
        for (int i = 0; i < 3; i++) {
            T[(3 + i) * columns + shifts + k] = turn[i] / size * (1 + 2e-16 * random_number(state));
            T[i * columns + shifts + k] += moved[i] / size;
        }
    }
    return columns;
}

static double apart_from_unit(const movable *v)
{
    double worst = 0;
    for (int i = 0; i < v->count; i++)
        for (int j = 0; j < v->count; j++) {
            double sum = i == j ? -1 : 0;
            for (int k = 0; k < 6; k++)
                sum += v->dual[6 * i + k] * v->span[v->count * k + j];
            worst = fmax(worst, fabs(sum));
        }
    return worst;
}

static double outside(int columns, const double *T, double length, const movable *v)
{
    double worst = 0;
    for (int k = 0; k < columns; k++)
        for (int i = 0; i < 6; i++) {
            double rest = T[i * columns + k];
            for (int j = 0; j < v->count; j++)
                for (int l = 0; l < 6; l++)
                    rest -= v->span[v->count * i + j] * v->dual[6 * j + l] * T[l * columns + k];
            worst = fmax(worst, fabs(rest) / (i < 3 ? fmax(1, length) : 1));
        }
    return worst;
}

static void dimensions(void)
{
    static const double length[] = {1e-6, 1, 1e4};
    uint64_t state = 7;
    for (int trial = 0; trial < 600; trial++) {
        const int shifts = trial % 4, turns = trial / 4 % 4, in_plane = trial / 16 % 2;
        const double size = length[trial / 32 % 3];
        const int most = in_plane ? 2 : 3, rank = shifts + (turns < most ? turns : most);
        double T[36];
        movable v;
        const int columns = fill(&state, shifts, turns, in_plane, size, T);
        movable_of(columns, T, size, &v);
        gsl_test(v.count != rank, "%d displacements and %d turns%s, size %g: %d dimensions", shifts,
                 turns, in_plane ? " in a plane" : "", size, v.count);
        gsl_test(!(apart_from_unit(&v) <= 1e-14), "dual and span: %.1e", apart_from_unit(&v));
        gsl_test(!(outside(columns, T, size, &v) <= 1e-12), "columns lie in the span: %.1e",
                 outside(columns, T, size, &v));
    }
}

static void whole_components(void)
{
    const double c = cos(0.35), s = sin(0.35),
                 T[12] = {0, 0, 0, 0, 0, 0, -s, c, c, s, 1e-17, -3e-17};
    movable v;
    movable_of(2, T, 0.06, &v);
    gsl_test(v.count != 2 || v.components != 0x18, "the plane of two components: %d, %x", v.count,
             v.components);
    for (int i = 0; i < 12; i++)
        gsl_test(v.span[i] != (double)(i == 6 || i == 9), "unit vectors: %g at %d", v.span[i], i);
}

static void components_alone(void)
{
    const double alone[24] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0,
                              0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0};
    double beside[24];
    movable v, w;
    memcpy(beside, alone, sizeof beside);
    beside[0] = 1e-17;
    movable_of(4, alone, 0.1, &v);
    movable_of(4, beside, 0.1, &w);
    gsl_test(v.count != 2 || !v.whole || v.component[0] != 2 || v.component[1] != 4,
             "components alone: %d of them", v.count);
    gsl_test(memcmp(&v, &w, sizeof v) != 0, "the same motions");
}

static void nothing(void)
{
    const double T[6] = {1e-19, 0, 0, 1e-17, -1e-17, 0};
    movable v;
    movable_of(1, T, 1, &v);
    gsl_test(v.count != 0 || v.components != 0, "turns that cancel: %d dimensions", v.count);
    movable_of(0, T, 1, &v);
    gsl_test(v.count != 0, "no coordinates: %d dimensions", v.count);
}

static void prescribed_moment(void)
{
    uint64_t state = 3;
    for (int turns = 0; turns < 4; turns++)
        for (int in_plane = 0; in_plane < 2; in_plane++) {
            double T[36], left[3];
            const double m[3] = {0.3, -0.2, 0.9};
            const int columns = fill(&state, 3, turns, in_plane, 1, T);
            movable_prescribed(columns, T, m, left);
            for (int k = 3; k < columns; k++) {
                double along = 0;
                for (int i = 0; i < 3; i++)
                    along += T[(3 + i) * columns + k] * left[i];
                gsl_test(!(fabs(along) <= 1e-14), "%d turns: %.1e left along one of them", turns,
                         along);
            }
            gsl_test((vec3_norm(left) == 0) != (turns == 3 && !in_plane),
                     "%d turns%s: %g is prescribed", turns, in_plane ? " in a plane" : "",
                     vec3_norm(left));
            gsl_test(turns == 0 && memcmp(left, m, sizeof left) != 0, "no turns: all of it");
        }
}

static void movable_tests(void)
{
    dimensions();
    whole_components();
    components_alone();
    nothing();
    prescribed_moment();
}

enum { MOST = TEST_ELEMENT_COORDINATES };

static void at_nodes(const test_element *s, const node_state x[], double M[])
{
    const lumped_mass whole = lumped_of(&s->section, s->request.features, s->request.length);
    double share[ELEMENT_MAX_NODES];
    lumped_shares(s->nodes, s->place, share);
    lumped_element(&whole, s->nodes, share, x, NULL, &(inertia_output){.M = M});
}

static void make(const char *name, const test_element_request *what, test_element *out)
{
    fault f = {""};
    gsl_test(test_element_make(what, out, &f) != STATUS_OK, "%s: prepared %s", name, f.text);
}

static void lumped_moments(const char *name)
{
    formulation chosen;
    test_element s;
    double M[MOST * MOST], x_moment = 0, polar = 0;
    node_state x[ELEMENT_MAX_NODES];
    gsl_test(formulation_parse(name, &chosen, NULL) != STATUS_OK, "%s", name);
    const test_element_request what = {.given = chosen.type,
                                       .options = chosen.option,
                                       .features = FEATURE_MASS | FEATURE_ROTARY_INERTIA,
                                       .form = PROFILES_UNSYMMETRIC,
                                       .unit = 1};
    make(name, &what, &s);
    s.section.Ip *= 1.3;
    gsl_test(s.type.prepare(&s.request, s.data, NULL) != STATUS_OK, "%s: prepared again", name);
    test_element_state(&s, 0, 1, x);
    at_nodes(&s, x, M);
    for (int k = 0; k < s.nodes; k++) {
        x_moment += M[(NODE_COORDINATES * k + 1) * (s.coordinates + 1)] * pow(x[k].r[0], 2);
        polar += M[(NODE_COORDINATES * k + 3) * (s.coordinates + 1)];
    }
    const double l = s.request.length, mass = s.section.density * s.section.A * l;
    gsl_test_rel(x_moment, mass * l * l / (s.nodes == 2 ? 2 : 3), 1e-13,
                 "%s: second moment of the masses", name);
    gsl_test_rel(polar, s.section.density * s.section.Ip * l, 1e-13, "%s: polar inertia", name);
    test_element_free(&s);
}

static void slice(const char *name)
{
    formulation chosen;
    test_element s;
    double M[MOST * MOST], worst = 0;
    node_state x[ELEMENT_MAX_NODES];
    gsl_test(formulation_parse(name, &chosen, NULL) != STATUS_OK, "%s", name);
    const test_element_request what = {.given = chosen.type,
                                       .options = chosen.option,
                                       .features = FEATURE_MASS | FEATURE_SHEAR,
                                       .form = PROFILES_MATRICES,
                                       .unit = 1};
    make(name, &what, &s);
    test_element_state(&s, 0, 1, x);
    at_nodes(&s, x, M);
    for (int i = 0; i < 36; i++)
        worst = worst_of(worst, fabs(M[s.coordinates * (i / 6) + i % 6] -
                                     s.request.length / 2 * s.section.mass[i]) /
                                    (s.request.length * s.section.mass[0]));
    gsl_test(!(worst < 1e-16), "%s: mass matrix of a node (%.1e)", name, worst);
    test_element_free(&s);
}

static void inertia_moments_tests(void)
{
    lumped_moments("geometrically_exact:nodes=2");
    lumped_moments("geometrically_exact:nodes=3");
    lumped_moments("collocation");
    slice("geometrically_exact:nodes=2");
    slice("collocation");
}

static void two_ends(const element_data *data, const node_state x[], strain_output *out)
{
    (void)data;
    spring_strain(2, x, NULL, out);
}

static void to_ground(const element_data *data, const node_state x[], strain_output *out)
{
    (void)data;
    spring_strain(1, x, NULL, out);
}

static const element_type spring[2] = {{.name = "to ground", .strain = to_ground},
                                       {.name = "two ends", .strain = two_ends}};

enum { SPRING_MOST = 2 * NODE_COORDINATES };

static void turn_end(double angle, uint64_t *seed, node_state *x)
{
    double axis[3], size = 0;
    for (int i = 0; i < 3; i++) {
        axis[i] = random_number(seed);
        size += axis[i] * axis[i];
    }
    for (int i = 0; i < 3; i++)
        axis[i] *= angle / sqrt(size);
    nodes_turn(x->R, axis);
}

static void derivatives(int nodes, double angle, uint64_t *seed)
{
    double d[SPRING_MOST], s[SPRING_STRAINS];
    node_state x[2];
    nodes_straight(2, 0.31, x);
    nodes_increments(nodes, 0.31, 1, (unsigned)random_bits(seed), d);
    nodes_move(nodes, 1, d, x);
    turn_end(angle, seed, &x[nodes - 1]);
    nodes_increments(nodes, 0.31, 1, (unsigned)random_bits(seed), d);
    for (int k = 0; k < nodes; k++)
        d[NODE_COORDINATES * k + 6] = 0;
    for (int i = 0; i < SPRING_STRAINS; i++)
        s[i] = random_number(seed) * (i < 3 ? 1 : 0.31);
    const nodes_departure found =
        nodes_differences(&spring[nodes - 1], NULL, nodes, SPRING_STRAINS, x, d, s);
    gsl_test(!(found.first < 1e-8), "%s, turn %g: first derivatives (%.1e)", spring[nodes - 1].name,
             angle, found.first);
    gsl_test(!(found.second < 1e-7), "%s, turn %g: second derivatives (%.1e)",
             spring[nodes - 1].name, angle, found.second);
    gsl_test(!(found.asymmetry < 1e-14), "%s, turn %g: symmetric (%.1e)", spring[nodes - 1].name,
             angle, found.asymmetry);
}

static void known(uint64_t *seed)
{
    double d[SPRING_MOST], e[SPRING_STRAINS];
    node_state x[2];
    nodes_straight(2, 0.31, x);
    nodes_increments(1, 0.31, 1, (unsigned)random_bits(seed), d);
    for (int i = 0; i < 3; i++)
        x[1].u[i] = x[0].u[i] = 0;
    nodes_turn(x[0].R, d + 3);
    memcpy(x[1].R, x[0].R, sizeof x[1].R);
    for (int i = 0; i < 3; i++) {
        x[1].r[i] = x[0].r[i] + 0.31 * x[0].R[3 * i];
        x[1].u[i] = x[1].r[i] - (i == 0 ? 0.31 : 0);
    }
    spring_strain(2, x, NULL, &(strain_output){.e = e});
    for (int i = 0; i < SPRING_STRAINS; i++)
        gsl_test(!(fabs(e[i]) < 4e-16), "rigid motion: no deformation %d (%.1e)", i, e[i]);
    const double y[3] = {0.7 * x[0].R[1], 0.7 * x[0].R[4], 0.7 * x[0].R[7]};
    nodes_turn(x[1].R, y);
    for (int i = 0; i < 3; i++) {
        x[1].r[i] += 0.02 * x[0].R[3 * i + 2];
        x[1].u[i] += 0.02 * x[0].R[3 * i + 2];
    }
    spring_strain(2, x, NULL, &(strain_output){.e = e});
    gsl_test_rel(e[2], 0.02, 1e-13, "pulled along its z axis");
    gsl_test_rel(e[4], 0.7, 1e-14, "turned about its y axis");
    gsl_test(!(fabs(e[0]) + fabs(e[1]) + fabs(e[3]) + fabs(e[5]) < 1e-15), "and nothing else");
}

static void spring_tests(void)
{
    static const double angle[] = {0, 1e-9, 1e-3, 0.2, 0.6, 0.72, 1.3, 2.4, 2.9};
    uint64_t seed = 11;
    for (int nodes = 1; nodes <= 2; nodes++)
        for (size_t i = 0; i < sizeof angle / sizeof angle[0]; i++)
            derivatives(nodes, angle[i], &seed);
    known(&seed);
}

int main(void)
{
    movable_tests();
    inertia_moments_tests();
    spring_tests();
    return gsl_test_summary();
}
