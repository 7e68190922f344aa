#include "harness/solver/quantity.h"

#include <math.h>
#include <stdio.h>

void quantity_no_value(quantity_result *r, status s, const char *reason)
{
    r->status = s != STATUS_OK ? s : STATUS_NO_VALUE;
    r->value = NAN;
    snprintf(r->reason, sizeof r->reason, "%s", reason);
}

double quantity_scaled(const scene_quantity *q, double value)
{
    return q->factor * value + q->offset;
}
