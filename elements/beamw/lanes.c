#define LANES 4
#include "elements/beamw/variants.h"

#include "elements/beamw/equilibrium.h"
#include "elements/beamw/modes.h"
#include "elements/beamw/modified_stress.h"
#include "elements/beamw/screw.h"

static const lanes_sizes sizes = {.nodes = 2, .strains = BEAMW_STRAINS};

static inline void modes(const element_data *d, const node_real x[], strain_real *out)
{
    beamw_modes_evaluate(d->l0, x, out);
}

static inline void helicoidal(const element_data *d, const node_real x[], strain_real *out)
{
    beamw_helicoidal_evaluate(d->l0, x, out);
}

static inline real_truth modified(const element_data *d, const real e[], const real inner[],
                                  stress_real *out)
{
    (void)inner;
    beamw_modified_stress_evaluate(d, e, out);
    return real_true();
}

static inline real_truth consistent(const element_data *d, const real e[], const real inner[],
                                    stress_real *out)
{
    if (!beamw_prepare_whole(d)->condensed)
        return modified(d, e, inner, out);
    return beamw_equilibrium_stress(&beamw_prepare_whole(d)->internal, e, out);
}

void REAL_NAMED(beamw_lanes_modes)(int count, const element_data *const data[],
                                   const node_state x[], strain_output out[])
{
    lanes_strain_many(sizes, modes, count, data, x, out);
}

void REAL_NAMED(beamw_lanes_helicoidal)(int count, const element_data *const data[],
                                        const node_state x[], strain_output out[])
{
    lanes_strain_many(sizes, helicoidal, count, data, x, out);
}

void REAL_NAMED(beamw_lanes_modified)(int count, const element_data *const data[],
                                      const double *const e[], const double *const inner[],
                                      stress_output out[], status outcome[])
{
    lanes_stress_many(sizes, modified, STATUS_NOT_CONVERGED, count, data, e, inner, out, outcome);
}

void REAL_NAMED(beamw_lanes_consistent)(int count, const element_data *const data[],
                                        const double *const e[], const double *const inner[],
                                        stress_output out[], status outcome[])
{
    lanes_stress_many(sizes, consistent, STATUS_NOT_CONVERGED, count, data, e, inner, out, outcome);
}
