/* Deep simply supported beam, 10 m of 2 x 2 m: shear and rotary inertia in bending, and torsional
 * and extensional frequencies among them. NAFEMS test FV5. */
#include "cases/case.h"
#include "cases/shared/frequencies.h"

#include <stddef.h>

enum { TORSION, SHEAR, ROTARY_INERTIA };
enum { FREQUENCIES = 9 };

static const parameter_type parameters[] = {
    [TORSION] = {"torsion", "", 0, 0, 0, "polar|exact",
                 "polar: J = a^4/6, as the published values; exact: Saint-Venant's of the square"},
    [SHEAR] = {"shear", "1", 1, 0, 1, NULL, "1: flexible in shear, k = 5/6; 0: shear-rigid"},
    [ROTARY_INERTIA] = {"rotary_inertia", "1", 1, 0, 1, NULL,
                        "1: rotary inertia, 0: translations only"},
    {0},
};

static int square(const double value[], scene *s)
{
    const double side = 2;
    section_spec spec = section_spec_rectangle(200e9, 200e9 / 2.6, side, side);
    spec.density = 8000;
    spec.shear_factor[0] = spec.shear_factor[1] = 5.0 / 6;
    spec.given.Iw = 0; /* uniform torsion */
    if (value[TORSION] == 0)
        spec.given.It = side * side * side * side / 6;
    return scene_add_section(s, &spec);
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double y_axis[3] = {0, 1, 0}, length = 10;
    const int profile = square(value, s), a = scene_add_node(s, 0, 0, 0),
              b = scene_add_node(s, length, 0, 0);
    scene_add_member(s, a, b, profile, y_axis);
    scene_hold(s, a, SCENE_UX, SCENE_RX);
    scene_hold(s, b, SCENE_UY, SCENE_UZ);
    scene_omit(s, (value[SHEAR] == 0 ? FEATURE_SHEAR : 0) |
                      (value[ROTARY_INERTIA] == 0 ? FEATURE_ROTARY_INERTIA : 0));
    const int modal = scene_add_modal(s, SCENE_NONE);
    frequencies_add(s, "frequency", modal, SCENE_ANY, FREQUENCIES);
    /* without shear and rotary inertia the ninth has most waves */
    const int is_slender = value[SHEAR] == 0 && value[ROTARY_INERTIA] == 0;
    scene_meshes_doubled(s, 2, is_slender ? 128 : 64);
    return STATUS_OK;
}

const case_type case_deep_beam = {
    .name = "deep_beam",
    .summary = "deep simply supported beam: frequencies in bending, torsion and extension",
    .source = "NAFEMS, Selected Benchmarks for Natural Frequency Analysis (1987), test FV5; closed "
              "form of the Timoshenko beam",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
