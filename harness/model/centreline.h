/* Centre lines of all members in a state, for pictures and other programs.
 * Between two vertices of the mesh runs a cubic whose tangents are the vertices' x axes, whatever
 * field the formulation has inside: what is drawn is the same for all. Resultants are in
 * equilibrium with the element's nodal forces J^T sigma. */
#ifndef BEAMWORK_CENTRELINE_H
#define BEAMWORK_CENTRELINE_H

#include "harness/model/model.h"

typedef struct centreline_point {
    double r[3];      /* position [m] */
    double q[4];      /* of the section's triad: x along the line, y and z principal */
    double force[3];  /* N, Qy, Qz: of the part beyond on the part before, in that triad [N] */
    double moment[3]; /* Mx, My, Mz about the point [N m] */
    double bimoment;  /* linear between an element's ends [N m^2] */
} centreline_point;

/* Points of all members; first[members + 1]: where each begins; NULL: count only. */
int centreline_points(const model *m, int first[]);
/* out[points] in the order of the members, each from p to q. */
void centreline_fill(const model *m, const model_state *s, centreline_point out[]);
/* Positions of the scene's nodes: out[nodes x 3] [m]. */
void centreline_nodes(const model *m, const model_state *s, double out[]);
/* New state: `from` moved by scale x the increments x[free + driven]; sigma[elements x strains] its
 * stresses, NULL: those of `from`. scale 0: what makes it visible: a tenth of the scene's size or
 * half a radian. *scale returns what was used. */
status centreline_displaced(const model *m, const model_state *from, const double x[],
                            const double sigma[], double *scale, model_state **out, fault *f);

#endif
