/* What motions in time may not be, and their functions. */
#include <math.h>
#include <stdlib.h>

#include "cases/test/refuse.h"

/* From the end of the static path, where the driver is at 1 m. */
static scene_motion *moves_from(scene *s, int follows)
{
    const double station[] = {0.5, 2};
    s->section[0] = section_spec_rectangle(1e9, 4e8, 0.01, 0.01);
    s->section[0].density = 1000;
    const int i = scene_add_motion(
        s, follows, 2, station,
        (scene_motion){.alpha = scene_alpha_of_radius(0.9), .step = 0.1, .tolerance = 1e-4});
    return &s->analysis[i].of.motion;
}

static scene_motion *moves(scene *s)
{
    return moves_from(s, 0);
}

/* Driven in time, from 1 s on by another function; NULL: by one alone. */
static void drives(scene *s, const char *first, const char *then)
{
    moves(s);
    scene_drive_piece(s, 0, then != NULL ? 1 : 0, first);
    if (then != NULL)
        scene_drive_piece(s, 0, 0, then);
}

static void asks(scene *s, scene_extract what)
{
    moves(s);
    scene_add_quantity(s, "asked", "1", 1, what);
}

static void step_of_nothing(scene *s)
{
    moves(s)->step = 0;
}

static void step_without_end(scene *s)
{
    moves(s)->step = INFINITY;
}

static void tolerance_below(scene *s)
{
    moves(s)->tolerance = -1e-4;
}

static void tolerance_above(scene *s)
{
    moves(s)->tolerance = 1;
}

static void station_before(scene *s)
{
    moves(s)->path.value[0] = -0.5;
}

static void stations_fall(scene *s)
{
    moves(s)->path.value[1] = 0.25;
}

static void alpha_unstable(scene *s)
{
    moves(s)->alpha = (scene_alpha){0.3, 0.2};
}

static void alpha_beyond(scene *s)
{
    moves(s)->alpha = (scene_alpha){0.3, 0.6};
}

static void alpha_of_radius_beyond(scene *s)
{
    moves(s)->alpha = scene_alpha_of_radius(1.1);
}

static void integrator_unknown(scene *s)
{
    moves(s)->scheme = SCENE_SCHEMES;
}

static void starts_nowhere(scene *s)
{
    moves(s)->start.spin[2] = NAN;
}

static void without_mass(scene *s)
{
    moves(s);
    s->section[0].density = 0;
}

static void after_linear(scene *s)
{
    moves_from(s, scene_add_linear(s));
}

static void modes_of_motion(scene *s)
{
    moves(s);
    scene_add_modal(s, 1);
}

static void unknown_driver(scene *s)
{
    moves(s);
    scene_add_unknown_driver(s, "slide", TIP, SCENE_UY, 0);
    scene_drive(s, TIP, SCENE_UX, 1);
}

static void values_over_no_path(scene *s)
{
    moves_from(s, SCENE_NONE);
}

static void factors_over_no_path(scene *s)
{
    const double path[] = {0, 1};
    moves_from(s, SCENE_NONE);
    s->driver[0].value[1] = 0;
    scene_drive_piece(s, 0, 0, "t");
    scene_set_factor(s, 0, 2, path, path);
}

static void begins_elsewhere(scene *s)
{
    drives(s, "t^2", NULL);
}

static void driver_jumps(scene *s)
{
    drives(s, "1 + t^2", "3*t - 0.5");
}

static void driver_hits(scene *s)
{
    drives(s, "1 + t^2", "2");
}

static void driver_without_acceleration(scene *s)
{
    drives(s, "1 + t^1.5", NULL);
}

static void driver_unread(scene *s)
{
    drives(s, "1 + x", NULL);
}

static void pieces_fall(scene *s)
{
    moves(s);
    scene_load_piece(s, 0, 2, "1");
    scene_load_piece(s, 0, 1, "2");
    scene_load_piece(s, 0, 0, "3");
}

static void load_without_value(scene *s)
{
    moves(s);
    scene_load_piece(s, 0, 0, "1/t");
}

static void idle_function(scene *s)
{
    scene_load_piece(s, 0, 0, "t");
}

static void relative_to_itself(scene *s)
{
    asks(s, scene_relative_to(TIP, SCENE_UX, TIP));
}

static void orientation_of_nothing(scene *s)
{
    asks(s, scene_orientation_entry(TIP, 3, 0));
}

