/* The families of checks: what element.h asks of every type. Each looks at all that the formulation
 * can be made of, and leaves claims. */
#ifndef BEAMWORK_CHECKS_H
#define BEAMWORK_CHECKS_H

#include "harness/experiments/claims.h"
#include "harness/experiments/specimen.h"

typedef void checks_run(const formulation *chosen, claims *out);

checks_run checks_declared; /* its declarations are consistent            */
checks_run checks_features; /* what it offers it can do, alone, in subsets, as cases ask for it */
checks_run checks_derivatives; /* J and H of the strains */
checks_run checks_energy;      /* stress, stiffness and geometric stiffness come from the energy */
checks_run checks_force;       /* of types by force: force and stiffness come from the energy */
checks_run checks_motion;      /* rigid motion, order of the nodes, units */
checks_run checks_stateless;   /* the same call gives the same, whatever went before */
checks_run checks_many;        /* many at once give what each gives alone */
checks_run checks_bounds;      /* outputs are filled, and nothing beside them is touched */
checks_run checks_unsound;     /* what is no number is told, and not swallowed */
checks_run checks_mass;        /* mass matrix: symmetric, positive, of the beam's mass */
checks_run checks_rotating;    /* what a rotating frame does */
checks_run checks_along;       /* loads along one element */
checks_run checks_in_time;     /* forces of inertia in time */

typedef struct checks_family {
    const char *name, *what; /* one word; what holds, in a line */
    checks_run *run;
} checks_family;

enum { CHECKS_FAMILIES = 14 };
extern const checks_family checks_families[CHECKS_FAMILIES];

#endif
