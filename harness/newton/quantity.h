/* A quantity that has been read from an outcome. */
#ifndef BEAMWORK_QUANTITY_H
#define BEAMWORK_QUANTITY_H

#include "harness/newton/result.h"

/* STATUS_OK of an outcome that lacks the value becomes STATUS_NO_VALUE. */
void quantity_no_value(quantity_result *, status, const char *reason);
/* In the units of the quantity: times its factor, plus its offset. */
double quantity_scaled(const scene_quantity *, double value);

/* The same for the abscissa of its curve. */
double quantity_abscissa(const scene_quantity *, double x);
/* Room for a curve of so many points; 0: there is none, which the result says. */
int quantity_curve(quantity_result *, int points);

#endif
