/* Tests formulas: values, derivatives, points without derivatives, and invalid text. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <signal.h>
#include <stddef.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/test/ended.h"

static int at(const char *text, double t, double out[3])
{
    formula *f = NULL;
    fault why = {""};
    const status read = formula_read(text, &f, &why);
    gsl_test(read != STATUS_OK, "%s: read (%s)", text, why.text);
    if (read != STATUS_OK)
        return 0;
    formula_at(f, t, out);
    formula_free(f);
    return 1;
}

static void check_differences(const char *text, double t)
{
    static const double first[] = {-1. / 60, 3. / 20, -3. / 4, 0, 3. / 4, -3. / 20, 1. / 60};
    const double h = 2e-3;
    double here[3], d[2] = {0, 0}, beside[3];
    if (!at(text, t, here))
        return;
    for (int k = 0; k < 7; k++) {
        at(text, t + (k - 3) * h, beside);
        for (int i = 0; i < 2; i++)
            d[i] += first[k] * beside[i] / h;
    }
    for (int i = 0; i < 2; i++)
        gsl_test_abs(here[i + 1], d[i], 1e-8 * (1 + fabs(d[i])), "%s, derivative %d at %g", text,
                     i + 1, t);
}

static void check_derivatives(void)
{
    static const char *const text[] = {"t",
                                       "3",
                                       "-t",
                                       "t - 2*t^3",
                                       "(1 + t)*(2 - t)*t",
                                       "1/(1 + t)",
                                       "(t^2 + 1)/(3 - sin(t))",
                                       "t/1e-200*1e-200",
                                       "t^2.5",
                                       "2^t",
                                       "(1 + t)^(t - 3)",
                                       "sin(3*t)",
                                       "cos(t^2)",
                                       "tan(t/2)",
                                       "asin(t/3)",
                                       "acos(t/3)",
                                       "atan(2*t)",
                                       "sinh(t)",
                                       "cosh(2*t - 1)",
                                       "tanh(3*t)",
                                       "exp(-t^2)",
                                       "log(1 + t)",
                                       "sqrt(1 + t*t)",
                                       "0.4*(t^2/2 + (7.5/pi)^2*(cos(2*pi*t/15) - 1))",
                                       "exp(sin(t))*log(2 + cos(t))/sqrt(t)"};
    static const double where[] = {0.31, 0.9, 1.7};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
        for (int k = 0; k < 3; k++)
            check_differences(text[i], where[k]);
}

static void check_value(const char *text, double t, double expected)
{
    double out[3];
    if (at(text, t, out))
        gsl_test_rel(out[0], expected, 1e-15, "%s at %g", text, t);
}

static void check_binding(void)
{
    check_value("-2^2", 0, -4);
    check_value("2^3^2", 0, 512);
    check_value("-t^2", 3, -9);
    check_value("2^-t", 1, 0.5);
    check_value("8/4/2", 0, 1);
    check_value("7 - 4 - 2", 0, 1);
    check_value("2*-t", 3, -6);
    check_value("30*deg*t", 6, 3.14159265358979323846);
    check_value(" 1e-3 * t ", 2, 2e-3);
    check_value("+.5", 0, 0.5);
    check_value("max(1, 3, 2)*t", 2, 6);
    check_value("hypot(3, 2*2)*t", 2, 10);
    check_value("abs(-2)^t", 3, 8);
    check_value("sinh(atan2(0, 1)) + t", 3, 3);
}

static void check_edge(const char *text, double t, int value, int velocity, int acceleration)
{
    const int expected[3] = {value, velocity, acceleration};
    double out[3];
    if (at(text, t, out))
        for (int k = 0; k < 3; k++)
            gsl_test_int(isfinite(out[k]) != 0, expected[k], "%s at %g: derivative %d is finite",
                         text, t, k);
}

static void check_edges(void)
{
    check_edge("sqrt(t)", 0, 1, 0, 0);
    check_edge("t^0.5", 0, 1, 0, 0);
    check_edge("t^1.5", 0, 1, 1, 0);
    check_edge("t^2.5", 0, 1, 1, 1);
    check_edge("t^2", 0, 1, 1, 1);
    check_edge("t^1", 0, 1, 1, 1);
    check_edge("t^0", 0, 1, 1, 1);
    check_edge("1/t", 0, 0, 0, 0);
    check_edge("log(t)", 0, 0, 0, 0);
    check_edge("log(-t)", 0, 0, 0, 0);
    check_edge("exp(1000*t)", 1, 0, 0, 0);
    check_edge("asin(t)", 1, 1, 0, 0);
    check_edge("sqrt(t - 2)", 1, 0, 0, 0);
    /* a constant has the derivative zero, even where its function has no finite derivative */
    check_edge("t*sqrt(0)", 1, 1, 1, 1);
    check_edge("t + asin(1)", 1, 1, 1, 1);
}

