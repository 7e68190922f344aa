/* Velocity, acceleration or jerk of a node; those of its rotation are in the axes of the node. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    QUANTITY_NODE(rated.at.node),
    QUANTITY_COMPONENT("coordinate of the node", rated.at.component),
    {"of", ENTRY_WORD, .words = SCENE_RATE_CHOICES,
     .summary = "first, second or third derivative with respect to time", .usual = "velocity",
     ENTRY_IN(scene_quantity, what.of.rated.rate)},
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    static const char *const of[][2] = {
        {"m/s", "rad/s"}, {"m/s^2", "rad/s^2"}, {"m/s^3", "rad/s^3"}};
    return of[q->what.of.rated.rate][q->what.of.component.component > SCENE_UZ];
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    static const char *const of[] = {"velocity", "acceleration", "jerk"};
    const int turn = q->what.of.component.component >= SCENE_RX;
    fprintf(to, "%s%s", turn ? "angular " : "", of[q->what.of.rated.rate]);
    meaning_node(to, s, "of", q->what.of.component.node);
    fprintf(to, turn ? " about its own %c axis" : " along %c",
            meaning_axis(q->what.of.component.component));
}

/* For a jerk, returns the acceleration, which harness/time differentiates. */
static double read(const scene_quantity *q, const quantity_state *state)
{
    const scene_component *what = &q->what.of.component;
    return q->what.of.rated.rate == SCENE_SPEED
               ? state->rate(state, what->node, what->component)
               : state->acceleration(state, what->node, what->component);
}

/* Checks that the integrator computes the rate. */
static status check(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_scheme scheme = scene_motion_of(&s->analysis[q->analysis])->scheme;
    const scene_rate_of what = q->what.of.rated.rate;
    if (what == SCENE_SPEEDING && scheme == SCENE_CONSERVING)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: the integrator conserving computes only the mean "
                         "acceleration of each step; use integrator: radau, alpha or explicit",
                         q->name);
    if (what == SCENE_JERK && scheme != SCENE_RADAU && scheme != SCENE_EXPLICIT)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: integrators of order 2 do not compute the jerk; use "
                         "integrator: radau or explicit",
                         q->name);
    return STATUS_OK;
}

static int turns(const scene *s, const scene_quantity *q, int i, scene_component *out)
{
    (void)s;
    *out = q->what.of.component;
    return i < 1;
}

const quantity_type quantity_rate = {.key = "rate",
                                     .summary = "velocity, acceleration or jerk of a node; those "
                                                "of rotations are along the axes of the node",
                                     .kind = SCENE_RATE,
                                     .field = fields,
                                     .analyses = 1u << SCENE_MOTION,
                                     .between = 1,
                                     .unit = unit,
                                     .meaning = meaning,
                                     .read = read,
                                     .turns = turns,
                                     .check = check};
