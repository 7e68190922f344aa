/* The beam of timoshenko.c with a torsional strain that is integrated along the path by the
 * midpoint rule: the strain per length is that of the last accepted state plus (t - T)(1 + 10 m^2).
 * Here t is the twist per length between the nodes, T is its last accepted value, and m = (t +
 * T)/2. */
#define beamwork_element timoshenko
#include "elements/examples/timoshenko.c"
#undef beamwork_element

enum { TWIST = 3 };

/* Returns the strain per length of a trial twist. history: twist, and strain per length, of the
 * last accepted state. */
static double twist_strain(const double history[], double t)
{
    const double m = (t + history[0]) / 2;
    return history[1] + (t - history[0]) * (1 + 10 * m * m);
}

static void midpoint_strain(const element_data *d, const node_state x[], strain_output *out)
{
    strain(d, x, out);
    if (out->e != NULL)
        out->e[TWIST] = d->length * twist_strain(out->history, out->e[TWIST] / d->length);
}

static void midpoint_commit(const element_data *d, const node_state x[], double history[])
{
    double e[STRAINS];
    strain(d, x, &(strain_output){.e = e});
    const double t = e[TWIST] / d->length;
    history[1] = twist_strain(history, t);
    history[0] = t;
}

static int two(const double options[])
{
    (void)options;
    return 2;
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "midpoint",
    .summary = "torsion by the midpoint rule along the path",
    .source = "made for a test",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN | LIMIT_PATH_DEPENDENT,
    .leaves = LEAVES_J,
    .data_size = data_size,
    .prepare = prepare,
    .strains = strains,
    .strain = midpoint_strain,
    .stress = stress,
    .history = two,
    .commit = midpoint_commit,
};
