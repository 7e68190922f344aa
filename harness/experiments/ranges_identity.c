#include "harness/experiments/ranges_identity.h"

#include "harness/formulations/formulations.h"

static void add_count(digest *plan, long count)
{
    digest_add_number(plan, (double)count);
}

static void identity_add_axis(digest *plan, const sweep_axis *a)
{
    digest_add_text(plan, a->of->name);
    add_count(plan, a->kind);
    add_count(plan, a->count);
    digest_add_number(plan, a->from);
    digest_add_number(plan, a->to);
    for (int i = 0; a->value != NULL && i < a->count; i++)
        digest_add_number(plan, a->value[i]);
}

void ranges_identity_add(const parameter_ranges *r, digest *plan)
{
    digest_add_text(plan, r->request.type->name);
    for (int i = 0; i < parameters_count(r->request.type); i++)
        digest_add_number(plan, r->base[i]);
    add_count(plan, r->design.axes);
    for (int i = 0; i < r->design.axes; i++)
        identity_add_axis(plan, &r->axis[i]);
    digest_add_text(plan, design_name(r->design.kind));
    add_count(plan, r->design.points);
    add_count(plan, (long)r->design.seed);
    add_count(plan, r->formulations);
    for (int i = 0; i < r->formulations; i++)
        digest_add_text(plan, r->formulation[i].key);
    add_count(plan, r->meshes);
    for (int i = 0; i < r->meshes; i++)
        add_count(plan, r->mesh[i]);
    for (int i = 0; i < r->quantities; i++)
        digest_add_text(plan, r->quantity[i].name);
    digest_add_number(plan, r->request.tolerance);
    add_count(plan, r->request.time_limit);
    add_count(plan, r->request.derive != NULL);
    add_count(plan, r->points_in_batch);
}
