/* What a type offers in one direction only (element.h): how much of it a scene would have needed,
 * and where that is too much. */
#include "harness/model/lacks.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "elements/math/dense.h"
#include "harness/model/features.h"
#include "harness/model/model_impl.h"

/* What bends over a length l with ends that do not turn gives way by F l^3/(12 EI) and slides by F
 * l/(kGA): Phi = 12 EI/(kGA l^2) of its deflection is shear (a cantilever: a quarter of that;
 * bending in n half-waves: about n^2 times it). Beyond this part of it a rigid section is another
 * model, not a discretisation. */
static const double largest_phi = 0.01;

/* Box around members that hang together. */
typedef struct box {
    double low[3], high[3];
} box;

static void include(const scene *s, int node, char *reached, box *b)
{
    reached[node] = 1;
    for (int k = 0; k < 3; k++) {
        b->low[k] = fmin(b->low[k], s->node[node].position[k]);
        b->high[k] = fmax(b->high[k], s->node[node].position[k]);
    }
}

static int shares_section(const scene_member *a, const scene_member *b)
{
    return a->section == b->section || a->section == b->section_q || a->section_q == b->section ||
           a->section_q == b->section_q;
}

/* Diagonal [m] of the box around a member and those of its section that it is connected with
 * through common nodes: a beam may be described by any number of short members. reached [nodes]:
 * not to be set; what is reached is. */
static double extent_of(const scene *s, int member, char *reached)
{
    const scene_member *first = &s->member[member];
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    include(s, first->p, reached, &b);
    include(s, first->q, reached, &b);
    for (int grows = 1; grows;) {
        grows = 0;
        for (int i = 0; i < s->members; i++) {
            const scene_member *m = &s->member[i];
            if (!shares_section(m, first) || reached[m->p] == reached[m->q])
                continue;
            include(s, reached[m->p] ? m->q : m->p, reached, &b);
            grows = 1;
        }
    }
    const double size[3] = {b.high[0] - b.low[0], b.high[1] - b.low[1], b.high[2] - b.low[2]};
    return vec3_norm(size);
}

/* Largest Phi of bending along y. */
static double phi_along_y(const scene *s)
{
    double largest = 0;
    for (int i = 0; i < s->members; i++) {
        const int end[2] = {s->member[i].section, s->member[i].section_q};
        char *reached = calloc((size_t)s->nodes + 1, 1);
        const double l = reached != NULL ? extent_of(s, i, reached) : INFINITY;
        for (int k = 0; k < 2; k++) {
            section c;
            if (scene_constants(s, end[k], &c, NULL) == STATUS_OK)
                largest = fmax(largest, 12 * c.young * c.Iz * c.F[0] / (c.shear_modulus * l * l));
        } /* model_alloc says why a section is none */
        free(reached);
    }
    return largest;
}

int lacks_of(const scene *s, const element_type *type, char *words, int size)
{
    if (size > 0)
        words[0] = '\0';
    if (!(type->lacks & LACKS_SHEAR_Y) || !(features_needed(s) & FEATURE_SHEAR))
        return 0;
    const double phi = phi_along_y(s);
    snprintf(words, (size_t)size,
             "shear flexibility along y (%s), %.2g of the deflection of a beam guided at both ends",
             type->lacks_by, phi);
    return phi > largest_phi ? 2 : 1;
}
