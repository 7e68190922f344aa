/* Element coordinates -> coordinates of the model, in place; K[columns x columns]. force: internal,
 * for the second derivatives; NULL entries are skipped. */
#ifndef BEAMWORK_MODEL_ELIMINATE_H
#define BEAMWORK_MODEL_ELIMINATE_H

#include "harness/model/mesh.h"

void eliminate_forces(const model *m, const model_state *s, const mesh_element *el,
                      double force[]); /* [columns] */
void eliminate_matrix(const model *m, const model_state *s, const mesh_element *el,
                      const double force[], double K[]);

#endif
