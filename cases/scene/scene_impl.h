/* The inside of scene/. */
#ifndef BEAMWORK_CASES_SCENE_SCENE_IMPL_H
#define BEAMWORK_CASES_SCENE_SCENE_IMPL_H

#include "cases/scene/scene.h"

/* Requirements on transient analyses, and on the functions of time that they contain. */

/* REFUSED: the culprit. The scene's nodes, members, drivers and loads are sound. */
status scene_validate_motion(const scene *s, int analysis, fault *f);
/* REFUSED: nothing moves with inertia, and the analysis is of such a motion. */
status scene_validate_mass(const scene *s, int analysis, fault *f);
/* The functions of drivers and loads, also where no analysis is in time. */
status scene_validate_functions(const scene *s, fault *f);

/* Requirements on a node: its position, supports, fork, body and attachment. */

/* REFUSED: the culprit and the remedy, of the node i. */
status scene_validate_node(const scene *s, int i, fault *f);

/* Checks that a scene restricted to a plane has all geometry, motion and loads in it. */

/* REFUSED: what lies, moves or acts out of the plane, and the remedy. */
status scene_validate_plane(const scene *s, fault *f);

/* Requirements on released ends of members: parts of scene_validate. */

/* For one member: released components exist, each once; not all, and none at both ends that would
 * leave the member loose. */
status scene_validate_release(const scene *s, int member, fault *f);
/* A node keeps something that resists its turns: a member that is joined, a support or a spring. */
status scene_validate_turns(const scene *s, int node, fault *f);

/* Requirements on the analyses and quantities of a scene. */

/* REFUSED: the culprit and the remedy, of the analysis or quantity i. */
status scene_validate_analysis(const scene *s, int i, fault *f);
status scene_validate_quantity(const scene *s, int i, fault *f);

#endif
