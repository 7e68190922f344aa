#include "cases/shared/timed.h"

section_spec timed_profile(const timed_section *of)
{
    const double stiffness[6] = {of->EA, of->GA, of->GA, of->GJ, of->EI, of->EI},
                 mass[6] = {of->mass, of->mass, of->mass, of->polar, of->rotary, of->rotary};
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    for (int i = 0; i < 6; i++) {
        spec.constants.stiffness[7 * i] = stiffness[i];
        spec.constants.mass[7 * i] = mass[i];
    }
    return spec;
}

int timed_add(scene *s, const double value[], int follows)
{
    const scene_motion how = {.scheme = (scene_scheme)value[TIMED_INTEGRATOR],
                              .alpha = scene_alpha_of_radius(0.9),
                              .step = value[TIMED_STEP],
                              .tolerance = value[TIMED_TOLERANCE]};
    scene_need(s, FEATURE_SHEAR | FEATURE_HARINGX | FEATURE_ROTARY_INERTIA);
    scene_meshes_doubled(s, 2, 16);
    return scene_add_motion(s, follows, 1, &value[TIMED_TIME], how);
}

void timed_wanted(scene *s, const char *name, int motion, int node, int component)
{
    scene_add_quantity(s, name, component < SCENE_RX ? "m" : "rad", motion,
                       scene_coordinate(node, component));
}
