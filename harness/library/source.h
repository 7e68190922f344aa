/* What a bw_scene and its results stand on; it lives as long as any of them. */
#ifndef BEAMWORK_SOURCE_H
#define BEAMWORK_SOURCE_H

#include "cases/format/scene_file.h"
#include "harness/library/beamwork.h"
#include "harness/study/study.h"

typedef struct source source;

struct bw_scene {
    source *from;
    double parameter[CASE_MAX_PARAMETERS];
};

/* A built-in case, or a file that was read (name: what messages call it; both are taken, also
 * after a failure). */
status source_new(const case_type *type, scene_file *file, char *name, source **out, fault *f);
source *source_hold(source *); /* one more who releases it */
void source_release(source *); /* NULL: nothing */
const case_type *source_case(const source *);
const scene_file *source_file(const source *); /* NULL: a built-in case */

/* What is known of a case, of a scene file the ledger alone; read when it is first asked for.
 * NULL after FAULT. Several threads may ask. */
status source_known(source *, const truths **out, fault *f);

#endif
