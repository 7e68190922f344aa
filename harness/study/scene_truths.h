/* Truths of a scene file, among those of the run. */
#ifndef BEAMWORK_SCENE_TRUTHS_H
#define BEAMWORK_SCENE_TRUTHS_H

#include "cases/format/scene_file.h"
#include "harness/study/truths.h"

/* Adds the file's truths that hold at a point of its parameters, and their values there. */
status scene_truths_add(const scene_file *, const double value[], truths *t, fault *f);
/* The same at the defaults and at every point that a truth names. */
status scene_truths_add_all(const scene_file *, truths *t, fault *f);

#endif
