/* Known frequencies for every formulation with inertia: equal bending frequencies of a square bar,
 * axial frequencies, rigid-body modes, and a bar in tension or compression. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/tools/kit/accepted.h"
#include "harness/tools/kit/ask.h"

enum { MODES = 10, ELEMENTS = 24, RIGID = 6 };

static const double young = 2e11, density = 7800, side = 0.01, length = 1;
static const double direction[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3}, y_axis[3] = {0.1, 1, 0.05};

typedef struct request {
    int held;
    double force;
    double arm; /* distance of the point of action beyond the free end [m] */
    scene_family family;
} request;

static void make(scene *s, const request *what)
{
    section_spec spec = section_spec_rectangle(young, young / 2.6, side, side);
    spec.density = density;
    const int root = scene_add_node(s, 0, 0, 0);
    const int tip =
        scene_add_node(s, length * direction[0], length * direction[1], length * direction[2]);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), y_axis);
    if (what->held)
        scene_hold_all(s, root);
    int state = SCENE_NONE;
    if (what->force != 0) {
        const double at = length + what->arm;
        const int end = what->arm == 0 ? tip
                                       : scene_add_attached(s, tip, at * direction[0],
                                                            at * direction[1], at * direction[2]);
        scene_add_load(s, SCENE_FORCE, end, what->force * direction[0], what->force * direction[1],
                       what->force * direction[2]);
        state = scene_add_linear(s);
    }
    const int modal = scene_add_modal(s, state);
    for (int i = 0; i < MODES; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "frequency_%d", i + 1);
        scene_add_quantity(s, name, "Hz", modal, scene_frequency(i, what->family));
    }
}

static int find(const element_type *e, const request *what, ask_tally *tally, answer *out)
{
    scene s;
    scene_init(&s, "bar");
    scene_omit(&s, FEATURE_SHEAR | FEATURE_ROTARY_INERTIA);
    make(&s, what);
    ask_scene(&s, e, NULL, ELEMENTS, out);
    scene_free(&s);
    return ask_count(tally, out, "bar, force %g N", what->force);
}

static double bending(double root)
{
    return root * root / (2 * PI * length * length) * sqrt(young * side * side / (12 * density));
}

static const double clamped[] = {1.8751040687, 4.6940911330, 7.8547574382, 10.995540735,
                                 14.137168391};
static const double loose[] = {4.7300407449, 7.8532046241};

static void cantilever(const element_type *e, ask_tally *tally)
{
    static answer any, axial, across;
    const request all = {1, 0, 0, SCENE_ANY}, along = {1, 0, 0, SCENE_AXIAL},
                  not_along = {1, 0, 0, SCENE_NOT_AXIAL};
    if (!find(e, &all, tally, &any))
        return;
    for (int i = 0; i < 8; i++)
        gsl_test_rel(any.value[i], bending(clamped[i / 2]), 2e-2, "%s: frequency %d of bending",
                     e->name, i + 1);
    for (int i = 1; i < 8; i += 2)
        gsl_test_rel(any.value[i], any.value[i - 1], 1e-7, "%s: frequencies %d and %d are equal",
                     e->name, i, i + 1);
    if (!find(e, &along, tally, &axial) || !find(e, &not_along, tally, &across))
        return;
    const double first = sqrt(young / density) / (4 * length);
    gsl_test_rel(axial.value[0], first, 2e-3, "%s: the axial frequency", e->name);
    int at_axial = 0, at_across = 0;
    for (int i = 0; i < MODES; i++) {
        const int is_axial = axial.value[at_axial] <= across.value[at_across];
        gsl_test_rel(any.value[i], is_axial ? axial.value[at_axial] : across.value[at_across], 1e-9,
                     "%s: frequency %d is that of one of the families", e->name, i + 1);
        at_axial += is_axial;
        at_across += !is_axial;
    }
}

