#include "elements/exact/alone.h"

#include "elements/exact/collocated.h"
#include "elements/exact/deformed.h"
#include "elements/exact/loaded.h"

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

status REAL_NAMED(exact_alone_along)(const exact_stages *s, const exact_along *a,
                                     const node_state x[], along_output *out)
{
    status outcome;
    exact_loaded_along(s, a, 1, x, out, &outcome);
    return outcome;
}
