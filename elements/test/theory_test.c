/* The energies that elements/NAME.md writes for readers are those of the elements. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "elements/math/quadrature.h"
#include "elements/test/random.h"
#include "elements/test/sections.h"

extern const element_type element_beamw, element_beamw_first, element_beamw_vlasov,
    element_sheet_second, element_sheet_second_consistent;

enum { E = 8, STATES = 5, GAUSS = 5 };

/* Energy of the element for the strains e[8]. */
static double energy_of(const element_type *type, const section *c, double l, unsigned features,
                        const double e[E])
{
    double options[ELEMENT_MAX_OPTIONS] = {0}, energy = NAN;
    fault f = {""};
    parameter_defaults(type->options, options);
    const element_request request = {
        .section = c, .length = l, .features = features, .options = options};
    element_data *data = calloc(1, type->data_size(&request));
    gsl_test(data == NULL || type->prepare(&request, data, &f) != STATUS_OK, "%s (%s)", type->name,
             f.text);
    gsl_test(type->stress(data, e, NULL, &(stress_output){.energy = &energy}) != STATUS_OK, "%s",
             type->name);
    free(data);
    return energy;
}

/* J Eq. 66, e[1] to e[8] as in the text; ebar[7], ebar[8] are not modified. */
static void modified(const section *c, double l, const double e[E + 1], double ebar[E + 1])
{
    const double A = (e[7] - e[8]) / 2, t = e[2] - (e[7] + e[8]) / 2, l3 = l * l * l;
    memcpy(ebar, e, (E + 1) * sizeof *e);
    ebar[1] += (2 * e[3] * e[3] + e[3] * e[4] + 2 * e[4] * e[4] + 2 * e[5] * e[5] + e[5] * e[6] +
                2 * e[6] * e[6]) /
                   (30 * l) +
               c->Ip / c->A / (2 * l3) * (e[2] * e[2] + A * A / 3 + t * t / 5) -
               (c->ys * c->ys + c->zs * c->zs) / (10 * l3) * e[2] * e[2];
    ebar[2] += (e[4] * e[5] - e[3] * e[6]) / l;
    ebar[3] +=
        (e[2] * (e[5] / 10 + e[6] / 5) + e[5] * (e[7] / 10 - e[8] / 30) - e[6] * e[8] / 30) / l;
    ebar[4] += (-e[2] * (e[5] / 5 + e[6] / 10) + (e[5] + e[6]) * e[7] / 30 - e[6] * e[8] / 10) / l;
    ebar[5] +=
        (-e[2] * (e[3] / 10 + e[4] / 5) - e[3] * (e[7] / 10 - e[8] / 30) + e[4] * e[8] / 30) / l;
    ebar[6] += (e[2] * (e[3] / 5 + e[4] / 10) - (e[3] + e[4]) * e[7] / 30 + e[4] * e[8] / 10) / l;
}

