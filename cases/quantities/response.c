/* Steady vibration of a node as a function of frequency: receptance, mobility, accelerance,
 * transmissibility. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    QUANTITY_NODE(response.node),
    QUANTITY_COMPONENT("component of the node's small motion, along fixed axes",
                       response.component),
    {"from", ENTRY_NAME, .summary = "node whose corresponding component is subtracted",
     .left_out = "none", ENTRY_IN(scene_quantity, what.of.response.from), .of = SCENE_NODES},
    {"force", ENTRY_NAME, .group = 2,
     .summary = "node at which a harmonic force of 1 N or moment of 1 N m acts",
     .left_out = "the input is a motion, given by 'drive'",
     ENTRY_IN(scene_quantity, what.of.response.forced), .of = SCENE_NODES},
    {"drive", ENTRY_NAME, .group = 2,
     .summary = "motion that varies harmonically, by 1 m or 1 rad, such as that of a base",
     .left_out = "the input is a force", ENTRY_IN(scene_quantity, what.of.response.driver),
     .of = SCENE_DRIVERS},
    {"reference", ENTRY_NAME, .group = 2,
     .summary = "load with feedback, whose reference varies harmonically, by 1 m or 1 rad",
     .left_out = "the input is a force", ENTRY_IN(scene_quantity, what.of.response.reference),
     .of = SCENE_LOADS},
    {"unbalance", ENTRY_NAME, .group = 2,
     .summary = "node with an unbalance (mass times eccentricity) of 1 kg m that rotates at the "
                "excitation frequency",
     .left_out = "the input is a force", ENTRY_IN(scene_quantity, what.of.response.unbalanced),
     .of = SCENE_NODES},
    {"about", ENTRY_WORD, .words = "rx|ry|rz",
     .summary = "axis and sense of rotation of the unbalance", .usual = "rx",
     ENTRY_IN(scene_quantity, what.of.response.spinning), .first = SCENE_RX},
    {"along", ENTRY_WORD, .words = ENTRY_COMPONENTS, .summary = "component of the force",
     .usual = "ux", ENTRY_IN(scene_quantity, what.of.response.forced_along),
     .turns = ENTRY_COMPONENT},
    {"of", ENTRY_WORD, .words = SCENE_VIBRATION_CHOICES,
     .summary =
         "output; reaction: reaction force or moment of the motion that drives the component",
     .usual = "displacement", ENTRY_IN(scene_quantity, what.of.response.of)},
    {"part", ENTRY_WORD, .words = SCENE_VIBRATION_PARTS,
     .summary = "part of the complex response; a positive phase (-pi to pi) is ahead of the input",
     .usual = "amplitude", ENTRY_IN(scene_quantity, what.of.response.part)},
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    static const char *const of[2][5][4] = {
        {{"m/N", "m/(N s)", "m/(N s^2)", "1"},
         {"1/N", "1/(N s)", "1/(N s^2)", "1/m"},
         {"1", "1/s", "1/s^2", "N/m"},
         {"m/rad", "m/(rad s)", "m/(rad s^2)", "N/rad"},
         {"1/kg", "1/(kg s)", "1/(kg s^2)", "1/s^2"}},
        {{"rad/N", "rad/(N s)", "rad/(N s^2)", "m"},
         {"rad/(N m)", "rad/(N m s)", "rad/(N m s^2)", "1"},
         {"rad/m", "rad/(m s)", "rad/(m s^2)", "N"},
         {"1", "1/s", "1/s^2", "N m/rad"},
         {"rad/(kg m)", "rad/(kg m s)", "rad/(kg m s^2)", "m/s^2"}}};
    const scene_response *r = &q->what.of.response;
    const int by = r->unbalanced != SCENE_NONE ? 4
                   : r->driver != SCENE_NONE   ? 2 + scene_driver_turns(s, r->driver)
                   : r->reference != SCENE_NONE
                       ? 2 + (s->load[r->reference].feedback.component >= SCENE_RX)
                       : r->forced_along >= SCENE_RX;
    return r->part == SCENE_PHASE ? "rad" : of[r->component >= SCENE_RX][by][r->of];
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    static const char *const part[] = {"amplitude", "phase", "real part", "imaginary part"},
                             *const of[] = {"displacement", "velocity", "acceleration", "reaction"},
                             *const turn[] = {"rotation", "angular velocity",
                                              "angular acceleration", "reaction moment"};
    const scene_response *r = &q->what.of.response;
    const int turns = r->component >= SCENE_RX;
    fprintf(to, "%s of the harmonic %s", part[r->part], (turns ? turn : of)[r->of]);
    meaning_node(to, s, "of", r->node);
    fprintf(to, " %s %c", turns ? "about" : "along", meaning_axis(r->component));
    if (r->from != SCENE_NONE)
        meaning_node(to, s, "minus that of", r->from);
    if (r->driver != SCENE_NONE) {
        fprintf(to, " for a unit amplitude of motion %s", s->driver[r->driver].name);
        return;
    }
    if (r->unbalanced != SCENE_NONE) {
        fprintf(to, " for a unit unbalance that rotates about %c", meaning_axis(r->spinning));
        meaning_node(to, s, "at", r->unbalanced);
        return;
    }
    if (r->reference != SCENE_NONE) {
        fprintf(to, " for a unit amplitude of the reference of load %s",
                scene_name(s, SCENE_LOADS, r->reference).text);
        return;
    }
    fprintf(to, " for a unit %s %c", meaning_load(r->forced_along), meaning_axis(r->forced_along));
    meaning_node(to, s, "at", r->forced);
}

static int turns(const scene *s, const scene_quantity *q, int i, scene_component *out)
{
    (void)s;
    const scene_response *r = &q->what.of.response;
    *out = i == 0                        ? (scene_component){r->node, r->component}
           : r->unbalanced != SCENE_NONE ? (scene_component){r->unbalanced, r->spinning}
                                         : (scene_component){r->forced, r->forced_along};
    return i < 1 + (r->forced != SCENE_NONE || r->unbalanced != SCENE_NONE);
}

static status check(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_response *r = &q->what.of.response;
    if ((r->driver != SCENE_NONE) + (r->forced != SCENE_NONE) + (r->reference != SCENE_NONE) +
            (r->unbalanced != SCENE_NONE) !=
        1)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: exactly one input is required; name a node with 'force' or "
                         "'unbalance', a "
                         "motion with 'drive', or a load that has feedback with 'reference'",
                         q->name);
    if (r->reference != SCENE_NONE && s->load[r->reference].feedback.node == SCENE_NONE)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: load %s has no feedback and therefore no reference; name a "
                         "load with feedback, or give 'force'",
                         q->name, scene_name(s, SCENE_LOADS, r->reference).text);
    if (r->reference != SCENE_NONE && !scene_closes_loop(s, q->analysis, r->reference))
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: the feedback loop of load %s is open in %s, so its "
                         "reference has no effect; remove 'loops: open', or give another input",
                         q->name, scene_name(s, SCENE_LOADS, r->reference).text,
                         scene_called(s, SCENE_ANALYSES, q->analysis).text);
    if (r->of == SCENE_REACTING && r->from != SCENE_NONE)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: a reaction belongs to a single node; remove 'from'",
                         q->name);
    if (r->driver == SCENE_NONE || s->driver[r->driver].condition_driver == SCENE_NONE)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "quantity %s: the value of motion %s is unknown, but a "
                     "response requires known values; name another motion",
                     q->name, s->driver[r->driver].name);
}

const quantity_type quantity_response = {.key = "response",
                                         .summary =
                                             "response of a node to a harmonic force or motion",
                                         .kind = SCENE_RESPONSE,
                                         .field = fields,
                                         .analyses = 1u << SCENE_HARMONIC,
                                         .unit = unit,
                                         .meaning = meaning,
                                         .turns = turns,
                                         .check = check};
