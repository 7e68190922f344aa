/* Members whose section changes along them: how many kinds of elements there are, the sections that
 * they have, and what no formulation was asked for. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/section/taper.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model_impl.h"

enum { PROFILE_ELEMENTS = 5 };

static section_spec rectangle(double width)
{
    section_spec spec = section_spec_rectangle(2e11, 8e10, width, 0.01);
    spec.given.Iw = 0;
    return spec;
}

/* Members in a row along x between the sections of these indices. */
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
    const model_request what = {s, type, NULL, elements, 0};
    return model_alloc(&what, &m, f) == STATUS_OK ? m : NULL;
}

/* One kind for each element of a change, however many members have it; one for a member without. */
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

/* Element i of n has the section at (i + 1/2)/n. */
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

/* Doubly symmetric at its ends, with its flanges to either side, and a channel between. */
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

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        kinds(registry_formulations[i]);
        middles(registry_formulations[i]);
    }
    between();
    return gsl_test_summary();
}
