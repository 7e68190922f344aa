/* One element of two nodes, without a model around it. */
#ifndef BEAMWORK_TEST_PAIR_H
#define BEAMWORK_TEST_PAIR_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/beamw/twist.h"
#include "elements/element.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/nodes.h"
#include "elements/test/sections.h"

enum { N = 14, STRAINS = 8 };

typedef struct pair_subject {
    const element_type *type;
    union {
        double align;
        unsigned char bytes[1 << 15];
    } store;
} pair_subject;

static inline const element_data *data_of(const pair_subject *s)
{
    return (const element_data *)s->store.bytes;
}

/* One option of all has another value than its default. */
static inline void start_with(pair_subject *s, const element_type *type, const section *c,
                              double l0, unsigned features, const char *option, double value)
{
    double options[ELEMENT_MAX_OPTIONS] = {0};
    for (int i = 0; i < parameter_count(type->options); i++)
        options[i] = strcmp(parameter_at(type->options, i)->name, option) == 0
                         ? value
                         : parameter_at(type->options, i)->value;
    const element_request request = {
        .section = c, .length = l0, .features = features, .options = options};
    fault f;
    s->type = type;
    gsl_test(type->data_size(&request) > sizeof s->store, "%s: data fits", type->name);
    gsl_test(type->prepare(&request, (element_data *)s->store.bytes, &f) != STATUS_OK,
             "%s: prepared", type->name);
}

static inline void start(pair_subject *s, const element_type *type, const section *c, double l0,
                         unsigned features)
{
    start_with(s, type, c, l0, features, "", 0);
}

/* A sheet without warping shear, which N does not have: length 0.1 m, slender enough in neither
 * direction to hide Phi. */
static inline section sheet(void)
{
    section_spec spec = section_spec_rectangle(2e11, 7.7e10, 0.06, 0.02);
    spec.shear_factor[0] = spec.shear_factor[1] = 0.85;
    spec.sheet_warping = 1;
    section c = sections_computed(&spec);
    c.F[8] = 0;
    return c;
}

#endif
