#include "harness/experiments/experiments_impl.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/model/model.h"

/* Returns 1 if the measure has at least three points and none of them has a value. */
static int measures_useless(const element_measure *one);

check_result *checks_open(check_results *c, const char *name, double allowed)
{
    for (int i = 0; i < c->count; i++)
        if (strcmp(c->check_result[i].name, name) == 0)
            return &c->check_result[i];
    assert(c->count < CHECKS_MOST && strlen(name) < CHECK_NAME);
    check_result *one = &c->check_result[c->count++];
    memset(one, 0, sizeof *one);
    snprintf(one->name, sizeof one->name, "%s", name);
    one->allowed = allowed;
    return one;
}

void checks_not_made(check_results *c, const char *name, const char *why)
{
    check_result *one = checks_open(c, name, 0);
    one->outcome = CHECK_NOT_MADE;
    snprintf(one->sentence, sizeof one->sentence, "%s", why);
}

__attribute__((format(printf, 3, 0))) static void note(check_result *one, double departure,
                                                       const char *format, va_list words)
{
    const int worse = isnan(departure) ? !isnan(one->worst) : departure > one->worst;
    one->compared++;
    if (!worse)
        return;
    one->worst = departure;
    if (departure <= one->allowed)
        return;
    one->outcome = CHECK_FAILED;
    vsnprintf(one->sentence, sizeof one->sentence, format, words);
}

void checks_deviation(check_result *one, double departure, const char *format, ...)
{
    va_list words;
    va_start(words, format);
    note(one, departure, format, words);
    va_end(words);
}

void checks_require(check_result *one, int holds, const char *format, ...)
{
    va_list words;
    va_start(words, format);
    note(one, holds ? 0 : INFINITY, format, words);
    va_end(words);
}

void checks_current(check_results *c, const char *format, ...)
{
    va_list words;
    va_start(words, format);
    vsnprintf(c->doing, sizeof c->doing, format, words);
    va_end(words);
}

int checks_counted(const check_results *c, check_outcome outcome)
{
    int count = 0;
    for (int i = 0; i < c->count; i++)
        count += c->check_result[i].outcome == outcome;
    return count;
}

int checks_compared(const check_results *c)
{
    int count = 0;
    for (int i = 0; i < c->count; i++)
        count += c->check_result[i].compared;
    return count;
}

static void theories(const element_type *t, check_result *one)
{
    const int flexible = (t->offers & FEATURE_SHEAR) != 0,
              own = (t->shear_theories & SHEAR_OWN) != 0;
    checks_require(one, flexible == (t->shear_theories != 0),
                   flexible ? "shear_theories: the type supports shear but declares no theory; set "
                              "SHEAR_ENGESSER, SHEAR_HARINGX or SHEAR_OWN"
                            : "shear_theories: a shear theory is declared without FEATURE_SHEAR; "
                              "support shear, or remove the theory");
    checks_require(
        one,
        ((t->offers & FEATURE_ENGESSER) != 0) == ((t->shear_theories & SHEAR_ENGESSER) != 0) &&
            ((t->offers & FEATURE_HARINGX) != 0) == ((t->shear_theories & SHEAR_HARINGX) != 0),
        "shear_theories: FEATURE_ENGESSER and SHEAR_ENGESSER, or FEATURE_HARINGX and "
        "SHEAR_HARINGX, are not declared together; declare both of a pair or neither");
    checks_require(one, !own || t->shear_theories == SHEAR_OWN,
                   "shear_theories: SHEAR_OWN excludes other theories; set only SHEAR_OWN");
    checks_require(
        one, own == (t->own_theory != NULL),
        own ? "own_theory: describe SHEAR_OWN and its source in one line"
            : "own_theory: shear_theories has no SHEAR_OWN; remove own_theory, or set SHEAR_OWN");
}

static void words(const element_type *t, check_result *one)
{
    checks_require(one, t->family != NULL && t->family[0] != '\0' && strchr(t->family, ' ') == NULL,
                   "family: give one word");
    checks_require(one,
                   t->summary != NULL && t->summary[0] != '\0' && strchr(t->summary, '\n') == NULL,
                   "summary: give one line");
    checks_require(one, t->source != NULL && t->source[0] != '\0',
                   "source: name the paper and its equations");
    checks_require(one, (t->lacks != 0) == (t->lacks_by != NULL),
                   t->lacks != 0
                       ? "lacks_by: name the equations that omit the physics declared in 'lacks'"
                       : "lacks_by: 'lacks' is empty; remove lacks_by, or declare the omitted "
                         "physics in 'lacks'");
    checks_require(one, !(t->lacks & LACKS_SHEAR_Y) || t->offers & FEATURE_SHEAR,
                   "lacks: LACKS_SHEAR_Y is only for types that support shear; remove it");
    checks_require(
        one, !(t->offers & FEATURE_ROTARY_INERTIA) || t->offers & FEATURE_MASS,
        "offers: FEATURE_ROTARY_INERTIA requires FEATURE_MASS; declare both, or only FEATURE_MASS");
    checks_require(
        one, ((t->limits & LIMIT_TENSION) != 0) == (t->tension != NULL),
        "tension: this member and LIMIT_TENSION require each other; give both or neither");
    checks_require(one, !t->spreads || (t->inertia != NULL && t->offers & FEATURE_MASS),
                   "spreads: 'inertia' or FEATURE_MASS is missing; give both, or remove 'spreads'");
}