static void check_refused(const char *text, int character, const char *words)
{
    formula *f = NULL;
    expression_mistake mistake;
    fault why = {""};
    gsl_test_int((int)formula_parse(text, &f, &mistake), STATUS_REFUSED, "'%s' is refused", text);
    gsl_test_int(mistake.at + 1, character, "'%s': its place", text);
    gsl_test(f != NULL, "'%s': nothing is left", text);
    gsl_test_int((int)formula_read(text, &f, &why), STATUS_REFUSED, "'%s' is refused", text);
    gsl_test(strstr(why.text, words) == NULL, "'%s': %s", text, why.text);
}

static void check_refusals(void)
{
    char deep[200], wide[1802];
    check_refused("", 1, "ends where a number, a name or '(' is expected");
    check_refused("2*", 3, "ends where a number");
    check_refused("sin(t", 6, "arguments of sin are not closed");
    check_refused("sin t", 1, "sin is a function; write sin(...)");
    check_refused("(t", 1, "'(' is not closed");
    check_refused("t)", 2, "')' follows a complete expression; add an operator");
    check_refused("t t", 3, "add an operator");
    check_refused("2 + x*t", 5, "the name 'x' is unknown; give one of t, pi");
    check_refused("abs(t)", 1,
                  "abs accepts only numbers, but its argument contains t; give 'pieces'");
    check_refused("max(t, 1)", 1, "give 'pieces'");
    check_refused("2*max(1, t)", 3, "give 'pieces'");
    check_refused("atan2(t, 1)", 1,
                  "only numbers, but its argument contains t; write it with atan");
    check_refused("sin(t, 1)", 1, "sin takes one argument, not 2");
    check_refused("sin(t, t)", 1, "sin takes one argument, not 2");
    check_refused("min(1)*t", 1, "min takes two or more arguments, not 1");
    check_refused("mod(1, 0)*t", 1, "mod has no value for its arguments");
    check_refused("3mm", 2, "write 20 mm as 20e-3");
    check_refused("2*t + 4t", 8, "* between factors");
    check_refused("2 t", 3, "* between factors");
    check_refused("0x10", 2, "'x10' follows a number");
    check_refused(".", 1, "a decimal point has no digits");
    check_refused("1e999*t", 1, "too large");
    check_refused("1e-999*t", 1, "too small");
    check_refused("1e300*1e300*t", 6, "too large for a number");
    check_refused("t + 1/0", 6, "division by zero");
    check_refused("t/(1 - 1)", 2, "division by zero");
    check_refused("t + 0^-1", 6, "0^-1 has no value");
    check_refused("sqrt(-1)*t", 1, "sqrt has no value for its arguments");
    check_refused("1..2", 2, "this is a range");
    check_refused("t*#", 3, "'#' where a number");
    memset(deep, '(', sizeof deep - 1);
    deep[sizeof deep - 1] = '\0';
    check_refused(deep, 61, "is nested too deeply");
    for (int i = 0; i < 1801; i++)
        wide[i] = i % 2 ? '+' : 't';
    wide[1801] = '\0';
    check_refused(wide, 258, "too many operations");
}

static void formula_tests(void)
{
    check_derivatives();
    check_binding();
    check_edges();
    check_refusals();
}

static void constants_follow(void)
{
    scene s;
    fault f;
    section c;
    scene_init(&s, "constants");
    section_spec spec = section_spec_rectangle(1, 1, 2, 2);
    const int i = scene_add_section(&s, &spec);
    for (int times = 0; times < 2; times++)
        gsl_test(scene_constants(&s, i, &c, &f) != STATUS_OK || c.A != 4, "area %g", c.A);
    s.section[i].width = 3;
    gsl_test(scene_constants(&s, i, &c, &f) != STATUS_OK || c.A != 6, "of another one: %g", c.A);
    s.section[i].width = -1;
    gsl_test_int((int)scene_constants(&s, i, &c, &f), STATUS_REFUSED, "of none: %s", f.text);
    scene_free(&s);
}

static void constants_tests(void)
{
    constants_follow();
}

typedef void kinds_reader(const void *analysis_or_quantity);

