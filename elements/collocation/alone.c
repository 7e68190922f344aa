#include "elements/collocation/collocation.h"

#include "elements/collocation/collocated.h"

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
