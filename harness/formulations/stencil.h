/* Central differences of sixth order, of functions of arguments near one. */
#ifndef BEAMWORK_STENCIL_H
#define BEAMWORK_STENCIL_H

enum { STENCIL_MOST = 576 }; /* values of a function */

/* Units between places: what is left out is h^6/140 of the seventh derivative, h^6/560 of the
 * eighth; round-off eps/h and 4 eps/h^2. */
static const double stencil_first_step = 2e-3, stencil_second_step = 1e-3;

/* values[count] where arguments i and j are moved by si and sj units (i == j: by si + sj); returns
 * 0, or another number where there is none. */
typedef int stencil_function(const void *context, int i, double si, int j, double sj,
                             double values[]);

/* d values/d argument i per unit; 0, or what the function returned. */
int stencil_first(stencil_function *f, const void *context, int count, int i, double out[]);
/* d2 values/d argument i d argument j, as it is symmetric. */
int stencil_second(stencil_function *f, const void *context, int count, int i, int j, double out[]);

#endif
