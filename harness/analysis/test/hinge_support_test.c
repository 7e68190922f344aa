/* An end that is released from a clamped node is one at a support that lets it go: in every
 * analysis, by every formulation and way of Newton. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/analysis/test/hinged.h"
#include "harness/formulations/registry.h"
#include "harness/tools/kit/scenes.h"

/* An end that turns or slides at a support (0), or a clamped node that it is released from (1):
 * answers of every analysis. */
static int how_supported, what_released, dense; /* dense: without what follows a factored tangent */
static const char *const released_name[] = {"a hinge", "two turns", "a ball", "a slide"};

/* Three of each. It turns more slowly than the spring along the slide bears: 3 N/m is omega^2 times
 * the mass at 0.7 of (0.3, -0.8, 1.7) rad/s, a pole. Frequencies, displacements, forces at the end,
 * compliances. */
static void ask_all(scene *s, int path, int tip, int member)
{
    static const double end = 1;
    const int modal = scene_add_modal(s, SCENE_NONE), linear = scene_add_linear(s),
              turning = scene_add_rotation(s, 1, &end, 4, 4,
                                           (scene_rotating_frame){.omega = {0.18, -0.48, 1.02}}),
              compliance = scene_add_compliance(s, path, (scene_compliance){.node = tip});
    scenes_ask_frequencies(s, "rest", modal, 3);
    scenes_ask_frequencies(s, "turning", turning, 3);
    scenes_ask_motion(s, "linear", linear, tip);
    scenes_ask_motion(s, "moved", path, tip);
    for (int i = 0; i < 3; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "force_%d", i);
        scene_add_quantity(s, name, "N", path,
                           scene_internal_at(member, 1, (scene_resultant)(SCENE_N + i)));
        snprintf(name, sizeof name, "compliance_%d", i);
        scene_add_quantity(s, name, i ? "1/N" : "m/N", compliance,
                           scene_compliance_entry(SCENE_UY + 2 * i, SCENE_UY));
    }
    scene_add_quantity(s, "critical", "1", scene_add_buckling(s, SCENE_NONE),
                       scene_critical_factor(1, 0));
}

/* Frequencies about the loaded state, a load factor of a continuation. */
static void ask_about(scene *s, int path, int tip)
{
    const double far = 0.2;
    const scene_control control = {
        .node = tip, .component = SCENE_UY, .step = 0.05, .step_max = 0.1};
    const int loaded = scene_add_modal(s, path);
    scenes_ask_frequencies(s, "loaded", loaded, 3);
    scene_add_quantity(s, "factor", "1", scene_add_continuation(s, 1, &far, control),
                       scene_factor_at());
}

static status build_supported(const double value[], scene *s, fault *f)
{
    static const double end = 1, sequence[2][3] = {{0, 1, 0}, {0, 0, 1}};
    static const int turns[4][3] = {
        {SCENE_RZ, -1}, {SCENE_RY, SCENE_RZ, -1}, {SCENE_RX, SCENE_RY, SCENE_RZ}, {SCENE_UX, -1}};
    double stiffness[36] = {0};
    (void)value;
    (void)f;
    const int profile = add_section(s), root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, 1.3, 0, 0);
    const int member = scene_add_member(s, root, tip, profile, y_axis);
    scene_hold_all(s, root);
    for (int k = 0; k < 3 && turns[what_released][k] >= 0; k++) {
        const int c = turns[what_released][k];
        if (how_supported)
            scene_release_end(s, member, 0, c);
        else if (c < SCENE_RX)
            s->node[root].translation[c] = SCENE_FREE;
        else
            s->node[root].angle[c - SCENE_RX] = SCENE_FREE;
    }
    if (!how_supported && what_released == 1) {
        scene_node *n = scene_node_at(s, root);
        n->rotation = SCENE_ROTATION_SEQUENCE;
        memcpy(n->axis, sequence, sizeof sequence);
        n->angle[0] = n->angle[1] = n->angle[2] = SCENE_FREE;
    }
    for (int i = 0; i < 6; i++)
        stiffness[7 * i] = 3 + i;
    scene_add_spring(s, SCENE_NONE, tip, stiffness);
    scene_set_body(s, tip,
                   (scene_body){.mass = 0.8,
                                .centre = {0.1, 0.05, -0.02},
                                .inertia = {0.02, 0.03, 0.025, 0.001, 0.002, -0.003}});
    scene_add_load(s, SCENE_FORCE, tip, 0.5, 2, -1);
    const int distributed = scene_add_load(s, SCENE_DISTRIBUTED, member, 0.4, -0.3, 0.2);
    scene_load_at(s, distributed)->at[1] = 0.1;
    const int path = scene_add_static(s, 1, &end, 4);
    ask_all(s, path, tip, member);
    if (!dense)
        ask_about(s, path, tip);
    return STATUS_OK;
}

/* A released end of a clamped node and a support that lets the end go. */
static void supported(const char *chosen)
{
    for (what_released = 0; what_released < 4; what_released++) {
        cell_result at_support, at_node;
        how_supported = 0;
        cells_solve(build_supported, chosen, 4, &at_support);
        how_supported = 1;
        cells_solve(build_supported, chosen, 4, &at_node);
        const int asked = dense ? 19 : 23;
        gsl_test(at_node.solve.quantities != asked || at_support.solve.quantities != asked,
                 "%s, %s: %d quantities", chosen, released_name[what_released],
                 at_node.solve.quantities);
        for (int i = 0; i < at_node.solve.quantities; i++) {
            const double expected = at_support.solve.quantity[i].value,
                         value = at_node.solve.quantity[i].value;
            gsl_test(!(fabs(value - expected) <= 1e-8 * fabs(expected) + 1e-11),
                     "%s, %s: %s is %.12g, at a support %.12g (%s)", chosen,
                     released_name[what_released], at_node.scene.quantity[i].name, value, expected,
                     at_node.solve.quantity[i].reason);
        }
        cell_result_free(&at_support);
        cell_result_free(&at_node);
    }
}

int main(void)
{
    static const char *const newton[] = {"", ":newton=displacement", ":newton=dense"};
    for (int i = 0; registry_formulations[i] != NULL; i++)
        for (int k = 0; k < 3; k++) {
            char chosen[80];
            snprintf(chosen, sizeof chosen, "%s%s", registry_formulations[i]->name, newton[k]);
            dense = k == 2;
            supported(chosen);
        }
    return gsl_test_summary();
}
