/* What arc length is measured with: the mean over the moving bodies of (displacement/size)^2 +
 * angle^2, whatever moves, in whichever direction; the same of small steps and between states. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>

#include "elements/math/rotation.h"
#include "harness/model/model_impl.h"
#include "harness/model/test/corner.h"

enum { ELEMENTS = 3, BODIES = 6 }; /* of seven vertices one is held */

static void one_motion(const model *m, int vertex, int component, double size)
{
    static const double amount = 0.3;
    const int turns = component >= SCENE_RX, n = m->mesh.free + m->mesh.driven;
    const double share = turns ? 1.0 / BODIES : 1.0 / BODIES / (size * size);
    double *weight = calloc((size_t)n + 1, sizeof *weight), turn[3] = {0}, step[4];
    model_state *a, *b;
    fault f = {""};
    gsl_test(kinematics_state_alloc(m, &a, &f) != STATUS_OK ||
                 kinematics_state_alloc(m, &b, &f) != STATUS_OK,
             "states: %s", f.text);
    for (int i = 0; i <= n; i++)
        weight[i] = 17;
    metric_of(m, weight);
    gsl_test(weight[n] != 17, "what stands behind the weights is left alone");
    gsl_test_rel(weight[m->mesh.vertex[vertex].coordinate[component]], share, 1e-14,
                 "vertex %d, component %d: weight", vertex, component);
    if (turns) {
        turn[component - SCENE_RX] = amount;
        rotation_exp(turn, step);
        rotation_compose(step, &a->q[4 * vertex], &b->q[4 * vertex]);
    } else {
        b->u[3 * vertex + component] += amount;
    }
    gsl_test_rel(metric_distance(m, a, b, NULL), amount * sqrt(share), 1e-13,
                 "vertex %d, component %d: distance", vertex, component);
    gsl_test_abs(metric_turn_between(m, a, b), turns ? amount : 0, 1e-13,
                 "vertex %d, component %d: turn", vertex, component);
    kinematics_state_free(a);
    kinematics_state_free(b);
    free(weight);
}

int main(void)
{
    scene s;
    model *m = NULL;
    if (corner("beamw", ELEMENTS, 1, &s, &m)) {
        int bodies = 0;
        for (int v = 0; v < m->mesh.vertices; v++) {
            const mesh_vertex *here = &m->mesh.vertex[v];
            if (here->body != v || here->coordinate[0] == NONE)
                continue;
            bodies++;
            for (int c = 0; c < VERTEX_COORDINATES; c++)
                one_motion(m, v, c, 2);
        }
        gsl_test_int(bodies, BODIES, "bodies that move");
    }
    model_free(m);
    scene_free(&s);
    return gsl_test_summary();
}
