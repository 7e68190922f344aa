/* Clamped sheet flexure with a prescribed tip deflection and no tip rotation about z. The
 * quantities are the compliance of the deformed sheet (N section 4.1, Fig. 5). */
#include "cases/shared/shared.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { MODES = SHEET_PARAMETERS, DENSITY, ROTARY, STATIONS };
enum { MOST_STATIONS = 100, MOST_MODES = 6 };

static const parameter_type parameters[] = {
    {"modes", "1", 0, 0, MOST_MODES, NULL,
     "number of natural frequencies of the deflected sheet, with "
     "its tip fixed along y and about z"},
    {"density", "kg/m^3", 7850, 1e-3, 1e6, NULL, "of the sheet"},
    {"rotary_inertia", "1", 1, 0, 1, NULL,
     "1: rotary and warping inertia, 0: translations and twist only"},
    {"stations", "1", 15, 1, MOST_STATIONS, NULL,
     "number of equidistant states from zero to the full deflection"},
    {0},
};

/* Deformation in the plane of bending is uncoupled from deformation out of the plane, so the other
 * 18 entries are zero by symmetry. */
static const int entries[][2] = {
    {0, 0}, {0, 1}, {0, 5}, {1, 0}, {1, 1}, {1, 5}, {5, 0}, {5, 1}, {5, 5},
    {2, 2}, {2, 3}, {2, 4}, {3, 2}, {3, 3}, {3, 4}, {4, 2}, {4, 3}, {4, 4},
};

static void add_curve(scene *s, const char *name, int analysis, int component, double deflection)
{
    scene_quantity *q =
        scene_add_quantity(s, name, "m/N", analysis, scene_compliance_entry(component, component));
    scene_set_curve(q, "tip_deflection", "m", deflection, 0);
}

/* Adds the closed-form solution of N as a prediction, if it applies. */
static void add_predictions(const double value[], scene *s)
{
    section c;
    if (scene_constants(s, 0, &c, NULL) != STATUS_OK)
        return;
    const sheet_prediction p = sheet_prediction_of(
        &c, value[SHEET_LENGTH], value[SHEET_DEFLECTION], value[SHEET_TIP_WARPING] != 0,
        value[SHEET_SHEAR] != 0, (scene_moments)value[SHEET_MOMENTS]);
    const struct {
        const char *name;
        double value;
    } known[] = {{"C_xx", p.C_xx}, {"C_ux_Fx", p.C_xx}, {"C_zz", p.C_zz}, {"C_uz_Fz", p.C_zz},
                 {"u_x", p.u_x},   {"F_y", p.F_y},      {"M_z", p.M_z}};
    for (int i = 0; i < s->quantities; i++)
        for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
            if (strcmp(s->quantity[i].name, known[k].name) == 0 && isfinite(known[k].value))
                s->quantity[i].prediction =
                    (scene_prediction){known[k].value, sheet_prediction_source};
}

static void add_frequencies(scene *s, int modal, int count)
{
    for (int i = 0; i < count; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "frequency_%d", i + 1);
        scene_add_quantity(s, name, "Hz", modal, scene_frequency(i, SCENE_ANY))->least_order = 1.8;
    }
}

static status build(const double value[], scene *s, fault *f)
{
    int root, tip;
    TRY(sheet_build(value, s, &root, &tip, f));
    if (s->section != NULL)
        s->section[0].density = value[DENSITY];
    const double path[2] = {0, 1}, deflection[2] = {0, value[SHEET_DEFLECTION]}, none[2] = {0, 0};
    scene_drive(s, tip, SCENE_UY, scene_add_driver(s, "tip_deflection", 2, path, deflection));
    scene_drive(s, tip, SCENE_RZ, scene_add_driver(s, "tip_rotation", 2, path, none));

    double station[MOST_STATIONS];
    const int stations = (int)value[STATIONS];
    for (int i = 0; i < stations; i++)
        station[i] = (i + 1.0) / stations;
    const int path_analysis = scene_add_static(s, stations, station, 1);
    const int compliance =
        scene_add_compliance(s, path_analysis,
                             (scene_compliance){.node = tip,
                                                .moments = (scene_moments)value[SHEET_MOMENTS],
                                                .released = 1u << SCENE_UY | 1u << SCENE_RZ});

    scene_add_quantity(s, "C_xx", "m/N", compliance, scene_compliance_entry(SCENE_UX, SCENE_UX))
        ->least_order = 1.8;
    scene_add_quantity(s, "C_zz", "m/N", compliance, scene_compliance_entry(SCENE_UZ, SCENE_UZ))
        ->least_order = 1.8;
    sheet_add_compliance(s, compliance, entries, sizeof entries / sizeof entries[0]);
    scene_add_quantity(s, "u_x", "m", path_analysis, scene_coordinate(tip, SCENE_UX))->least_order =
        1.8;
    scene_add_quantity(s, "F_y", "N", path_analysis, scene_reaction(tip, SCENE_UY))->least_order =
        1.8;
    scene_add_quantity(s, "M_z", "N m", path_analysis, scene_reaction(tip, SCENE_RZ))->least_order =
        1.8;
    add_curve(s, "C_xx_curve", compliance, SCENE_UX, value[SHEET_DEFLECTION]);
    add_curve(s, "C_zz_curve", compliance, SCENE_UZ, value[SHEET_DEFLECTION]);
    if (s->sections > 0)
        add_predictions(value, s);
    if (value[MODES] > 0) {
        /* frequencies about the last state of the path; the rotation about z, as a component of the
         * rotation vector from this state, is fixed */
        add_frequencies(s, scene_add_modal(s, path_analysis), (int)value[MODES]);
        if (value[ROTARY] == 0)
            scene_omit(s, FEATURE_ROTARY_INERTIA);
    }
    return STATUS_OK;
}

const case_type case_sheet_cantilever = {
    .name = "sheet_cantilever",
    .summary = "clamped sheet flexure, tip deflected without rotation: compliance matrix",
    .source = "N section 4.1, Fig. 5",
    .parameters = {sheet_parameters, parameters, case_mass_omit},
    .build = build,
};