static void orders(const formulation *chosen, check_result *one)
{
    static const char *const analysis[ELEMENT_ANALYSES] = {"statics", "vibration", "buckling"};
    for (int a = 0; a < ELEMENT_ANALYSES; a++) {
        const element_order order =
            element_order_in(chosen->type, (element_analysis)a, chosen->option);
        checks_require(one, order.least >= 1 && order.highest >= order.least,
                       "order: the orders in %s are %d (lowest) and %d (highest); give a lowest "
                       "order of at least 1 and a highest order that is not smaller",
                       analysis[a], order.least, order.highest);
    }
}

static void sizes(const formulation *chosen, check_result *one)
{
    const element_type *t = chosen->type;
    const int inner = element_inner(t, chosen->option), memory = element_memory(t, chosen->option);
    checks_require(
        one, inner == 0 || t->update != NULL,
        "update: internal unknowns (%d) require a function that corrects them; add 'update'",
        inner);
    checks_require(one, inner == 0 || memory > 0,
                   "memory: internal unknowns (%d) require memory for 'update'; set 'memory'",
                   inner);
    checks_require(one, inner >= 0 && memory >= 0,
                   "inner, memory: the values are %d and %d; give values that are not negative",
                   inner, memory);
}

static void options(const element_type *t, check_result *one)
{
    const int count = parameter_count(t->options);
    checks_require(one, count <= ELEMENT_MAX_OPTIONS,
                   "options: there are %d options, but at most %d are allowed; remove some", count,
                   ELEMENT_MAX_OPTIONS);
    for (int i = 0; i < count; i++) {
        const parameter_type *o = parameter_at(t->options, i);
        const int choices = parameter_choices(o);
        checks_require(
            one,
            choices > 0 ? o->value >= 0 && o->value < choices
                        : o->value >= o->min && o->value <= o->max,
            "options: the default of '%s' is outside its range; give a default within it", o->name);
        checks_require(one, o->summary != NULL && o->summary[0] != '\0',
                       "options: describe '%s' in one line", o->name);
    }
}

void checks_declared(const formulation *chosen, check_results *out)
{
    checks_current(out, "its declarations");
    theories(chosen->type, checks_open(out, "theories of shear", 0));
    words(chosen->type, checks_open(out, "words and limits", 0));
    orders(chosen, checks_open(out, "orders", 0));
    sizes(chosen, checks_open(out, "sizes", 0));
    options(chosen->type, checks_open(out, "options", 0));
}

static section_spec i_profile(void)
{
    static const double h = 0.05, b = 0.03;
    static const double point[][2] = {{-b, h}, {0, h}, {b, h}, {-b, -h}, {0, -h}, {b, -h}},
                        thick[] = {2e-3, 2e-3, 2e-3, 2e-3, 2e-3};
    static const int ends[][2] = {{0, 1}, {1, 2}, {1, 4}, {3, 4}, {4, 5}};
    return section_spec_walls(210e9, 81e9, 5, point, ends, thick);
}

static section_spec spec_of(const beam_request *r)
{
    section_spec spec = section_spec_rectangle(210e9, 81e9, r->width, r->thickness);
    spec.given.Iw = 0;
    spec.shear_factor[0] = 5.0 / 6;
    spec.shear_factor[1] = 0.4;
    if (r->profile)
        spec = i_profile();
    spec.density = 7800;
    return spec;
}

status beam_section(const beam_request *r, section *out)
{
    const section_spec spec = spec_of(r);
    return section_compute(&spec, out, NULL);
}

static void place(const beam_request *r, double s, double at[3])
{
    const double radius = 2 / PI;
    at[0] = r->quarter ? radius * cos(s * PI / 2) : s;
    at[1] = r->quarter ? radius * sin(s * PI / 2) : 0;
    at[2] = 0;
}

