#include "harness/time/checks.h"

#include "harness/time/drive.h"
#include "harness/time/forms.h"
#include "harness/time/massless.h"

static status check_newton(const analysis_context *c, const scene_motion *how, fault *f)
{
    const newton_form newton = c->options->newton;
    if (newton == NEWTON_DENSE)
        return fault_set(f, STATUS_REFUSED,
                         "motions in time need a factored tangent, which newton=dense does not "
                         "make; give newton=mixed");
    if (newton == NEWTON_DISPLACEMENT && how->scheme == SCENE_CONSERVING)
        return fault_set(f, STATUS_REFUSED,
                         "the integrator conserving needs strains as unknowns; give newton=mixed");
    return STATUS_OK;
}

/* What consistent mass does not go with. */
static status check_mass(const analysis_context *c, int analysis, fault *f)
{
    const scene_analysis *one = &c->scene->analysis[analysis];
    const int spreads = model_spreads(c->model, analysis), follows = one->follows;
    const scene_scheme scheme = scene_motion_of(one)->scheme;
    if ((spreads || scene_spreads(one)) && (scheme == SCENE_CONSERVING || scheme == SCENE_EXPLICIT))
        return fault_set(f, STATUS_REFUSED,
                         "the integrator %s has lumped mass only; alpha and radau take mass: "
                         "consistent",
                         scheme == SCENE_CONSERVING ? "conserving" : "explicit");
    if (!spreads && scene_spreads(one))
        return fault_set(f, STATUS_REFUSED,
                         "the mass of %s is lumped at its nodes; give mass: lumped, or another "
                         "formulation",
                         model_formulation(c->model));
    if (follows != SCENE_NONE && c->scene->analysis[follows].kind == SCENE_MOTION &&
        model_spreads(c->model, follows) != spreads)
        return fault_set(f, STATUS_REFUSED,
                         "a motion continues with the mass of the motion before it; give both "
                         "lumped or both consistent");
    return STATUS_OK;
}

status checks_of(const analysis_context *c, int analysis, fault *f)
{
    TRY(check_newton(c, scene_motion_of(&c->scene->analysis[analysis]), f));
    TRY(check_mass(c, analysis, f));
    TRY(forms_check(c->model, f));
    return drive_check(c->model, f);
}

status checks_massless(const analysis_context *c, const carried_masses *masses,
                       const scene_motion *how, const model_state *begin, fault *f)
{
    int massless;
    TRY(massless_count(c->model, masses, begin, &massless, f));
    if (massless == 0 || how->scheme != SCENE_ALPHA || how->alpha.force > how->alpha.mass)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%d coordinates have no inertia: their accelerations would grow by the "
                     "trapezoidal rule and with rho = 1; take rho < 1 or radau, or give the "
                     "sections rotary inertia (do not omit rotary_inertia)",
                     massless);
}
