/* Resultants and stresses inside members compared with statics, the elastica and Vlasov torsion,
 * also in members that twist far, rotate steadily, or have an eccentric shear centre. */
#include <gsl/gsl_integration.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>

#include "harness/tools/kit/accepted.h"
#include "harness/tools/kit/scenes.h"

#define BARS "harness/analysis/test/bars.yaml"

static void statics(const element_type *e, ask_tally *tally, int elements)
{
    static answer a;
    scenes_ask(BARS, e, elements, &a, "load=all");
    if (!ask_count(tally, &a, "statics of %d elements", elements))
        return;
    const double b = 1.3, top = 0.5 / 0.9;
    const double exact[] = {0.5 + 0.1 * b,
                            0.4 - 0.9 * b,
                            -0.3 + 0.3 * b,
                            0.7 + 0.3 * b,
                            -0.2 + 0.3 * b - 0.15 * b * b,
                            0.6 + 0.5 * b - 0.45 * b * b,
                            0.6 + 0.5 * top - 0.45 * top * top,
                            0.6 + 0.5 * 2 - 0.45 * 4,
                            0.6 + 0.5 * top - 0.45 * top * top};
    for (int i = 0; i < a.count; i++)
        gsl_test_abs(a.value[i], exact[i], 1e-9, "%s: %s of %d elements", e->name, a.name[i],
                     elements);
}

static double slope(double u, void *top)
{
    /* d s/d u at sin theta = top - u^2 for F/EI = 1, where s is the arc length and theta the
     * inclination: ds = d theta/sqrt(2 (top - sin theta)) */
    const double sine = *(double *)top - u * u;
    return sqrt(2) / sqrt(1 - sine * sine);
}

static double arc(double top, double u)
{
    double sum, error;
    size_t count;
    gsl_function f = {slope, &top};
    gsl_integration_qng(&f, 0, u, 1e-13, 1e-13, &sum, &error, &count);
    return sum;
}

/* Returns the moment in an inextensible cantilever of length 2 with EI = 1 under a dead transverse
 * unit force (Bernoulli's elastica): M/EI = sqrt(2) u at the arc length `beyond` from the tip. */
static double elastica(double beyond)
{
    double low = 0.5, high = 0.99999, least = 0, most;
    for (int i = 0; i < 100; i++) {
        const double top = (low + high) / 2;
        *(arc(top, sqrt(top)) < 2 ? &low : &high) = top;
    }
    most = sqrt(low);
    for (int i = 0; i < 100; i++) {
        const double u = (least + most) / 2;
        *(arc(low, u) < beyond ? &least : &most) = u;
    }
    return sqrt(2) * (least + most) / 2;
}

static double bent(const element_type *e, ask_tally *tally, int elements, double error[2])
{
    static answer a;
    scenes_ask(BARS, e, elements, &a, "load=across");
    if (!ask_count(tally, &a, "elastica of %d elements", elements))
        return 0;
    error[0] = fabs(a.value[0] - elastica(2));
    error[1] = fabs(a.value[1] - elastica(1.26));
    gsl_test_rel(a.value[2], a.value[0], 1e-9, "%s: the moment is largest at the root", e->name);
    return 1;
}

static void bends(const element_type *e, ask_tally *tally)
{
    double coarse[2], fine[2];
    if (!(e->offers & FEATURE_LARGE) || !bent(e, tally, 8, coarse) || !bent(e, tally, 16, fine))
        return;
    for (int i = 0; i < 2; i++)
        gsl_test(!(fine[i] < 2e-3 && (fine[i] < coarse[i] / 3.5 || fine[i] < 1e-8)),
                 "%s: moment %s, error %.3g with 8 elements, %.3g with 16", e->name,
                 i ? "inside" : "at the root", coarse[i], fine[i]);
}

/* A torque on a bar with warping restrained at its root: its bimoment is B = T/lambda sinh(lambda
 * b)/cosh(lambda l), where lambda^2 = G It/(E Iw), l is the length, and b is measured from the tip
 * (Vlasov). */
