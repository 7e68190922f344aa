/* What released ends of members must be: parts of scene_validate. */
#ifndef BEAMWORK_SCENE_VALIDATE_RELEASE_H
#define BEAMWORK_SCENE_VALIDATE_RELEASE_H

#include "cases/scene/scene.h"

/* Of one member: components that exist, each once; not all, and none at both ends that would leave
 * the member loose. */
status scene_validate_release(const scene *s, int member, fault *f);
/* A node keeps something that resists its turns: a member that is joined, a support or a spring. */
status scene_validate_turns(const scene *s, int node, fault *f);

#endif
