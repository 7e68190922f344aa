/* What one kind of analysis or quantity has cannot be read from another kind: the program ends. */
#include <gsl/gsl_test.h>
#include <signal.h>
#include <stddef.h>

#include "cases/scene/scene.h"
#include "elements/test/ended.h"

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

/* One scene with every kind. */
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

int main(void)
{
    static const struct {
        const char *name;
        kinds_reader *read;
        unsigned analyses, quantities; /* kinds that have it; 0: it is not asked of them */
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
    return gsl_test_summary();
}
