/* Strains of an element that is known by its force, or by its energy: the places of its nodes
 * relative to the first one, in the axes of that one,
 *   e = (|d| - undeformed distance, l p, l log(R0^T R_k)) of every other node, l^2 a of all [m]:
 * d = r_k - r_0; p = (2 n_y, 2 n_z)/(1 + n_x) of its direction n, which is regular unless the chord
 * points backward. The distance is a strain of its own, so that in the mixed equations a stiff
 * chord takes no more iterations than a soft one. */
#ifndef BEAMWORK_PLACES_H
#define BEAMWORK_PLACES_H

#include "elements/element.h"

enum { PLACES_MOST = 6 * (ELEMENT_MAX_NODES - 1) + ELEMENT_MAX_NODES };

int places_strains_two(const double options[]);   /* of two nodes */
int places_strains_three(const double options[]); /* of three */

void places_strain(const element_data *d, const node_state x[], strain_output *out);

/* The element with these strains whose first node rests at the origin. */
void places_nodes(const element_data *d, const double e[], node_state x[]);

/* B [7n x strains]: how these nodes move with the strains. */
void places_motion(const element_data *d, const double e[], double B[]);

#endif
