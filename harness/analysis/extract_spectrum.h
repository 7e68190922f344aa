/* Quantities of eigenvalues: critical loads and frequencies. */
#ifndef BEAMWORK_EXTRACT_SPECTRUM_H
#define BEAMWORK_EXTRACT_SPECTRUM_H

#include "harness/newton/newton.h"

/* Critical load factor of the wanted sign and order. */
void extract_spectrum_buckling(const scene_quantity *, const analysis_outcome *, quantity_result *);
/* Frequency [Hz] of the wanted kind and order of mode. */
void extract_spectrum_modal(const analysis_context *, const scene_quantity *,
                            const analysis_outcome *, quantity_result *);

#endif
