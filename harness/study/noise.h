/* Noise of the values of the finest mesh: the same cell again in words that change nothing but the
 * rounding of its numbers. */
#ifndef BEAMWORK_NOISE_H
#define BEAMWORK_NOISE_H

#include "harness/study/sweep.h"

/* The finest mesh of a series is run so often again: in a unit of length that is no power of two,
 * and with the nodes of members in reverse order; in two units where a formulation answers to the
 * order of nodes. The stations that only curves show are left out. */
enum { NOISE_REPETITIONS = 2 };

/* In what other words. */
scene_edit noise_words(const formulation *, int repetition);
/* Fills series.noise: twice the larger of the two differences, relative to the value or near_zero,
 * or what differences leave where a formulation needs them; NAN where a value or a repetition is
 * missing. -1: out of memory. */
int noise_take(const sweep_point *, const cell_result again[NOISE_REPETITIONS], series *);
int noise_cells(const sweep *s); /* that were run for it */

#endif
