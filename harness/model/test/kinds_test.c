/* Elements must share the data of one kind if, and only if, all properties that affect these data
 * are equal. Also tests weights and distances of the metric, members with a varying section, and
 * sections given in rotated axes. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/section/section.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model_impl.h"
#include "harness/model/test/corner.h"
#include "harness/study/study.h"
#include "harness/tools/kit/accepted.h"
#include "harness/tools/kit/ask.h"

enum { SECTIONS = 2, MOST_MEMBERS = 3 };
static const double young = 1e4, side[SECTIONS] = {0.1, 0.1 * (1 + 1e-6)};

typedef struct kinds_link {
    int section;
    double length, strain, curvature; /* curvature about z [1/m]; 0: straight */
} kinds_link;

static void row_of(int count, const kinds_link links[], double force, scene *s)
{
    const double y[3] = {0, 1, 0}, end = 1;
    int profile[SECTIONS], last = 0;
    double at = 0;
    scene_init(s, "row");
    for (int i = 0; i < SECTIONS; i++) {
        section_spec spec = section_spec_rectangle(young, young / 2.6, side[i], side[i]);
        spec.given.Iw = 0;
        profile[i] = scene_add_section(s, &spec);
    }
    last = scene_add_node(s, 0, 0, 0);
    scene_hold_all(s, last);
    for (int i = 0; i < count; i++) {
        at += links[i].length;
        const int next = scene_add_node(s, at, 0, 0),
                  member = scene_add_member(s, last, next, profile[links[i].section], y);
        scene_member_at(s, member)->strain[0] = links[i].strain;
        scene_member_at(s, member)->curvature[2] = links[i].curvature;
        last = next;
    }
    scene_hold_all(s, last);
    scene_add_load(s, SCENE_FORCE, 1, force, 0, 0);
    const int path = scene_add_static(s, 1, &end, 1);
    static const char *const name[] = {"reaction", "shift"};
    for (int i = 0; i < 2; i++) {
        scene_add_quantity(s, name[i], "1", path,
                           i == 0 ? scene_reaction(last, SCENE_UX) : scene_coordinate(1, SCENE_UX));
    }
}

static int solve(const element_type *type, int count, const kinds_link links[], double force,
                 int elements, double value[2], int *kinds)
{
    scene s;
    model *m = NULL;
    solve_result r = {0};
    fault f = {""};
    row_of(count, links, force, &s);
    const model_request what = {&s, type, NULL, elements, 0, 0};
    status outcome = model_alloc(&what, &m, &f);
    const int offered = ask_offered(&s, type);
    if (outcome == STATUS_OK) {
        *kinds = m->mesh.kinds;
        outcome = solve_scene(&s, m, NULL, &r, &f);
        value[0] = r.quantity[0].value;
        value[1] = r.quantity[1].value;
    }
    gsl_test(offered && outcome != STATUS_OK, "%s: %s", type->name, f.text);
    result_free(&r);
    model_free(m);
    scene_free(&s);
    return outcome == STATUS_OK;
}

static void counts(const element_type *type)
{
    static const struct {
        kinds_link second;
        int kinds;
        const char *what;
    } row[] = {{{0, 1, 0, 0}, 1, "equal members"},
               {{1, 1, 0, 0}, 2, "another section"},
               {{0, 1 + 1e-9, 0, 0}, 2, "another length"},
               {{0, 1, 1e-9, 0}, 2, "another initial strain"},
               {{0, 1, 0, 1e-3}, 2, "another curvature"}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        const kinds_link links[] = {{0, 1, 0, 0}, row[i].second, {0, 1, 0, 0}};
        for (int elements = 1; elements <= 7; elements += 3) {
            double value[2];
            int kinds = 0;
            const int straight =
                row[i].second.curvature != 0 && !(type->offers & FEATURE_CURVATURE);
            if (solve(type, MOST_MEMBERS, links, 0, elements, value, &kinds) && !straight)
                gsl_test_int(kinds, row[i].kinds, "%s, %d elements a member: kinds of %s",
                             type->name, elements, row[i].what);
        }
    }
}

static void arcs(const element_type *type)
{
    const kinds_link links[] = {{0, 1, 0, 0.1}, {0, 1, 0, -0.1}};
    double value[2];
    int kinds = 0;
    if ((type->offers & FEATURE_CURVATURE) && solve(type, 2, links, 0, 2, value, &kinds))
        gsl_test_int(kinds, 2, "%s: arcs to either side", type->name);
}

