#include "harness/model/model_impl.h"

#include <math.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/section/section.h"
#include "elements/section/walls.h"

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
            needs |= FEATURE_GEOMETRIC | (scene_inputs_flutter(s, i) ? FEATURE_MASS : 0);
            break;
        case SCENE_MODAL:
        case SCENE_HARMONIC:
            needs |= FEATURE_MASS | (s->analysis[i].follows != SCENE_NONE ? FEATURE_GEOMETRIC : 0);
            break;
        case SCENE_ROTATION:
        case SCENE_MOTION:
            needs |= FEATURE_LARGE | FEATURE_MASS;
            break;
        }
    return needs;
}

unsigned features_of_quantities(const scene *s)
{
    unsigned needs = 0;
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].what.kind == SCENE_INTERNAL &&
            scene_internal_of(&s->quantity[i])->resultant == SCENE_MX_WAGNER)
            needs |= FEATURE_TRAPEZE;
    return needs;
}

static int elements_have_mass(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MODAL || s->analysis[i].kind == SCENE_HARMONIC ||
            s->analysis[i].kind == SCENE_ROTATION || scene_rotates(&s->analysis[i]) ||
            scene_spreads(&s->analysis[i]) ||
            (s->analysis[i].kind == SCENE_BUCKLING && scene_inputs_flutter(s, i)))
            return 1;
    return 0;
}

static int is_used(const scene *s, int index)
{
    for (int i = 0; i < s->members; i++)
        if (s->member[i].section == index || s->member[i].section_q == index)
            return 1;
    return 0;
}

/* Returns the second-order physics that the constants of a section require; 0: the analyses do not
 * include stresses. */
static unsigned needs_of_stresses(const section *c, unsigned needs)
{
    const double arm = sqrt(c->Ip / c->A), zero = 1e-10;
    unsigned out = FEATURE_TRAPEZE;
    if (!(needs & (FEATURE_GEOMETRIC | FEATURE_LARGE)))
        return 0;
    if (hypot(c->wagner_y, c->wagner_z) > zero * c->Ip * arm)
        out |= FEATURE_WAGNER_MOMENTS;
    if ((needs & FEATURE_LARGE) && fabs(c->wagner_torque) > zero * c->Ip * arm * arm)
        out |= FEATURE_WAGNER_TORQUE;
    return out;
}

static unsigned needs_of_constants(const section *c, unsigned needs)
{
    unsigned out = needs_of_stresses(c, needs);
    for (int i = 0; i < 3; i++)
        out |= c->F[4 * i] > 0 && (i < 2 || c->Iw > 0) ? FEATURE_SHEAR : 0;
    out |= c->Iw > 0 ? FEATURE_WARPING : 0;
    out |= features_eccentric(c) ? FEATURE_ECCENTRIC : 0;
    return out | (needs & FEATURE_MASS && c->density > 0 ? FEATURE_ROTARY_INERTIA : 0);
}

static unsigned needs_of_matrices(const scene *s, const section *c, unsigned needs, unsigned omits)
{
    const unsigned rotary = needs & FEATURE_MASS ? FEATURE_ROTARY_INERTIA & ~omits : 0;
    const int coupled = section_matrices_couple(c, elements_have_mass(s), rotary != 0);
    return FEATURE_SHEAR | rotary | (coupled ? FEATURE_COUPLED : 0);
}

static int is_sheared(unsigned needs)
{
    return (needs & FEATURE_SHEAR) && (needs & (FEATURE_GEOMETRIC | FEATURE_LARGE));
}

static unsigned needed_without(const scene *s, unsigned omits)
{
    unsigned needs = s->demands | needs_of_analyses(s) | (features_of_quantities(s) & ~omits),
             all = needs;
    for (int i = 0; i < s->members; i++)
        all |= vec3_norm(s->member[i].strain) > 0 ? FEATURE_CURVATURE : 0;
    for (int i = 0; i < s->sections; i++) {
        section c;
        if (!is_used(s, i) || scene_constants(s, i, &c, NULL) != STATUS_OK)
            continue; /* model_alloc reports the error */
        all |= c.matrices ? needs_of_matrices(s, &c, needs, omits)
                          : needs_of_constants(&c, needs) & ~omits;
    }
    if (is_sheared(all))
        all |= s->shear_theory == SCENE_SHEAR_HARINGX    ? FEATURE_HARINGX
               : s->shear_theory == SCENE_SHEAR_ENGESSER ? FEATURE_ENGESSER
                                                         : 0;
    return all;
}

unsigned features_needed(const scene *s)
{
    return needed_without(s, s->omits);
}

unsigned features_omitted(const scene *s)
{
    return needed_without(s, 0) & ~needed_without(s, s->omits) & SCENE_OMITTABLE;
}

/* Returns the physics that a section given by constants specifies explicitly: declared as zero or,
 * for warping and the Wagner torque, given by a value. */
