#include "harness/newton/quantity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

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

double quantity_abscissa(const scene_quantity *q, double x)
{
    return x * q->x.factor + q->x.offset;
}

int quantity_curve(quantity_result *r, int points)
{
    r->curve.x = calloc((size_t)points + 1, sizeof(double));
    r->curve.value = calloc((size_t)points + 1, sizeof(double));
    if (r->curve.x == NULL || r->curve.value == NULL) {
        quantity_no_value(r, STATUS_FAULT, "out of memory");
        return 0;
    }
    r->curve.points = points;
    return 1;
}
