/* Rates that a motion begins with: those of the field that is asked for, about its centre, at all
 * frames; angles of a sequence, whose axes are askew, take what is left beside a driven one. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/test/flying.h"
#include "harness/tools/kit/scenes.h"

#define LAUNCH_SWUNG "harness/time/test/swung.yaml"

static const double driven_rate = 0.4, none = 1e-10;

/* A beam whose tip turns by angles about axes askew. driven: the first of them is driven. */
static void launched(int driven)
{
    scene s;
    flying at;
    scenes_read(&s, LAUNCH_SWUNG, "tip=%s;step=0.02", driven ? "askew_driven" : "askew");
    const int tip = scenes_find(&s, SCENE_NODES, driven ? "tip_askew_driven" : "tip_askew");
    const scene_start field = scene_motion_of(&s.analysis[0])->start;
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
    scene_rotating_frame frame = {.omega = {0.8, -1.5, 1.1}, .centre = {0.3, 0.5, beside}};
    scene s;
    flying at;
    scenes_read(&s, LAUNCH_SWUNG, "base=held;thrown=0;step=0.02");
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