static void read_walk(const void *a)
{
    scene_walk_of(a);
}
static void read_compliance(const void *a)
{
    scene_compliance_of(a);
}
static void read_continuation(const void *a)
{
    scene_continuation_of(a);
}
static void read_component(const void *q)
{
    scene_component_of(q);
}
static void read_entry(const void *q)
{
    scene_entry_of(q);
}
static void read_load(const void *q)
{
    scene_critical_load_of(q);
}
static void read_mode(const void *q)
{
    scene_mode_of(q);
}
static void read_point(const void *q)
{
    scene_point_of(q);
}
static void read_internal(const void *q)
{
    scene_internal_of(q);
}

static void read_stress(const void *q)
{
    scene_stress_of(q);
}

static void read_driver(const void *q)
{
    scene_driver_of(q);
}

static void everything(scene *s)
{
    const double end = 1;
    scene_init(s, "everything");
    scene_add_linear(s);
    scene_add_static(s, 1, &end, 1);
    scene_add_buckling(s, SCENE_NONE);
    scene_add_modal(s, SCENE_NONE);
    scene_add_compliance(s, SCENE_NONE, (scene_compliance){.node = 0});
    scene_add_continuation(s, 1, &end, (scene_control){.node = 0});
    scene_add_rotation(s, 1, &end, 1, 0, (scene_rotating_frame){.omega = {0, 0, 1}});
    const scene_extract what[] = {
        [SCENE_COORDINATE] = scene_coordinate(0, 0),
        [SCENE_REACTION] = scene_reaction(0, 0),
        [SCENE_COMPLIANCE_ENTRY] = scene_compliance_entry(0, 0),
        [SCENE_STIFFNESS_ENTRY] = scene_stiffness_entry(0),
        [SCENE_CRITICAL_FACTOR] = scene_critical_factor(1, 0),
        [SCENE_GROWTH] = scene_growth(),
        [SCENE_FREQUENCY] = scene_frequency(0, SCENE_ANY),
        [SCENE_FACTOR_AT] = scene_factor_at(),
        [SCENE_CRITICAL_POINT] = scene_critical_point(SCENE_LIMIT_POINT, 0, SCENE_CONTROL),
        [SCENE_DRIVER_VALUE] = scene_driver_value(0),
        [SCENE_INTERNAL] = scene_internal_at(0, 0, SCENE_N),
        [SCENE_STRESS] = scene_stress_along(0, SCENE_VON_MISES),
    };
    for (size_t i = 0; i < sizeof what / sizeof what[0]; i++)
        scene_add_quantity(s, "q", "1", 0, what[i]);
}

static void kinds_tests(void)
{
    static const struct {
        const char *name;
        kinds_reader *read;
        unsigned analyses, quantities; /* kinds that have these data; 0: none */
    } row[] = {
        {"walk", read_walk, 1 << SCENE_STATIC | 1 << SCENE_ROTATION, 0},
        {"compliance", read_compliance, 1 << SCENE_COMPLIANCE, 0},
        {"continuation", read_continuation, 1 << SCENE_CONTINUATION, 0},
        {"component", read_component, 0, 1 << SCENE_COORDINATE | 1 << SCENE_REACTION},
        {"entry", read_entry, 0, 1 << SCENE_COMPLIANCE_ENTRY | 1 << SCENE_STIFFNESS_ENTRY},
        {"critical load", read_load, 0, 1 << SCENE_CRITICAL_FACTOR},
        {"mode", read_mode, 0, 1 << SCENE_FREQUENCY},
        {"point", read_point, 0, 1 << SCENE_CRITICAL_POINT},
        {"driver", read_driver, 0, 1 << SCENE_DRIVER_VALUE},
        {"resultant", read_internal, 0, 1 << SCENE_INTERNAL},
        {"stress", read_stress, 0, 1 << SCENE_STRESS},
    };
    scene s;
    everything(&s);
    gsl_test(s.analyses != SCENE_ROTATION + 1 || s.quantities != SCENE_STRESS + 1,
             "every kind is there");
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        if (row[i].analyses != 0)
            for (int k = 0; k < s.analyses; k++)
                gsl_test_int(ended_by(row[i].read, &s.analysis[k]),
                             row[i].analyses >> s.analysis[k].kind & 1 ? 0 : SIGABRT,
                             "%s of analysis %d", row[i].name, k);
        if (row[i].quantities != 0)
            for (int k = 0; k < s.quantities; k++)
                gsl_test_int(ended_by(row[i].read, &s.quantity[k]),
                             row[i].quantities >> s.quantity[k].what.kind & 1 ? 0 : SIGABRT,
                             "%s of quantity %d", row[i].name, k);
    }
    scene_free(&s);
}

int main(void)
{
    formula_tests();
    constants_tests();
    kinds_tests();
    return gsl_test_summary();
}
