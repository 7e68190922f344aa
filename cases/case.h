/* A case: a table of parameters and a function from their values to a scene.
 * One file in cases/ defines one const case_type whose symbol is case_<file name>: in C, or as a
 * scene file, which the build reads (cases/format/format_impl.h). */
#ifndef BEAMWORK_CASE_H
#define BEAMWORK_CASE_H

#include "cases/scene/scene.h"
#include "elements/shared/parameter.h"

enum { CASE_MAX_PARAMETERS = 32 };

typedef struct case_type {
    const char *name, *summary, *source;
    const parameter_type *parameters[PARAMETER_PARTS];
    /* value[i] belongs to the i-th of all parts and is inside its range.  Refuses combinations that
     * make no sense. */
    status (*build)(const double value[], scene *s, fault *f);
    /* The same of a case that is made from a scene file, where build is NULL; context: what it is
     * made from. */
    status (*build_from)(const void *context, const double value[], scene *s, fault *f);
    const void *context;
    const char *file; /* of a scene file; NULL: built in */
} case_type;

/* Last part of the parameters of every built-in case: `omit` chooses between the physics that the
 * source omits and none. case_mass_omit also chooses the mass of members, where the quantities
 * depend on it. Names of points are those without these parameters, except where a value differs
 * from its default. */
extern const parameter_type case_omit[], case_mass_omit[];
int case_is_omit(const parameter_type *);
int case_is_mass(const parameter_type *);
/* Nothing, although the source may omit something: what is known of the case is of another
 * model. */
int case_omits_nothing(const case_type *, const double value[]);

status case_build(const case_type *, const double value[], scene *s, fault *f);

#endif