static void lengths(const element_type *type)
{
    static const double apart[] = {1e-3, 1e-6, 1e-9, 1e-11};
    const double A = side[0] * side[0];
    for (size_t i = 0; i < sizeof apart / sizeof apart[0]; i++) {
        const kinds_link links[] = {{0, 1, 0, 0}, {0, 1 + apart[i], 0, 0}};
        double value[2];
        int kinds;
        if (solve(type, 2, links, 0, 2, value, &kinds))
            gsl_test(!(fabs(value[0]) <= 1e-14 * young * A),
                     "%s: lengths 1 and 1 + %g: stressed by %.1e of EA", type->name, apart[i],
                     value[0] / (young * A));
    }
}

/* With the initial strain e in one of two equal links, which are held at the outer ends, the force
 * at the end must be -EA e/2, and the joint must move by e/2 times the length of a link. */
static void strains(const element_type *type)
{
    static const double strain[] = {1e-3, -1e-7, 1e-10};
    const double A = side[0] * side[0];
    for (size_t i = 0; i < sizeof strain / sizeof strain[0]; i++) {
        const kinds_link links[] = {{0, 1, strain[i], 0}, {0, 1, 0, 0}};
        double value[2];
        int kinds;
        if (!solve(type, 2, links, 0, 1, value, &kinds))
            continue;
        gsl_test_rel(value[0], -young * A * strain[i] / 2, 1e-4,
                     "%s: strain %g in one of two: force", type->name, strain[i]);
        gsl_test_rel(value[1], strain[i] / 2, 1e-4, "%s: strain %g in one of two: shift",
                     type->name, strain[i]);
    }
}

static void sections(const element_type *type)
{
    const double A0 = side[0] * side[0], A1 = side[1] * side[1], force = 1e-6 * young * A0;
    for (int first = 0; first < 2; first++) {
        const kinds_link links[] = {{first, 1, 0, 0}, {1 - first, 1, 0, 0}};
        double value[2];
        int kinds;
        const double area = first == 0 ? A1 : A0;
        if (solve(type, 2, links, force, 1, value, &kinds))
            gsl_test(!(fabs(value[0] / (-force * area / (A0 + A1)) - 1) <= 4e-7),
                     "%s: section %d first: force %.9g, not %.9g", type->name, first, value[0],
                     -force * area / (A0 + A1));
    }
}

static void kinds_tests(void)
{
    int offered = 0;
    for (int i = 0; accepted_at(i) != NULL; i++) {
        const element_type *type = accepted_at(i);
        counts(type);
        arcs(type);
        lengths(type);
        strains(type);
        sections(type);
        offered += (type->offers & FEATURE_CURVATURE) != 0;
    }
    gsl_test(offered < 3, "%d formulations with initial strains", offered);
}

enum { ELEMENTS = 3, BODIES = 6 };

static void one_motion(const model *m, int vertex, int component, double size)
{
    static const double amount = 0.3;
    const int turns = component >= SCENE_RX, n = m->mesh.free + m->mesh.driven;
    const double share = turns ? 1.0 / BODIES : 1.0 / BODIES / (size * size);
    double *weight = calloc((size_t)n + 1, sizeof *weight), turn[3] = {0}, step[4];
    model_state *a, *b;
    fault f = {""};
    gsl_test(kinematics_state_alloc(m, &a, &f) != STATUS_OK ||
                 kinematics_state_alloc(m, &b, &f) != STATUS_OK,
             "states: %s", f.text);
    for (int i = 0; i <= n; i++)
        weight[i] = 17;
    metric_of(m, weight);
    gsl_test(weight[n] != 17, "what stands behind the weights is left alone");
    gsl_test_rel(weight[m->mesh.vertex[vertex].coordinate[component]], share, 1e-14,
                 "vertex %d, component %d: weight", vertex, component);
    if (turns) {
        turn[component - SCENE_RX] = amount;
        rotation_exp(turn, step);
        rotation_compose(step, &a->q[4 * vertex], &b->q[4 * vertex]);
    } else {
        b->u[3 * vertex + component] += amount;
    }
    gsl_test_rel(metric_distance(m, a, b, NULL), amount * sqrt(share), 1e-13,
                 "vertex %d, component %d: distance", vertex, component);
    gsl_test_abs(metric_turn_between(m, a, b), turns ? amount : 0, 1e-13,
                 "vertex %d, component %d: turn", vertex, component);
    kinematics_state_free(a);
    kinematics_state_free(b);
    free(weight);
}

