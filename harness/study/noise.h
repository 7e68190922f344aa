/* Noise of the values of the finest mesh: the same cell again in words that change nothing but the
 * rounding of its numbers. */
#ifndef BEAMWORK_NOISE_H
#define BEAMWORK_NOISE_H

#include "harness/study/sweep.h"

/* Runs the finest mesh of every series that is wanted twice more: members with their nodes in
 * reverse order, and in a unit of length that is no power of two; in two units where a formulation
 * answers to the order of nodes; without the stations that only curves show. Fills series.noise:
 * twice the larger of the two differences, relative to the value or near_zero, or what differences
 * leave where a formulation needs them; NAN where a value or a repetition is missing. */
status noise_measure(const sweep_request *request, const char wanted[], sweep *s, fault *f);
int noise_cells(const sweep *s); /* that were run for it */

#endif
