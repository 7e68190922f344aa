/* What a scene file consists of, for the files that read it. */
#ifndef BEAMWORK_SCENE_FILE_IMPL_H
#define BEAMWORK_SCENE_FILE_IMPL_H

#include "cases/format/scene_file.h"
#include "cases/format/scope.h"

struct scene_file {
    arena arena; /* of the document and of all texts */
    const char *path;
    const document_node *root;
    case_type type;
    parameter_type parameter[CASE_MAX_PARAMETERS + 1];
    int parameters;
};

/* The table of parameters; defaults are in their ranges where there is no mistake. */
void parameter_table_read(scene_file *file, mistakes *m);
/* The names of the parameters of a table with these values. */
const scope *parameter_table_names(const parameter_type *, const double value[], arena *a);
/* Mistakes of the truths, whose quantities are those of the scene, at a point. */
void scene_file_truths_check(const scene_file *file, const scene *s, const double value[],
                             mistakes *m);

#endif
