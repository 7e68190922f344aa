/* How far the values of two meshes are apart, with a scale for those that are zero but for
 * round-off: by symmetry, in hinges, beside the plane of a plane frame. */
#ifndef BEAMWORK_CHANGE_H
#define BEAMWORK_CHANGE_H

#include "harness/study/cell.h"

typedef struct value_change {
    double largest;  /* INFINITY: not known, or one mesh alone has a value */
    int which;       /* its quantity, -1: none */
    int missing;     /* 1: there are values that neither mesh has; a finer one may */
    double *of_each; /* [quantities of the scene] by the value, or by its scale where that is
                        larger; of a curve, by its largest value; NAN: not known */
} value_change;

/* Of `now` from `before`, into out, whose of_each the caller has made. What says how wrong a
 * solution is (the drift of a balance of energy) is left out. */
void change_between(const scene *s, const cell_result *before, const cell_result *now,
                    value_change *out);
/* Size [unit of the quantity] of which round-off is a small part: strains of 1e-14, turns and parts
 * of the structure's size of 1e-12, parts of 1e-9 of other values in the same unit. */
double change_scale(const scene *s, int quantity, const solve_result *r);

#endif
