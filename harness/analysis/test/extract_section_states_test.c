/* Resultants and stresses inside members that twist far, turn steadily, or have their shear centre
 * beside them. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>

#include "harness/tools/kit/accepted.h"
#include "harness/tools/kit/ask.h"

/* A strip, free to shorten and to warp, twisted by 0.6 rad: kappa is uniform, M = G J kappa + 4 E c
 * kappa^3, and its edges are stretched. */
static void strip(const element_type *e, ask_tally *tally)
{
    const double y[3] = {0, 1, 0}, w = 0.04, h = 1e-3, l = 0.4, path[2] = {0, 1},
                 turn[2] = {0, 0.6};
    static answer a;
    scene s;
    const section_spec spec = section_spec_rectangle(200e9, 80e9, w, h);
    section c;
    scene_init(&s, "strip");
    const int root = scene_add_node(&s, 0, 0, 0), tip = scene_add_node(&s, l, 0, 0);
    scene_hold_all(&s, root);
    scene_hold(&s, tip, SCENE_UY, SCENE_UZ);
    scene_hold(&s, tip, SCENE_RY, SCENE_RZ);
    scene_drive(&s, tip, SCENE_RX, scene_add_driver(&s, "turn", 2, path, turn));
    scene_add_member(&s, root, tip, scene_add_section(&s, &spec), y);
    scene_omit(&s, FEATURE_SHEAR | FEATURE_ROTARY_INERTIA);
    const int twisted = scene_add_static(&s, 1, &path[1], 4);
    scene_add_quantity(&s, "torque", "N m", twisted, scene_internal_at(0, 0.3, SCENE_MX));
    scene_add_quantity(&s, "shear", "N m", twisted,
                       scene_internal_at(0, 0.3, SCENE_MX_SAINT_VENANT));
    scene_add_quantity(&s, "fibres", "N m", twisted, scene_internal_at(0, 0.3, SCENE_MX_WAGNER));
    scene_add_quantity(&s, "edge", "Pa", twisted, scene_stress_along(0, SCENE_NORMAL_MAX));
    scene_add_quantity(&s, "middle", "Pa", twisted, scene_stress_along(0, SCENE_NORMAL_MIN));
    gsl_test(scene_constants(&s, 0, &c, NULL) != STATUS_OK, "a strip");
    ask_scene(&s, e, NULL, 4, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "strip"))
        return;
    const double k = 0.6 / l, shear = 80e9 * c.It * k,
                 fibres = 4 * 200e9 * c.wagner_torque * k * k * k,
                 exact[] = {shear + fibres, shear, fibres, 200e9 * k * k * (w * w + h * h) / 12,
                            -200e9 * k * k * (w * w + h * h) / 24};
    for (int i = 0; i < a.count; i++)
        gsl_test_rel(a.value[i], exact[i], 1e-5, "%s: %s of a twisted strip", e->name, a.name[i]);
}

/* A blade that turns about z, its root on the axis: N = rho A Omega^2 (l^2 - x^2)/2, but for its
 * stretch of some 1e-6. */
static void blade(const element_type *e, ask_tally *tally)
{
    const double y[3] = {0, 1, 0}, l = 0.5, one = 1, omega = 20;
    static answer a;
    scene s;
    section_spec spec = section_spec_rectangle(200e9, 80e9, 0.02, 0.01);
    spec.density = 7800;
    scene_init(&s, "blade");
    const int root = scene_add_node(&s, 0, 0, 0), tip = scene_add_node(&s, l, 0, 0);
    scene_hold_all(&s, root);
    scene_add_member(&s, root, tip, scene_add_section(&s, &spec), y);
    const int turning =
        scene_add_rotation(&s, 1, &one, 1, 0, (scene_rotating_frame){.omega = {0, 0, omega}});
    scene_add_quantity(&s, "N", "N", turning, scene_internal_at(0, 0.6, SCENE_N));
    scene_add_quantity(&s, "stress", "Pa", turning, scene_stress_along(0, SCENE_VON_MISES));
    ask_scene(&s, e, NULL, 3, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "blade"))
        return;
    const double root_stress = 7800 * omega * omega * l * l / 2;
    gsl_test_rel(a.value[0], root_stress * 0.02 * 0.01 * (1 - 0.36), 1e-4, "%s: pull inside",
                 e->name);
    gsl_test_rel(a.value[1], root_stress, 1e-4, "%s: stress at the root", e->name);
}