static void nothing_held(const element_type *e, ask_tally *tally)
{
    static answer a;
    const request free_bar = {0, 0, 0, SCENE_ANY};
    if (!find(e, &free_bar, tally, &a))
        return;
    for (int i = 0; i < RIGID; i++)
        gsl_test_abs(a.value[i], 0, 1e-3 * bending(loose[0]), "%s: motion %d of a rigid body",
                     e->name, i + 1);
    for (int i = RIGID; i < MODES; i++)
        gsl_test_rel(a.value[i], bending(loose[(i - RIGID) / 2]), 1e-2,
                     "%s: frequency %d of the free bar", e->name, i + 1 - RIGID);
}

/* Returns the characteristic determinant of a bar in tension T = t EI. The deflection is w = A
 * (cosh ax - cos bx) + B (sinh ax/a - sin bx/b) with a^2 - b^2 = t, a^2 b^2 = k^4. At the free end
 * there is no moment, and no force across the initial direction of the bar. The determinant is zero
 * if k^2 sqrt(EI/(rho A)) is a circular frequency. */
static double determinant(double t, double k)
{
    const double root = sqrt(t * t / 4 + k * k * k * k), a = sqrt(root + t / 2),
                 b = sqrt(root - t / 2);
    const double C = cosh(a), S = sinh(a), c = cos(b), s = sin(b);
    return (a * a * C + b * b * c) * (b * b * C + a * a * c) -
           a * b * (a * S + b * s) * (b * S - a * s);
}

static double first_root(double t)
{
    const double step = 1e-3;
    double k = step;
    while (determinant(t, k) * determinant(t, k + step) > 0)
        k += step;
    double low = k, high = k + step;
    for (int i = 0; i < 100; i++) {
        const double middle = (low + high) / 2;
        *(determinant(t, low) * determinant(t, middle) > 0 ? &low : &high) = middle;
    }
    return low;
}

static void loaded(const element_type *e, ask_tally *tally)
{
    static const double part[] = {-0.999, -0.5, 0.5, 20};
    gsl_test_rel(first_root(0), clamped[0], 1e-9, "the equation gives the bar without load");
    for (int i = 0; i < 4; i++) {
        static answer a;
        const double t = part[i] * PI * PI / (4 * length * length);
        const request state = {1, t * young * pow(side, 4) / 12, 0, SCENE_ANY};
        if (!find(e, &state, tally, &a))
            return;
        const double square = pow(a.value[0] / bending(clamped[0]), 2),
                     exact = pow(first_root(t) / clamped[0], 4);
        gsl_test_abs(square, exact, 2e-3 * fmax(1, exact),
                     "%s: square of the first frequency at %g of Euler's load", e->name, part[i]);
        gsl_test_rel(a.value[1], a.value[0], 1e-6, "%s: the second is equal", e->name);
    }
}

/* If the load acts on an arm as long as the bar, the critical load is k^2 EI with k tan k = 1. At
 * this load, the frequency is zero. */
static void loaded_on_arm(const element_type *e, ask_tally *tally)
{
    const double critical = 0.86033358901937976 * 0.86033358901937976 * young * pow(side, 4) / 12;
    static answer below;
    const request state = {1, -0.999 * critical, length, SCENE_ANY};
    if (!find(e, &state, tally, &below))
        return;
    gsl_test_abs(pow(below.value[0] / bending(clamped[0]), 2), 0, 5e-3,
                 "%s: the frequency vanishes at the critical load of an arm", e->name);
}

int main(void)
{
    for (int i = 0; accepted_at(i) != NULL; i++) {
        const element_type *e = accepted_at(i);
        ask_tally tally = {0};
        cantilever(e, &tally);
        nothing_held(e, &tally);
        loaded(e, &tally);
        loaded_on_arm(e, &tally);
        ask_conclude(&tally, e, "frequencies of bars");
        gsl_test((e->offers & FEATURE_MASS) && tally.count[ASK_ANSWERED] == 0,
                 "%s offers inertia and solves nothing", e->name);
    }
    return gsl_test_summary();
}
