/* The geometrically exact beam with warping, solved inside the element by Gauss collocation, with
 * exact equilibrium of forces (elements/collocation/collocation.h). The variables of the Gauss
 * points are inner unknowns of the element. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "elements/collocation/collocation.h"
#include "elements/field/field.h"
#include "elements/geometrically_exact/exact.h"
#include "elements/math/scalar.h"
#include "elements/shared/lanes.h"

enum { OPTION_STAGES, FEWEST = 3, OUTER = EXACT_STAGES_OUTER };

struct element_data {
    exact_stages stages;
    exact_along along;
    field_mass mass;
    int prestressed; /* 1 if the derivatives for the prestress have been computed */
    double prestress[OUTER][OUTER * OUTER];
};

static const parameter_type options[] = {
    [OPTION_STAGES] =
        {"stages", "", 2, 0, 0, "3|4|5|6|7|8",
         "number of Gauss points inside an element; the order in statics is twice this number"},
    {0},
};

static int stage_count(const double value[])
{
    return FEWEST + (int)value[OPTION_STAGES];
}

/* The order in statics also holds under dead forces along members. Under other loads along members,
 * the order is 4 at large rotations. For frequencies see field/field.h. In linear buckling, the
 * inner unknowns are those of the stress-free element (elements/collocation/prestress.c). */
static element_order order(element_analysis analysis, const double value[])
{
    const int collocated = 2 * stage_count(value);
    if (analysis == ELEMENT_VIBRATION)
        return FIELD_MASS_ORDER;
    return (element_order){2, analysis == ELEMENT_STATICS ? collocated : 4};
}

static int inner_count(const double value[])
{
    return 3 * stage_count(value);
}

static int memory_count(const double value[])
{
    return inner_count(value) * (1 + OUTER);
}

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    field_mass_prepare(request, 2, &out->mass);
    TRY(exact_stages_prepare(request, stage_count(request->options), &out->stages, f));
    exact_along_prepare(request, &out->stages, &out->along);
    out->prestressed = (request->features & FEATURE_GEOMETRIC) != 0;
    if (out->prestressed)
        exact_prestress_derivatives(&out->stages, out->prestress);
    return STATUS_OK;
}

static void unstressed(const element_data *d, const double more[3], const node_state x[],
                       element_data *out)
{
    exact_stages *s = &out->stages;
    (void)x;
    *out = *d;
    s->c.initial[0] += more[0];
    for (int i = 0; i < s->stages; i++)
        for (int j = 1; j < 3; j++)
            s->rest_kappa[i][j] += s->line.l0 * more[j];
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    REAL_CHOSEN(exact_alone_strain)(&d->stages.line, x, out);
}

static void rest(const element_data *d, double inner[])
{
    const exact_stages *s = &d->stages;
    memset(inner, 0, 3 * sizeof *inner);
    memcpy(inner + 3, s->rest_x[1], 3 * (size_t)(s->stages - 1) * sizeof *inner);
}

static status stress(const element_data *data, const double e[], const double inner[],
                     stress_output *out)
{
    return REAL_CHOSEN(exact_alone_stress)(&data->stages, e, inner, out);
}

static void strain_many(int count, const element_data *const data[], const node_state x[],
                        strain_output out[])
{
    REAL_CHOSEN(exact_lanes_stages_strain)(count, data, x, out);
}

static void stress_many(int count, const element_data *const data[], const double *const e[],
                        const double *const inner[], stress_output out[], status outcome[])
{
    REAL_CHOSEN(exact_lanes_stages_stress)(count, data, e, inner, out, outcome);
}

static void along(int count, const element_data *const data[], const node_state x[],
                  along_output out[], status outcome[])
{
    for (int i = 0, run; i < count; i += run) {
        const element_data *d = data[i];
        const node_state *at = x + (ptrdiff_t)2 * i;
        run = 1;
        if (out[i].e == NULL || out[i].rate != NULL) {
            outcome[i] = (out[i].e == NULL ? exact_along_linear
                                           : exact_along_rate)(&d->stages, &d->along, at, &out[i]);
            continue;
        }
        while (i + run < count && run < LANES_TOGETHER && data[i + run] == d &&
               out[i + run].e != NULL && out[i + run].rate == NULL)
            run++;
        if (run > 1)
            REAL_CHOSEN(exact_lanes_along)
        (&d->stages, &d->along, run, at, out + i, outcome + i);
        else outcome[i] = REAL_CHOSEN(exact_alone_along)(&d->stages, &d->along, at, &out[i]);
    }
}

static void geometric(const element_data *data, const double sigma[], double G[])
{
    double own[OUTER][OUTER * OUTER];
    memset(G, 0, OUTER * OUTER * sizeof *G);
    if (!data->prestressed)
        exact_prestress_derivatives(&data->stages, own);
    for (int k = 0; k < OUTER; k++) {
        const double *Q = data->prestressed ? data->prestress[k] : own[k];
        const double weight = sigma[k] / data->stages.line.l0; /* (energy/l0^2)/(energy/l0) */
        for (int i = 0; i < OUTER * OUTER; i++)
            G[i] += weight * Q[i];
    }
}

/* Returns the force by which changes of force are divided. If a force equals a stiffness times an
 * elongation, its rounding error is proportional to the stiffness. A rounding error above 1e-9 of
 * the unit of bending forces must not prevent convergence. */
static double force_scale(const beam_constants *c)
{
    const double resolved = 1e-9, stiffness = c->coupled ? c->C[0] : c->EA;
    return fmax(1, DBL_EPSILON / resolved * stiffness);
}

static double update(const element_data *data, const double de[], const double memory[],
                     double inner[])
{
    const exact_stages *s = &data->stages;
    double largest = 0, force = force_scale(&s->c);
    for (int i = 0; i < s->unknowns; i++) {
        double change = -memory[i * (OUTER + 1) + OUTER];
        for (int j = 0; j < OUTER; j++)
            change -= memory[i * (OUTER + 1) + j] * de[j] / s->line.l0;
        inner[i] += change;
        if (i < 3)
            force =
                fmax(force, fabs(inner[i])); /* forces are divided by a scale, rotations are not */
        largest = larger(largest, fabs(change) / (i < 3 ? force : 1));
    }
    return largest;
}

static int strains(const double value[])
{
    (void)value;
    return OUTER;
}

static status inertia(const element_data *d, const node_state x[],
                      const element_rotating_frame *frame, inertia_output *out)
{
    return field_mass_inertia(&d->mass, x, frame, out);
}

static int mass_of_field(const double value[])
{
    (void)value;
    return 1;
}

const element_type element_collocation = {
    .name = "collocation",
    .summary =
        "geometrically exact beam with warping, solved inside the element by Gauss collocation",
    .source =
        "beamwork; theory: Reissner, J. Appl. Math. Phys. 32 (1981); Simo, Comput. Methods Appl. "
        "Mech. Eng. 49 (1985)",
    EXACT_TYPE,
    .limits = LIMIT_HALF_TURN,
    .options = {options},
    .order = order,
    .strains = strains,
    .inner = inner_count,
    .memory = memory_count,
    .data_size = data_size,
    .prepare = prepare,
    .strain = strain,
    .stress = stress,
    .update = update,
    .rest = rest,
    .unstressed = unstressed,
    .geometric = geometric,
    .lanes = LANES_TOGETHER,
    .strain_many = strain_many,
    .stress_many = stress_many,
    .inertia = inertia,
    .along = along,
    .spreads = 1,
    .mass_of_field = mass_of_field,
};
