/* Resultants inside members against statics, the elastica and Vlasov's torsion, of every
 * formulation; a value inside converges as those at the ends do. */
#include <gsl/gsl_integration.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>

#include "harness/tools/kit/accepted.h"
#include "harness/tools/kit/ask.h"

static section_spec bar(double Iw)
{
    section_spec spec = section_spec_constants(1, 1);
    spec.constants = (section){
        .young = 1, .shear_modulus = 1, .A = 1e9, .Iy = 2, .Iz = 1, .It = 1, .Iw = Iw, .Ip = 3};
    return spec;
}

/* Clamped at x = 0, its tip at x = 2. */
static int cantilever(scene *s, double Iw)
{
    const double y[3] = {0, 1, 0};
    const section_spec spec = bar(Iw);
    scene_init(s, "cantilever");
    scene_add_node(s, 0, 0, 0);
    const int tip = scene_add_node(s, 2, 0, 0);
    scene_hold_all(s, 0);
    const int member = scene_add_member(s, 0, tip, scene_add_section(s, &spec), y);
    scene_member_at(s, member)->warp_p = SCENE_WARP_FIXED;
    return tip;
}

/* Tip force and moment and a load along: N, Qy, Qz, Mx, My, Mz at 0.35 of the length, and the
 * extremes of Mz. */
static void statics(const element_type *e, ask_tally *tally, int elements)
{
    static answer a;
    scene s;
    const int tip = cantilever(&s, 0);
    scene_add_load(&s, SCENE_FORCE, tip, 0.5, 0.4, -0.3);
    scene_add_load(&s, SCENE_MOMENT, tip, 0.7, -0.2, 0.6);
    scene_add_load(&s, SCENE_DISTRIBUTED, 0, 0.1, -0.9, 0.3);
    scene_add_load(&s, SCENE_DISTRIBUTED_MOMENT, 0, 0.3, 0, 0.1);
    const int linear = scene_add_linear(&s);
    for (int r = SCENE_N; r <= SCENE_MZ; r++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "r%d", r);
        scene_add_quantity(&s, name, "1", linear, scene_internal_at(0, 0.35, (scene_resultant)r));
    }
    scene_add_quantity(&s, "max", "1", linear, scene_internal_along(0, SCENE_ALONG_MAX, SCENE_MZ));
    scene_add_quantity(&s, "min", "1", linear, scene_internal_along(0, SCENE_ALONG_MIN, SCENE_MZ));
    scene_add_quantity(&s, "largest", "1", linear,
                       scene_internal_along(0, SCENE_ALONG_LARGEST, SCENE_MZ));
    ask_scene(&s, e, NULL, elements, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "statics of %d elements", elements))
        return;
    const double b = 1.3, /* what lies beyond */
        top = 0.5 / 0.9;  /* Mz' = 0: 0.4 - 0.9 b + 0.1 */
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
    /* d s/d u at sin theta = top - u^2, for F/EI = 1: ds = d theta/sqrt(2 (top - sin theta)) */
    const double sine = *(double *)top - u * u;
    return sqrt(2) / sqrt(1 - sine * sine);
}

/* Arc length from the tip to where u is. */
static double arc(double top, double u)
{
    double sum, error;
    size_t count;
    gsl_function f = {slope, &top};
    gsl_integration_qng(&f, 0, u, 1e-13, 1e-13, &sum, &error, &count);
    return sum;
}

/* Inextensible cantilever of length 2, EI = 1, under a dead unit force across it: Bernoulli's
 * elastica. M/EI = sqrt(2) u at arc length `beyond` from the tip. */
