/* One element of a formulation, for what every formulation must keep. */
#ifndef BEAMWORK_TEST_CONTRACT_H
#define BEAMWORK_TEST_CONTRACT_H

#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "harness/catalogue/parameters.h"

enum { MOST_STRAINS = ELEMENT_MAX_STRAINS, MOST = ELEMENT_MAX_COORDINATES };

typedef struct subject {
    const element_type *type;
    section section;
    double options[ELEMENT_MAX_OPTIONS], length, unit; /* unit: metres per length unit */
    element_data *data;
    int nodes, strains, coordinates, inner, memory;
} subject;

/* Lengths in units of `unit` metres, force in newtons. */
static inline status contract_prepare_of(const section_spec *spec, const element_type *type,
                                         unsigned features, double unit, subject *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->type = type;
    out->unit = unit;
    out->length = 0.2385 / unit;
    parameter_defaults(type->options, out->options);
    gsl_test(section_compute(spec, &out->section, f) != STATUS_OK, "%s: section", type->name);
    const element_request request = {.section = &out->section,
                                     .length = out->length,
                                     .features = features,
                                     .options = out->options};
    out->nodes = element_nodes(type, out->options);
    out->strains = element_strains(type, out->options);
    out->inner = element_inner(type, out->options);
    out->memory = element_memory(type, out->options);
    out->coordinates = NODE_COORDINATES * out->nodes;
    out->data = calloc(1, type->data_size(&request));
    return type->prepare(&request, out->data, f);
}

/* A rectangle: what every formulation can do. */
static inline status contract_prepare(const element_type *type, unsigned features, double unit,
                                      subject *out, fault *f)
{
    section_spec spec = section_spec_rectangle(210e9 * unit * unit, 80.7e9 * unit * unit,
                                               0.0371 / unit, 0.0123 / unit);
    spec.density = 7850 * unit * unit * unit;
    spec.shear_factor[0] = spec.shear_factor[1] = 0.847;
    return contract_prepare_of(&spec, type, features, unit, out, f);
}

/* Energy with inner unknowns solved for: Newton on the element's own equations. */
static inline status contract_settled(const subject *s, const double e[], double inner[],
                                      stress_output *out)
{
    double memory[4096], residual = 1;
    const double none[MOST_STRAINS] = {0};
    if (s->inner > 0)
        for (int i = 0; i < 30; i++) {
            TRY(s->type->stress(s->data, e, inner,
                                &(stress_output){.residual = &residual, .memory = memory}));
            if (s->type->update(s->data, none, memory, inner) < 1e-15)
                break;
        }
    out->memory = s->memory > 0 ? memory : NULL;
    const status outcome = s->type->stress(s->data, e, inner, out);
    out->memory = NULL;
    return outcome;
}

static inline void contract_rest(const subject *s, double inner[])
{
    if (s->type->rest != NULL)
        s->type->rest(s->data, inner);
}

#endif
