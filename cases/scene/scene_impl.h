#ifndef BEAMWORK_CASES_SCENE_SCENE_IMPL_H
#define BEAMWORK_CASES_SCENE_SCENE_IMPL_H

#include "cases/scene/scene.h"

/* Default relative tolerance of the limit of mesh refinement. */
#define SCENE_TOLERANCE 1e-3

/* Returns the first component whose table has a slope discontinuity at zero, where the stiffness of
 * the undeformed state is undefined, or SCENE_NONE. */
int scene_spring_kink(const scene_spring *);

/* Bits of rx, ry and rz. */
#define SCENE_TURNS (7u << SCENE_RX)
/* Returns 1 if a constraint contains any of these components of the node. */
int scene_is_constrained(const scene *, int node, unsigned components);

status scene_validate_functions(const scene *s, fault *f);

/* Checks the position, supports, fork, body and attachment of node i. Returns REFUSED with the
 * cause and the remedy in f. */
status scene_validate_node(const scene *s, int i, fault *f);

/* Checks that the geometry, motions and loads of a plane scene are in its plane. Returns REFUSED
 * with the entry and the remedy in f. */
status scene_validate_plane(const scene *s, fault *f);

/* Returns 1 if the body of the node is connected to a member or a spring. */
int scene_is_joined(const scene *s, int node);
/* Checks that members, springs, supports, motions or constraints carry a load at a node. */
status scene_validate_carried(const scene *s, int load, fault *f);

status scene_validate_release(const scene *s, int member, fault *f);
/* Checks that a member, a support or a spring resists the rotations of a node. */
status scene_validate_turns(const scene *s, int node, fault *f);

status scene_validate_constraints(const scene *s, fault *f);

status scene_validate_imperfections(const scene *s, fault *f);

/* Checks load cases and combinations, and the entries that select them. */

status scene_validate_cases(const scene *s, fault *f);
status scene_validate_acting(const scene *s, int analysis, fault *f);
status scene_validate_case_of(const scene *s, const scene_quantity *q, fault *f);

/* Check analysis or quantity i. Return REFUSED with the cause and the remedy in f. */
status scene_validate_analysis(const scene *s, int i, fault *f);
status scene_validate_quantity(const scene *s, int i, fault *f);

#endif
