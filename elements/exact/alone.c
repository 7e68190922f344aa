#include "elements/exact/alone.h"

#include "elements/exact/collocated.h"
#include "elements/exact/deformed.h"

void REAL_NAMED(exact_alone_strain)(const exact_strain_line *line, const node_state x[],
                                    strain_output *out)
{
    exact_deformed_strain(line, 1, x, out);
}

status REAL_NAMED(exact_alone_stress)(const exact_stages *s, const double e[], const double inner[],
                                      stress_output *out)
{
    status outcome;
    exact_collocated_stress(s, 1, &e, &inner, out, &outcome);
    return outcome;
}