/* The sum of squares of elements/beamw.md; Phi[3]: y, z, w. */
static double squares(const section *c, double l, const double Phi[3], const double b[E + 1])
{
    const double l2 = l * l, l3 = l2 * l, A = (b[7] - b[8]) / 2, G = c->shear_modulus;
    const double inertia[3] = {c->Iz, c->Iy, c->Iw};
    const double h[3] = {(b[5] - b[6]) / (2 * l) - c->zs / l2 * b[2],
                         (b[4] - b[3]) / (2 * l) + c->ys / l2 * b[2],
                         (b[2] - (b[7] + b[8]) / 2) / l2};
    double sum = c->young * c->A / l * b[1] * b[1] + G * c->It / l3 * (b[2] * b[2] + A * A / 3) +
                 c->young / l3 * (c->Iy * pow(b[3] + b[4], 2) + c->Iz * pow(b[5] + b[6], 2)) +
                 4 * c->young * c->Iw / (l2 * l3) * A * A +
                 G * c->It * l / (5 * pow(1 + Phi[2], 2)) * h[2] * h[2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum +=
                (i == j ? 12 * c->young * inertia[i] / (l * (1 + Phi[i]))
                        : G * l * c->D[3 * i + j] * Phi[i] * Phi[j] / (1 + Phi[i]) / (1 + Phi[j])) *
                h[i] * h[j];
    return sum / 2;
}

static void beamw(void)
{
    static const double point[4][2] = {{0, 0}, {-0.03, 0.01}, {-0.03, 0.07}, {0.01, 0.08}},
                        thickness[3] = {0.004, 0.003, 0.005};
    const section_spec spec = section_spec_walls(207e9, 79e9, 3, point, NULL, thickness);
    const section c = sections_computed(&spec);
    const unsigned rigid = FEATURE_WARPING | FEATURE_ECCENTRIC | FEATURE_TRAPEZE;
    const double l = 0.31, none[3] = {0}, inertia[3] = {c.Iz, c.Iy, c.Iw};
    double Phi[3], e[E + 1] = {0}, ebar[E + 1];
    uint64_t seed = 1;
    for (int i = 0; i < 3; i++)
        Phi[i] = 12 * c.young * inertia[i] / (c.shear_modulus * c.D[4 * i] * l * l);
    for (int state = 0; state < STATES; state++) {
        for (int i = 1; i <= E; i++)
            e[i] = 0.2 * l * random_number(&seed);
        modified(&c, l, e, ebar);
        gsl_test_rel(energy_of(&element_beamw, &c, l, rigid | FEATURE_SHEAR, e + 1),
                     squares(&c, l, Phi, ebar), 1e-13, "beamw");
        gsl_test_rel(energy_of(&element_beamw_first, &c, l, rigid | FEATURE_SHEAR, e + 1),
                     squares(&c, l, Phi, e), 1e-13, "beamw_first");
        gsl_test_rel(energy_of(&element_beamw_vlasov, &c, l, rigid, e + 1),
                     squares(&c, l, none, ebar), 1e-13, "beamw_vlasov");
    }
}

/* elements/sheet_second.md, with P_x and the Wagner torque. */
static double sheet_energy(const section *c, double l, const double e[E + 1])
{
    const double l3 = l * l * l, G = c->shear_modulus, sum = e[7] + e[8],
                 square = e[7] * e[7] + e[8] * e[8], product = e[7] * e[8];
    const double Phi_y = 12 * c->young * c->Iz * c->F[0] / (G * l * l),
                 Phi_z = 12 * c->young * c->Iy * c->F[4] / (G * l * l);
    double x[GAUSS], w[GAUSS],
        P = c->young * c->A / (2 * l) * e[1] * e[1] +
            c->young * c->Iy / (2 * l3) *
                (pow(e[3] + e[4], 2) + 3 / (1 + Phi_z) * pow(e[3] - e[4], 2)) +
            c->young * c->Iz / (2 * l3) *
                (pow(e[5] + e[6], 2) + 3 / (1 + Phi_y) * pow(e[5] - e[6], 2)) +
            G * c->It / (30 * l3) * (18 * e[2] * e[2] - 3 * e[2] * sum + 2 * square - product) +
            c->young * c->Iw / (l3 * l * l) *
                (6 * e[2] * e[2] - 6 * e[2] * sum + 2 * square + 2 * product);
    quadrature_points(GAUSS, x, w);
    for (int i = 0; i < GAUSS; i++) {
        const double k = (6 * x[i] * (1 - x[i]) * e[2] + (1 - x[i]) * (1 - 3 * x[i]) * e[7] +
                          x[i] * (3 * x[i] - 2) * e[8]) /
                         (l * l);
        P += w[i] * l * c->young * c->wagner_torque * pow(k, 4);
    }
    return P;
}

static void sheets(void)
{
    section_spec spec = section_spec_rectangle(198.7e9, 76.3e9, 0.1, 0.00225);
    spec.sheet_warping = 1;
    spec.shear_factor[0] = spec.shear_factor[1] = 0.853;
    const section c = sections_computed(&spec);
    const unsigned features =
        FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE;
    const double l = 0.12;
    double e[E + 1] = {0};
    uint64_t seed = 2;
    for (int state = 0; state < STATES; state++) {
        for (int i = 1; i <= E; i++)
            e[i] = 0.2 * l * random_number(&seed);
        gsl_test_rel(energy_of(&element_sheet_second, &c, l, features, e + 1),
                     sheet_energy(&c, l, e), 1e-13, "sheet_second");
        gsl_test_rel(energy_of(&element_sheet_second_consistent, &c, l, features, e + 1),
                     sheet_energy(&c, l, e), 1e-13, "sheet_second_consistent");
    }
}

int main(void)
{
    beamw();
    sheets();
    return gsl_test_summary();
}