static void add_pieces(const beam_request *r, scene *s)
{
    const section_spec spec = spec_of(r);
    const int profile = scene_add_section(s, &spec);
    double at[3], done = 0;
    place(r, 0, at);
    int from = scene_add_node(s, at[0], at[1], at[2]);
    scene_hold_all(s, from);
    for (int i = 0; i < r->elements; i++) {
        double next[3];
        done = i == r->elements - 1  ? 1
               : r->fraction != NULL ? done + r->fraction[i]
                                     : (i + 1.0) / r->elements;
        place(r, done, next);
        const double across[3] = {-(next[1] - at[1]), next[0] - at[0], 0};
        const int to = scene_add_node(s, next[0], next[1], next[2]);
        scene_member *m = scene_member_at(s, scene_add_member(s, from, to, profile, across));
        m->warp_p = i == 0 && r->profile ? SCENE_WARP_FIXED : i;
        m->warp_q = i == r->elements - 1 ? SCENE_WARP_FREE : i + 1;
        m->divisions = 1;
        memcpy(at, next, sizeof at);
        from = to;
    }
}

static void add_question(const beam_request *r, scene *s)
{
    static const double end = 1;
    const int tip = s->nodes - 1;
    int analysis;
    if (r->analysis != BEAM_VIBRATION)
        scene_add_load(s, r->load, tip, r->vector[0], r->vector[1], r->vector[2]);
    switch (r->analysis) {
    case BEAM_LARGE:
        analysis = scene_add_static(s, 1, &end, 1);
        break;
    case BEAM_BUCKLING:
        analysis = scene_add_buckling(s, SCENE_NONE);
        scene_add_quantity(s, "value", "1", analysis, scene_critical_factor(1, 0));
        return;
    case BEAM_VIBRATION:
        analysis = scene_add_modal(s, SCENE_NONE);
        scene_add_quantity(s, "value", "Hz", analysis, scene_frequency(0, SCENE_ANY));
        return;
    default:
        analysis = scene_add_linear(s);
    }
    scene_add_quantity(s, "value", r->component < SCENE_RX ? "m" : "rad", analysis,
                       scene_coordinate(tip, r->component));
}

static double solved(const beam_request *r, const scene *s, char words[MEASURE_WORDS])
{
    cell_request request = {.scene = s, .elements = 1};
    cell_result found;
    fault f = {""};
    double value = NAN;
    cell_formulation(&request, r->chosen);
    const status outcome = cell_run(&request, &found, &f);
    if (outcome == STATUS_OK && found.solve.quantities == 1)
        value = found.solve.quantity[0].value;
    if (isnan(value))
        snprintf(words, MEASURE_WORDS, "%.180s",
                 f.text[0] != '\0'               ? f.text
                 : found.solve.reason[0] != '\0' ? found.solve.reason
                                                 : "no value");
    cell_result_free(&found);
    return value;
}

int beam_point(const beam_request *r, double at, double exact, element_measure *one)
{
    scene s;
    fault f = {""};
    char words[MEASURE_WORDS] = "", missing[MEASURE_WORDS - 20];
    int offered = 1;
    double value = NAN;
    scene_init(&s, "beam");
    add_pieces(r, &s);
    add_question(r, &s);
    scene_omit(&s, SCENE_OMITTABLE & ~(r->needs | FEATURE_WARPING));
    if (scene_validate(&s, &f) != STATUS_OK)
        snprintf(words, sizeof words, "%.180s", f.text);
    else if (missing_words(&s, r->chosen->type, missing, sizeof missing))
        offered = 0;
    else
        value = solved(r, &s, words);
    if (!offered)
        snprintf(one->words, sizeof one->words, "not supported: %s", missing);
    else if (words[0] != '\0' && one->words[0] == '\0')
        memcpy(one->words, words, sizeof words);
    if (offered)
        measures_point(one, at, value / exact - 1);
    scene_free(&s);
    return offered && !measures_useless(one);
}

element_measure *measures_add(measures *m, const char *name)
{
    assert(m->count < MEASURES_MOST);
    element_measure *one = &m->measure[m->count++];
    memset(one, 0, sizeof *one);
    snprintf(one->name, sizeof one->name, "%s", name);
    one->order = NAN;
    return one;
}

void measures_point(element_measure *one, double at, double error)
{
    assert(one->points < MEASURE_POINTS);
    one->at[one->points] = at;
    one->error[one->points++] = error;
}

int measures_wrong_limits(const measures *m)
{
    int count = 0;
    for (int i = 0; i < m->count; i++)
        count += m->measure[i].wrong_limit;
    return count;
}

static int measures_useless(const element_measure *one)
{
    for (int i = 0; i < one->points; i++)
        if (!isnan(one->error[i]))
            return 0;
    return one->points >= 3;
}