static void rate_of_nothing(scene *s)
{
    asks(s, scene_rate(9, SCENE_UX));
}

static void rate_at_rest(scene *s)
{
    scene_add_quantity(s, "v", "m/s", 0, scene_rate(TIP, SCENE_UX));
}

static void frequency_of_motion(scene *s)
{
    asks(s, scene_frequency(0, SCENE_ANY));
}

static const refusal refusals[] = {
    {step_of_nothing, "analysis 1: ", "a step of 0 s"},
    {step_without_end, "analysis 1: ", "step = inf"},
    {tolerance_below, "analysis 1: ", "a tolerance of -0.0001"},
    {tolerance_above, "analysis 1: ", "a tolerance of 1;"},
    {station_before, "analysis 1: ", "a station at -0.5 s"},
    {stations_fall, "analysis 1: ", "must ascend"},
    {alpha_unstable, "analysis 1: ", "alpha_m = 0.3, alpha_f = 0.2 are not stable"},
    {alpha_beyond, "analysis 1: ", "not stable"},
    {alpha_of_radius_beyond, "analysis 1: ", "not stable"},
    {integrator_unknown, "analysis 1: ", "no such integrator"},
    {starts_nowhere, "analysis 1: ", "spin = nan"},
    {without_mass, "analysis 1: ", "nothing in it has a mass"},
    {after_linear, "analysis 2: ", "what it follows is linear"},
    {modes_of_motion, "analysis 2: ", "it is about a motion"},
    {unknown_driver, "driver slide: ", "it is unknown"},
    {values_over_no_path, "driver push: ", "its values are over a path"},
    {factors_over_no_path, "load 0: ", "its factors are over a path"},
    {begins_elsewhere, "driver push: ", "at 0 s it is 0, and a motion starts with it at 1"},
    {driver_jumps, "driver push: ", "its value jumps at 1 s"},
    {driver_hits, "driver push: ", "its velocity jumps at 1 s"},
    {driver_without_acceleration, "driver push: ", "at 0 s its value, velocity or acceleration"},
    {driver_unread, "driver push: ", "character 5: no such name"},
    {pieces_fall, "load 0: ", "the end of piece 2, 1 s, is not behind"},
    {load_without_value, "load 0: ", "at 0 s its factor is not finite"},
    {idle_function, "load 0: ", "no analysis is in time"},
    {relative_to_itself, "quantity asked: ", "no such relative coordinate"},
    {orientation_of_nothing, "quantity asked: ", "row: no word has the value 3; give one of x|y|z"},
    {rate_of_nothing, "quantity asked: ", "node: node 9 does not exist"},
    {rate_at_rest, "quantity v: ", "does not have it"},
    {frequency_of_motion, "quantity asked: ", "does not have it"},
};

static void accepts(void (*how)(scene *), const char *what)
{
    scene s;
    fault f = {""};
    refuse_sound(&s);
    how(&s);
    gsl_test(scene_validate(&s, &f) != STATUS_OK, "%s: %s", what, f.text);
    scene_free(&s);
}

static void held(scene *s)
{
    moves(s);
}

static void goes_on(scene *s)
{
    drives(s, "1 + t^2", "2*t");
    scene_load_piece(s, 0, 1, "1");
    scene_load_piece(s, 0, 0, "sqrt(t)");
}

/* Conditional: where alpha is another integrator's it is not looked at. */
static void without_alpha(scene *s)
{
    scene_motion *m = moves(s);
    m->scheme = SCENE_RADAU;
    m->alpha = (scene_alpha){3, 2};
}

static void turns_steadily(scene *s)
{
    const double one = 1;
    const scene_rotating_frame frame = {.omega = {0, 0, 1}};
    moves_from(s, scene_add_rotation(s, 1, &one, 1, 0, frame));
}

static void weighs_at_a_node(scene *s)
{
    moves(s);
    s->section[0].density = 0;
    scene_set_body(s, BODY, (scene_body){.mass = 1});
}

int main(void)
{
    refuse_all(sizeof refusals / sizeof refusals[0], refusals);
    accepts(held, "what no function moves stays at the end of the path");
    accepts(goes_on, "a driver goes on where the path has left it, a load may do anything");
    accepts(without_alpha, "parameters of another integrator");
    accepts(turns_steadily, "a start from a stationary rotation");
    accepts(weighs_at_a_node, "a mass at a node only");
    return gsl_test_summary();
}
