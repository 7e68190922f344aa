#define LANES 4
#include "elements/sheet/lanes.h"

#include "elements/sheet/base.h"
#include "elements/sheet/deformation.h"

static const lanes_sizes sizes = {2, SHEET_STRAINS, 0, 0};

static inline void strain(const element_data *d, const node_real x[], strain_real *out)
{
    sheet_deformation_evaluate(&((const sheet_base_data *)(const void *)d)->table, x, out);
}

void REAL_NAMED(sheet_lanes_strain)(int count, const element_data *const data[],
                                    const node_state x[], strain_output out[])
{
    lanes_strain_many(sizes, strain, count, data, x, out);
}
