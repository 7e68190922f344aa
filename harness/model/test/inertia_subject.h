/* An element with inertia and an unsymmetric section (a rectangle where only that is possible). */
#ifndef BEAMWORK_TEST_INERTIA_SUBJECT_H
#define BEAMWORK_TEST_INERTIA_SUBJECT_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>

#include "elements/element.h"
#include "elements/test/sections.h"
#include "harness/catalogue/parameters.h"
#include "harness/catalogue/registry.h"

enum { MOST = ELEMENT_MAX_COORDINATES };

typedef struct inertia_subject {
    const element_type *type;
    element_data *data;
    section section;
    double length; /* [m] */
    int nodes, coordinates;
    char name[96];
} inertia_subject;

static inline void inertia_subject_section(const element_type *type, section *out)
{
    static const double point[4][2] = {{0, 0}, {0.031, 0}, {0.031, 0.057}, {0.012, 0.057}};
    static const double thickness[3] = {0.0013, 0.002, 0.0027};
    section_spec spec = type->limits & LIMIT_DOUBLY_SYMMETRIC
                            ? section_spec_rectangle(210e9, 80.7e9, 0.0371, 0.0123)
                            : section_spec_walls(210e9, 80.7e9, 3, point, NULL, thickness);
    spec.density = 7850;
    *out = sections_computed(&spec);
    out->Iw = out->A * pow(0.2, 4); /* so that warping is as large as what is compared with it */
}

/* Of the section that is there.  0: refused, and the test has failed; data to be freed in any case.
 */
static inline int inertia_subject_prepare_of(const element_type *type, const double options[],
                                             unsigned features, inertia_subject *s)
{
    fault f = {""};
    s->type = type;
    s->length = 0.2385;
    s->nodes = element_nodes(type, options);
    s->coordinates = NODE_COORDINATES * s->nodes;
    const element_request request = {
        .section = &s->section, .length = s->length, .features = features, .options = options};
    s->data = calloc(1, type->data_size(&request));
    const int made = type->prepare(&request, s->data, &f) == STATUS_OK;
    gsl_test(!made, "%s: prepared (%s)", type->name, f.text);
    return made;
}

static inline int inertia_subject_prepare(const element_type *type, const double options[],
                                          unsigned features, inertia_subject *s)
{
    inertia_subject_section(type, &s->section);
    return inertia_subject_prepare_of(type, options, features, s);
}

/* All formulations that have an inertia, with every mass they offer. */
typedef void inertia_subject_test(const element_type *type, const double options[], int choice);

static inline void inertia_subject_each(inertia_subject_test *test)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        double options[ELEMENT_MAX_OPTIONS] = {0};
        if (type->inertia == NULL || !(type->offers & FEATURE_MASS))
            continue;
        parameter_defaults(type->options, options);
        const int mass = parameter_index(type->options, "mass"),
                  choices = mass < 0 ? 1 : parameter_choices(parameter_at(type->options, mass));
        for (int choice = 0; choice < choices; choice++) {
            if (choices > 1)
                options[mass] = choice;
            test(type, options, choice);
        }
    }
}

#endif
