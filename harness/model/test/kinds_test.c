/* What elements share: nothing that makes a difference, and everything else. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/analysis/analysis.h"
#include "harness/model/model_impl.h"
#include "harness/tools/kit/accepted.h"
#include "harness/tools/kit/ask.h"

enum { SECTIONS = 2, MOST_MEMBERS = 3 };
static const double young = 1e4, side[SECTIONS] = {0.1, 0.1 * (1 + 1e-6)};

typedef struct kinds_link {
    int section;
    double length, strain, curvature; /* curvature about z; 0: straight */
} kinds_link;

/* Links in a row along x between two nodes that are clamped; a force along x at the first joint. */
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

/* 1: solved. value: reaction at the end, shift of the first joint. */
static int solve(const element_type *type, int count, const kinds_link links[], double force,
                 int elements, double value[2], int *kinds)
{
    scene s;
    model *m = NULL;
    solve_result r = {0};
    fault f = {""};
    row_of(count, links, force, &s);
    const model_request what = {&s, type, NULL, elements, 0};
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

/* One kind for all elements of equal members, however many; one more for each thing that
 * differs. */
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

/* Arcs of one length to either side: their curvature is all that differs. */
static void arcs(const element_type *type)
{
    const kinds_link links[] = {{0, 1, 0, 0.1}, {0, 1, 0, -0.1}};
    double value[2];
    int kinds = 0;
    if ((type->offers & FEATURE_CURVATURE) && solve(type, 2, links, 0, 2, value, &kinds))
        gsl_test_int(kinds, 2, "%s: arcs to either side", type->name);
}

/* Without load and initial strain nothing is stressed: an element that takes another's length
 * would be. */
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

/* Strain e in one of two equal links: -EA e/2 at the end, and the joint moves by e/2. */
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

/* Sections that differ by 2e-6 in area carry a force between them by their stiffness. */
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

int main(void)
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
    return gsl_test_summary();
}