/* A C under a force at its centroid, root held: torque F e about the shear centre, B = F e/lambda
 * tanh(lambda l). */
static void channel(const element_type *e, ask_tally *tally)
{
    static const double y[3] = {0, 1, 0}, t[3] = {3e-3, 3e-3, 3e-3},
                        point[4][2] = {{-0.03, 0.05}, {0.02, 0.05}, {0.02, -0.05}, {-0.03, -0.05}};
    static answer a;
    scene s;
    section c;
    const double l = 1.5, F = 40;
    const section_spec spec = section_spec_walls(200e9, 80e9, 3, point, NULL, t);
    scene_init(&s, "channel");
    const int root = scene_add_node(&s, 0, 0, 0), tip = scene_add_node(&s, l, 0, 0),
              member = scene_add_member(&s, root, tip, scene_add_section(&s, &spec), y);
    scene_hold_all(&s, root);
    scene_member_at(&s, member)->warp_p = SCENE_WARP_FIXED;
    scene_add_load(&s, SCENE_FORCE, tip, 0, 0, F);
    const int linear = scene_add_linear(&s);
    scene_add_quantity(&s, "root", "N m^2", linear, scene_internal_at(0, 0, SCENE_BIMOMENT));
    scene_add_quantity(&s, "inside", "N m^2", linear,
                       scene_internal_along(0, SCENE_ALONG_LARGEST, SCENE_BIMOMENT));
    scene_add_quantity(&s, "stress", "Pa", linear, scene_stress_along(0, SCENE_NORMAL_MAX));
    gsl_test(scene_constants(&s, 0, &c, NULL) != STATUS_OK, "a C");
    ask_scene(&s, e, NULL, 16, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "channel"))
        return;
    const double k = sqrt(80e9 * c.It / (200e9 * c.Iw)), B = F * fabs(c.ys) / k * tanh(k * l);
    /* at the ends of flanges and at their corners: e of a thin C, and the warping function there */
    const double f = 0.05, h = 0.1, web = 3 * f * f / (h + 6 * f), tip_omega = h / 2 * (f - web),
                 corner = h / 2 * web, bend = F * l * h / 2 / c.Iy,
                 most = fmax(bend + B * corner / c.Iw, fabs(bend - B * tip_omega / c.Iw));
    gsl_test_rel(fabs(c.ys - 0.02 + c.centroid[0]), web, 1e-12, "shear centre of a C");
    gsl_test_rel(fabs(a.value[0]), B, 3e-3, "%s: bimoment at the root", e->name);
    gsl_test_rel(a.value[1], fabs(a.value[0]), 1e-9, "%s: it is largest there", e->name);
    gsl_test_rel(a.value[2], most, 3e-3, "%s: bending and bimoment together", e->name);
}

/* A bar that tapers from h to h/4 under a force at its thin tip: 6 F b/(w h(b)^2) is largest a
 * third of the length from there, whatever the elements, each of which has the section of its
 * middle. */