static int twisted(const element_type *e, ask_tally *tally, int elements, double Iw,
                   double error[4])
{
    static answer a;
    scenes_ask(BARS, e, elements, &a, "load=torque;Iw=%g", Iw);
    if (!ask_count(tally, &a, "torsion of %d elements", elements))
        return 0;
    const double k = 1 / sqrt(Iw), b = 1.2, c = cosh(2 * k),
                 exact[] = {0.5 / k * sinh(2 * k) / c, 0.5 / k * sinh(k * b) / c,
                            0.5 * cosh(k * b) / c, 0.5 - 0.5 * cosh(k * b) / c};
    for (int i = 0; i < 4; i++)
        error[i] = fabs(a.value[i] - exact[i]);
    gsl_test_rel(a.value[2] + a.value[3], 0.5, 1e-9, "%s: the parts are the torque", e->name);
    return 1;
}

static void twists(const element_type *e, ask_tally *tally)
{
    double coarse[4], fine[4];
    if (!twisted(e, tally, 4, 0.25, coarse) || !twisted(e, tally, 8, 0.25, fine))
        return;
    for (int i = 0; i < 4; i++)
        gsl_test(!(fine[i] < 3e-3 && (fine[i] < coarse[i] / 1.8 || fine[i] < 1e-9)),
                 "%s: torsion, value %d: error %.3g with 4 elements, %.3g with 8", e->name, i,
                 coarse[i], fine[i]);
}

static void flat_bar(const element_type *e, ask_tally *tally)
{
    const double w = 0.05, h = 0.004, l = 0.3;
    static answer a;
    scene s;
    section c;
    scenes_read(&s, BARS, "bar=flat");
    gsl_test(scene_constants(&s, 0, &c, NULL) != STATUS_OK, "a flat bar");
    ask_scene(&s, e, NULL, 2, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "flat bar"))
        return;
    const double N = 200 / (w * h), M = 3 * l * 6 / (w * h * h), tau = 2 * h / c.It,
                 exact[] = {N + M, N - M, N + 0.75 * M, sqrt(N * N + 3 * tau * tau)};
    for (int i = 0; i < a.count; i++)
        gsl_test_rel(a.value[i], exact[i], 1e-7, "%s: stress %s of a flat bar", e->name, a.name[i]);
}

static void flanged(const element_type *e, ask_tally *tally)
{
    static answer a;
    scene s;
    section c;
    scenes_read(&s, BARS, "bar=flanged");
    gsl_test(scene_constants(&s, 0, &c, NULL) != STATUS_OK, "an I");
    ask_scene(&s, e, NULL, 4, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "flanged beam"))
        return;
    gsl_test_rel(c.Iw, 2 * 4e-3 * pow(0.08, 3) / 12 * 0.01, 1e-12, "I f h^2/4");
    gsl_test_rel(a.value[1], fabs(a.value[0]) * (0.1 + 2e-3) * 0.04 / c.Iw, 1e-9,
                 "%s: normal stress of the bimoment at the flanges' ends", e->name);
    gsl_test(!(fabs(a.value[0]) > 60 && fabs(a.value[0]) < 200), "%s: bimoment %g", e->name,
             a.value[0]);
}

static void turns_beside_rest(const element_type *e, ask_tally *tally, int turning_first)
{
    const double tension = 2;
    static answer a;
    scenes_ask(BARS, e, 4, &a, "load=spin;turns=%s", turning_first ? "first" : "last");
    if (!ask_count(tally, &a, "a turning bar beside one at rest, %d", turning_first))
        return;
    gsl_test_abs(a.value[0], 0, 1e-9, "%s: no axial force at rest, %d", e->name, turning_first);
    gsl_test_rel(a.value[1], 0.75 * tension, 0.02, "%s: tension half-way while it turns, %d",
                 e->name, turning_first);
    gsl_test_rel(a.value[2], -tension, 0.02, "%s: reaction while it turns, %d", e->name,
                 turning_first);
}

