/* Damping in proportion to stiffness: stresses gain eta S0 e', with the rates of the strains and
 * the stiffness S0 of the undeformed element. Rigid motions cost nothing. */
#ifndef BEAMWORK_DAMPING_H
#define BEAMWORK_DAMPING_H

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/instant.h"

/* Is any member of the scene damped? */
int damping_acts(const scene *);
/* S0 of all kinds, and from here on its share of the run's stresses, with rates that stay zero
 * until they are set. Nothing where no member is damped. */
status damping_begin(const equations *, run_damping *, fault *);
void damping_end(const equations *, run_damping *);

/* C of small motions about a state, on a pattern of model.h. */
status damping_matrix(const equations *, const model_state *, sparse *C, fault *);

/* Rates of the strains now: known + g (e - from); all [elements x strains]. */
void damping_follow(const equations *, double g, const double known[], const double from[]);
/* e' = J x' at rates v[free + driven] -> rate[elements x strains]. */
status damping_rates(const model *, const model_state *, const double v[], double rate[], fault *);
/* Rates of the strains by those of the coordinates, which stay; nothing where nothing is damped. */
status damping_now(const equations *, instant *, fault *);
/* Power that rates of strains lose [W]. */
double damping_power(const equations *, const double rate[]);

#endif
