/* Clamped sheet flexure with a prescribed tip deflection and no tip rotation about z: compliance of the deformed sheet.
 * N section 4.1, Fig. 5. */
#include "cases/shared/sheet.h"
#include "cases/shared/sheet_prediction.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { MODES = SHEET_PARAMETERS, DENSITY, ROTARY, STATIONS };
enum { MOST_STATIONS = 100, MOST_MODES = 6 };

static const parameter_type parameters[] = {
    SHEET_TABLE(0),
    [MODES] = {"modes", "1", 0, 0, MOST_MODES, NULL,
               "natural frequencies of the deflected sheet, its tip held along y and about z"},
    [DENSITY] = {"density", "kg/m^3", 7850, 1e-3, 1e6, NULL, "of the sheet"},
    [ROTARY] = {"rotary_inertia", "1", 1, 0, 1, NULL,
                "1: rotary and warping inertia, 0: translations and twist only"},
    [STATIONS] = {"stations", "1", 15, 1, MOST_STATIONS, NULL,
                  "states from rest to the deflection, at equal distances"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

/* In the plane of bending nothing couples to the motion out of it: the other 18 entries are zero by symmetry. */
static const int entries[][2] = {
    {0, 0}, {0, 1}, {0, 5}, {1, 0}, {1, 1}, {1, 5}, {5, 0}, {5, 1}, {5, 5},
    {2, 2}, {2, 3}, {2, 4}, {3, 2}, {3, 3}, {3, 4}, {4, 2}, {4, 3}, {4, 4},
};

static void add_gated(scene *s, const char *name, const char *unit, scene_quantity_kind kind,
                      int analysis, int node, int row)
{
    scene_quantity *q = scene_add_quantity(s, name, unit, kind, analysis);
    q->node = node;
    q->row = row;
    q->column = row;
    q->least_order = 1.8;
}

static void add_curve(scene *s, const char *name, int analysis, int node, int row,
                      double deflection)
{
    scene_quantity *q = scene_add_quantity(s, name, "m/N", SCENE_COMPLIANCE_ENTRY, analysis);
    q->node = node;
    q->row = q->column = row;
    q->reduction = SCENE_CURVE;
    q->x_factor = deflection;
    snprintf(q->x_name, sizeof q->x_name, "tip_deflection");
    snprintf(q->x_unit, sizeof q->x_unit, "m");
}

/* About the last state of the path.  The rotation about z is held in the sense of the rotation vector from there. */
static void add_frequencies(scene *s, int path, int count)
{
    const int modal = scene_add_modal(s, path);
    for (int i = 0; i < count; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "frequency_%d", i + 1);
        scene_quantity *q = scene_add_quantity(s, name, "Hz", SCENE_FREQUENCY, modal);
        q->order = i;
        q->least_order = 1.8;
    }
}

/* N's closed-form solution beside the elements, where it speaks of them. */
static void add_predictions(const double value[], scene *s)
{
    section c;
    if (section_compute(&s->section[0], &c, NULL) != STATUS_OK)
        return; /* model_alloc says why */
    const sheet_prediction p = sheet_predict(&c, value[SHEET_LENGTH], value[SHEET_DEFLECTION],
                                             value[SHEET_TIP_WARPING] != 0, value[SHEET_SHEAR] != 0,
                                             (scene_moments)value[SHEET_MOMENTS]);
    const struct {
        const char *name;
        double value;
    } known[] = {{"C_xx", p.C_xx}, {"C_ux_Fx", p.C_xx}, {"C_zz", p.C_zz}, {"C_uz_Fz", p.C_zz},
                 {"u_x", p.u_x},   {"F_y", p.F_y},      {"M_z", p.M_z}};
    for (int i = 0; i < s->quantities; i++)
        for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
            if (strcmp(s->quantity[i].name, known[k].name) == 0 && isfinite(known[k].value)) {
                s->quantity[i].prediction = known[k].value;
                s->quantity[i].predicted_by = sheet_prediction_source;
            }
}

static status build(const double value[], scene *s, fault *f)
{
    int root, tip;
    const status outcome = sheet_build(value, s, &root, &tip, f);
    if (outcome != STATUS_OK)
        return outcome;
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

    add_gated(s, "C_xx", "m/N", SCENE_COMPLIANCE_ENTRY, compliance, tip, SCENE_UX);
    add_gated(s, "C_zz", "m/N", SCENE_COMPLIANCE_ENTRY, compliance, tip, SCENE_UZ);
    sheet_add_compliance(s, compliance, tip, entries, sizeof entries / sizeof entries[0]);
    add_gated(s, "u_x", "m", SCENE_COORDINATE, path_analysis, tip, SCENE_UX);
    add_gated(s, "F_y", "N", SCENE_REACTION, path_analysis, tip, SCENE_UY);
    add_gated(s, "M_z", "N m", SCENE_REACTION, path_analysis, tip, SCENE_RZ);
    add_curve(s, "C_xx_curve", compliance, tip, SCENE_UX, value[SHEET_DEFLECTION]);
    add_curve(s, "C_zz_curve", compliance, tip, SCENE_UZ, value[SHEET_DEFLECTION]);
    if (s->sections > 0)
        add_predictions(value, s);
    if (value[MODES] > 0) {
        add_frequencies(s, path_analysis, (int)value[MODES]);
        if (value[ROTARY] != 0)
            scene_need(s, FEATURE_ROTARY_INERTIA);
    }
    return STATUS_OK;
}

const case_type case_sheet_cantilever = {
    .name = "sheet_cantilever",
    .summary = "clamped sheet flexure, tip deflected without rotation: compliance matrix",
    .source = "N section 4.1, Fig. 5",
    .parameters = parameters,
    .build = build,
};
