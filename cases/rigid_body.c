/* A rigid body with moments of inertia 1, 2, 3 kg m^2 tumbles free of forces and carries a rod
 * without mass, which is in nobody's way. Exact angular velocities are elliptic
 * functions (E.T. Whittaker, Analytical Dynamics, 1904, chapter 6); it may also turn steadily. */
#include <stddef.h>

#include "cases/shared/timed.h"

enum { SPIN = TIMED_PARAMETERS };
enum { TUMBLING, STEADY };

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 2, 0, 1e9, NULL, "when it is looked at"},
    TIMED_HOW(0.05, "a fortieth of a turn", 1e-9),
    [SPIN] = {"spin", "", TUMBLING, 0, 0, "tumbling|steady",
              "(0.5, 0.2, 2) rad/s, or 2 rad/s about z, the axis of its largest moment of inertia"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0};
    static const char axis[] = "xyz";
    (void)f;
    section_spec spec = section_spec_constants(1, 1); /* N, N m^2 */
    spec.constants.A = spec.constants.Iy = spec.constants.Iz = spec.constants.It = 1e4;
    spec.constants.Ip = 2e4;
    const int profile = scene_add_section(s, &spec), body = scene_add_node(s, 0, 0, 0);
    scene_omit(s, FEATURE_TRAPEZE);
    scene_set_body(s, body, (scene_body){.mass = 1, .inertia = {1, 2, 3}});
    scene_add_member(s, body, scene_add_attached(s, body, 0.5, 0, 0), profile, y_axis);
    const scene_start start = {
        .spin = {value[SPIN] == TUMBLING ? 0.5 : 0, value[SPIN] == TUMBLING ? 0.2 : 0, 2}};
    const int motion = timed_add_started(s, value, SCENE_NONE, start);
    for (int i = 0; i < 3; i++) {
        const char name[] = {'w', '_', axis[i], 0};
        scene_add_quantity(s, name, "rad/s", motion, scene_rate(body, SCENE_RX + i));
    }
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const char name[] = {'R', '_', axis[i], axis[k], 0};
            scene_add_quantity(s, name, "1", motion, scene_orientation_entry(body, i, k));
        }
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    scene_meshes_doubled(s, 1, 4);
    return STATUS_OK;
}

const case_type case_rigid_body = {
    .name = "rigid_body",
    .summary = "a rigid body with three moments of inertia tumbles free of forces",
    .source = "elliptic functions (reference/derive/rigid_body.py)",
    .parameters = {parameters, case_omit},
    .build = build,
};
