/* What a scene needs and a formulation does not offer, in words. */
#include "harness/model/missing.h"

#include <math.h>
#include <stdio.h>

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
