/* Truths at new parameter points, on demand: the deriving programs of reference/derive, which share
 * nothing with this one, solve for them. */
#ifndef BEAMWORK_DERIVE_H
#define BEAMWORK_DERIVE_H

#include <limits.h>
#include <stdio.h>

#include "cases/scene/scene.h"

typedef struct derived_value {
    char quantity[SCENE_NAME], unit[16], convention[96], source[96];
    double value, uncertainty; /* [unit] */
} derived_value;

/* Where a program of reference/derive is: in BEAMWORK_REFERENCE, or where data stand. FAULT: too
 * long a path. */
status derive_script(const char *name, char out[PATH_MAX], fault *f);
/* Runs `script CASE PARAMETERS`. REFUSED with its line when no program derives the case or the
 * parameters; FAULT when it could not be run or said something else. *out: malloced. */
status derive_values(const char *script, const char *case_name, const char *parameters,
                     derived_value **out, int *count, fault *f);
/* The same of `script` with a scene, as write_scene writes it, on its standard input; what of it no
 * program derives is said on standard error, a line each. */
status derive_scene(const char *script, FILE *scene_text, derived_value **out, int *count,
                    fault *f);

#endif
