/* What a scene needs, in features of formulations. */
#include "harness/model/features.h"

#include <math.h>

#include "elements/math/dense.h"
#include "elements/section/matrices.h"
#include "harness/model/model_impl.h"

int features_eccentric(const section *c)
{
    return hypot(c->ys, c->zs) > 1e-12 * sqrt(c->Ip / c->A);
}

static unsigned needs_of_analyses(const scene *s)
{
    unsigned needs = 0;
    for (int i = 0; i < s->analyses; i++)
        switch (s->analysis[i].kind) {
        case SCENE_LINEAR:
        case SCENE_COMPLIANCE:
            break;
        case SCENE_STATIC:
        case SCENE_CONTINUATION:
            needs |= FEATURE_LARGE | (scene_rotates(&s->analysis[i]) ? FEATURE_MASS : 0);
            break;
        case SCENE_BUCKLING:
            needs |= FEATURE_GEOMETRIC;
            break;
        case SCENE_MODAL:
            needs |= FEATURE_MASS | (s->analysis[i].follows != SCENE_NONE ? FEATURE_GEOMETRIC : 0);
            break;
        case SCENE_ROTATION:
        case SCENE_MOTION:
            needs |= FEATURE_LARGE | FEATURE_MASS;
            break;
        }
    return needs;
}

/* The torque of stresses along the fibres is there where they are turned. */
unsigned features_of_quantities(const scene *s)
{
    unsigned needs = 0;
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].what.kind == SCENE_INTERNAL &&
            scene_internal_of(&s->quantity[i])->resultant == SCENE_MX_WAGNER)
            needs |= FEATURE_TRAPEZE;
    return needs;
}

/* Do formulations give their own inertia? A motion in time with lumped mass has that of the
 * section, with all of them alike. */
static int elements_have_mass(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MODAL || s->analysis[i].kind == SCENE_ROTATION ||
            scene_rotates(&s->analysis[i]) || scene_spreads(&s->analysis[i]))
            return 1;
    return 0;
}

static unsigned needs_of_matrices(const scene *s, const section *c, unsigned needs)
{
    if (!c->matrices)
        return 0;
    const int coupled =
        section_matrices_couple(c, elements_have_mass(s), (needs & FEATURE_ROTARY_INERTIA) != 0);
    return FEATURE_SHEAR | (coupled ? FEATURE_COUPLED : 0);
}

unsigned features_needed(const scene *s)
{
    unsigned needs = s->needs | needs_of_analyses(s) | features_of_quantities(s);
    for (int i = 0; i < s->members; i++)
        needs |= vec3_norm(s->member[i].strain) > 0 ? FEATURE_CURVATURE : 0;
    for (int i = 0; i < s->sections; i++) {
        section c;
        if (scene_constants(s, i, &c, NULL) != STATUS_OK)
            continue; /* model_alloc says why */
        needs |= c.Iw > 0 ? FEATURE_WARPING : 0;
        needs |= needs_of_matrices(s, &c, needs);
        needs |= features_eccentric(&c) ? FEATURE_ECCENTRIC : 0;
    }
    return needs;
}

static unsigned theory_features(unsigned theories)
{
    return (theories & SHEAR_ENGESSER ? FEATURE_ENGESSER : 0) |
           (theories & SHEAR_HARINGX ? FEATURE_HARINGX : 0);
}

unsigned features_needed_of(const scene *s, const element_type *type)
{
    const unsigned theories = FEATURE_ENGESSER | FEATURE_HARINGX, needs = features_needed(s),
                   has = theory_features(type->shear_theories);
    return (needs & theories) == 0 || (needs & theories & has) != 0 ? needs
                                                                    : (needs & ~theories) | has;
}

unsigned features_theory(const scene *s, const element_type *type)
{
    const unsigned needs = features_needed_of(s, type);
    if (!(needs & FEATURE_SHEAR))
        return 0;
    if (type->shear_theories & SHEAR_OWN)
        return SHEAR_OWN;
    if (needs & FEATURE_ENGESSER)
        return SHEAR_ENGESSER;
    return needs & FEATURE_HARINGX ? SHEAR_HARINGX : 0;
}

unsigned features_needed_by_quantity(const scene *s, int quantity)
{
    const unsigned inertia = FEATURE_MASS | FEATURE_ROTARY_INERTIA;
    const int analysis = s->quantity[quantity].analysis;
    const int moves = analysis >= 0 && (s->analysis[analysis].kind == SCENE_MODAL ||
                                        s->analysis[analysis].kind == SCENE_ROTATION ||
                                        scene_rotates(&s->analysis[analysis]));
    return features_needed(s) & (moves ? ~0U : ~inertia);
}

/* What elements of one section are asked for. */
status features_of_section(const model *m, int index, unsigned *features, fault *f)
{
    (void)f;
    const section *c = &m->section[index];
    *features = m->features & m->type->offers;
    if ((c->Iw <= 0 && !m->keep_all) || c->matrices)
        *features &= ~(unsigned)FEATURE_WARPING;
    if (!features_eccentric(c))
        *features &= ~(unsigned)FEATURE_ECCENTRIC;
    return STATUS_OK;
}
