/* Centre lines for pictures: a shaft that is twisted, a beam that is bent to an arc. */
#include "harness/model/model.h"

#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/math/rotation.h"
#include "elements/test/sections.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/scenes.h"

enum { POINTS = 13, MOST = 60 };

/* One element; its tip moved and turned. */
static void moved(const char *name, const double tip[6], centreline_point out[POINTS])
{
    const double end = 1;
    const section_spec spec = sections_of(1, 1, 1, 1);
    formulation chosen;
    scene s;
    model *m = NULL;
    model_state *state = NULL;
    fault f = {""};
    double x[MOST] = {0}, scale = 1;
    scene_init(&s, "cantilever");
    const int node = scenes_cantilever(&s, &spec);
    scene_add_static(&s, 1, &end, 1);
    gsl_test(formulation_parse(name, &chosen, &f) != STATUS_OK ||
                 scene_validate(&s, &f) != STATUS_OK,
             "%s", f.text);
    const model_request request = {
        .scene = &s, .type = chosen.type, .options = chosen.option, .elements = 1};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s: %s", name, f.text);
    gsl_test_int(centreline_points(m, NULL), POINTS, "%s: points of a member", name);
    for (int i = 0; i < 6; i++)
        x[kinematics_coordinate(m, node, SCENE_UX + i)] = tip[i];
    gsl_test(centreline_displaced(m, kinematics_rest(m), x, NULL, &scale, &state, &f) != STATUS_OK,
             "%s: %s", name, f.text);
    centreline_fill(m, state, out);
    kinematics_state_free(state);
    model_free(m);
    scene_free(&s);
}

/* A cubic between ends that are tangents to an arc is off it by angle^3/384; triads follow its
 * tangents, and share a twist evenly. */
static void arc(const char *name, double angle, double twist)
{
    const double radius = angle > 0 ? 1 / angle : 0;
    const double tip[6] = {angle > 0 ? radius * sin(angle) - 1 : 0,
                           angle > 0 ? radius * (1 - cos(angle)) : 0,
                           0,
                           twist,
                           0,
                           angle};
    const double off = pow(angle, 3) / 380;
    centreline_point p[POINTS];
    moved(name, tip, p);
    for (int i = 0; i < POINTS; i++) {
        const double t = (double)i / (POINTS - 1), a = angle * t;
        const double r[3] = {angle > 0 ? radius * sin(a) : t, angle > 0 ? radius * (1 - cos(a)) : 0,
                             0};
        const double turn[3] = {twist * t, 0, a};
        double q[4], same = 0;
        rotation_exp(turn, q);
        for (int k = 0; k < 3; k++)
            gsl_test_abs(p[i].r[k], r[k], 1e-14 + off, "%s: place %d of point %d", name, k, i);
        for (int k = 0; k < 4; k++)
            same += p[i].q[k] * q[k];
        gsl_test_abs(fabs(same), 1, 1e-14 + off, "%s: triad of point %d", name, i);
    }
}

int main(void)
{
    static const char *const name[] = {"beamw", "collocation", "sheet_third"};
    for (int i = 0; i < 3; i++) {
        arc(name[i], 0, 0.9);
        arc(name[i], 0.4, 0);
    }
    return gsl_test_summary();
}
