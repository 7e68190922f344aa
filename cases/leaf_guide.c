/* A block on two upright leaf springs is pulled aside, let go, and swings in the plane.  The sheets
 * are beams with EI = E w t^3/12; the block's centre P is above their ends. */
#include <stddef.h>

#include "cases/shared/sheet.h"
#include "cases/shared/timed.h"

enum { AMPLITUDE = TIMED_PARAMETERS };

static const parameter_type parameters[] = {
    [TIMED_TIME] = {"time", "s", 0.05, 0, 10, NULL, "when it is looked at"},
    TIMED_HOW(2e-4, "a twentieth of the block's quickest motion", 1e-3),
    [AMPLITUDE] = {"amplitude", "m", 0.01, 1e-5, 0.05, NULL,
                   "displacement of the block's centre at the begin"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static int add_block(scene *s)
{
    const double mass = 1, width = 0.1, height = 0.04, centre = 0.12;
    const int P = scene_add_node(s, width / 2, centre, 0);
    scene_set_body(s, P,
                   (scene_body){.mass = mass,
                                .inertia = {mass * height * height / 12, mass * width * width / 12,
                                            mass * (width * width + height * height) / 12}});
    scene_hold(s, P, SCENE_UZ, SCENE_RY);
    return P;
}

static void add_sheets(scene *s, int P)
{
    static const double across[] = {1, 0, 0};
    section_spec spec;
    sheet_section(0.1, 0.5e-3, 200e9, 0.3, 0, &spec);
    spec.density = 7800;
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    const int profile = scene_add_section(s, &spec);
    for (int i = 0; i < 2; i++) {
        const double x = 0.1 * i;
        const int foot = scene_add_node(s, x, 0, 0);
        scene_hold_all(s, foot);
        scene_member *m = scene_member_at(
            s, scene_add_member(s, foot, scene_add_attached(s, P, x, 0.1, 0), profile, across));
        m->warp_p = m->warp_q = SCENE_WARP_FIXED;
    }
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double amplitude = value[AMPLITUDE];
    const int P = add_block(s);
    add_sheets(s, P);
    scene_load_piece(s, scene_add_load(s, SCENE_FORCE, P, 1, 0, 0), 0, "0");
    scene_add_quantity(s, "small_frequency", "Hz", scene_add_modal(s, SCENE_NONE),
                       scene_frequency(0, SCENE_ANY));
    const int held = scene_add_continuation(
        s, 1, &amplitude,
        (scene_control){
            .node = P, .component = SCENE_UX, .step = amplitude / 4, .step_max = amplitude});
    scene_add_quantity(s, "static_force", "N", held, scene_factor_at());
    scene_add_quantity(s, "static_y", "m", held, scene_coordinate(P, SCENE_UY))->near_zero = 1e-4;
    scene_add_quantity(s, "static_rotation", "rad", held, scene_coordinate(P, SCENE_RZ))
        ->near_zero = 1e-4;
    const int motion = timed_add(s, value, held);
    scene_add_quantity(s, "displacement", "m", motion, scene_coordinate(P, SCENE_UX))->near_zero =
        amplitude;
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    scene_meshes_doubled(s, 2, 32);
    return STATUS_OK;
}

const case_type case_leaf_guide = {
    .name = "leaf_guide",
    .summary = "a block on two leaf springs is pulled aside and let go",
    .source = "equations of Simo and Reissner, solved twice",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
