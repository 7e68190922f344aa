/* Quantities of a path: at a station, the largest or least of all, or as a curve. */
#ifndef BEAMWORK_EXTRACT_PATH_H
#define BEAMWORK_EXTRACT_PATH_H

#include "harness/newton/newton.h"

/* Without a value where the path ends before the stations that the quantity needs. */
void extract_path(const analysis_context *, const scene_quantity *, const analysis_outcome *,
                  quantity_result *);

/* Is a station of the path[stations] of an analysis one that some quantity other than a curve is
 * taken at? */
int extract_path_asks(const analysis_context *, int analysis, int stations, const double path[],
                      int station);
/* The same, or are all stations wanted? */
int extract_path_wants(const analysis_context *, int analysis, int stations, const double path[],
                       int station);
/* Is more of the state at a station read than the motion of nodes: resultants, reactions, shapes,
 * matrices, or what an analysis that follows begins with? Compliances that were taken on the way
 * ask for nothing more. */
int extract_path_whole(const analysis_context *, int analysis, int station);

#endif
