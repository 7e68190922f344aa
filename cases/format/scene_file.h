/* A scene file as a case like any other: parameters, a function that builds the scene, truths. */
#ifndef BEAMWORK_SCENE_FILE_H
#define BEAMWORK_SCENE_FILE_H

#include <stddef.h>

#include "cases/case.h"
#include "cases/format/mistakes.h"

typedef struct scene_file scene_file;

/* What a file says of a quantity at a point of its parameters. */
typedef struct scene_truth {
    const double *parameter;       /* [CASE_MAX_PARAMETERS] */
    double value, uncertainty, at; /* at: an abscissa of a curve; NAN: it is a number */
    const char *quantity, *unit, *kind, *formulation, *theory, *model, *convention, *source;
} scene_truth;
/* Takes one, whose texts and numbers last as long as the call. */
typedef status scene_truth_taker(void *to, const scene_truth *, fault *);

/* The file, with its defaults built once to see that they are a scene. Not OK: *out is NULL;
 * REFUSED with all mistakes in m (and the first in f), FAULT when it cannot be read. path must
 * outlive m and the file. */
status scene_file_read(const char *path, scene_file **out, mistakes *m, fault *f);
/* Its form and parameters alone, where values other than the defaults are asked for; what it is
 * at these says scene_file_check. */
status scene_file_read_form(const char *path, scene_file **out, mistakes *m, fault *f);
/* Is it a scene at these values of its parameters? REFUSED with all mistakes in m, the first in f.
 */
status scene_file_check(const scene_file *, const double value[], mistakes *m, fault *f);
/* The same as scene_file_read of bytes, which the fuzzer gives; path: as messages call it. */
status scene_file_read_bytes(const char *bytes, size_t size, const char *path, scene_file **out,
                             mistakes *m, fault *f);
void scene_file_free(scene_file *);

/* Lives as long as the file. */
const case_type *scene_file_case(const scene_file *);
/* The path of the file that a case is made from; NULL: of none. */
const char *scene_file_path(const case_type *type);
const struct document_node *scene_file_document(const scene_file *);
/* Does the file say anything under this key? */
int scene_file_states(const scene_file *, const char *key);
/* The scene as earlier versions read it: ends that say nothing of their warping leave it free.
 * The caller frees it in any case. */
status scene_file_build_before(const scene_file *, const double value[], scene *, fault *);
/* Gives the truths that hold at a point of the parameters, with their values there. */
status scene_file_truths(const scene_file *, const double value[], scene_truth_taker *, void *to,
                         fault *f);
/* The same at the defaults and at every point that a truth names: some come several times. */
status scene_file_truths_all(const scene_file *, scene_truth_taker *, void *to, fault *f);

#endif
