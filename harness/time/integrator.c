#include "harness/time/integrator.h"

#include "harness/time/alpha.h"
#include "harness/time/conserving.h"
#include "harness/time/damping.h"
#include "harness/time/explicit.h"
#include "harness/time/radau.h"

status integrator_alloc(const scheme_request *r, motion_scheme **out, fault *f)
{
    *out = NULL;
    if (r->how->scheme == SCENE_EXPLICIT && damping_acts(r->c->scene))
        return fault_set(f, STATUS_REFUSED,
                         "integrator explicit takes no members with damping: take another");
    switch (r->how->scheme) {
    case SCENE_ALPHA:
        return alpha_alloc(r, out, f);
    case SCENE_RADAU:
        return radau_alloc(r, out, f);
    case SCENE_CONSERVING:
        return conserving_alloc(r, out, f);
    case SCENE_EXPLICIT:
        return explicit_alloc(r, out, f);
    case SCENE_SCHEMES:
        break;
    }
    return fault_set(f, STATUS_REFUSED, "this integrator is not available");
}

void integrator_free(motion_scheme *s)
{
    if (s != NULL)
        s->free(s);
}
