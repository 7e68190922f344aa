/* What of a scene a motion that goes on depends on: all but its stations and quantities. */
#ifndef BEAMWORK_RESTART_TEXT_H
#define BEAMWORK_RESTART_TEXT_H

#include "cases/scene/scene.h"

/* As text of a scene file, which the caller frees. REFUSED: no file can say it. */
status restart_text(const scene *, char **out, fault *);
/* REFUSED: it differs from the former text, with the first line that does. */
status restart_text_check(const char *former, const scene *, fault *);

#endif
