/* What a scene needs and a formulation does not offer, in words. */
#include "harness/model/missing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/model/features.h"
#include "harness/model/lacks.h"
#include "harness/model/model_impl.h"

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
