/* Critical loads and frequencies of beams whose answer is known, for every formulation: sign, order and number of equal values,
 * what does not exist, and loads beside which rounding would look like a load. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/analysis/solve.h"
#include "harness/catalogue/formulations.h"
#include "harness/catalogue/registry.h"

enum { WANTED = 4, ELEMENTS = 16 };

/* A square bar: E = 2e11 Pa, so slender that shear is felt in the sixth digit. */
static const double young = 2e11, side = 1e-3, length = 1;

static double flexural_rigidity(void)
{
    return young * pow(side, 4) / 12;
}

static double euler(void)
{
    return M_PI * M_PI * flexural_rigidity() / (length * length);
}

static int square(scene *s)
{
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_RECTANGLE;
    spec.young = young;
    spec.shear_modulus = young / 2.6;
    spec.density = 7800;
    spec.width = spec.height = side;
    return scene_add_section(s, &spec);
}

/* Critical loads of one scene; value[sign][order], NAN where there is none. */
typedef struct loads {
    status status;
    char reason[FAULT_TEXT], why[2][WANTED][FAULT_TEXT];
    double value[2][WANTED];
} loads;

typedef void build(scene *s, const double direction[3]);

static void ask_for_loads(scene *s)
{
    const int buckling = scene_add_analysis(s, SCENE_BUCKLING);
    for (int sign = 0; sign < 2; sign++)
        for (int i = 0; i < WANTED; i++) {
            char name[SCENE_NAME];
            snprintf(name, sizeof name, "%s_%d", sign == 0 ? "positive" : "negative", i + 1);
            scene_quantity *q = scene_add_quantity(s, name, "N", SCENE_CRITICAL_FACTOR, buckling);
            q->order = i;
            q->sign = sign == 0 ? 1 : -1;
        }
}

/* 0: the formulation does not offer it. */
static int find_loads(const element_type *e, build *make, const double direction[3], int n, loads *out)
{
    scene s;
    model *m = NULL;
    solve_result r = {0};
    formulation chosen;
    fault f = {""};
    memset(out, 0, sizeof *out);
    formulation_default(e, &chosen);
    scene_init(&s, "bar");
    make(&s, direction);
    ask_for_loads(&s);
    const model_request request = {.scene = &s, .type = e, .options = chosen.option, .elements = n};
    out->status = model_alloc(&request, &m, &f);
    const int offered = out->status != STATUS_REFUSED;
    if (out->status == STATUS_OK)
        out->status = solve_scene(&s, m, NULL, &r, &f);
    snprintf(out->reason, sizeof out->reason, "%s", f.text);
    for (int i = 0; i < r.quantities; i++) {
        out->value[i / WANTED][i % WANTED] = r.quantity[i].value;
        snprintf(out->why[i / WANTED][i % WANTED], FAULT_TEXT, "%s", r.quantity[i].reason);
    }
    gsl_test(offered && out->status != STATUS_OK, "%s: solved (%s)", e->name, out->reason);
    solve_result_free(&r);
    model_free(m);
    scene_free(&s);
    return offered && out->status == STATUS_OK;
}

static int end_node(scene *s, const double direction[3], double at)
{
    return scene_add_node(s, at * direction[0], at * direction[1], at * direction[2]);
}

static const double along_x[3] = {1, 0, 0}, oblique[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3}, y_axis[3] = {0.1, 1, 0.05};

static void push(scene *s, int node, const double direction[3], double force)
{
    scene_add_load(s, SCENE_FORCE, node, force * direction[0], force * direction[1], force * direction[2]);
}

static int cantilever(scene *s, const double direction[3])
{
    const int root = scene_add_node(s, 0, 0, 0), tip = end_node(s, direction, length);
    scene_add_member(s, root, tip, square(s), y_axis);
    scene_hold_all(s, root);
    return tip;
}

static void compressed(scene *s, const double direction[3])
{
    push(s, cantilever(s, direction), direction, -1);
}

static void stretched(scene *s, const double direction[3])
{
    push(s, cantilever(s, direction), direction, 1);
}

static void unloaded(scene *s, const double direction[3])
{
    push(s, cantilever(s, direction), direction, 0);
}

/* Held at both ends and pushed in the middle: one half is compressed, the other stretched. */
static void half_and_half(scene *s, const double direction[3])
{
    const int a = scene_add_node(s, 0, 0, 0), b = end_node(s, direction, length / 2), c = end_node(s, direction, length);
    const int profile = square(s);
    scene_add_member(s, a, b, profile, y_axis);
    scene_add_member(s, b, c, profile, y_axis);
    scene_hold_all(s, a);
    scene_hold_all(s, c);
    push(s, b, direction, 1);
}

