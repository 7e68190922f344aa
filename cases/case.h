/* A case: a table of parameters and a function that builds a scene from their values. One file in
 * cases/ defines one const case_type with the symbol case_<file name>. The file is written in C, or
 * it is a scene file that the build reads (cases/format/format.h). */
#ifndef BEAMWORK_CASE_H
#define BEAMWORK_CASE_H

#include "cases/scene/scene.h"
#include "elements/shared/parameter.h"

enum { CASE_MAX_PARAMETERS = 32 };

typedef struct case_type {
    const char *name, *summary, *source;
    const parameter_type *parameters[PARAMETER_PARTS];
    /* Builds the scene. value[i] belongs to entry i of the parameter tables and is within its
     * range. Rejects invalid combinations of values. */
    status (*build)(const double value[], scene *s, fault *f);
    /* Builds the scene of a case from a scene file, for which `build` is NULL. `context` is the
     * file. */
    status (*build_from)(const void *context, const double value[], scene *s, fault *f);
    const void *context;
    const char *file; /* path of the scene file, or NULL for a built-in case */
} case_type;

/* The parameters of every built-in case end with one of these two tables. `omit` selects whether
 * the scene omits the physics that the source omits, or no physics. case_mass_omit also selects
 * lumped or consistent mass of members, for cases whose quantities depend on the mass. The name of
 * a parameter point contains these parameters only if their values differ from the defaults. */
extern const parameter_type case_omit[], case_mass_omit[];
int case_is_omit(const parameter_type *);
int case_is_mass(const parameter_type *);
/* Returns 1 if no physics is omitted at this parameter point although the source omits physics. The
 * reference values of the case then belong to another model. */
int case_omits_nothing(const case_type *, const double value[]);

status case_build(const case_type *, const double value[], scene *s, fault *f);

#endif
