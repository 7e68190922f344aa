#include "cases/scene/scene_impl.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "quantities.h" /* by the build: QUANTITY_TYPES, a word for each file of cases/quantities */

#define DECLARED(name) extern const quantity_type quantity_##name;
QUANTITY_TYPES(DECLARED)

/* An extracted value of the kind defined in the file of this name. */
#define EXTRACT(name, ...) ((scene_extract){quantity_##name.kind, &quantity_##name, {__VA_ARGS__}})

scene_extract scene_coordinate(int node, int component)
{
    return EXTRACT(displacement, .component = {node, component});
}

scene_extract scene_reaction(int node, int component)
{
    return EXTRACT(reaction, .component = {node, component});
}

scene_extract scene_compliance_entry(int row, int column)
{
    return EXTRACT(compliance, .entry = {row, column});
}

scene_extract scene_stiffness_entry(int component)
{
    return EXTRACT(stiffness, .entry = {component, component});
}

scene_extract scene_critical_factor(int sign, int order)
{
    return EXTRACT(critical_factor, .load = {sign, order});
}

scene_extract scene_growth(void)
{
    return (scene_extract){.kind = SCENE_GROWTH, .type = &quantity_growth};
}

scene_extract scene_frequency(int order, scene_family family)
{
    return EXTRACT(frequency, .mode = {.order = order, .family = family});
}

scene_extract scene_factor_at(void)
{
    return (scene_extract){.kind = SCENE_FACTOR_AT, .type = &quantity_factor_at};
}

scene_extract scene_critical_point(scene_critical kind, int order, scene_ordinate ordinate)
{
    return EXTRACT(critical_point, .point = {kind, order, ordinate});
}

scene_extract scene_driver_value(int driver)
{
    return EXTRACT(motion, .driver = driver);
}

scene_extract scene_rate(int node, int component)
{
    return EXTRACT(rate, .rated = {.at = {node, component}});
}

scene_extract scene_orientation_entry(int node, int row, int column)
{
    return EXTRACT(orientation, .reading = {.node = {node}, .component = {row, column}});
}

scene_extract scene_balance_of(scene_balance what)
{
    return what < SCENE_PX ? EXTRACT(energy, .balance = what) : EXTRACT(momentum, .balance = what);
}

scene_extract scene_response_to(scene_response what)
{
    return (scene_extract){SCENE_RESPONSE, &quantity_response, {.response = what}};
}

int scene_unbalance_along(const scene_response *r, int k)
{
    return (r->spinning - SCENE_RX + 1 + k) % 3;
}

scene_extract scene_relative_to(int node, int component, int from)
{
    return EXTRACT(relative, .relative = {node, component, from});
}

scene_quantity *scene_add_quantity(scene *s, const char *name, const char *unit, int analysis,
                                   scene_extract what)
{
    const int i = scene_grow(s, &s->quantity, &s->quantities, sizeof *s->quantity);
    scene_quantity *q = i >= 0 ? &s->quantity[i] : &s->scrap.quantity;
    *q = (scene_quantity){.analysis = analysis,
                          .acting = {SCENE_NONE, SCENE_NONE},
                          .what = what,
                          .x = {.factor = 1},
                          .factor = 1,
                          .tolerance = SCENE_TOLERANCE};
    snprintf(q->name, sizeof q->name, "%s", name);
    snprintf(q->unit, sizeof q->unit, "%s", unit);
    return q;
}

void scene_set_curve(scene_quantity *q, const char *x_name, const char *x_unit, double factor,
                     double offset)
{
    q->reduction = SCENE_CURVE;
    q->x = (scene_abscissa){.factor = factor, .offset = offset};
    snprintf(q->x.name, sizeof q->x.name, "%s", x_name);
    snprintf(q->x.unit, sizeof q->x.unit, "%s", x_unit);
}

void scene_set_curve_over(scene_quantity *q, const char *quantity, const char *unit)
{
    scene_set_curve(q, quantity, unit, 1, 0);
    q->x.is_quantity = 1;
}

int scene_abscissa_of(const scene *s, const scene_quantity *q)
{
    for (int i = 0; i < s->quantities && q->reduction == SCENE_CURVE && q->x.is_quantity; i++)
        if (strcmp(s->quantity[i].name, q->x.name) == 0)
            return i;
    return SCENE_NONE;
}

void scene_set_at(scene_quantity *q, double at)
{
    q->reduction = SCENE_AT;
    q->at = at;
}

void scene_set_passing(scene_quantity *q, scene_reduction reduction, scene_passing what)
{
    q->reduction = reduction;
    q->passing = what;
}

