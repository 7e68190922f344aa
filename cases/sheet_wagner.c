/* The sheet of sheet_cantilever, deflected and rotated about z, then twisted at its tip: du_x/dM_y
 * shows the Wagner torque. N section 4.1, Fig. 6.  Tip rotation R = Ry(phi_y) Rz(phi_z) Rx(phi_x)
 * with phi_y free (zero moment about y). */
#include "cases/shared/sheet.h"

#include <math.h>
#include <stddef.h>

enum { TIP_PHI_Z = SHEET_PARAMETERS, TIP_PHI_X };
enum { STATIONS_BENT = 5, STATIONS_TWISTED = 5 };

/* In the order of the enumeration. */
static const parameter_type parameters[] = {
    {"tip_phi_z", "rad", 0.15, -1.5, 1.5, NULL, "prescribed tip rotation about z"},
    {"tip_phi_x", "rad", 0.15, -1.5, 1.5, NULL, "prescribed tip twist, after the bending"},
    {0},
};

static void prescribe_tip(scene *s, int tip, const double value[])
{
    /* First the deflection and phi_z together (path 0 to 1), then phi_x (1 to 2). */
    const double path[3] = {0, 1, 2};
    const double deflection[3] = {0, value[SHEET_DEFLECTION], value[SHEET_DEFLECTION]};
    const double bend[3] = {0, value[TIP_PHI_Z], value[TIP_PHI_Z]};
    const double twist[3] = {0, 0, value[TIP_PHI_X]};
    scene_drive(s, tip, SCENE_UY, scene_add_driver(s, "tip_deflection", 3, path, deflection));
    const int about[3] = {SCENE_FREE, scene_add_driver(s, "tip_phi_z", 3, path, bend),
                          scene_add_driver(s, "tip_phi_x", 3, path, twist)};
    static const double axis[3][3] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    scene_node *n = scene_node_at(s, tip);
    n->rotation = SCENE_ROTATION_SEQUENCE;
    for (int k = 0; k < 3; k++) {
        n->angle[k] = about[k];
        for (int i = 0; i < 3; i++)
            n->axis[k][i] = axis[k][i];
    }
}

static status build(const double value[], scene *s, fault *f)
{
    int root, tip;
    TRY(sheet_build(value, s, &root, &tip, f));
    prescribe_tip(s, tip, value);
    /* twisted as far as bent or farther, what shear adds settles late */
    const int meshes[] = {1, 2, 3, 4, 8, 16, 32, 64, 128},
              is_far = fabs(value[TIP_PHI_X]) >= fabs(value[TIP_PHI_Z]);
    scene_meshes(s, is_far ? 9 : 8, meshes);
    double stations[STATIONS_BENT + STATIONS_TWISTED];
    for (int i = 0; i < STATIONS_BENT + STATIONS_TWISTED; i++)
        stations[i] = i < STATIONS_BENT ? (i + 1.0) / STATIONS_BENT
                                        : 1 + (i + 1.0 - STATIONS_BENT) / STATIONS_TWISTED;
    const int path_analysis = scene_add_static(s, STATIONS_BENT + STATIONS_TWISTED, stations, 1);
    const int compliance =
        scene_add_compliance(s, path_analysis,
                             (scene_compliance){.node = tip,
                                                .moments = (scene_moments)value[SHEET_MOMENTS],
                                                .released = 1u << SCENE_UY | 1u << SCENE_RX |
                                                            1u << SCENE_RY | 1u << SCENE_RZ});

    int entries[36][2];
    for (int i = 0; i < 36; i++) {
        /* du_x/dM_y, the fifth, first: it is the figure's. */
        int k = i;
        if (i <= 4)
            k = i == 0 ? 4 : i - 1;
        entries[i][0] = k / 6;
        entries[i][1] = k % 6;
    }
    sheet_add_compliance(s, compliance, (const int(*)[2])entries, 36);
    const struct {
        const char *name, *unit;
        scene_extract what;
    } motions[] = {
        {"u_x", "m", scene_coordinate(tip, SCENE_UX)},
        {"u_z", "m", scene_coordinate(tip, SCENE_UZ)},
        {"F_y", "N", scene_reaction(tip, SCENE_UY)},
        {"M_x", "N m", scene_reaction(tip, SCENE_RX)},
        {"M_z", "N m", scene_reaction(tip, SCENE_RZ)},
    };
    for (size_t i = 0; i < sizeof motions / sizeof motions[0]; i++)
        scene_add_quantity(s, motions[i].name, motions[i].unit, path_analysis, motions[i].what)
            ->least_order = 1.8;
    return STATUS_OK;
}

const case_type case_sheet_wagner = {
    .name = "sheet_wagner",
    .summary = "sheet flexure bent, then twisted: effect of the Wagner torque",
    .source = "N section 4.1, Fig. 6",
    .parameters = {sheet_parameters, sheet_wagner, sheet_moments, parameters, case_omit},
    .build = build,
};
