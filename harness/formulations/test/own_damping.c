/* The beam of timoshenko.c made of a viscous material, as in own_damping.py, in C. */
#define beamwork_element timoshenko
#include "elements/examples/timoshenko.c"
#undef beamwork_element

static const parameter_type eta = {
    .name = "eta", .summary = "retardation time", .value = 1e-4, .min = -1, .max = 10, .unit = "s"};

typedef struct damped {
    element_data beam;
    double eta; /* retardation time [s] */
} damped;

static size_t damped_size(const element_request *request)
{
    (void)request;
    return sizeof(damped);
}

static status damped_prepare(const element_request *request, element_data *out, fault *f)
{
    ((damped *)out)->eta = request->options[0];
    return prepare(request, out, f);
}

static void damping(const element_data *d, double V[])
{
    const double still[STRAINS] = {0};
    stress(d, still, NULL, &(stress_output){.C = V});
    for (int i = 0; i < STRAINS * STRAINS; i++)
        V[i] *= ((const damped *)d)->eta;
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "own_damping",
    .summary = "two nodes, one integration point, flexible in shear, viscous material",
    .source = "Reissner, J. Appl. Math. Phys. 32 (1981), with one integration point",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN,
    .leaves = LEAVES_J,
    .options = {&eta},
    .data_size = damped_size,
    .prepare = damped_prepare,
    .strains = strains,
    .strain = strain,
    .stress = stress,
    .damping = damping,
};