static void tapered(const element_type *e, ask_tally *tally, int elements)
{
    const double y[3] = {0, 1, 0}, w = 0.02, h = 0.04, l = 0.9, F = 50;
    static answer a;
    scene s;
    const section_spec thick = section_spec_rectangle(200e9, 80e9, w, h),
                       thin = section_spec_rectangle(200e9, 80e9, w, h / 4);
    scene_init(&s, "tapered");
    const int root = scene_add_node(&s, 0, 0, 0), tip = scene_add_node(&s, l, 0, 0),
              member = scene_add_member(&s, root, tip, scene_add_section(&s, &thick), y);
    scene_member_at(&s, member)->section_q = scene_add_section(&s, &thin);
    scene_hold_all(&s, root);
    scene_add_load(&s, SCENE_FORCE, tip, 0, F, 0);
    const int linear = scene_add_linear(&s);
    scene_add_quantity(&s, "largest", "Pa", linear, scene_stress_along(0, SCENE_NORMAL_MAX));
    scene_add_quantity(&s, "root", "Pa", linear, scene_stress_at(0, 0, SCENE_NORMAL_MIN));
    scene_add_quantity(&s, "shear", "Pa", linear, scene_stress_at(0, 1, SCENE_VON_MISES));
    ask_scene(&s, e, NULL, elements, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "taper of %d elements", elements))
        return;
    const double exact[] = {6 * F * (l / 3) / (w * h * h / 4), -6 * F * l / (w * h * h),
                            sqrt(3) * 1.5 * F / (w * h / 4)};
    for (int i = 0; i < a.count; i++)
        gsl_test_rel(a.value[i], exact[i], 1e-8, "%s: %s of a taper, %d elements", e->name,
                     a.name[i], elements);
}

/* An angle whose legs change turns its principal axes along the member: forces at its ends are in
 * those of the section there, not of the element. */
static void turning_axes(const element_type *e, ask_tally *tally, int elements)
{
    const double y[3] = {0, 1, 0}, F[3] = {0, 30, 50}, l = 0.9, t[2] = {2e-3, 2e-3};
    const double leg[2][2] = {{0.08, 0.03}, {0.05, 0.045}};
    static const int walls[2][2] = {{0, 1}, {0, 2}};
    static answer a;
    scene s;
    section c[2];
    int profile[2];
    scene_init(&s, "angle");
    const int root = scene_add_node(&s, 0, 0, 0), tip = scene_add_node(&s, l, 0, 0);
    for (int k = 0; k < 2; k++) {
        const double point[3][2] = {{0, 0}, {leg[k][0], 0}, {0, leg[k][1]}};
        const section_spec spec = section_spec_walls(200e9, 80e9, 2, point, walls, t);
        gsl_test(section_compute(&spec, &c[k], NULL) != STATUS_OK, "an angle");
        profile[k] = scene_add_section(&s, &spec);
    }
    scene_member_at(&s, scene_add_member(&s, root, tip, profile[0], y))->section_q = profile[1];
    scene_hold_all(&s, root);
    scene_omit(&s, FEATURE_WARPING);
    scene_add_load(&s, SCENE_FORCE, tip, F[0], F[1], F[2]);
    const int linear = scene_add_linear(&s);
    static const char *const name[2][2] = {{"Qy from", "Qz from"}, {"Qy to", "Qz to"}};
    for (int k = 0; k < 2; k++) {
        scene_add_quantity(&s, name[k][0], "N", linear, scene_internal_at(0, k, SCENE_QY));
        scene_add_quantity(&s, name[k][1], "N", linear, scene_internal_at(0, k, SCENE_QZ));
    }
    ask_scene(&s, e, NULL, elements, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "an angle that tapers, %d elements", elements))
        return;
    gsl_test(!(fabs(c[0].axes_angle - c[1].axes_angle) > 0.1), "its axes turn");
    for (int k = 0; k < 2; k++) {
        const double cosine = cos(c[k].axes_angle), sine = sin(c[k].axes_angle);
        gsl_test_rel(a.value[2 * k], cosine * F[1] + sine * F[2], 1e-8, "%s: %s of %d", e->name,
                     a.name[2 * k], elements);
        gsl_test_rel(a.value[2 * k + 1], cosine * F[2] - sine * F[1], 1e-8, "%s: %s of %d", e->name,
                     a.name[2 * k + 1], elements);
    }
}

