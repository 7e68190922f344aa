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

enum { N = 14, STRAINS = 8 };

typedef struct subject {
    const element_type *type;
    union {
        double align;
        unsigned char bytes[1 << 15];
    } store;
} subject;

static inline const element_data *data_of(const subject *s)
{
    return (const element_data *)s->store.bytes;
}

/* One option of all has another value than its default. */
static inline void start_with(subject *s, const element_type *type, const section *c, double l0, unsigned features,
                              const char *option, double value)
{
    double options[ELEMENT_MAX_OPTIONS] = {0};
    for (int i = 0; type->options != NULL && type->options[i].name != NULL; i++)
        options[i] = strcmp(type->options[i].name, option) == 0 ? value : type->options[i].value;
    const element_request request = {.section = c, .length = l0, .features = features, .options = options};
    fault f;
    s->type = type;
    gsl_test(type->data_size(&request) > sizeof s->store, "%s: data fits", type->name);
    gsl_test(type->prepare(&request, (element_data *)s->store.bytes, &f) != STATUS_OK, "%s: prepared", type->name);
}

static inline void start(subject *s, const element_type *type, const section *c, double l0, unsigned features)
{
    start_with(s, type, c, l0, features, "", 0);
}

/* A sheet without warping shear, which N does not have: length 0.1 m, slender enough in neither direction to hide Phi. */
static inline section sheet(void)
{
    section_spec spec;
    section c;
    fault f;
    section_spec_init(&spec);
    spec.kind = SECTION_RECTANGLE;
    spec.young = 2e11;
    spec.shear_modulus = 7.7e10;
    spec.width = 0.06;
    spec.height = 0.02;
    spec.shear_factor[0] = spec.shear_factor[1] = 0.85;
    spec.sheet_warping = 1;
    gsl_test(section_compute(&spec, &c, &f) != STATUS_OK, "section of the sheet");
    c.F[8] = 0;
    return c;
}

static inline void mul_turn(double R[9], const double phi[3])
{
    double q[4], turn[9], old[9];
    memcpy(old, R, sizeof old);
    rotation_exp(phi, q);
    rotation_matrix(q, turn);
    mat3_mul(turn, old, R);
}

/* Nodes of an element along x moved by d [14]. */
static inline void place(double l0, const double d[N], node_state x[2])
{
    for (int node = 0; node < 2; node++) {
        const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, *step = d + 7 * node;
        memcpy(x[node].R, identity, sizeof identity);
        mul_turn(x[node].R, step + 3);
        for (int i = 0; i < 3; i++) {
            x[node].u[i] = step[i];
            x[node].r[i] = step[i] + (i == 0 ? node * l0 : 0);
        }
        x[node].a = step[6];
    }
}

#endif
