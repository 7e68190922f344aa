#include "harness/motion/integrator.h"

#include "harness/conserving/conserving.h"
#include "harness/explicit/explicit.h"
#include "harness/radau/radau.h"
#include "harness/scheme/alpha.h"
#include "harness/scheme/damping.h"

status integrator_alloc(const scheme_request *r, scheme **out, fault *f)
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

void integrator_free(scheme *s)
{
    if (s != NULL)
        s->free(s);
}
