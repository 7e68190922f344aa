/* Units: SI throughout; what else is written is refused with the way to write it. */
#ifndef BEAMWORK_SCENE_UNITS_H
#define BEAMWORK_SCENE_UNITS_H

#include "cases/format/document.h"

/* A mistake where the text is none of the units that values have here. */
void units_check(const document_node *unit, mistakes *m);

/* Units of a scene: of length and force; those of stress and of mass (force s^2/length) follow. */
typedef struct unit_system {
    int given;            /* 0: SI */
    double length, force; /* [m], [N]: of one of them */
    const char *name_of_length, *name_of_force;
    char name_of_stress[16];
} unit_system;

/* What "mm, N, MPa" or [mm, N, MPa] says; NULL: SI. A mistake: units that do not fit each other. */
void units_read(const document_node *n, mistakes *m, unit_system *out);
/* A unit of SI in those of the system: "N m" becomes "N mm"; seconds and angles stay. */
void units_translate(const unit_system *, const char *unit, size_t size, char out[]);

#endif
