/* x = g(x) by Anderson's mixing: iterations that a plain repetition would let grow converge too. */
#ifndef BEAMWORK_FIXED_POINT_H
#define BEAMWORK_FIXED_POINT_H

enum { FIXED_POINT_MAX = 160 };

/* out = g(x), [n] each; 0, or 1 where it cannot be evaluated. */
typedef int (*fixed_point_map)(void *context, const double x[], double out[]);

/* From the start in x[n], n <= FIXED_POINT_MAX.  Ends where no entry moves by more than `enough`,
 * or where that no longer falls; returns the largest last move; INFINITY where the map failed. */
double fixed_point_find(int n, fixed_point_map map, void *context, double enough, double x[]);

#endif
