#include "elements/geometrically_exact/exact.h"

#include "elements/geometrically_exact/deformed.h"

void REAL_NAMED(exact_alone_strain)(const exact_strain_line *line, const node_state x[],
                                    strain_output *out)
{
    exact_deformed_strain(line, 1, x, out);
}
