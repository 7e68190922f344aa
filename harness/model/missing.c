/* What a scene needs and a formulation does not offer, in words. */
#include "harness/model/missing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* Shear flexibilities off the diagonal, beyond the round-off of those on it. */
static int is_coupled(const section *c)
{
    static const int row[3] = {0, 0, 1}, column[3] = {1, 2, 2};
    int coupled = 0;
    for (int k = 0; k < 3; k++)
        coupled |= fabs(c->F[3 * row[k] + column[k]]) >
                   1e-12 * sqrt(c->F[4 * row[k]] * c->F[4 * column[k]]);
    return coupled;
}

const char *missing_in_section(const element_type *type, const section *c, int cells, int warps)
{
    if ((type->limits & LIMIT_DOUBLY_SYMMETRIC) && (features_eccentric(c) || is_coupled(c)))
        return "sections that are not doubly symmetric";
    if ((type->limits & LIMIT_WARPING_RIGID) && warps && cells > 0 && c->Iw > 0)
        return "shear of warping, by which closed cells warp";
    return NULL;
}

static int limit_hit(const scene *s, const element_type *type, char *words, int size)
{
    const int warps = (features_needed(s) & FEATURE_WARPING) != 0;
    for (int i = 0; i < s->sections; i++) {
        section c;
        if (scene_constants(s, i, &c, NULL) != STATUS_OK)
            continue;
        const char *limit = missing_in_section(type, &c, s->section[i].cells, warps);
        if (limit != NULL)
            return snprintf(words, (size_t)size, "%s", limit) > 0;
    }
    return 0;
}

/* A motion asks for it. */
static int mass_lacks(const scene *s, const element_type *type, char *words, int size)
{
    for (int i = 0; i < s->analyses && !type->spreads; i++)
        if (scene_spreads(&s->analysis[i]))
            return snprintf(words, (size_t)size, "consistent mass in time") > 0;
    return 0;
}

/* Curved members can be made of straight elements: what a scene needs of this feature is the strain
 * of its members. */
static void words_of(unsigned missing, char *words, int size)
{
    const int used = feature_words(missing & ~(unsigned)FEATURE_CURVATURE, words, size);
    if ((missing & FEATURE_CURVATURE) && used < size)
        snprintf(words + used, (size_t)(size - used), "%sinitial strain", used > 0 ? ", " : "");
}

int missing_words(const scene *s, const element_type *type, char *words, int size)
{
    const unsigned missing = features_needed_of(s, type) & ~type->offers;
    if (size > 0)
        words[0] = '\0';
    if (missing != 0) {
        words_of(missing, words, size);
        return 1;
    }
    if (mass_lacks(s, type, words, size) || limit_hit(s, type, words, size) ||
        lacks_of(s, type, words, size) > 1)
        return 1;
    if (size > 0)
        words[0] = '\0';
    return 0;
}

/* Features without which a structure is still one: its loads and supports keep their meaning. */
static unsigned can_be_omitted(const scene *s)
{
    const unsigned physics = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_ECCENTRIC | FEATURE_TRAPEZE |
                             FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE |
                             FEATURE_ROTARY_INERTIA;
    return physics & ~features_of_quantities(s);
}

int missing_refused(const scene *s, const element_type *type, char *words, int size)
{
    const unsigned missing = features_needed_of(s, type) & ~type->offers & ~can_be_omitted(s);
    if (size > 0)
        words[0] = '\0';
    if (missing != 0) {
        words_of(missing, words, size);
        return 1;
    }
    return mass_lacks(s, type, words, size);
}

/* What sections have beyond the limits of the type. */
static unsigned omits_of_sections(const scene *s, const element_type *type)
{
    const int warps = (features_needed(s) & FEATURE_WARPING) != 0;
    unsigned omits = 0;
    for (int i = 0; i < s->sections; i++) {
        section c;
        if (scene_constants(s, i, &c, NULL) != STATUS_OK ||
            missing_in_section(type, &c, s->section[i].cells, warps) == NULL)
            continue;
        if (!(type->limits & LIMIT_DOUBLY_SYMMETRIC))
            omits |= FEATURE_WARPING;
        else if (features_eccentric(&c))
            omits |= FEATURE_ECCENTRIC;
        else
            omits |= is_coupled(&c) ? OMIT_SHEAR_COUPLING : FEATURE_WARPING;
    }
    return omits & FEATURE_ECCENTRIC ? omits & ~(unsigned)OMIT_SHEAR_COUPLING : omits;
}

unsigned missing_omits(const scene *s, const element_type *type)
{
    char words[OMIT_WORDS];
    const unsigned missing = features_needed_of(s, type) & ~type->offers & can_be_omitted(s);
    return missing | omits_of_sections(s, type) |
           (lacks_of(s, type, words, sizeof words) > 1 ? OMIT_SHEAR_Y : 0);
}

void missing_omit_words(unsigned omits, char words[OMIT_WORDS])
{
    static const struct {
        unsigned bit;
        const char *words;
    } more[] = {{OMIT_SHEAR_Y, "shear along y"}, {OMIT_SHEAR_COUPLING, "coupling of shear"}};
    words[0] = '\0';
    if ((omits & (FEATURE_END - 1)) != 0)
        feature_words(omits & (FEATURE_END - 1), words, OMIT_WORDS);
    for (int i = 0; i < 2; i++) {
        const size_t used = strlen(words);
        if (omits & more[i].bit)
            snprintf(words + used, OMIT_WORDS - used, "%s%s", used > 0 ? ", " : "", more[i].words);
    }
}

void missing_omit(section *c, unsigned omits)
{
    for (int i = 0; i < 9; i++) {
        const int off = i % 4 != 0 && (omits & (FEATURE_ECCENTRIC | OMIT_SHEAR_COUPLING)),
                  along_y = (i < 3 || i % 3 == 0) && (omits & OMIT_SHEAR_Y);
        if (off || along_y)
            c->F[i] = c->D[i] = 0;
    }
    if ((omits & (FEATURE_ECCENTRIC | OMIT_SHEAR_COUPLING)) && !c->matrices)
        for (int i = 0; i < 9; i += 4)
            c->D[i] = c->F[i] > 0 ? 1 / c->F[i] : 0;
    if (omits & FEATURE_ECCENTRIC)
        c->ys = c->zs = 0;
}
