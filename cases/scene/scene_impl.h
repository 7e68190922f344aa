/* The inside of scene/. */
#ifndef BEAMWORK_CASES_SCENE_SCENE_IMPL_H
#define BEAMWORK_CASES_SCENE_SCENE_IMPL_H

#include "cases/scene/scene.h"

/* What motions in time must be, and the functions of time that they meet. */

/* REFUSED: the culprit. The scene's nodes, members, drivers and loads are sound. */
status scene_validate_motion(const scene *s, int analysis, fault *f);
/* REFUSED: nothing moves with inertia, and the analysis is of such a motion. */
status scene_validate_mass(const scene *s, int analysis, fault *f);
/* The functions of drivers and loads, also where no analysis is in time. */
status scene_validate_functions(const scene *s, fault *f);

/* What a node must be: its place, supports, fork, body and attachment. */

/* REFUSED: the culprit and the remedy, of the node i. */
status scene_validate_node(const scene *s, int i, fault *f);

/* Whether all of a scene that is held in a plane lies and acts in it. */

/* REFUSED: what lies, moves or acts out of the plane, and the remedy. */
status scene_validate_plane(const scene *s, fault *f);

/* What released ends of members must be: parts of scene_validate. */

/* Of one member: components that exist, each once; not all, and none at both ends that would leave
 * the member loose. */
status scene_validate_release(const scene *s, int member, fault *f);
/* A node keeps something that resists its turns: a member that is joined, a support or a spring. */
status scene_validate_turns(const scene *s, int node, fault *f);

/* What the analyses and quantities of a scene must be. */

/* REFUSED: the culprit and the remedy, of the analysis or quantity i. */
status scene_validate_analysis(const scene *s, int i, fault *f);
status scene_validate_quantity(const scene *s, int i, fault *f);

#endif