scene_extract scene_internal_at(int member, double place, scene_resultant resultant)
{
    return EXTRACT(internal, .internal = {member, resultant, SCENE_ALONG_PLACE, place, 0});
}

scene_extract scene_beside(scene_extract what, int before)
{
    if (what.kind == SCENE_STRESS)
        what.of.stress.before = before;
    else
        what.of.internal.before = before;
    return what;
}

scene_extract scene_internal_along(int member, scene_along along, scene_resultant resultant)
{
    return EXTRACT(internal, .internal = {member, resultant, along, 0, 0});
}

scene_extract scene_stress_along(int member, scene_stress_measure measure)
{
    return EXTRACT(stress, .stress = {member, measure, 1, 0, 0});
}

scene_extract scene_stress_at(int member, double place, scene_stress_measure measure)
{
    return EXTRACT(stress, .stress = {member, measure, 0, place, 0});
}

const scene_stress *scene_stress_of(const scene_quantity *q)
{
    assert(q->what.kind == SCENE_STRESS);
    return &q->what.of.stress;
}

const scene_internal *scene_internal_of(const scene_quantity *q)
{
    assert(q->what.kind == SCENE_INTERNAL);
    return &q->what.of.internal;
}

const scene_component *scene_component_of(const scene_quantity *q)
{
    assert(q->what.kind == SCENE_COORDINATE || q->what.kind == SCENE_REACTION ||
           q->what.kind == SCENE_RATE);
    return &q->what.of.component;
}

const scene_entry *scene_entry_of(const scene_quantity *q)
{
    assert(q->what.kind == SCENE_COMPLIANCE_ENTRY || q->what.kind == SCENE_STIFFNESS_ENTRY);
    return &q->what.of.entry;
}

const scene_critical_load *scene_critical_load_of(const scene_quantity *q)
{
    assert(q->what.kind == SCENE_CRITICAL_FACTOR);
    return &q->what.of.load;
}

const scene_mode *scene_mode_of(const scene_quantity *q)
{
    assert(q->what.kind == SCENE_FREQUENCY || q->what.kind == SCENE_DAMPING_RATIO);
    return &q->what.of.mode;
}

const scene_point *scene_point_of(const scene_quantity *q)
{
    assert(q->what.kind == SCENE_CRITICAL_POINT);
    return &q->what.of.point;
}

int scene_driver_of(const scene_quantity *q)
{
    assert(q->what.kind == SCENE_DRIVER_VALUE);
    return q->what.of.driver;
}

const scene_relative *scene_relative_of(const scene_quantity *q)
{
    assert(q->what.kind == SCENE_RELATIVE);
    return &q->what.of.relative;
}

int scene_asks(const scene_quantity *q, int analysis, scene_quantity_kind kind)
{
    return q->analysis == analysis && q->what.kind == kind;
}

int scene_reads_forces(const scene_quantity *q)
{
    return q->what.kind == SCENE_REACTION || q->what.kind == SCENE_INTERNAL ||
           q->what.kind == SCENE_STRESS || q->what.kind == SCENE_DEFLECTION;
}

int scene_reads(const scene *s, int analysis)
{
    int read = s->quantities == 0;
    for (int i = 0; i < s->quantities && !read; i++)
        read = s->quantity[i].analysis == analysis;
    for (int i = analysis + 1; i < s->analyses && !read; i++)
        read = s->analysis[i].follows == analysis && scene_reads(s, i);
    for (int i = 0; i < s->imperfections && !read; i++)
        read = s->imperfection[i].analysis == analysis;
    return read;
}

static int has_quantity(const scene *s, const char *name)
{
    int found = 0;
    for (int i = 0; i < s->quantities && !found; i++)
        found = strcmp(s->quantity[i].name, name) == 0;
    return found;
}

void scene_keep_quantities(scene *s, const scene *of)
{
    int kept = 0;
    for (int i = 0; i < s->quantities; i++)
        if (has_quantity(of, s->quantity[i].name)) {
            for (int k = 0; k < s->quantities; k++)
                for (int j = 0; j < s->quantity[k].overs; j++)
                    if (s->quantity[k].what.kind == SCENE_ENVELOPE_OF &&
                        s->quantity[k].over[j] == i)
                        s->quantity[k].over[j] = kept;
            s->quantity[kept++] = s->quantity[i];
        } else {
            free(s->quantity[i].over);
            s->quantity[i].overs = 0; /* later envelopes then include all combinations */
        }
    s->quantities = kept;
}
