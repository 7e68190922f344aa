/* Linear statics about the undeformed state. */
#include "harness/analysis/linear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/newton/newton.h"
#include "harness/numerics/numerics.h"

/* With what linear_analysis frees. */
static status displace(analysis_context *c, linear_system *s, analysis_outcome *o, fault *f)
{
    const model_size size = model_sizes(c->model);
    o->left.x = calloc((size_t)(size.free + size.driven) + 1, sizeof *o->left.x);
    if (o->left.x == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a linear solution");
    TRY(linear_system_alloc(c, s, f));
    return linear_system_solve(c, s, 1, o->left.x, f);
}

status linear_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    (void)analysis;
    linear_system s = {0};
    const status result = displace(c, &s, o, f);
    linear_system_free(&s);
    return result;
}
