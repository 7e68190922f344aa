/* A folder with the matrices of small motions about the states of a solution:
 *   dofs.csv    what each row is, loads.csv what each column of B is, states.csv what each folder
 * is STATE/      K.mtx, M.mtx, where the axes turn G.mtx, where there are loads B.mtx */
#ifndef BEAMWORK_SYSTEM_FOLDER_H
#define BEAMWORK_SYSTEM_FOLDER_H

#include "cases/scene/scene.h"
#include "harness/newton/newton.h"

/* title: of the solution, one line, for the comments of the matrices. The folder appears complete
 * or not at all. */
status system_folder_write(const char *path, const char *title, const scene *,
                           const system_matrices *, fault *);

#endif
