/* A cantilever of a section by its matrices, with bend-twist, extension-twist and other couplings,
 * as of a composite blade. L = 1 m.  Under forces and a torque at its tip; under its weight, which
 * acts at centres of mass beside the line; rolled up to a helix by a moment about an axis about
 * which it turns; its frequencies; the pressure under which it buckles. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "cases/case.h"

enum { ASKED, COUPLING, TURN };
enum { DISPLACEMENTS, WEIGHT, HELIX, FREQUENCIES, BUCKLING };

static const parameter_type parameters[] = {
    [ASKED] = {"asked", "", 0, 0, 0, "displacements|weight|helix|frequencies|buckling",
               "how it is loaded"},
    [COUPLING] = {"coupling", "1", 0.5, 0, 0.5, NULL,
                  "size of the terms off the diagonal; 0: any formulation carries it"},
    [TURN] = {"turn", "rad", 3, -6, 6, NULL, "of the tip of the helix"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

/* [N] and [N m^2], of N, Qy, Qz, Mx, My, Mz */
static const double stiff[6] = {1e7, 4e6, 3e6, 800, 1000, 4000};
/* Of a slice: mass [kg/m], centre of mass [m] times the coupling, moments of inertia about it [kg
 * m] */
static const double mass = 2, centre_y = 0.02, centre_z = -0.01, about_y = 0.8e-3, about_z = 1.8e-3;

static void couple(int row, int column, double part, double C[36])
{
    C[6 * row + column] = C[6 * column + row] = part * sqrt(stiff[row] * stiff[column]);
}

/* Helix: extension and twist, bending and twist only. */
static section_spec profile(double coupling, int helix)
{
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    double *C = spec.constants.stiffness, *M = spec.constants.mass;
    for (int i = 0; i < 6; i++)
        C[7 * i] = stiff[i];
    couple(0, 3, coupling / 2, C);
    couple(3, 4, coupling, C);
    if (!helix) {
        couple(0, 1, 0.3 * coupling, C);
        couple(1, 5, -0.2 * coupling, C);
        couple(2, 4, 0.2 * coupling, C);
        couple(3, 5, 0.4 * coupling, C);
    }
    const double y = coupling * centre_y, z = coupling * centre_z;
    M[0] = M[7] = M[14] = mass;
    M[4] = M[24] = mass * z;
    M[9] = M[19] = -M[4];
    M[15] = M[20] = mass * y;
    M[5] = M[30] = -M[15];
    M[21] = about_y + about_z + mass * (y * y + z * z);
    M[28] = about_y + mass * z * z;
    M[35] = about_z + mass * y * y;
    M[29] = M[34] = -mass * y * z;
    return spec;
}

static void add_quantities(scene *s, int analysis, int tip, int couples)
{
    static const struct {
        const char *name, *unit;
        int row;
    } wanted[] = {{"ux", "m", SCENE_UX},   {"uy", "m", SCENE_UY},   {"uz", "m", SCENE_UZ},
                  {"rx", "rad", SCENE_RX}, {"ry", "rad", SCENE_RY}, {"rz", "rad", SCENE_RZ}};
    const int helix = s->analysis[analysis].kind == SCENE_STATIC;
    for (size_t i = 0; i < (helix ? 3 : sizeof wanted / sizeof wanted[0]); i++)
        if (couples || (wanted[i].row != SCENE_UY && wanted[i].row != SCENE_RZ))
            scene_add_quantity(s, wanted[i].name, wanted[i].unit, analysis,
                               scene_coordinate(tip, wanted[i].row))
                ->least_order = 1.8;
}

/* Twist and bending about y have the stiffness [k, b; b, EIy] where nothing pulls; the moment is
 * along its softer axis. */
static void add_helix(scene *s, int tip, const section_spec *spec, double turn)
{
    const double *C = spec->constants.stiffness, end = 1;
    const double k = C[21] - C[3] * C[3] / C[0], b = C[22], EIy = C[28];
    const double soft = (k + EIy) / 2 - hypot((k - EIy) / 2, b), size = hypot(b, soft - k);
    scene_add_load(s, SCENE_MOMENT, tip, soft * turn * b / size, soft * turn * (soft - k) / size,
                   0);
    add_quantities(s, scene_add_static(s, 1, &end, 1), tip, 1);
}

static void add_frequencies(scene *s)
{
    static const char *const name[] = {"frequency_1", "frequency_2", "frequency_3", "frequency_4"};
    const int modal = scene_add_modal(s, SCENE_NONE);
    for (int i = 0; i < 4; i++)
        scene_add_quantity(s, name[i], "Hz", modal, scene_frequency(i, SCENE_ANY))->least_order =
            1.8;
}

static status build(const double value[], scene *s, fault *f)
{
    const int asked = (int)value[ASKED];
    const double y_axis[3] = {0, 1, 0}, coupling = value[COUPLING];
    if (asked == HELIX && coupling == 0)
        return fault_set(f, STATUS_REFUSED,
                         "without coupling there is no helix; give a coupling above 0");
    const section_spec spec = profile(coupling, asked == HELIX);
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, 1, 0, 0),
              member = scene_add_member(s, root, tip, scene_add_section(s, &spec), y_axis);
    scene_hold_all(s, root);
    if (asked == DISPLACEMENTS) {
        scene_add_load(s, SCENE_FORCE, tip, 1000, 0, 50);
        scene_add_load(s, SCENE_MOMENT, tip, 10, 0, 0);
    } else if (asked == WEIGHT) {
        scene_add_load(s, SCENE_GRAVITY, member, 0, 0, -9.81);
    } else if (asked == BUCKLING) {
        scene_add_load(s, SCENE_FORCE, tip, -1, 0, 0);
    }
    if (asked == HELIX)
        add_helix(s, tip, &spec, value[TURN]);
    else if (asked == FREQUENCIES)
        add_frequencies(s);
    else if (asked == BUCKLING)
        scene_add_quantity(s, "buckling_load", "N", scene_add_buckling(s, SCENE_NONE),
                           scene_critical_factor(1, 0))
            ->least_order = 1.8;
    else
        add_quantities(s, scene_add_linear(s), tip, coupling != 0);
    scene_omit(s, FEATURE_ROTARY_INERTIA);
    const int meshes[] = {2, 4, 8, 16, 32, 64};
    scene_meshes(s, 6, meshes);
    return STATUS_OK;
}

const case_type case_coupled_beam = {
    .name = "coupled_beam",
    .summary = "cantilever of a section by its 6 x 6 matrices: displacements, helix, frequencies, "
               "buckling",
    .source = "linear Cosserat rod in closed form and by its transfer matrix "
              "(reference/derive/coupled_beam.py)",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