/* The force acts on a rigid arm of the bar's length beyond its tip, or before it. */
static void with_arm(scene *s, const double direction[3], double arm)
{
    const int tip = cantilever(s, direction);
    const double at = length + arm;
    const int end = scene_add_attached(s, tip, at * direction[0], at * direction[1], at * direction[2]);
    push(s, end, direction, -1);
}

static void arm_beyond(scene *s, const double direction[3])
{
    with_arm(s, direction, length);
}

static void arm_before(scene *s, const double direction[3])
{
    with_arm(s, direction, -length / 2);
}

/* tan(kL) = 1/(k a) in (0, pi/2) for a > 0, (pi/2, pi) for a < 0. */
static double load_with_arm(double arm)
{
    double low = (arm > 0 ? 1e-9 : 0.5 + 1e-9) * M_PI / length, high = low + (0.5 - 2e-9) * M_PI / length;
    for (int i = 0; i < 200; i++) {
        const double k = (low + high) / 2, value = cos(k * length) - k * arm * sin(k * length);
        *(value > 0 ? &low : &high) = k;
    }
    return low * low * flexural_rigidity();
}

static void expect(const element_type *e, const char *what, const loads *l, int sign, int order, double exact, double tolerance)
{
    gsl_test_rel(l->value[sign][order], exact, tolerance, "%s, %s: %s load %d (%s)", e->name, what,
                 sign == 0 ? "positive" : "negative", order + 1, l->why[sign][order]);
}

static void expect_none(const element_type *e, const char *what, const loads *l, int sign)
{
    for (int i = 0; i < WANTED; i++)
        gsl_test(!isnan(l->value[sign][i]) || strstr(l->why[sign][i], sign == 0 ? "no positive" : "no negative") == NULL,
                 "%s, %s: %g, %s", e->name, what, l->value[sign][i], l->why[sign][i]);
}

/* Every load twice, about y and about z. */
static int columns(const element_type *e, const double direction[3])
{
    const double first = euler() / 4, exact[WANTED] = {first, first, 9 * first, 9 * first};
    loads l;
    if (!find_loads(e, compressed, direction, ELEMENTS, &l))
        return 0;
    for (int i = 0; i < WANTED; i++) {
        expect(e, "compressed", &l, 0, i, exact[i], i < 2 ? 2e-3 : 2e-2);
        if (i % 2 == 1)
            gsl_test_rel(l.value[0][i], l.value[0][i - 1], 1e-7, "%s: loads %d and %d are equal", e->name, i, i + 1);
    }
    if (find_loads(e, stretched, direction, ELEMENTS, &l)) {
        for (int i = 0; i < WANTED; i++)
            expect(e, "stretched", &l, 1, i, -exact[i], i < 2 ? 2e-3 : 2e-2);
    }
    if (find_loads(e, unloaded, direction, ELEMENTS, &l)) {
        expect_none(e, "without load", &l, 0);
        expect_none(e, "without load", &l, 1);
    }
    if (find_loads(e, half_and_half, direction, ELEMENTS, &l))
        for (int i = 0; i < WANTED; i++) {
            gsl_test_rel(l.value[0][i], -l.value[1][i], 1e-7, "%s, half and half: load %d has both signs", e->name, i + 1);
            gsl_test(i > 0 && !(l.value[0][i] >= l.value[0][i - 1] * (1 - 1e-9)), "%s, half and half: load %d in order", e->name,
                     i + 1);
        }
    if (find_loads(e, arm_beyond, direction, ELEMENTS, &l))
        expect(e, "arm beyond the tip", &l, 0, 0, load_with_arm(length), 2e-3);
    if (find_loads(e, arm_before, direction, ELEMENTS, &l))
        expect(e, "arm before the tip", &l, 0, 0, load_with_arm(-length / 2), 5e-3);
    return 1;
}

static const char *few(const element_type *e)
{
    return e->offers & FEATURE_GEOMETRIC ? "" : " (not offered)";
}

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *e = registry_formulations[i];
        const int solved = columns(e, along_x) + columns(e, oblique);
        gsl_test((e->offers & FEATURE_GEOMETRIC) != 0 && solved == 0, "%s: solved some%s", e->name, few(e));
    }
    return gsl_test_summary();
}
