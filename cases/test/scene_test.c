/* What a scene may not be: every refusal names its culprit and says what to do, in one line; and
 * what is refused is one thing only: the scene it was made from is accepted. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/edit.h"

enum { ROOT, TIP, BODY };

static const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0}, zero[3] = {0, 0, 0};

/* A cantilever with a body at its tip that is driven along y, and a static path. */
static void sound(scene *s)
{
    const double station[2] = {0, 1};
    section_spec spec;
    section_spec_init(&spec);
    scene_init(s, "sound");
    scene_add_node(s, 0, 0, 0);
    scene_add_node(s, 1, 0, 0);
    scene_add_attached(s, TIP, 1, 0.1, 0);
    scene_add_member(s, ROOT, TIP, scene_add_section(s, &spec), y_axis);
    scene_hold_all(s, ROOT);
    scene_drive(s, TIP, SCENE_UY, scene_add_driver(s, "push", 2, station, station));
    scene_add_load(s, SCENE_FORCE, TIP, 1, 0, 0);
    const int path = scene_add_static(s, 2, station, 1);
    scene_add_quantity(s, "u", "m", path, scene_coordinate(TIP, SCENE_UX));
}

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

static void no_memory(scene *s)
{
    s->out_of_memory = 1;
}
static void position(scene *s)
{
    s->node[TIP].position[1] = NAN;
}
static void driver_of_node(scene *s)
{
    s->node[TIP].translation[0] = 7;
}
static void half_a_vector(scene *s)
{
    s->node[TIP].rotation = SCENE_ROTATION_VECTOR;
}
static void fork_and_held(scene *s)
{
    scene_fork(s, ROOT, x_axis, y_axis);
}
static void web_along(scene *s)
{
    scene_fork(s, TIP, x_axis, x_axis);
}
static void no_web(scene *s)
{
    scene_fork(s, TIP, x_axis, zero);
}
static void fork_across(scene *s)
{
    scene_fork(s, TIP, y_axis, x_axis);
}
static void body_of_body(scene *s)
{
    s->node[TIP].attached = BODY;
}
static void body_of_itself(scene *s)
{
    s->node[BODY].attached = BODY;
}
static void body_of_nothing(scene *s)
{
    s->node[BODY].attached = 9;
}
static void body_held(scene *s)
{
    scene_hold(s, BODY, SCENE_UZ, SCENE_UZ);
}
static void end_of_member(scene *s)
{
    s->member[0].q = 5;
}
static void no_section(scene *s)
{
    s->member[0].section = 1;
}
static void no_length(scene *s)
{
    memset(s->node[TIP].position, 0, sizeof zero);
}
static void y_along(scene *s)
{
    memcpy(s->member[0].y_axis, x_axis, sizeof x_axis);
}
static void no_y(scene *s)
{
    memset(s->member[0].y_axis, 0, sizeof zero);
}
static void divisions(scene *s)
{
    s->member[0].divisions = -3;
}
static void idle_driver(scene *s)
{
    scene_drive(s, TIP, SCENE_UY, SCENE_FREE);
}
static void value_of_driver(scene *s)
{
    s->driver[0].value[1] = INFINITY;
}
static void path_of_driver(scene *s)
{
    s->driver[0].path[1] = 0;
}
static void no_load_there(scene *s)
{
    s->load[0].where = 3;
}
static void no_member_loaded(scene *s)
{
    s->load[0] = (scene_load){SCENE_DISTRIBUTED, .where = 1};
}
static void load(scene *s)
{
    s->load[0].vector[2] = NAN;
}
static void load_nowhere(scene *s)
{
    s->load[0].at[1] = INFINITY;
}
static void moment_beside(scene *s)
{
    s->load[0].kind = SCENE_MOMENT;
    s->load[0].at[0] = 1;
}
static void node_along(scene *s)
{
    s->load[0].axes = SCENE_AXES_MEMBER;
}
static void weight_turns(scene *s)
{
    s->load[0] = (scene_load){SCENE_GRAVITY, .follower = 1};
}
static void weightless(scene *s)
{
    section_spec *spec = &s->section[0];
    spec->kind = SECTION_RECTANGLE;
    spec->young = spec->shear_modulus = spec->width = spec->height = 1;
    spec->density = 0;
    s->load[0] = (scene_load){SCENE_GRAVITY, .vector = {0, 0, -9.81}};
}
static void buckles_by_follower(scene *s)
{
    s->load[0].follower = 1;
    scene_add_buckling(s, SCENE_NONE);
}
static void turns_with_moments(scene *s)
{
    s->load[0] = (scene_load){SCENE_DISTRIBUTED_MOMENT, .vector = {1, 0, 0}};
    scene_add_modal(s, scene_add_linear(s));
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
    scene_set_spin(s, 0, (scene_spin){.omega = {0, 0, NAN}});
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

static void unknown_driver(scene *s)
{
    scene_drive(s, TIP, SCENE_UZ, scene_add_unknown_driver(s, "sought", TIP, SCENE_UY, SCENE_NONE));
}

static void condition_nowhere(scene *s)
{
    scene_drive(s, TIP, SCENE_UZ, scene_add_unknown_driver(s, "sought", 9, SCENE_UY, 0));
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

static void spoil_body(scene *s, scene_body b)
{
    scene_set_body(s, 1, b);
}

static void negative_mass(scene *s)
{
    spoil_body(s, (scene_body){.mass = -1});
}

static void endless_inertia(scene *s)
{
    spoil_body(s, (scene_body){.mass = 1, .inertia = {INFINITY, 1, 1}});
}

static void centre_of_nothing(scene *s)
{
    spoil_body(s, (scene_body){.centre = {0, 1, 0}});
}

static void no_triangle(scene *s)
{
    spoil_body(s, (scene_body){.mass = 1, .inertia = {1, 1, 2.1}});
}

static void products_too_large(scene *s)
{
    spoil_body(s, (scene_body){.mass = 1, .inertia = {1, 1, 1, 0.6, 0, 0}});
}

static void loose_mass(scene *s)
{
    scene_set_body(s, scene_add_node(s, 0, 0, 7), (scene_body){.mass = 1});
}

static scene_spring *spring_of(scene *s)
{
    const double stiffness[36] = {[0] = 4, [1] = 1, [6] = 1, [7] = 2, [35] = 3};
    const int i = scene_add_spring(s, 0, 1, stiffness);
    return &s->spring[i];
}

static void spring_nowhere(scene *s)
{
    spring_of(s)->q = 9;
}

static void spring_of_one(scene *s)
{
    spring_of(s)->p = 1;
}

static void unsymmetric_spring(scene *s)
{
    spring_of(s)->stiffness[1] = 1.1;
}

static void negative_spring(scene *s)
{
    spring_of(s)->stiffness[14] = -1;
}

static void indefinite_spring(scene *s)
{
    double *K = spring_of(s)->stiffness;
    K[1] = K[6] = 2.9;
}

static void coupled_to_nothing(scene *s)
{
    double *K = spring_of(s)->stiffness;
    K[2] = K[12] = 0.1;
}

typedef void spoil(scene *);

static const struct {
    spoil *how;
    const char *culprit, *words; /* how its line starts, and what it says */
} refusal[] = {
    {position, "node 1: ", "position is not a number"},
    {driver_of_node, "node 1: ", "driver that does not exist"},
    {half_a_vector, "node 1: ", "three drivers"},
    {fork_and_held, "node 0: ", "a fork and RX held"},
    {web_along, "node 1: ", "not at right angles"},
    {no_web, "node 1: ", "not at right angles"},
    {fork_across, "node 1: ", "no member there runs along"},
    {body_of_body, "node 1: ", "attached to node 2, which is no body"},
    {body_of_itself, "node 2: ", "attached to node 2, which is no body"},
    {body_of_nothing, "node 2: ", "attached to node 9, which is no body"},
    {body_held, "node 2: ", "it moves with node 1"},
    {negative_mass, "node 1: ", "is no such number"},
    {endless_inertia, "node 1: ", "is no such number"},
    {centre_of_nothing, "node 1: ", "a centre without a mass"},
    {no_triangle, "node 1: ", "no body has this inertia"},
    {products_too_large, "node 1: ", "no body has this inertia"},
    {loose_mass, "node 3: ", "nothing holds its mass"},
    {spring_nowhere, "spring 0: ", "a node that does not exist"},
    {spring_of_one, "spring 0: ", "both its ends are node 1"},
    {unsymmetric_spring, "spring 0: ", "is not symmetric"},
    {negative_spring, "spring 0: ", "gives energy away"},
    {indefinite_spring, "spring 0: ", "gives energy away"},
    {coupled_to_nothing, "spring 0: ", "gives energy away"},
    {end_of_member, "member 0: ", "a node that does not exist"},
    {no_section, "member 0: ", "its section does not exist"},
    {no_length, "member 0: ", "its ends coincide"},
    {y_along, "member 0: ", "its y axis is parallel"},
    {no_y, "member 0: ", "its y axis is parallel"},
    {divisions, "member 0: ", "-3 elements"},
    {idle_driver, "driver push: ", "it moves nothing"},
    {unknown_driver, "driver sought: ", "no condition fixes it"},
    {condition_nowhere, "driver sought: ", "no condition fixes it"},
    {value_of_driver, "driver push: ", "station 1 is not a number"},
    {path_of_driver, "driver push: ", "must ascend"},
    {no_load_there, "load 0: ", "does not exist"},
    {no_member_loaded, "load 0: ", "does not exist"},
    {load, "load 0: ", "not a number"},
    {load_nowhere, "load 0: ", "not a number"},
    {moment_beside, "load 0: ", "only forces act at an offset"},
    {node_along, "load 0: ", "a member's axes and acts on a node"},
    {weight_turns, "load 0: ", "gravity has fixed axes"},
    {weightless, "load 0: ", "no density"},
    {buckles_by_follower, "analysis 1: ", "load 0 that follows has no potential"},
    {turns_with_moments, "analysis 2: ", "distributed moments has no potential"},
    {follows_itself, "analysis 0: ", "does not come before it"},
    {stations, "analysis 0: ", "must ascend"},
    {no_station, "analysis 0: ", "needs a station"},
    {spin, "analysis 0: ", "angular velocity is not a number"},
    {uncontrolled, "analysis 0: ", "control coordinate"},
    {step, "analysis 0: ", "steps of 0 to 0.1"},
    {smaller_step, "analysis 0: ", "steps of 0.1 to 0.05"},
    {driven, "analysis 0: ", "changes loads only"},
    {compliance_nowhere, "analysis 1: ", "a compliance needs a node"},
    {compliance_of_compliance, "analysis 2: ", "follows a path or nothing"},
    {two_names, "quantity u: ", "two of that name"},
    {no_analysis, "quantity u: ", "no such analysis"},
    {no_coordinate, "quantity u: ", "no such coordinate"},
    {not_of_a_path, "quantity frequency: ", "does not have it"},
    {no_entry, "quantity entry: ", "no such entry"},
    {no_driver, "quantity angle: ", "no such driver"},
};
enum { REFUSALS = sizeof refusal / sizeof refusal[0] };

static void one_line(const char *what, const fault *f)
{
    gsl_test(f->text[0] == '\0' || strchr(f->text, '\n') != NULL, "%s: one line: %s", what,
             f->text);
    gsl_test(strchr(f->text, ';') == NULL, "%s: says what to do: %s", what, f->text);
}

static void refuses(int i)
{
    scene s;
    fault f = {""};
    sound(&s);
    gsl_test(scene_validate(&s, &f) != STATUS_OK, "the scene is sound: %s", f.text);
    refusal[i].how(&s);
    gsl_test_int((int)scene_validate(&s, &f), STATUS_REFUSED, "refused: %s", refusal[i].words);
    gsl_test(strncmp(f.text, refusal[i].culprit, strlen(refusal[i].culprit)) != 0,
             "%s is named: %s", refusal[i].culprit, f.text);
    gsl_test(strstr(f.text, refusal[i].words) == NULL, "%s: %s", refusal[i].words, f.text);
    one_line(refusal[i].words, &f);
    scene_free(&s);
}

static void accepts_continuation(void)
{
    scene s;
    fault f = {""};
    sound(&s);
    continued(&s);
    gsl_test(scene_validate(&s, &f) != STATUS_OK, "a continued path is sound: %s", f.text);
    scene_free(&s);
}

static void says_that_memory_ran_out(void)
{
    scene s;
    fault f = {""};
    sound(&s);
    no_memory(&s);
    gsl_test_int((int)scene_validate(&s, &f), STATUS_FAULT, "no memory: %s", f.text);
    gsl_test(strstr(f.text, "sound: out of memory") == NULL, "no memory: %s", f.text);
    scene_free(&s);
}

static void twisted(scene *s)
{
    s->member[0].curvature[0] = 0.1;
}
static void curved(scene *s)
{
    s->member[0].curvature[2] = 0.1;
}
static void unchanged(scene *s)
{
    (void)s;
}

/* Changes of a scene that are not defined for it. */
static void edits(void)
{
    static const struct {
        spoil *how;
        scene_edit edit;
        const char *words;
    } row[] = {
        {twisted, {SCENE_EDIT_REVERSE, 0}, "member 0: initially twisted"},
        {curved, {SCENE_EDIT_SPLIT, 0.5}, "member 0: curved"},
        {unchanged, {SCENE_EDIT_SPLIT, 1}, "split at 1 of its length"},
        {unchanged, {SCENE_EDIT_SPLIT, NAN}, "split at nan of its length"},
        {unchanged, {SCENE_EDIT_UNIT, 0}, "no unit of length"},
        {unchanged, {SCENE_EDIT_UNIT, INFINITY}, "no unit of length"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        scene s;
        fault f = {""};
        sound(&s);
        row[i].how(&s);
        gsl_test_int((int)scene_edit_apply(&s, &row[i].edit, &f), STATUS_REFUSED, "refused: %s",
                     row[i].words);
        gsl_test(strstr(f.text, row[i].words) == NULL, "%s: %s", row[i].words, f.text);
        one_line(row[i].words, &f);
        scene_free(&s);
    }
}

/* An edited scene is a scene. */
static void edited(void)
{
    static const scene_edit edit[] = {
        {SCENE_EDIT_REVERSE, 0}, {SCENE_EDIT_SPLIT, 0.3}, {SCENE_EDIT_UNIT, 1000}};
    for (size_t i = 0; i < sizeof edit / sizeof edit[0]; i++) {
        scene s;
        fault f = {""};
        sound(&s);
        gsl_test(scene_edit_apply(&s, &edit[i], &f) != STATUS_OK, "edit %d: %s", (int)i, f.text);
        gsl_test(scene_validate(&s, &f) != STATUS_OK, "edit %d gives a scene: %s", (int)i, f.text);
        scene_free(&s);
    }
}

/* What a section comes to follows its description, however often it was asked for. */
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

int main(void)
{
    for (int i = 0; i < REFUSALS; i++)
        refuses(i);
    accepts_continuation();
    says_that_memory_ran_out();
    edits();
    edited();
    constants_follow();
    return gsl_test_summary();
}
