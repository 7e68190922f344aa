/* Measures the cost of one evaluation of every formulation for a sheet bent by 3 % of its length:
 * kinematics (strains, gradient, second derivatives), stress with stiffness, and the update of the
 * inner unknowns. The times are in microseconds, each the smallest of many repetitions. */
#include <stdio.h>

#include "elements/test/chain.h"
#include "harness/formulations/formulations.h"
#include "harness/numerics/numerics.h"

enum { REPEATS = 40, CALLS = 300, TIMED = 4 };

/* Returns the time of one call of a phase [s]: 0: e and J, 1: e, J and H, 2: stress, C and memory,
 * 3: update. */
static double lap(chain *c, chain_linearised *w, int phase)
{
    const element_type *type = c->type;
    double e[ELEMENT_MAX_STRAINS], H[CHAIN_MOST * CHAIN_MOST];
    const double none[ELEMENT_MAX_STRAINS] = {0}, start = clock_processor_seconds();
    for (int i = 0; i < CALLS; i++)
        switch (phase) {
        case 0:
            type->strain(chain_data(c), c->x, &(strain_output){.e = e, .J = w->J});
            break;
        case 1:
            type->strain(chain_data(c), c->x,
                         &(strain_output){.e = e, .J = w->J, .s = c->sigma[0], .H = H});
            break;
        case 2:
            type->stress(chain_data(c), c->e[0], c->inner[0],
                         &(stress_output){.sigma = w->sigma, .C = w->C, .memory = w->memory});
            break;
        default:
            if (type->update != NULL)
                type->update(chain_data(c), none, w->memory, c->inner[0]);
        }
    return (clock_processor_seconds() - start) / CALLS;
}

static void measure(const element_type *type, const double option[], const char *label,
                    const section *s)
{
    static chain c;
    static chain_linearised w;
    const unsigned wanted =
        FEATURE_SHEAR | FEATURE_WARPING | FEATURE_TRAPEZE | FEATURE_HARINGX | FEATURE_LARGE;
    double least[TIMED], held[7] = {0}, step[7] = {0, 0.003};
    if (chain_start(&c, type, option, s, 0.1, 1, wanted & type->offers) != 0)
        return;
    c.held[1] = c.held[5] = c.held[6] = 1;
    chain_solve(&c, step, held);
    for (int phase = 0; phase < TIMED; phase++) {
        least[phase] = 1;
        for (int i = 0; i < REPEATS; i++)
            least[phase] = fmin(least[phase], lap(&c, &w, phase));
    }
    printf("%-32s %10.2f %14.2f %16.2f %8.2f %8.2f\n", label, 1e6 * least[0], 1e6 * least[1],
           1e6 * least[2], 1e6 * least[3], 1e6 * (least[1] + least[2] + least[3]));
}

int main(void)
{
    section s;
    fault f;
    section_spec spec = section_spec_rectangle(200e9, 200e9 / 2.6, 0.1, 0.00225);
    spec.shear_factor[0] = spec.shear_factor[1] = 0.85;
    if (section_compute(&spec, &s, &f) != STATUS_OK)
        return 1;
    printf("%-32s %10s %14s %16s %8s %8s\n", "microseconds per element", "e, J", "e, J and H",
           "stress and C", "update", "all");
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        measure(type, NULL, type->name, &s);
        for (int k = 0; k < parameter_count(type->options); k++) {
            const int shapes = type->inner != NULL || type->nodes != NULL;
            for (int v = 0;
                 shapes && k == 0 && v < parameter_choices(parameter_at(type->options, k)); v++) {
                char label[64];
                double option[ELEMENT_MAX_OPTIONS];
                parameter_defaults(type->options, option);
                option[k] = v;
                snprintf(label, sizeof label, "%s, choice %d of %s", type->name, v + 1,
                         parameter_at(type->options, k)->name);
                measure(type, option, label, &s);
            }
        }
    }
    return 0;
}
