/* Rates that a motion begins with: those of the field that is asked for, about its centre, at all
 * frames; angles of a sequence, whose axes are askew, take what is left beside a driven one. */
#include <math.h>

#include "elements/math/vec3.h"
#include "harness/model/kinematics.h"
#include "harness/model/mesh.h"
#include "harness/time/test/flying.h"
#include "harness/time/test/swung.h"

static const scene_start field = {
    .velocity = {0.3, -0.1, 0.2}, .spin = {0.8, -1.5, 1.1}, .centre = {0.4, -0.7, 0.2}};
static const double driven_rate = 0.4, none = 1e-10;

/* A beam whose tip turns by angles about axes askew. driven: the first of them is driven. */
static int add_beam(scene *s, int driven)
{
    static const double end[] = {1}, axis[3][3] = {{0.2, 1, 0.3}, {0.7, -0.1, 1}, {1, 0.4, -0.2}};
    scene_init(s, "launched");
    const swung of = swung_build(s);
    scene_node *tip = scene_node_at(s, of.tip);
    tip->rotation = SCENE_ROTATION_SEQUENCE;
    memcpy(tip->axis, axis, sizeof axis);
    scene_set_body(s, of.tip, (scene_body){.mass = 1, .inertia = {1, 1, 1}});
    if (driven) {
        const int turn = scene_add_moving_driver(s, "turn");
        scene_drive_piece(s, turn, 0, "0.4*t");
        scene_drive(s, of.tip, SCENE_RX, turn);
    }
    scene_motion how = swung_motion(SCENE_ALPHA, 0.02);
    how.start = field;
    scene_add_motion(s, SCENE_NONE, 1, end, how);
    return of.tip;
}

static void launched(int driven)
{
    scene s;
    flying at;
    const int tip = add_beam(&s, driven);
    gsl_test(flying_begin(&s, formulation_find("collocation"), 2, &at) != STATUS_OK, "begins: %s",
             at.why.text);
    for (int i = 0; i < model_vertices(at.m); i++) {
        frame_rates r;
        double place[3], turn[4], velocity[3], left[3];
        kinematics_frame(at.m, at.now.state, i, place, turn);
        forms_rates(at.m, at.now.state, i, at.now.v, NULL, &r);
        for (int k = 0; k < 3; k++)
            place[k] -= field.centre[k];
        vec3_cross(field.spin, place, velocity);
        for (int k = 0; k < 3; k++)
            gsl_test_abs(r.v[k], velocity[k] + field.velocity[k], none, "vertex %d, velocity %d", i,
                         k);
        for (int k = 0; k < 3; k++)
            left[k] = r.w[k] - field.spin[k];
        if (i != tip || !driven) {
            gsl_test(!(vec3_norm(left) < none), "vertex %d: %g rad/s beside its spin", i,
                     vec3_norm(left));
            continue;
        }
        const int *c = &model_vertex(at.m, i)->coordinate[SCENE_RX];
        double b[3][3];
        kinematics_axes(at.m, at.now.state, i, b);
        gsl_test_abs(at.now.v[c[0]], driven_rate, none, "the driven angle");
        gsl_test(!(vec3_norm(left) > 0.1), "what is driven is not of the field");
        for (int k = 1; k < 3; k++)
            gsl_test_abs(vec3_dot(b[k], left), 0, none, "about axis %d nothing is left", k);
    }
    flying_end(&at);
    scene_free(&s);
}

/* Axes that turn about a place, where a node is held: the state is at rest in them. */
static void turning(double beside)
{
    static const double end[] = {1};
    scene_rotating_frame frame = {.omega = {0.8, -1.5, 1.1}, .centre = {0.3, 0.5, beside}};
    scene s;
    flying at;
    scene_init(&s, "turning");
    const swung of = swung_build(&s);
    memcpy(scene_node_at(&s, of.base)->position, (const double[]){0.3, 0.5, 0}, sizeof frame.omega);
    scene_hold(&s, of.base, SCENE_UX, SCENE_UZ);
    scene_motion how = swung_motion(SCENE_ALPHA, 0.02);
    how.start = (scene_start){.velocity = {0}};
    scene_add_motion(&s, SCENE_NONE, 1, end, how);
    gsl_test(flying_begin(&s, formulation_find("collocation"), 2, &at) != STATUS_OK, "begins: %s",
             at.why.text);
    const status outcome = launch_turning(&at.c, &at.masses, scene_motion_of(&s.analysis[0]),
                                          &frame, &at.now, &at.next, &at.why);
    gsl_test(outcome != (beside == 0 ? STATUS_OK : STATUS_REFUSED), "turns %g m beside it: %s",
             beside, at.why.text);
    flying_end(&at);
    scene_free(&s);
}

int main(void)
{
    turning(0);
    turning(0.1);
    launched(0);
    launched(1);
    return gsl_test_summary();
}
