/* A beam that is held at its beginning and loaded at its end, straight or bent into a quarter of a
 * circle, solved with one formulation. */
#ifndef BEAMWORK_BEAM_H
#define BEAMWORK_BEAM_H

#include "cases/scene/scene.h"
#include "harness/experiments/measures.h"
#include "harness/formulations/formulations.h"

typedef enum beam_analysis { BEAM_LINEAR, BEAM_LARGE, BEAM_BUCKLING, BEAM_VIBRATION } beam_analysis;

/* The length is 1 m: along x, or along a quarter of a circle that begins along y and has its centre
 * at the origin. */
typedef struct beam_request {
    const formulation *chosen;
    int elements;            /* of equal length */
    const double *fraction;  /* [elements] of the length; NULL: equal */
    double thickness, width; /* of a rectangle, along y (towards the centre) and z [m] */
    int profile;             /* 1: an I that warps and is held at the beginning, in its place */
    int quarter;             /* 1: bent */
    unsigned needs;          /* FEATURE_* bits */
    beam_analysis analysis;
    scene_load_kind load; /* at the end: force or moment */
    double vector[3];     /* [N, N m] */
    int component;        /* of the end that is read; of a frequency or critical factor: any */
} beam_request;

/* Constants of its section. */
status beam_section(const beam_request *, section *out);
/* Solves it; one more point of the measure, the error of what is read against the exact value; NAN
 * where there is none, and the words of the first say why. 0: no more need be
 * asked: the formulation does not offer it, or the first three have no value. */
int beam_point(const beam_request *, double at, double exact, element_measure *one);

#endif