static double elastica(double beyond)
{
    double low = 0.5, high = 0.99999, least = 0, most;
    for (int i = 0; i < 100; i++) { /* the tip's sine: theta = 0 at the root */
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
    const double one = 1;
    static answer a;
    scene s;
    const int tip = cantilever(&s, 0);
    scene_add_load(&s, SCENE_FORCE, tip, 0, 1, 0);
    const int path = scene_add_static(&s, 1, &one, 4);
    scene_add_quantity(&s, "root", "1", path, scene_internal_at(0, 0, SCENE_MZ));
    scene_add_quantity(&s, "inside", "1", path, scene_internal_at(0, 0.37, SCENE_MZ));
    scene_add_quantity(&s, "largest", "1", path,
                       scene_internal_along(0, SCENE_ALONG_LARGEST, SCENE_MZ));
    ask_scene(&s, e, NULL, elements, &a);
    scene_free(&s);
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

/* Torque on a bar that warps, held at its root: B = T/lambda sinh(lambda b)/cosh(lambda l), b from
 * the tip (Vlasov). */
static int twisted(const element_type *e, ask_tally *tally, int elements, double Iw,
                   double error[4])
{
    static answer a;
    scene s;
    const int tip = cantilever(&s, Iw);
    scene_add_load(&s, SCENE_MOMENT, tip, 0.5, 0, 0);
    const int linear = scene_add_linear(&s);
    scene_add_quantity(&s, "root", "1", linear, scene_internal_at(0, 0, SCENE_BIMOMENT));
    scene_add_quantity(&s, "inside", "1", linear, scene_internal_at(0, 0.4, SCENE_BIMOMENT));
    scene_add_quantity(&s, "warping", "1", linear, scene_internal_at(0, 0.4, SCENE_MX_WARPING));
    scene_add_quantity(&s, "rest", "1", linear, scene_internal_at(0, 0.4, SCENE_MX_SAINT_VENANT));
    ask_scene(&s, e, NULL, elements, &a);
    scene_free(&s);
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

/* A flat bar, free to warp, pulled, bent and twisted at its tip: M/W at the root, Saint-Venant's
 * shear everywhere; and how a restrained flange beam's stress follows from its bimoment. */
static void flat_bar(const element_type *e, ask_tally *tally)
{
    const double y[3] = {0, 1, 0}, w = 0.05, h = 0.004, l = 0.3;
    static answer a;
    scene s;
    const section_spec spec = section_spec_rectangle(200e9, 80e9, w, h);
    scene_init(&s, "flat bar");
    const int root = scene_add_node(&s, 0, 0, 0), tip = scene_add_node(&s, l, 0, 0);
    scene_hold_all(&s, root);
    scene_add_member(&s, root, tip, scene_add_section(&s, &spec), y);
    scene_add_load(&s, SCENE_FORCE, tip, 200, 3, 0);
    scene_add_load(&s, SCENE_MOMENT, tip, 2, 0, 0);
    const int linear = scene_add_linear(&s);
    scene_add_quantity(&s, "tension", "Pa", linear, scene_stress_along(0, SCENE_NORMAL_MAX));
    scene_add_quantity(&s, "compression", "Pa", linear, scene_stress_along(0, SCENE_NORMAL_MIN));
    scene_add_quantity(&s, "inside", "Pa", linear, scene_stress_at(0, 0.25, SCENE_NORMAL_MAX));
    scene_add_quantity(&s, "tip", "Pa", linear, scene_stress_at(0, 1, SCENE_VON_MISES));
    section c;
    gsl_test(scene_constants(&s, 0, &c, NULL) != STATUS_OK, "a flat bar");
    ask_scene(&s, e, NULL, 2, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "flat bar"))
        return;
    const double N = 200 / (w * h), M = 3 * l * 6 / (w * h * h),
                 tau = 2 * h / c.It, /* long sides, w/h > 10 */
        exact[] = {N + M, N - M, N + 0.75 * M, sqrt(N * N + 3 * tau * tau)};
    for (int i = 0; i < a.count; i++)
        gsl_test_rel(a.value[i], exact[i], 1e-7, "%s: stress %s of a flat bar", e->name, a.name[i]);
}

static void flanged(const element_type *e, ask_tally *tally)
{
    static const double y[3] = {0, 1, 0}, t[5] = {4e-3, 4e-3, 3e-3, 4e-3, 4e-3},
                        point[6][2] = {{0.1, -0.04}, {0.1, 0},      {0.1, 0.04},
                                       {-0.1, 0},    {-0.1, -0.04}, {-0.1, 0.04}};
    static const int ends[5][2] = {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {3, 5}};
    static answer a;
    scene s;
    const section_spec spec = section_spec_walls(200e9, 80e9, 5, point, ends, t);
    section c;
    scene_init(&s, "flanged");
    const int root = scene_add_node(&s, 0, 0, 0), tip = scene_add_node(&s, 2, 0, 0),
              member = scene_add_member(&s, root, tip, scene_add_section(&s, &spec), y);
    scene_hold_all(&s, root);
    scene_member_at(&s, member)->warp_p = SCENE_WARP_FIXED;
    scene_add_load(&s, SCENE_MOMENT, tip, 100, 0, 0);
    const int linear = scene_add_linear(&s);
    scene_add_quantity(&s, "bimoment", "1", linear, scene_internal_at(0, 0, SCENE_BIMOMENT));
    scene_add_quantity(&s, "stress", "Pa", linear, scene_stress_along(0, SCENE_NORMAL_MAX));
    gsl_test(scene_constants(&s, 0, &c, NULL) != STATUS_OK, "an I");
    ask_scene(&s, e, NULL, 4, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "flanged beam"))
        return;
    gsl_test_rel(c.Iw, 2 * 4e-3 * pow(0.08, 3) / 12 * 0.01, 1e-12, "I f h^2/4");
    gsl_test_rel(a.value[1], fabs(a.value[0]) * 0.1 * 0.04 / c.Iw, 1e-9,
                 "%s: normal stress of the bimoment at the flanges' ends", e->name);
    gsl_test(!(fabs(a.value[0]) > 60 && fabs(a.value[0]) < 200), "%s: bimoment %g", e->name,
             a.value[0]);
}

/* A bar that turns steadily beside one at rest, in either order: each quantity is that of its own
 * analysis. */
static void turns_beside_rest(const element_type *e, ask_tally *tally, int turning_first)
{
    const double one = 1, tension = 2; /* rho A Omega^2 l^2/2 */
    static answer a;
    scene s;
    const int tip = cantilever(&s, 0);
    s.section[0].density = s.section[0].constants.density =
        1e-9; /* rho A = 1, no rotary inertia to speak of */
    scene_add_load(&s, SCENE_FORCE, tip, 0, 0.01, 0);
    int rest = -1;
    if (!turning_first)
        rest = scene_add_linear(&s);
    const int turning = scene_add_static(&s, 1, &one, 1);
    scene_set_rotating_frame(&s, turning, (scene_rotating_frame){.omega = {0, 0, 1}});
    if (turning_first)
        rest = scene_add_linear(&s);
    scene_add_quantity(&s, "N at rest", "N", rest, scene_internal_at(0, 0.5, SCENE_N));
    scene_add_quantity(&s, "N turning", "N", turning, scene_internal_at(0, 0.5, SCENE_N));
    scene_add_quantity(&s, "reaction", "N", turning, scene_reaction(0, 0));
    ask_scene(&s, e, NULL, 4, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "a turning bar beside one at rest, %d", turning_first))
        return;
    gsl_test_abs(a.value[0], 0, 1e-9, "%s: no axial force at rest, %d", e->name, turning_first);
    gsl_test_rel(a.value[1], 0.75 * tension, 0.02, "%s: tension half-way while it turns, %d",
                 e->name, turning_first);
    gsl_test_rel(a.value[2], -tension, 0.02, "%s: reaction while it turns, %d", e->name,
                 turning_first);
}

int main(void)
{
    for (int i = 0; accepted_at(i) != NULL; i++) {
        const element_type *e = accepted_at(i);
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
    return gsl_test_summary();
}