static void metric_tests(void)
{
    scene s;
    model *m = NULL;
    if (corner("beamw", ELEMENTS, 1, &s, &m)) {
        int bodies = 0;
        for (int v = 0; v < m->mesh.vertices; v++) {
            const mesh_vertex *here = &m->mesh.vertex[v];
            if (here->body != v || here->coordinate[0] == NONE)
                continue;
            bodies++;
            for (int c = 0; c < VERTEX_COORDINATES; c++)
                one_motion(m, v, c, 2);
        }
        gsl_test_int(bodies, BODIES, "bodies that move");
    }
    model_free(m);
    scene_free(&s);
}

enum { PROFILE_ELEMENTS = 5 };

static section_spec rectangle(double width)
{
    section_spec spec = section_spec_rectangle(2e11, 8e10, width, 0.01);
    spec.given.Iw = 0;
    return spec;
}

static void profile_row_of(int members, const int ends[][2], scene *s)
{
    const double y[3] = {0, 1, 0};
    scene_init(s, "row");
    for (int i = 0; i < 3; i++) {
        const section_spec spec = rectangle(0.01 * (i + 1));
        scene_add_section(s, &spec);
    }
    for (int i = 0; i <= members; i++)
        scene_add_node(s, i, 0, 0);
    scene_hold_all(s, 0);
    for (int i = 0; i < members; i++)
        scene_member_at(s, scene_add_member(s, i, i + 1, ends[i][0], y))->section_q = ends[i][1];
}

static model *meshed(const scene *s, const element_type *type, int elements, fault *f)
{
    model *m = NULL;
    const model_request what = {s, type, NULL, elements, 0, 0};
    return model_alloc(&what, &m, f) == STATUS_OK ? m : NULL;
}

static void kinds(const element_type *type)
{
    static const struct {
        int members, ends[3][2], kinds;
        const char *what;
    } row[] = {{3, {{0, 0}, {0, 0}, {0, 0}}, 1, "none changes"},
               {1, {{0, 1}}, PROFILE_ELEMENTS, "one changes"},
               {3, {{0, 1}, {0, 1}, {0, 1}}, PROFILE_ELEMENTS, "the same change three times"},
               {2, {{0, 1}, {1, 2}}, 2 * PROFILE_ELEMENTS, "two changes"},
               {2, {{0, 1}, {1, 0}}, 2 * PROFILE_ELEMENTS, "there and back"},
               {3, {{0, 1}, {1, 1}, {1, 1}}, PROFILE_ELEMENTS + 1, "one of three"}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        scene s;
        fault f = {""};
        profile_row_of(row[i].members, row[i].ends, &s);
        model *m = meshed(&s, type, PROFILE_ELEMENTS, &f);
        gsl_test(m == NULL, "%s, %s: %s", type->name, row[i].what, f.text);
        if (m != NULL)
            gsl_test_int(m->mesh.kinds, row[i].kinds, "%s: kinds where %s", type->name,
                         row[i].what);
        model_free(m);
        scene_free(&s);
    }
}

static void middles(const element_type *type)
{
    const int ends[][2] = {{2, 0}};
    scene s;
    fault f = {""};
    profile_row_of(1, ends, &s);
    model *m = meshed(&s, type, PROFILE_ELEMENTS, &f);
    gsl_test(m == NULL, "%s: %s", type->name, f.text);
    for (int i = 0; m != NULL && i < PROFILE_ELEMENTS; i++) {
        const double width = 0.03 - 0.02 * (i + 0.5) / PROFILE_ELEMENTS;
        gsl_test_rel(m->section[m->mesh.kind[m->mesh.element[i].kind].section].width, width, 1e-14,
                     "%s: width of element %d", type->name, i);
    }
    model_free(m);
    scene_free(&s);
}

/* Returns a section of three walls with its web along z. The flanges end at y = upper and y = lower
 * [m]. */
static section_spec flanges(double upper, double lower)
{
    const double point[][2] = {{upper, 0.05}, {0, 0.05}, {0, -0.05}, {lower, -0.05}},
                 thickness[] = {1e-3, 1e-3, 1e-3};
    section_spec spec = section_spec_walls(2e11, 8e10, 3, point, NULL, thickness);
    spec.given.Iw = 0;
    return spec;
}

