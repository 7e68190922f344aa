/* A scene file as the build writes it into the program (harness/tools/pack_case.c): read and
 * checked there, without a pointer in it, and a case like any other here. */
#ifndef BEAMWORK_SCENE_PACKED_H
#define BEAMWORK_SCENE_PACKED_H

#include "cases/case.h"

typedef struct document_packed {
    int kind, line, column, inset; /* as document_node has them */
    /* Of a text: where it begins in all texts. Of a list: its first entry, which the others follow;
     * of a map: its first key, which the other keys follow, and then its entries. */
    int first;
    int count;
} document_packed;

typedef struct scene_packed {
    const char *file, *texts;
    const parameter_type *parameters; /* of the file */
    const document_packed *node;      /* the first one is the root */
    int nodes;
} scene_packed;

/* The build_from of such a case; context: a scene_packed. */
status scene_packed_build(const void *context, const double value[], scene *s, fault *f);

#endif