/* All of it, of a section without symmetry under every load. */
static void everything(scene *s, int whole)
{
    static const double y[3] = {0, 1, 0}, t[3] = {3e-3, 2e-3, 4e-3},
                        point[4][2] = {{-0.03, 0.05}, {0.02, 0.06}, {0.02, -0.05}, {-0.05, -0.04}};
    const section_spec spec = section_spec_walls(200e9, 80e9, 3, point, NULL, t);
    scene_init(s, "everything");
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, 1.5, 0.3, 0.2),
              member = scene_add_member(s, root, tip, scene_add_section(s, &spec), y);
    scene_hold_all(s, root);
    scene_member_at(s, member)->warp_p = SCENE_WARP_FIXED;
    scene_add_load(s, SCENE_FORCE, tip, 200, -30, 40);
    scene_add_load(s, SCENE_MOMENT, tip, 5, 7, -3);
    scene_load_at(s, scene_add_load(s, SCENE_DISTRIBUTED, member, 20, 30, 10))->axes =
        SCENE_AXES_MEMBER;
    const int linear = scene_add_linear(s);
    for (int r = SCENE_N; r <= SCENE_MX_WARPING; r++)
        for (int along = SCENE_ALONG_PLACE; along <= SCENE_ALONG_LARGEST; along++) {
            char name[SCENE_NAME];
            snprintf(name, sizeof name, "%d_%d", r, along);
            if (along == SCENE_ALONG_PLACE || whole)
                scene_add_quantity(
                    s, name, "1", linear,
                    along == SCENE_ALONG_PLACE
                        ? scene_internal_at(member, 0.3, (scene_resultant)r)
                        : scene_internal_along(member, (scene_along)along, (scene_resultant)r));
        }
    for (int i = SCENE_VON_MISES; i <= SCENE_NORMAL_MIN; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "stress_%d", i);
        scene_add_quantity(s, name, "Pa", linear,
                           whole ? scene_stress_along(member, (scene_stress_measure)i)
                                 : scene_stress_at(member, 0.8, (scene_stress_measure)i));
    }
}

/* The same answer when the member runs the other way, is two, or is measured in millimetres. */
static void in_other_words(const element_type *e, ask_tally *tally)
{
    static const scene_edit edits[] = {
        {SCENE_EDIT_REVERSE, 0}, {SCENE_EDIT_UNIT, 1000}, {SCENE_EDIT_SPLIT, 0.5}};
    static answer a, b;
    for (int i = 0; i < 3; i++) {
        scene s;
        fault f = {""};
        everything(&s, edits[i].kind != SCENE_EDIT_SPLIT);
        ask_scene(&s, e, NULL, 4, &a);
        gsl_test(scene_edit_apply(&s, &edits[i], &f) != STATUS_OK, "edit %d: %s", i, f.text);
        ask_scene(&s, e, NULL, edits[i].kind == SCENE_EDIT_SPLIT ? 2 : 4, &b);
        scene_free(&s);
        if (!ask_count(tally, &a, "everything") || !ask_count(tally, &b, "edit %d", i))
            continue;
        for (int k = 0; k < a.count; k++)
            gsl_test(!(fabs(b.value[k] - a.value[k]) <= 1e-7 * (fabs(a.value[k]) + 1e-2)),
                     "%s: %s in other words %d: %.12g, %.12g", e->name, a.name[k], i, b.value[k],
                     a.value[k]);
    }
    scene s;
    fault f = {""};
    everything(&s, 1);
    gsl_test(scene_edit_apply(&s, &edits[2], &f) != STATUS_REFUSED, "the whole is not split");
    scene_free(&s);
}

int main(void)
{
    for (int i = 0; accepted_at(i) != NULL; i++) {
        const element_type *e = accepted_at(i);
        ask_tally tally = {0};
        strip(e, &tally);
        blade(e, &tally);
        channel(e, &tally);
        tapered(e, &tally, 1);
        tapered(e, &tally, 4);
        turning_axes(e, &tally, 1);
        turning_axes(e, &tally, 4);
        in_other_words(e, &tally);
        ask_conclude(&tally, e, "resultants of states");
    }
    return gsl_test_summary();
}
