#define LANES 4
#include "elements/collocation/collocation.h"

#include "elements/collocation/collocated.h"
#include "elements/geometrically_exact/deformed.h"
#include "elements/shared/lanes.h"

void REAL_NAMED(exact_lanes_stages_strain)(int count, const element_data *const data[],
                                           const node_state x[], strain_output out[])
{
    for (int i = 0, run; i < count; i += run) {
        const exact_strain_line *line = &((const exact_stages *)(const void *)data[i])->line;
        run = lanes_run(count - i, data + i);
        exact_deformed_strain(line, run, x + i * line->nodes, out + i);
    }
}

void REAL_NAMED(exact_lanes_stages_stress)(int count, const element_data *const data[],
                                           const double *const e[], const double *const inner[],
                                           stress_output out[], status outcome[])
{
    for (int i = 0, run; i < count; i += run) {
        run = lanes_run(count - i, data + i);
        exact_collocated_stress((const exact_stages *)(const void *)data[i], run, e + i, inner + i,
                                out + i, outcome + i);
    }
}

void REAL_NAMED(exact_lanes_along)(const exact_stages *s, const exact_along *a, int count,
                                   const node_state x[], along_output out[], status outcome[])
{
    exact_loaded_along(s, a, count, x, out, outcome);
}
