#define LANES 4
#include "elements/geometrically_exact/exact.h"

#include "elements/geometrically_exact/deformed.h"
#include "elements/geometrically_exact/stressed.h"
#include "elements/shared/lanes.h"

void REAL_NAMED(exact_lanes_gauss_strain)(int count, const element_data *const data[],
                                          const node_state x[], strain_output out[])
{
    for (int i = 0, run; i < count; i += run) {
        const exact_strain_line *line = &((const exact_gauss *)(const void *)data[i])->line;
        run = lanes_run(count - i, data + i);
        exact_deformed_strain(line, run, x + i * line->nodes, out + i);
    }
}

void REAL_NAMED(exact_lanes_gauss_stress)(int count, const element_data *const data[],
                                          const double *const e[], const double *const inner[],
                                          stress_output out[], status outcome[])
{
    (void)inner;
    for (int i = 0, run; i < count; i += run) {
        run = lanes_run(count - i, data + i);
        exact_stressed_stress(&((const exact_gauss *)(const void *)data[i])->stiffness, run, e + i,
                              out + i, outcome + i);
    }
}