static unsigned features_zero(const section_spec *spec)
{
    const unsigned zeros = spec->zeros, moments = SECTION_ZERO_WAGNER_Y | SECTION_ZERO_WAGNER_Z;
    const int warps = !isnan(spec->given.Iw), torque = !isnan(spec->given.wagner_torque);
    return (zeros & SECTION_ZERO_SHEAR ? FEATURE_SHEAR : 0) |
           (warps || (zeros & SECTION_ZERO_WARPING) ? FEATURE_WARPING : 0) |
           ((zeros & moments) == moments ? FEATURE_WAGNER_MOMENTS : 0) |
           (torque || (zeros & SECTION_ZERO_WAGNER_TORQUE) ? FEATURE_WAGNER_TORQUE : 0);
}

unsigned features_not_given(const scene *s, int section_index)
{
    const unsigned higher = FEATURE_TRAPEZE | FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE,
                   needs = needs_of_analyses(s);
    section c;
    unsigned out = FEATURE_WARPING;
    if (!is_used(s, section_index) || scene_constants(s, section_index, &c, NULL) != STATUS_OK)
        return 0;
    if (c.matrices) {
        out |= higher;
    } else if (s->section[section_index].kind == SECTION_CONSTANTS) {
        const unsigned has =
            needs_of_constants(&c, ~0U) | features_zero(&s->section[section_index]);
        const int symmetric = !features_eccentric(&c);
        out = (FEATURE_SHEAR | FEATURE_WARPING | FEATURE_WAGNER_TORQUE |
               (symmetric ? 0 : FEATURE_WAGNER_MOMENTS)) &
              ~has;
    } else {
        return 0;
    }
    if (!(needs & (FEATURE_GEOMETRIC | FEATURE_LARGE)))
        out &= ~higher;
    if (!(needs & FEATURE_LARGE))
        out &= ~(unsigned)FEATURE_WAGNER_TORQUE;
    if (s->plane != SCENE_SPACE)
        out &= FEATURE_SHEAR;
    return out & ~s->omits;
}

int features_one_sided(const scene *s, int section_index)
{
    const unsigned left_out = s->omits & (FEATURE_WARPING | FEATURE_WAGNER_TORQUE);
    section c;
    return is_used(s, section_index) && left_out == 0 && s->plane == SCENE_SPACE &&
           (needs_of_analyses(s) & (FEATURE_GEOMETRIC | FEATURE_LARGE)) != 0 &&
           scene_constants(s, section_index, &c, NULL) == STATUS_OK && c.Iw > 0 &&
           walls_one_sided(&s->section[section_index]) > 1e-6;
}

int features_sheared(const scene *s)
{
    return is_sheared(features_needed(s));
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
    if (!is_sheared(needs))
        return 0;
    if (type->shear_theories & SHEAR_OWN)
        return SHEAR_OWN;
    if (needs & FEATURE_HARINGX)
        return SHEAR_HARINGX;
    /* Engesser's theory is used if the type has both theories and none is requested. */
    return needs & FEATURE_ENGESSER || type->shear_theories & SHEAR_ENGESSER ? SHEAR_ENGESSER
                                                                             : type->shear_theories;
}

const char *features_theory_words(const element_type *type, unsigned theory)
{
    if (theory == SHEAR_OWN)
        return type->own_theory;
    return theory == SHEAR_ENGESSER ? "Engesser" : theory == SHEAR_HARINGX ? "Haringx" : "";
}

unsigned features_needed_by_quantity(const scene *s, int quantity)
{
    const unsigned inertia = FEATURE_MASS | FEATURE_ROTARY_INERTIA;
    const int analysis = s->quantity[quantity].analysis;
    const int moves = analysis >= 0 && (s->analysis[analysis].kind == SCENE_MODAL ||
                                        s->analysis[analysis].kind == SCENE_HARMONIC ||
                                        s->analysis[analysis].kind == SCENE_ROTATION ||
                                        scene_rotates(&s->analysis[analysis]));
    return features_needed(s) & (moves ? ~0U : ~inertia);
}

status features_of_section(const model *m, int index, unsigned *features, fault *f)
{
    (void)f;
    const section *c = &m->section[index];
    const unsigned beyond_matrices =
        FEATURE_WARPING | FEATURE_TRAPEZE | FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE;
    *features = m->features & m->mesh.type->offers;
    *features &= ~(c->matrices ? beyond_matrices : m->scene->omits & FEATURE_SHEAR);
    if (c->Iw <= 0 && !m->keep_all)
        *features &= ~(unsigned)FEATURE_WARPING;
    if (!features_eccentric(c))
        *features &= ~(unsigned)FEATURE_ECCENTRIC;
    return STATUS_OK;
}

static int knows_constants_only(const scene *s, const element_type *type)
{
    int matrices = 0;
    for (int i = 0; i < s->sections; i++)
        matrices |= is_used(s, i) && s->section[i].kind == SECTION_MATRICES;
    return matrices && type->mass_of_field == NULL && !(type->offers & FEATURE_COUPLED);
}

int features_spreads(const scene *s, int analysis, const element_type *type, const double options[])
{
    return scene_may_spread(s, analysis) && element_spreads(type, options) &&
           !knows_constants_only(s, type);
}
