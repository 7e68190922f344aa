/* The geometrically exact beam with warping (Reissner, Simo), as in general-purpose codes. The
 * element has two or three nodes and reduced integration, and its strains are those at the
 * integration points. */
#include <math.h>
#include <string.h>

#include "elements/field/field.h"
#include "elements/geometrically_exact/exact.h"
#include "elements/shared/lanes.h"

enum { OPTION_NODES };

/* Transverse compliance of an element in a plane. The element cannot be used if the axial force N
 * times this compliance reaches 1. The compliance is the sum of two terms [1/N]: the shear
 * flexibility of the section, and l^2/12EI or l^2/60EI, the bending flexibility that the element
 * treats as shear (exact.h). */
typedef struct across {
    double shear, bending;
} across;

struct element_data {
    exact_gauss gauss;
    field_mass mass;
    int nodes;
    across plane[2]; /* transverse directions y and z */
};

static const parameter_type options[] = {
    [OPTION_NODES] = {"nodes", "", 1, 0, 0, "2|3",
                      "number of nodes of an element; there is one integration point fewer"},
    {0},
};

static int nodes(const double value[])
{
    return 2 + (int)value[OPTION_NODES];
}

static int strains(const double value[])
{
    return 6 * (nodes(value) - 1) + nodes(value);
}

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

static void set_across(const element_request *r, int nodes, across plane[2])
{
    const section *c = r->section;
    const double square = r->length * r->length,
                 EI[2] = {c->matrices ? c->stiffness[35] : c->young * c->Iz,
                          c->matrices ? c->stiffness[28] : c->young * c->Iy};
    const int sheared = r->features & FEATURE_SHEAR && c->F[0] > 0 && c->F[4] > 0;
    for (int i = 0; i < 2; i++) {
        plane[i].shear = c->matrices                   ? 1 / c->stiffness[7 * (1 + i)]
                         : r->features & FEATURE_SHEAR ? c->F[4 * i] / c->shear_modulus
                                                       : 0;
        plane[i].bending = nodes == 2               ? square / (12 * EI[i])
                           : c->matrices || sheared ? 0
                                                    : square / (60 * EI[i]);
    }
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    const int count = nodes(request->options);
    TRY(exact_stiffness_prepare(request, count, &out->gauss.stiffness, f));
    field_mass_prepare(request, count, &out->mass);
    out->nodes = count;
    set_across(request, count, out->plane);
    exact_strain_prepare(count, count - 1, request->length, request->curvature, request->strain,
                         count == 2 ? EXACT_MEASURE_ANGLE : EXACT_MEASURE_QUARTER,
                         &out->gauss.line);
    return STATUS_OK;
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    REAL_CHOSEN(exact_alone_strain)(&d->gauss.line, x, out);
}

static status stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    (void)inner;
    return exact_stiffness_stress(&d->gauss.stiffness, e, out);
}

static void strain_many(int count, const element_data *const data[], const node_state x[],
                        strain_output out[])
{
    REAL_CHOSEN(exact_lanes_gauss_strain)(count, data, x, out);
}

static void stress_many(int count, const element_data *const data[], const double *const e[],
                        const double *const inner[], stress_output out[], status outcome[])
{
    REAL_CHOSEN(exact_lanes_gauss_stress)(count, data, e, inner, out, outcome);
}

static void geometric(const element_data *d, const double sigma[], double G[])
{
    exact_stiffness_geometric(&d->gauss.stiffness, sigma, G);
}

static double tension(const element_data *d, const double sigma[])
{
    const int points = d->nodes - 1;
    double most = 0;
    for (int g = 0; g < points; g++)
        for (int i = 0; i < 2; i++) {
            const double N = points * sigma[6 * g], left = 1 - N * d->plane[i].shear;
            if (N > 0 && left > 0)
                most = fmax(most, N * d->plane[i].bending / left);
        }
    return sqrt(most);
}

static status inertia(const element_data *d, const node_state x[],
                      const element_rotating_frame *frame, inertia_output *out)
{
    return field_mass_inertia(&d->mass, x, frame, out);
}

static int mass_of_field(const double value[])
{
    return nodes(value) == 2;
}

static element_order order(element_analysis analysis, const double value[])
{
    if (analysis != ELEMENT_VIBRATION)
        return (element_order){2, 4};
    return nodes(value) == 2 ? FIELD_MASS_ORDER : (element_order){4, 4};
}

const element_type element_geometrically_exact = {
    .name = "geometrically_exact",
    .summary = "geometrically exact beam with warping, two or three nodes and reduced integration",
    .source = "Reissner, J. Appl. Math. Phys. 32 (1981); Simo, Comput. Methods Appl. Mech. Eng. 49 "
              "(1985); interpolation of "
              "rotations: beamwork",
    EXACT_TYPE,
    .limits = LIMIT_HALF_TURN | LIMIT_TENSION,
    .options = {options},
    .nodes = nodes,
    .strains = strains,
    .data_size = data_size,
    .prepare = prepare,
    .strain = strain,
    .stress = stress,
    .geometric = geometric,
    .lanes = LANES_TOGETHER,
    .strain_many = strain_many,
    .stress_many = stress_many,
    .inertia = inertia,
    .spreads = 1,
    .mass_of_field = mass_of_field,
    .order = order,
    .tension = tension,
};
