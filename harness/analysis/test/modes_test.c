/* What a mode looks like, asked of motions that are made up: each family, any number of half-waves,
 * members in any direction, and motions in which no vertex leaves its place. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"
#include "elements/math/rotation.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

enum { ELEMENTS = 24, MEMBERS = 2, MOST_WAVES = 5, TURN_Y = 4, TURN_Z = 5, WARPING = 6 };
static const double length = 2;

/* Two equal members along x', the first axis of any triad: the second does not count for
 * half-waves. */
static int make(const double R[9], scene *s, model **m)
{
    fault f = {""};
    section_spec spec = section_spec_rectangle(2e11, 8e10, 0.2, 0.1);
    scene_init(s, "made_up");
    const double y[3] = {R[1], R[4], R[7]};
    const int profile = scene_add_section(s, &spec);
    for (int i = 0; i < MEMBERS; i++) {
        const int p = scene_add_node(s, 5 * i, 0, 0),
                  q = scene_add_node(s, 5 * i + length * R[0], length * R[3], length * R[6]);
        scene_add_member(s, p, q, profile, y);
    }
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
    scene_add_modal(s, SCENE_NONE);
    const model_request request = {s, formulation_find("geometrically_exact"), NULL, ELEMENTS, 1};
    const status made = model_alloc(&request, m, &f);
    gsl_test(made != STATUS_OK, "two members: %s", f.text);
    return made == STATUS_OK;
}

/* Adds to a mode: local component k of every vertex of a member follows a sine of so many
 * half-waves. */
static void add(const model *m, const double R[9], int member, int k, int waves, double size,
                double x[])
{
    int vertex[2 * ELEMENTS + 1];
    const int count = model_member_vertices(m, member, vertex);
    for (int i = 0; i < count; i++) {
        const double value = size * sin(waves * PI * (i + 0.3) / (count - 1 + 0.6));
        const mesh_vertex *v = model_vertex(m, vertex[i]);
        if (k < WARPING)
            for (int c = 0; c < 3; c++)
                x[v->coordinate[3 * (k / 3) + c]] += R[3 * c + k % 3] * value;
        else
            for (int e = model_first_element(m, member); e < model_first_element(m, member + 1);
                 e++)
                for (int end = 0; end < model_nodes(m); end++)
                    if (model_element(m, e)->vertex[end] == vertex[i])
                        x[model_warp(m, model_element(m, e)->warp[end])] = value;
    }
}

typedef struct modes_part {
    int component, waves; /* of the member's own axes; on the first member */
    double size;
} modes_part;

static void modes_compare(const model *m, const scene *s, const double R[9], int parts,
                          const modes_part *p, scene_family family, int half_waves,
                          const char *what)
{
    double *x = calloc((size_t)model_all_coordinates(m) + 1, sizeof *x);
    mode_shape shape = {SCENE_ANY, 0};
    fault f = {""};
    for (int i = 0; i < parts; i++)
        for (int member = 0; member < MEMBERS; member++)
            add(m, R, member, p[i].component, p[i].waves + member, p[i].size, x);
    gsl_test(modes_identify(m, s, x, &shape, &f) != STATUS_OK, "%s: %s", what, f.text);
    gsl_test(shape.family != family, "%s: %s", what, modes_family_name(shape.family));
    gsl_test_int(shape.half_waves, half_waves, "%s: half-waves", what);
    free(x);
}

static void in_direction(const double R[9])
{
    static const scene_family moved[] = {SCENE_AXIAL, SCENE_BENDING_Y, SCENE_BENDING_Z,
                                         SCENE_TORSION};
    scene s;
    model *m = NULL;
    if (make(R, &s, &m)) {
        const section *c = model_section(m, 0);
        const double r = sqrt(c->Ip / c->A);
        for (int waves = 1; waves <= MOST_WAVES; waves++) {
            for (int k = 0; k < 4; k++)
                modes_compare(m, &s, R, 1, &(modes_part){k, waves, 1e-3}, moved[k], waves,
                              "one motion");
            for (int k = 0; k < 4; k++)
                for (int other = 0; other < 4; other++)
                    if (other != k)
                        modes_compare(
                            m, &s, R, 2,
                            (modes_part[]){{k, waves, k == 3 ? 1 / r : 1},
                                           {other, waves + 2, other == 3 ? 0.8 / r : 0.8}},
                            moved[k], waves, "the larger of two motions");
            /* of sections that turn in place, and of warping */
            static const int turn[] = {TURN_Z, TURN_Y, WARPING};
            const double unit[] = {1 / r, 1 / r, 1 / (r * r)};
            for (int k = 0; k < 3; k++) {
                modes_compare(m, &s, R, 1, &(modes_part){turn[k], waves, 1}, moved[k + 1], waves,
                              "in place");
                for (int other = 0; other < 3; other++)
                    if (other != k)
                        modes_compare(m, &s, R, 2,
                                      (modes_part[]){{turn[k], waves, unit[k]},
                                                     {turn[other], waves + 2, 0.8 * unit[other]}},
                                      moved[k + 1], waves, "the larger of two turns in place");
                modes_compare(m, &s, R, 2,
                              (modes_part[]){{turn[k], waves, unit[k]}, {1, waves + 1, 1e-3}},
                              moved[1], waves + 1, "the least motion counts before turns");
                modes_compare(m, &s, R, 2,
                              (modes_part[]){{turn[k], waves, unit[k]}, {1, waves + 1, 1e-12}},
                              moved[k + 1], waves, "but for round-off");
            }
        }
    }
    model_free(m);
    scene_free(&s);
}

/* What a quantity asks for. */
static void families(void)
{
    for (int family = SCENE_AXIAL; family <= SCENE_TORSION; family++)
        for (int waves = 1; waves <= 3; waves++) {
            const mode_shape shape = {(scene_family)family, waves};
            for (int asked = SCENE_ANY; asked <= SCENE_TORSION; asked++)
                for (int half_waves = 0; half_waves <= 3; half_waves++) {
                    const scene_mode wanted = {.family = (scene_family)asked,
                                               .half_waves = half_waves};
                    const int fits = asked == SCENE_ANY || asked == family ||
                                     (asked == SCENE_NOT_AXIAL && family != SCENE_AXIAL);
                    gsl_test_int(modes_in_family(&wanted, &shape),
                                 fits && (half_waves == 0 || half_waves == waves),
                                 "family %d with %d half-waves, asked for %d with %d", family,
                                 waves, asked, half_waves);
                }
        }
}

int main(void)
{
    static const double along[][3] = {{1, 0, 0}, {0, 0, 1}, {1, -2, 3}},
                        beside[][3] = {{0, 1, 0}, {1, 0, 0}, {3, 1, 1}};
    for (int i = 0; i < 3; i++) {
        double R[9];
        rotation_triad(along[i], beside[i], R);
        in_direction(R);
    }
    families();
    return gsl_test_summary();
}
