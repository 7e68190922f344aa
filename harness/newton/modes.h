/* What a mode of vibration or buckling looks like. */
#ifndef BEAMWORK_MODES_H
#define BEAMWORK_MODES_H

#include "harness/model/model.h"

typedef struct mode_shape {
    scene_family family;
    int half_waves;
} mode_shape;
status modes_identify(const model *, const scene *, const double mode[], mode_shape *, fault *);
int modes_in_family(const scene_mode *, const mode_shape *); /* is it what the quantity asks for? */
const char *modes_family_name(scene_family);
/* Modes of equal value[count], one after the other (each [n = free + driven]), may be mixed in any
 * way: they become those that move along the members' z axes and those that do not. */
status modes_separate(const model *, const scene *, int count, const double value[], size_t n,
                      double *mode, fault *);

#endif
