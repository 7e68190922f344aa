/* The beam of incremental.c as an element that gives forces with a history: J^T sigma, where J is
 * computed by differences of fourth order. Every result must be that of incremental.c. */
#define beamwork_element incremental
#include "elements/examples/incremental.c"
#undef beamwork_element

static void strains_near(const element_data *d, const node_state x[], const double *values, int c,
                         double step, double e[STRAINS])
{
    node_state moved[2] = {x[0], x[1]};
    node_state *one = &moved[c / NODE_COORDINATES];
    const int k = c % NODE_COORDINATES;
    if (k < 3) {
        one->r[k] += step;
    } else if (k < 6) {
        double axis[3] = {0}, turn[9];
        axis[k - 3] = 1;
        series(axis, sin(step), 2 * sin(step / 2) * sin(step / 2), turn);
        product(turn, x[c / NODE_COORDINATES].R, 0, one->R);
    }
    strain(d, moved, &(strain_output){.e = e, .history = values});
}

static status force(const element_data *d, const node_state x[], force_output *out)
{
    static const double weight[] = {1. / 12, -8. / 12, 8. / 12, -1. / 12}, at[] = {-2, -1, 1, 2};
    double e[STRAINS], sigma[STRAINS], near[STRAINS];
    strain(d, x, &(strain_output){.e = e, .history = out->history});
    const status outcome = stress(d, e, NULL, &(stress_output){.sigma = sigma});
    for (int c = 0; c < 2 * NODE_COORDINATES && out->F != NULL; c++) {
        const double step = 1e-3 * (c % NODE_COORDINATES < 3 ? d->length : 1);
        out->F[c] = 0;
        for (int k = 0; k < 4; k++) {
            strains_near(d, x, out->history, c, at[k] * step, near);
            for (int i = 0; i < STRAINS; i++)
                out->F[c] += weight[k] / step * sigma[i] * (near[i] - e[i]);
        }
    }
    return outcome;
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "incremental_force",
    .summary = "the beam of incremental.c, given by its forces",
    .source = "made for a test",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN | LIMIT_NOT_OBJECTIVE | LIMIT_PATH_DEPENDENT,
    .leaves = LEAVES_TANGENT,
    .data_size = data_size,
    .prepare = prepare,
    .force = force,
    .history = history,
    .begin = begin,
    .commit = commit,
};
