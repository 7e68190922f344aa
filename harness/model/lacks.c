/* What a type offers in one direction only (element.h): how much of it a scene would have needed, and where that is too much. */
#include <math.h>
#include <stdio.h>

#include "elements/math/dense.h"
#include "harness/model/parts.h"

/* A member whose ends do not turn bends by F l^3/(12 EI) and slides by F l/(kGA): Phi = 12 EI/(kGA l^2) of its deflection is shear
 * (a cantilever: a quarter of that; a half-wave of n in the member: about n^2 times it). Beyond this part of it a rigid
 * section is another model, not a discretisation. */
static const double largest_phi = 0.01;

/* Largest Phi of bending along y among the members; NAN where the sections cannot be computed. */
static double phi_along_y(const scene *s)
{
    double largest = 0;
    for (int i = 0; i < s->members; i++) {
        const scene_member *m = &s->member[i];
        section c;
        double between[3];
        if (section_compute(&s->section[m->section], &c, NULL) != STATUS_OK)
            continue; /* model_alloc says why */
        for (int k = 0; k < 3; k++)
            between[k] = s->node[m->q].position[k] - s->node[m->p].position[k];
        const double l = vec3_norm(between);
        largest = fmax(largest, 12 * c.young * c.Iz * c.F[0] / (c.shear_modulus * l * l));
    }
    return largest;
}

int model_lacks(const scene *s, const element_type *type, char *words, int size)
{
    if (size > 0)
        words[0] = '\0';
    if (!(type->lacks & LACKS_SHEAR_Y) || !(model_needs(s) & FEATURE_SHEAR))
        return 0;
    const double phi = phi_along_y(s);
    snprintf(words, (size_t)size, "shear flexibility along y (%s), %.2g of the deflection of a member guided at both ends",
             type->lacks_by, phi);
    return phi > largest_phi ? 2 : 1;
}
