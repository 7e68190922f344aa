/* Which points of the parameters: a grid over all axes, or points that fill their box. */
#ifndef BEAMWORK_DESIGN_H
#define BEAMWORK_DESIGN_H

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_rng.h>

#include "harness/experiments/axis.h"

typedef enum design_kind { DESIGN_GRID, DESIGN_SOBOL, DESIGN_HALTON, DESIGN_RANDOM } design_kind;
/* Words of --design, in that order. */
#define DESIGN_CHOICES "grid|sobol|halton|random"

/* Where a sequence is after so many of its points. */
typedef struct design_mark {
    gsl_qrng *quasi;
    gsl_rng *random; /* the other one is NULL */
} design_mark;

typedef struct design {
    design_kind kind;
    int axes;
    const sweep_axis *axis; /* [axes]; not owned */
    long points;            /* all */
    unsigned long seed;     /* of DESIGN_RANDOM: GSL's mt19937 */
    long marks, stride;
    design_mark *mark; /* [marks] at every `stride` points: any of them is soon found */
} design;

/* Least stride; most marks, of some kilobytes each. */
enum { DESIGN_STRIDE = 16384, DESIGN_MARKS = 1024, DESIGN_MOST_POINTS = 1000000000 };

/* points: of what is no grid. Grids: the last axis changes first. The first point of Sobol's and
 * Halton's sequences is the one behind the origin, as GSL has them. REFUSED: too many points, an
 * axis without parts in a grid, with parts in what is none, more axes than the sequence has. */
status design_make(design_kind kind, int axes, const sweep_axis list[], long points,
                   unsigned long seed, design *out, fault *f);
void design_free(design *);
/* Values of the axes at `count` points from `first` on, into out[count x axes]. FAULT: no memory.
 */
status design_points(const design *, long first, long count, double out[], fault *f);
const char *design_name(design_kind);

#endif
