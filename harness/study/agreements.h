/* Values of single meshes against stored discrete ones. */
#ifndef BEAMWORK_AGREEMENTS_H
#define BEAMWORK_AGREEMENTS_H

#include "harness/study/judgement.h"

/* One series against the stored values of its own meshes. */
status agreements_add(const sweep *s, const truths *t, int index, judgement *out, fault *f);

#endif