static void strip(const element_type *e, ask_tally *tally)
{
    const double w = 0.04, h = 1e-3, l = 0.4;
    static answer a;
    scene s;
    section c;
    scenes_read(&s, BARS, "bar=strip");
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

static void blade(const element_type *e, ask_tally *tally)
{
    const double l = 0.5, omega = 20;
    static answer a;
    scenes_ask(BARS, e, 3, &a, "bar=blade");
    if (!ask_count(tally, &a, "blade"))
        return;
    const double root_stress = 7800 * omega * omega * l * l / 2;
    gsl_test_rel(a.value[0], root_stress * 0.02 * 0.01 * (1 - 0.36), 1e-4, "%s: pull inside",
                 e->name);
    gsl_test_rel(a.value[1], root_stress, 1e-4, "%s: stress at the root", e->name);
}

static void channel(const element_type *e, ask_tally *tally)
{
    static answer a;
    scene s;
    section c;
    scenes_read(&s, BARS, "bar=channel");
    gsl_test(scene_constants(&s, 0, &c, NULL) != STATUS_OK, "a C");
    ask_scene(&s, e, NULL, 16, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "channel"))
        return;
    const double l = 1.5, F = 40, k = sqrt(80e9 * c.It / (200e9 * c.Iw)),
                 B = F * fabs(c.ys) / k * tanh(k * l);
    const double f = 0.05, h = 0.1, t = 3e-3, web = 3 * f * f / (h + 6 * f),
                 corner = h / 2 * (web + t / 2) + t / 2 * (web - t / 2),
                 most = F * l * (h + t) / 2 / c.Iy + B * corner / c.Iw;
    gsl_test_rel(fabs(c.ys - 0.02 + c.centroid[0]), web, 1e-12, "shear centre of a C");
    gsl_test_rel(fabs(a.value[0]), B, 3e-3, "%s: bimoment at the root", e->name);
    gsl_test_rel(a.value[1], fabs(a.value[0]), 1e-9, "%s: it is largest there", e->name);
    gsl_test_rel(a.value[2], most, 3e-3, "%s: bending and bimoment together", e->name);
}

/* A bar that tapers from height h to h/4 under a force at its thin tip. Its stress 6 F b/(w h(b)^2)
 * is largest at a third of the length from the tip, where b is the distance from the tip. */
static void tapered(const element_type *e, ask_tally *tally, int elements)
{
    const double w = 0.02, h = 0.04, l = 0.9, F = 50;
    static answer a;
    scenes_ask(BARS, e, elements, &a, "bar=tapered");
    if (!ask_count(tally, &a, "taper of %d elements", elements))
        return;
    const double exact[] = {6 * F * (l / 3) / (w * h * h / 4), -6 * F * l / (w * h * h),
                            sqrt(3) * 1.5 * F / (w * h / 4)};
    for (int i = 0; i < a.count; i++)
        gsl_test_rel(a.value[i], exact[i], 1e-8, "%s: %s of a taper, %d elements", e->name,
                     a.name[i], elements);
}

static void turning_axes(const element_type *e, ask_tally *tally, int elements)
{
    const double F[3] = {0, 30, 50};
    static answer a;
    scene s;
    section c[2];
    scenes_read(&s, BARS, "bar=angle");
    for (int k = 0; k < 2; k++)
        gsl_test(scene_constants(&s, k, &c[k], NULL) != STATUS_OK, "an angle");
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

static void inside_members(const element_type *e)
{
    ask_tally tally = {0};
    statics(e, &tally, 1);
    statics(e, &tally, 3);
    bends(e, &tally);
    twists(e, &tally);
    flat_bar(e, &tally);
    flanged(e, &tally);
    turns_beside_rest(e, &tally, 0);
    turns_beside_rest(e, &tally, 1);
    ask_conclude(&tally, e, "resultants inside members");
}

static void of_states(const element_type *e)
{
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

int main(void)
{
    for (int i = 0; accepted_at(i) != NULL; i++) {
        inside_members(accepted_at(i));
        of_states(accepted_at(i));
    }
    return gsl_test_summary();
}