static void between(void)
{
    const double y[3] = {0, 1, 0};
    const section_spec zed = flanges(0.04, -0.04), mirrored = flanges(-0.04, 0.0401);
    const element_type *type = NULL;
    scene s;
    fault f = {""};
    for (int i = 0; registry_formulations[i] != NULL; i++)
        if (strcmp(registry_formulations[i]->name, "collocation") == 0)
            type = registry_formulations[i];
    scene_init(&s, "between");
    const int p = scene_add_node(&s, 0, 0, 0), q = scene_add_node(&s, 1, 0, 0),
              first = scene_add_section(&s, &zed), last = scene_add_section(&s, &mirrored);
    scene_hold_all(&s, p);
    scene_member_at(&s, scene_add_member(&s, p, q, first, y))->section_q = last;
    model *m = type != NULL ? meshed(&s, type, 1, &f) : NULL;
    gsl_test(m != NULL || strstr(f.text, "member 0") == NULL,
             "a flange that vanishes between the ends is refused, and where (%s)", f.text);
    model_free(m);
    scene_free(&s);
}

static void profile_tests(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        kinds(registry_formulations[i]);
        middles(registry_formulations[i]);
    }
    between();
}

enum { ANGLE = CASE_MAX_PARAMETERS - 1, ORIGINAL = CASE_MAX_PARAMETERS - 2 };

static status turned(const double value[], scene *s, fault *f)
{
    const double c = cos(value[ANGLE]), d = sin(value[ANGLE]);
    const status outcome = case_build(registry_cases[(int)value[ORIGINAL]], value, s, f);
    for (int i = 0; i < s->sections && outcome == STATUS_OK; i++)
        for (int k = 0; k < s->section[i].points; k++) {
            const double y = s->section[i].point[k][0], z = s->section[i].point[k][1];
            s->section[i].point[k][0] = c * y + d * z;
            s->section[i].point[k][1] = c * z - d * y;
        }
    for (int i = 0; i < s->members && outcome == STATUS_OK; i++) {
        const double y = s->member[i].y_axis[1], z = s->member[i].y_axis[2];
        s->member[i].y_axis[1] = c * y - d * z;
        s->member[i].y_axis[2] = c * z + d * y;
    }
    return outcome;
}

static status turned_solve(int original, double angle, const element_type *element,
                           cell_result *out)
{
    case_type type = *registry_cases[original];
    cell_request request = {.type = &type, .elements = 4};
    formulation chosen;
    fault f = {""};
    formulation_default(element, &chosen);
    cell_formulation(&request, &chosen);
    parameters_default(&type, request.parameter);
    request.parameter[ORIGINAL] = original;
    request.parameter[ANGLE] = angle;
    type.build = turned;
    return cell_run(&request, out, &f);
}

static int compare(int original, const element_type *element)
{
    static const double angle[] = {0.5, 1.5707963267948966, -2.2};
    cell_result before, after;
    int compared = 0;
    const int runs = turned_solve(original, 0, element, &before) == STATUS_OK;
    gsl_test(!runs && ask_offered(&before.scene, element), "%s, %s: solved where it is offered %s",
             before.scene.name, element->name, before.solve.reason);
    const int lacks = (element->lacks & LACKS_SHEAR_Y) && !ask_offered(&before.scene, element);
    const size_t angles = runs && !lacks ? sizeof angle / sizeof angle[0] : 0;
    for (size_t k = 0; k < angles; k++) {
        gsl_test(turned_solve(original, angle[k], element, &after) != STATUS_OK,
                 "%s, %s turned by %g: %s", before.scene.name, element->name, angle[k],
                 after.solve.reason);
        for (int i = 0; i < after.solve.quantities; i++) {
            const double expected = before.solve.quantity[i].value,
                         value = after.solve.quantity[i].value;
            if (before.solve.quantity[i].curve.points > 0)
                continue;
            gsl_test(!(fabs(value - expected) <= 1e-9 * fabs(expected)),
                     "%s, %s turned by %g: %s %.12g, not %.12g", before.scene.name, element->name,
                     angle[k], before.scene.quantity[i].name, value, expected);
            compared++;
        }
        cell_result_free(&after);
    }
    cell_result_free(&before);
    return compared;
}

static void turned_tests(void)
{
    int compared = 0;
    for (int i = 0; registry_cases[i] != NULL; i++)
        for (int k = 0; registry_formulations[k] != NULL; k++)
            if (strcmp(registry_cases[i]->name, "moment_buckling") == 0 ||
                strcmp(registry_cases[i]->name, "unsymmetric_column") == 0 ||
                strcmp(registry_cases[i]->name, "c_column") == 0)
                compared += compare(i, registry_formulations[k]);
    gsl_test(compared < 100, "%d values were compared", compared);
}

int main(void)
{
    kinds_tests();
    metric_tests();
    profile_tests();
    turned_tests();
    return gsl_test_summary();
}
