/* One element of a formulation, as its checks look at it: sections, options and features that it
 * takes, states of its nodes, its calls. */
#ifndef BEAMWORK_SPECIMEN_H
#define BEAMWORK_SPECIMEN_H

#include "harness/experiments/profiles.h"
#include "harness/formulations/formulations.h"

enum {
    SPECIMEN_STRAINS = ELEMENT_MAX_STRAINS,
    SPECIMEN_COORDINATES = ELEMENT_MAX_COORDINATES,
    SPECIMEN_INNER = 1 << 10,  /* most unknowns of its own that are checked */
    SPECIMEN_MEMORY = 1 << 13, /* and doubles between stress and update */
    SPECIMEN_WORDS = 160
};

/* Lengths in units of `unit` metres, force in newtons. */
typedef struct specimen_request {
    const element_type *given;
    const double *options;
    unsigned features;
    profiles_form form;
    double unit;
    double curvature[3]; /* [1/length] */
    double length;       /* 0: the usual */
} specimen_request;

typedef struct specimen {
    element_type type; /* completed by the adapters */
    specimen_request made;
    double options[FORMULATION_OPTIONS];
    section section;
    element_request request;
    element_data *data;
    size_t size; /* of data */
    int nodes, strains, coordinates, inner, memory;
    char words[SPECIMEN_WORDS]; /* "" or ", with option=value, section", for sentences */
} specimen;

/* STATUS_REFUSED, ...: the type's own word. specimen_free in any case. */
status specimen_make(const specimen_request *, specimen *out, fault *f);
void specimen_free(specimen *s);

/* Features for a straight element: all, and without those. */
unsigned specimen_features(const element_type *t, unsigned without);

/* Numbers of high entropy in (-1/2, 1/2), the same for the same seed. */
void specimen_numbers(int count, unsigned seed, double out[]);
/* The undeformed element moved by such numbers times `size` lengths, radians, 1/lengths. */
void specimen_state(const specimen *s, double size, unsigned seed, node_state x[]);
/* The whole turned about the origin by a rotation vector, then shifted by some lengths. */
void specimen_carry(const specimen *s, const double turn[3], const node_state x[],
                    node_state out[]);

/* Where differences are taken. */
typedef struct specimen_place {
    const specimen *s;
    const node_state *x;
} specimen_place;

/* Coordinate i moved by si units of differences, j by sj. */
void specimen_moved(const specimen_place *at, int i, double si, int j, double sj, node_state out[]);

/* Inner unknowns at rest [inner]. */
void specimen_rest(const specimen *s, double inner[]);
/* Stress with the inner unknowns solved for: Newton on the element's own equations. */
status specimen_settled(const specimen *s, const double e[], double inner[], stress_output *out);

/* "rotation about y of node 2". */
const char *specimen_coordinate(int c, char words[SPECIMEN_WORDS]);

#endif
