#include "harness/experiments/profiles.h"

#include <math.h>
#include <stddef.h>

section_spec profiles_matrices(double unit)
{
    static const double stiff[6] = {5e6, 2e6, 1.7e6, 90, 130, 480},
                        part[15] = {0.2,  -0.1, 0.3, 0.15, -0.2, 0.1,  -0.15, 0.2,
                                    -0.3, 0.25, 0.1, -0.1, 0.4,  -0.2, 0.1};
    const double m = 0.7 * unit, y = 0.011 / unit, z = -0.007 / unit, r = 1e-4 / (unit * unit);
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    double *C = spec.constants.stiffness, *M = spec.constants.mass;
    for (int i = 0, k = 0; i < 6; i++) {
        C[7 * i] = stiff[i] / (i < 3 ? 1 : unit * unit);
        for (int j = 0; j < i; j++, k++)
            C[6 * i + j] = C[6 * j + i] = part[k] * sqrt(C[7 * i] * C[7 * j]);
    }
    M[0] = M[7] = M[14] = m;
    M[4] = M[24] = m * z;
    M[9] = M[19] = -M[4];
    M[15] = M[20] = m * y;
    M[5] = M[30] = -M[15];
    M[21] = m * (y * y + z * z) + 3 * m * r;
    M[28] = m * z * z + 2 * m * r;
    M[35] = m * y * y + m * r;
    M[29] = M[34] = -m * y * z + 0.3 * m * r;
    return spec;
}

static section_spec rectangle(double unit)
{
    section_spec spec = section_spec_rectangle(210e9 * unit * unit, 80.7e9 * unit * unit,
                                               0.0371 / unit, 0.0123 / unit);
    spec.shear_factor[0] = spec.shear_factor[1] = 0.847;
    return spec;
}

static section_spec open_walls(double unit)
{
    static const double at[4][2] = {{0, 0}, {0.031, 0}, {0.031, 0.057}, {0.012, 0.057}},
                        thick[3] = {0.0013, 0.002, 0.0027};
    double point[4][2], thickness[3];
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            point[i][k] = at[i][k] / unit;
    for (int i = 0; i < 3; i++)
        thickness[i] = thick[i] / unit;
    return section_spec_walls(210e9 * unit * unit, 80.7e9 * unit * unit, 3,
                              (const double(*)[2])point, NULL, thickness);
}

status profiles_section(profiles_form form, double unit, section *out, fault *f)
{
    section_spec spec = form == PROFILES_MATRICES      ? profiles_matrices(unit)
                        : form == PROFILES_UNSYMMETRIC ? open_walls(unit)
                                                       : rectangle(unit);
    if (form != PROFILES_MATRICES)
        spec.density = 7850 * unit * unit * unit;
    TRY(section_compute(&spec, out, f));
    if (form == PROFILES_UNSYMMETRIC)
        out->Iw = out->A * pow(0.2 / unit, 4); /* as large as what it is compared with */
    return STATUS_OK;
}
