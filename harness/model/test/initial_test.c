/* Members with initial elongation and shear strains g (N Eq. 52) must have the displacements and
 * reactions of closed forms. Also tests points and triads of centre lines, the division of members
 * into elements, and rigid motions of supports. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/test/kit.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model_impl.h"
#include "harness/tools/kit/scenes.h"

static const char *const names[] = {
    "sheet_second",        "sheet_second_consistent",     "sheet_third", "sheet_third_printed",
    "geometrically_exact", "geometrically_exact:nodes=2", "collocation"};
enum { NAMES = sizeof names / sizeof names[0] };

/* Solves a rectangular member of length 2 m with the initial strains g[3]. It is clamped at one
 * end, and its tip is fixed in the components marked in held[6]. u[6] and F[6] are the coordinates
 * and the reactions of the tip. */
static void solve(const char *name, const double g[3], const int held[6], double u[6], double F[6])
{
    static const char *const quantity[12] = {"u0", "u1", "u2", "u3", "u4", "u5",
                                             "F0", "F1", "F2", "F3", "F4", "F5"};
    scene s;
    formulation fm;
    model *m = NULL;
    solve_result r;
    fault f = {""};
    const double y_axis[3] = {0, 1, 0}, end = 1;
    scene_init(&s, "strained");
    section_spec spec = section_spec_rectangle(2e9, 8e8, 0.2, 0.1);
    spec.shear_factor[0] = spec.shear_factor[1] = 5.0 / 6;
    spec.given.Iw = 0;
    const int root = scene_add_node(&s, 0, 0, 0), tip = scene_add_node(&s, 2, 0, 0);
    const int member = scene_add_member(&s, root, tip, scene_add_section(&s, &spec), y_axis);
    memcpy(scene_member_at(&s, member)->strain, g, sizeof scene_member_at(&s, member)->strain);
    scene_hold_all(&s, root);
    scene_omit(&s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
    const int path = scene_add_static(&s, 1, &end, 1);
    for (int i = 0; i < 6; i++)
        if (held[i])
            scene_hold(&s, tip, i, i);
    for (int i = 0; i < 12; i++) {
        scene_add_quantity(&s, quantity[i], "1", path,
                           i < 6 ? scene_coordinate(tip, i) : scene_reaction(tip, i - 6));
    }
    gsl_test(formulation_parse(name, &fm, &f) != STATUS_OK, "%s exists", name);
    const model_request what = {&s, fm.type, fm.option, 3, 0, 0};
    status outcome = model_alloc(&what, &m, &f);
    if (outcome == STATUS_OK) {
        outcome = solve_scene(&s, m, NULL, &r, &f);
        if (outcome == STATUS_OK)
            for (int i = 0; i < 6; i++) {
                u[i] = r.quantity[i].value;
                F[i] = r.quantity[6 + i].value;
            }
        result_free(&r);
    }
    gsl_test(outcome != STATUS_OK, "%s: %s", name, f.text);
    model_free(m);
    scene_free(&s);
}

static void elongation(const char *name)
{
    const double g[3] = {1e-3, 0, 0}, EA = 2e9 * 0.02;
    const int loose[6] = {0}, held[6] = {1, 1, 1, 1, 1, 1};
    double u[6] = {0}, F[6] = {0};
    solve(name, g, loose, u, F);
    gsl_test_rel(u[0], 2e-3, 1e-12, "%s: a free end moves by L g", name);
    gsl_test_abs(F[0] / EA, 0, 1e-14, "%s: without stress", name);
    solve(name, g, held, u, F);
    gsl_test_rel(F[0], -EA * 1e-3, 1e-12, "%s: held at both ends it pushes with EA g", name);
}

static void shear(const char *name, int direction)
{
    double g[3] = {0}, u[6] = {0}, F[6] = {0};
    const double GA = 5.0 / 6 * 8e8 * 0.02, small = 1e-6;
    const int loose[6] = {0}, held[6] = {1, 1, 1, 1, 1, 1};
    g[direction] = small;
    solve(name, g, loose, u, F);
    gsl_test_rel(u[direction], 2 * small, 1e-5, "%s: a free end slides by L g along %c", name,
                 "xyz"[direction]);
    gsl_test_abs(u[direction == 1 ? 5 : 4] / small, 0, 1e-5, "%s: and does not turn", name);
    solve(name, g, held, u, F);
    /* Timoshenko's clamped beam with the transverse displacement L g of one end has the force 12 EI
     * L g/(L^3 (1 + Phi)) with Phi = 12 EI/(GA L^2), where GA is the shear stiffness */
    const double EI = 2e9 * (direction == 1 ? 0.2 * 0.1 * 0.1 * 0.1 : 0.1 * 0.2 * 0.2 * 0.2) / 12,
                 L = 2;
    const double Phi = 12 * EI / (GA * L * L), expected = -12 * EI * small / (L * L * (1 + Phi));
    gsl_test_rel(F[direction], expected, 1e-5, "%s: held, along %c", name, "xyz"[direction]);
}

static void not_offered(void)
{
    formulation fm;
    char words[100];
    scene s;
    scene_init(&s, "strained");
    gsl_test(formulation_parse("beamw", &fm, NULL) != STATUS_OK, "beamw exists");
    scene_member_at(&s, scene_add_member(&s, 0, 0, 0, (const double[3]){0, 1, 0}))->strain[0] =
        1e-3;
    gsl_test(!missing_words(&s, fm.type, words, sizeof words) || strstr(words, "initial") == NULL,
             "a formulation without it is told: %s", words);
    scene_free(&s);
}

static void no_energy_at_rest(const char *name)
{
    static const double none[ELEMENT_MAX_STRAINS] = {0};
    double inner[1024] = {0}, energy = NAN;
    formulation chosen;
    fault f = {""};
    const section_spec spec = section_spec_rectangle(2e11, 8e10, 0.05, 0.001);
    const section c = sections_computed(&spec);
    gsl_test(formulation_parse(name, &chosen, &f) != STATUS_OK, "%s", f.text);
    const double length = 0.3;
    const element_request request = {.section = &c,
                                     .length = length,
                                     .features =
                                         chosen.type->offers & ~(unsigned)FEATURE_WAGNER_TORQUE,
                                     .options = chosen.option,
                                     .curvature = {0.2, 0.3, 0.9}};
    element_data *data = calloc(1, chosen.type->data_size(&request));
    gsl_test(chosen.type->prepare(&request, data, &f) != STATUS_OK, "%s: %s", name, f.text);
    if (chosen.type->rest != NULL)
        chosen.type->rest(data, inner);
    chosen.type->stress(data, none, inner, &(stress_output){.energy = &energy});
    const double bending = c.young * c.Iz * 0.9 * 0.9 * length / 2;
    gsl_test(!(fabs(energy) <= 1e-12 * bending),
             "%s: energy at rest, by that of straightening it: %.1e", name, energy / bending);
    free(data);
}

static void initial_tests(void)
{
    for (int i = 0; i < NAMES; i++) {
        no_energy_at_rest(names[i]);
        elongation(names[i]);
        if (strncmp(names[i], "sheet_third", 11) != 0)
            shear(names[i], 1);
        shear(names[i], 2);
    }
    not_offered();
}

enum { POINTS = 13, MOST = 60 };

static void moved(const char *name, const double tip[6], centreline_point out[POINTS])
{
    const double end = 1;
    const section_spec spec = sections_of(1, 1, 1, 1);
    formulation chosen;
    scene s;
    model *m = NULL;
    model_state *state = NULL;
    fault f = {""};
    double x[MOST] = {0}, scale = 1;
    scene_init(&s, "cantilever");
    const int node = scenes_cantilever(&s, &spec);
    scene_add_static(&s, 1, &end, 1);
    gsl_test(formulation_parse(name, &chosen, &f) != STATUS_OK ||
                 scene_validate(&s, &f) != STATUS_OK,
             "%s", f.text);
    const model_request request = {
        .scene = &s, .type = chosen.type, .options = chosen.option, .elements = 1};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s: %s", name, f.text);
    gsl_test_int(centreline_points(m, NULL), POINTS, "%s: points of a member", name);
    for (int i = 0; i < 6; i++)
        x[kinematics_coordinate(m, node, SCENE_UX + i)] = tip[i];
    gsl_test(centreline_displaced(m, kinematics_rest(m), x, NULL, &scale, &state, &f) != STATUS_OK,
             "%s: %s", name, f.text);
    centreline_fill(m, state, out);
    kinematics_state_free(state);
    model_free(m);
    scene_free(&s);
}

/* A cubic with the end tangents of an arc of length 1 deviates from the arc by angle^3/384. The
 * centre line must lie on the arc, and its triads must follow the tangents, within angle^3/380. A
 * twist must be distributed evenly. */
static void arc(const char *name, double angle, double twist)
{
    const double radius = angle > 0 ? 1 / angle : 0;
    const double tip[6] = {angle > 0 ? radius * sin(angle) - 1 : 0,
                           angle > 0 ? radius * (1 - cos(angle)) : 0,
                           0,
                           twist,
                           0,
                           angle};
    const double off = pow(angle, 3) / 380;
    centreline_point p[POINTS];
    moved(name, tip, p);
    for (int i = 0; i < POINTS; i++) {
        const double t = (double)i / (POINTS - 1), a = angle * t;
        const double r[3] = {angle > 0 ? radius * sin(a) : t, angle > 0 ? radius * (1 - cos(a)) : 0,
                             0};
        const double turn[3] = {twist * t, 0, a};
        double q[4], same = 0;
        rotation_exp(turn, q);
        for (int k = 0; k < 3; k++)
            gsl_test_abs(p[i].r[k], r[k], 1e-14 + off, "%s: place %d of point %d", name, k, i);
        for (int k = 0; k < 4; k++)
            same += p[i].q[k] * q[k];
        gsl_test_abs(fabs(same), 1, 1e-14 + off, "%s: triad of point %d", name, i);
    }
}

static void centreline_tests(void)
{
    static const char *const name[] = {"beamw", "collocation", "sheet_third"};
    for (int i = 0; i < 3; i++) {
        arc(name[i], 0, 0.9);
        arc(name[i], 0.4, 0);
    }
}

enum { WHOLE, LOADED, OWN };

static void row(scene *s)
{
    const double y[3] = {0, 1, 0};
    const section_spec spec = section_spec_rectangle(2e11, 8e10, 0.01, 0.01);
    scene_init(s, "row");
    scene_add_section(s, &spec);
    for (int i = 0; i < 4; i++)
        scene_add_node(s, i, 0, 0);
    for (int i = 0; i < 3; i++)
        scene_add_member(s, i, i + 1, 0, y);
    scene_member_at(s, OWN)->divisions = 3;
    scene_add_load(s, SCENE_FORCE, 1, 1, 0, 0);
    scene_add_load(s, SCENE_DISTRIBUTED, WHOLE, 1, 0, 0);
    scene_add_load_within(s, SCENE_MEMBER_FORCE, LOADED, 0.7, 1, 0, 0);
    scene_load *part = scene_load_at(s, scene_add_load(s, SCENE_DISTRIBUTED, LOADED, 1, 0, 0));
    part->range[0] = 0.2;
    part->range[1] = 0.7 + 1e-16;
    scene_add_load_within(s, SCENE_MEMBER_MOMENT, LOADED, 0.7005, 1, 0, 0);
    scene_add_load_within(s, SCENE_MEMBER_MOMENT, LOADED, 0.9995, 1, 0, 0);
    scene_add_load_within(s, SCENE_MEMBER_MOMENT, OWN, 1, 1, 0, 0);
    scene_add_load_within(s, SCENE_MEMBER_FORCE, OWN, 0.5, 1, 0, 0);
}

static void pieces(const division *d)
{
    static const int expected[] = {1, 3, 2}, elements[] = {2, 6, 6};
    static const double place[] = {0, 0.1, 0.2, 0.45, 0.7, 0.85};
    for (int i = 0; i < 3; i++) {
        gsl_test_int(division_pieces(d, i), expected[i], "pieces of member %d", i);
        gsl_test_int(division_elements(d, i), elements[i], "elements of member %d", i);
    }
    for (int i = 0; i < 6; i++) {
        gsl_test_abs(division_place(d, LOADED, i, 0), place[i], 1e-15, "element %d begins", i);
        gsl_test_abs(division_inside(d, LOADED, i, place[i]), 0, 1e-14, "place of element %d", i);
    }
    gsl_test_abs(division_inside(d, LOADED, 3, 0.7), 1, 0, "a piece ends exactly");
}

static void elements_at(const division *d)
{
    static const struct {
        double place;
        int before, element;
        double x;
    } row[] = {{0, 0, 0, 0},    {0, 1, 0, 0},           {0.05, 0, 0, 0.5},      {0.2, 0, 2, 0},
               {0.2, 1, 1, 1},  {0.2 - 1e-16, 0, 2, 0}, {0.325, 0, 2, 0.5},     {0.325, 1, 2, 0.5},
               {0.45, 1, 2, 1}, {0.7, 0, 4, 0},         {0.7 + 1e-16, 1, 3, 1}, {1, 0, 5, 1},
               {1, 1, 5, 1}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        double x;
        gsl_test_int(division_at(d, LOADED, row[i].place, row[i].before, &x), row[i].element,
                     "element at %.17g, before: %d", row[i].place, row[i].before);
        gsl_test_abs(x, row[i].x, 1e-14, "point of it at %.17g, before: %d", row[i].place,
                     row[i].before);
    }
}

static void words(const scene *s)
{
    char text[400];
    division_words(s, 2, text, sizeof text);
    gsl_test(strcmp(text,
                    "member_1 has 6 elements, 2 in each of 3 pieces, because loads begin, end or "
                    "act at 0.2, 0.7 of the length; member_2 has 6 elements, 3 in each of 2 "
                    "pieces, because loads begin, end or act at 0.5 of the length") != 0,
             "words: %s", text);
    division_words(s, 0, text, 60);
    gsl_test(strncmp(text, "member_1 has n elements in each of 3 pieces, because ", 53) != 0,
             "words of any mesh: %s", text);
    division_words(s, 2, text, 40);
    gsl_test_int((int)strlen(text), 39, "words in little room");
}

static void division_tests(void)
{
    scene s;
    division d;
    fault f = {""};
    row(&s);
    gsl_test(division_make(&s, 2, &d, &f) != STATUS_OK, "is divided: %s", f.text);
    pieces(&d);
    elements_at(&d);
    words(&s);
    division_free(&d);
    scene_free(&s);
}

static void supports_tests(void)
{
    enum { N = 6 };
    const double at[3] = {0.3, -0.7, 1.1}, length = 2;
    const double expected[N][N] = {{1, 0, 0, 0, at[2] / length, -at[1] / length},
                                   {0, 1, 0, -at[2] / length, 0, at[0] / length},
                                   {0, 0, 1, at[1] / length, -at[0] / length, 0},
                                   {0, 0, 0, 1 / length, 0, 0},
                                   {0, 0, 0, 0, 1 / length, 0},
                                   {0, 0, 0, 0, 0, 1 / length}};
    double G[N * N + 1];
    for (int i = 0; i <= N * N; i++)
        G[i] = 17;
    supports_rigid(at, length, G);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            gsl_test_abs(G[N * i + j], expected[i][j], 1e-15, "entry %d, %d", i, j);
    gsl_test(G[N * N] != 17, "what stands behind is left alone");
}

int main(void)
{
    initial_tests();
    centreline_tests();
    division_tests();
    supports_tests();
    return gsl_test_summary();
}
