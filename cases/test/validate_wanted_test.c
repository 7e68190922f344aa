/* What analyses and quantities may not be: every refusal names its culprit and says what to do, in
 * one line; and what is refused is one thing only: the scene it was made from is accepted. */
#include <math.h>
#include <stdlib.h>

#include "cases/test/refuse.h"

/* The path of an unknown load factor, which changes loads only. */
static void driven(scene *s)
{
    const double station[] = {0, 1};
    free(scene_path_of(&s->analysis[0])->value);
    s->analyses = 0;
    scene_add_continuation(
        s, 2, station,
        (scene_control){.node = TIP, .component = SCENE_UX, .step = 0.1, .step_max = 0.1});
}

static void continued(scene *s)
{
    driven(s);
    scene_drive(s, TIP, SCENE_UY, SCENE_FREE);
    free(s->driver[0].path);
    free(s->driver[0].value);
    s->drivers = 0;
}

static void follows_itself(scene *s)
{
    s->analysis[0].follows = 0;
}

static void stations(scene *s)
{
    s->analysis[0].of.walk.path.value[1] = -1;
}

static void no_station(scene *s)
{
    s->analysis[0].of.walk.path.stations = 0;
}

static void spin(scene *s)
{
    scene_set_rotating_frame(s, 0, (scene_rotating_frame){.omega = {0, 0, NAN}});
}

static void two_names(scene *s)
{
    scene_add_quantity(s, "u", "m", 0, scene_coordinate(TIP, SCENE_UX));
}

static void no_analysis(scene *s)
{
    s->quantity[0].analysis = 1;
}

static void no_coordinate(scene *s)
{
    s->quantity[0].what.of.component.component = 6;
}

static void not_of_a_path(scene *s)
{
    scene_add_quantity(s, "frequency", "Hz", 0, scene_frequency(0, SCENE_ANY));
}

static void no_entry(scene *s)
{
    const int at_tip = scene_add_compliance(s, 0, (scene_compliance){.node = TIP});
    scene_add_quantity(s, "entry", "m/N", at_tip, scene_compliance_entry(SCENE_UX, 6));
}

static void no_driver(scene *s)
{
    scene_add_quantity(s, "angle", "rad", 0, scene_driver_value(1));
}

static void uncontrolled(scene *s)
{
    continued(s);
    s->analysis[0].of.continuation.control.component = SCENE_RX;
}

static void step(scene *s)
{
    continued(s);
    s->analysis[0].of.continuation.control.step = 0;
}

static void smaller_step(scene *s)
{
    continued(s);
    s->analysis[0].of.continuation.control.step_max = 0.05;
}

static void compliance_nowhere(scene *s)
{
    scene_add_compliance(s, SCENE_NONE, (scene_compliance){.node = SCENE_NONE});
}

static void compliance_of_compliance(scene *s)
{
    const scene_compliance at_tip = {.node = TIP};
    scene_add_compliance(s, scene_add_compliance(s, 0, at_tip), at_tip);
}

static void critical_about_linear(scene *s)
{
    scene_add_buckling(s, scene_add_linear(s));
}

static void critical_about_buckling(scene *s)
{
    scene_add_buckling(s, scene_add_buckling(s, SCENE_NONE));
}

static void frequencies_about_rotation(scene *s)
{
    const double end = 1;
    scene_add_modal(
        s, scene_add_rotation(s, 1, &end, 1, 0, (scene_rotating_frame){.omega = {0, 0, 1}}));
}

static void station_of_linear(scene *s)
{
    scene_set_at(
        scene_add_quantity(s, "v", "m", scene_add_linear(s), scene_coordinate(TIP, SCENE_UY)), 0.5);
}

static void largest_of_frequencies(scene *s)
{
    scene_add_quantity(s, "f", "Hz", scene_add_modal(s, 0), scene_frequency(0, SCENE_ANY))
        ->reduction = SCENE_MAX;
}

static const refusal wanted_refusals[] = {
    {follows_itself, "analysis 0: ", "does not come before it"},
    {stations, "analysis 0: ", "must ascend"},
    {no_station, "analysis 0: ", "needs a station"},
    {spin, "analysis 0: ", "omega = "},
    {uncontrolled, "analysis 0: ", "component: no word has the value 3; give one of ux|uy|uz"},
    {step, "analysis 0: ", "steps of 0 to 0.1"},
    {smaller_step, "analysis 0: ", "steps of 0.1 to 0.05"},
    {compliance_nowhere, "analysis 1: ", "node: no node is named; name one"},
    {compliance_of_compliance, "analysis 2: ", "follows a path or nothing"},
    {critical_about_linear, "analysis 2: ", "name a static one, or leave about out"},
    {critical_about_buckling, "analysis 2: ", "name a static one, or leave about out"},
    {frequencies_about_rotation, "analysis 2: ", "ask the rotation for its own frequencies"},
    {station_of_linear, "quantity v: ", "analysis 1 has one state and no stations"},
    {largest_of_frequencies, "quantity f: ", "analysis 1 has one state and no stations"},
    {two_names, "quantity u: ", "two of that name"},
    {no_analysis, "quantity u: ", "analysis: analysis 1 does not exist"},
    {no_coordinate, "quantity u: ", "component: no word has the value 6"},
    {not_of_a_path, "quantity frequency: ", "does not have it"},
    {no_entry, "quantity entry: ", "column: no word has the value 6"},
    {no_driver, "quantity angle: ", "motion: driver 1 does not exist"},
};

static void accepts_continuation(void)
{
    scene s;
    fault f = {""};
    refuse_sound(&s);
    continued(&s);
    gsl_test(scene_validate(&s, &f) != STATUS_OK, "a continued path is sound: %s", f.text);
    scene_free(&s);
}

int main(void)
{
    refuse_all(sizeof wanted_refusals / sizeof wanted_refusals[0], wanted_refusals);
    accepts_continuation();
    return gsl_test_summary();
}
