/* What all built-in cases leave to their user: the physics that is left out, what its source leaves
 * out or nothing; and, where there is mass, how that of members lies. */
#include <stddef.h>

#include "cases/case.h"

static const char omitted[] =
    "physics omitted: what the source of the case omits, or nothing, whatever the other "
    "parameters say; values of the source are not those of the latter";

const parameter_type case_omit[] = {
    {"omit", "", 0, 0, 0, "source|none", omitted},
    {0},
};
const parameter_type case_mass_omit[] = {
    {"mass", "", SCENE_MASS_USUAL, 0, 0, "usual|" SCENE_MASS_CHOICES,
     "of members: along them where formulation and integrator have it so, halves at the nodes, or "
     "along them and refused without"},
    {"omit", "", 0, 0, 0, "source|none", omitted},
    {0},
};

int case_is_omit(const parameter_type *p)
{
    return p == case_omit || p == case_mass_omit + 1;
}

int case_is_mass(const parameter_type *p)
{
    return p == case_mass_omit;
}

int case_omits_nothing(const case_type *c, const double value[])
{
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++)
        if (case_is_omit(p))
            return value[i] != 0;
    return 0;
}

static void place_mass(scene *s, scene_mass mass)
{
    s->lumped = mass == SCENE_LUMPED;
    for (int i = 0; i < s->analyses && mass == SCENE_CONSISTENT; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            s->analysis[i].of.motion.mass = mass;
}

/* Where the case leaves it to its user; a scene file that does not says it itself. */
static void choose_mass(const case_type *c, const double value[], scene *s)
{
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++)
        if (case_is_mass(p))
            place_mass(s, (scene_mass)value[i]);
}

status case_build(const case_type *c, const double value[], scene *s, fault *f)
{
    TRY(c->build != NULL ? c->build(value, s, f) : c->build_from(c->context, value, s, f));
    if (case_omits_nothing(c, value))
        s->omits = 0;
    choose_mass(c, value, s);
    return STATUS_OK;
}
