#include "cases/shared/cantilever.h"

void cantilever_build(double length, const cantilever_stiffness *k, scene *s, int *root, int *tip)
{
    /* Only the products matter: E = G = 1 Pa. */
    section_spec spec = section_spec_constants(1, 1);
    spec.density = k->density;
    section *c = &spec.constants;
    c->A = k->EA;
    c->Iy = c->Iz = k->EI;
    c->Ip = 2 * k->EI;
    c->It = k->GJ;
    if (k->GA > 0)
        c->F[0] = c->F[4] = 1 / k->GA;
    const int profile = scene_add_section(s, &spec);
    const double y_axis[3] = {0, 1, 0};
    *root = scene_add_node(s, 0, 0, 0);
    *tip = scene_add_node(s, length, 0, 0);
    scene_add_member(s, *root, *tip, profile, y_axis);
    scene_hold_all(s, *root);
    /* rods of no fibres; Bernoulli's have no rotary inertia either */
    scene_omit(s, FEATURE_TRAPEZE | (k->GA > 0 ? 0 : FEATURE_ROTARY_INERTIA));
    scene_meshes_doubled(s, 1, 32);
}

int cantilever_path(scene *s)
{
    const double end = 1;
    return scene_add_static(s, 1, &end, 1);
}

void cantilever_quantity(scene *s, const char *name, const char *unit, int analysis, int tip,
                         int row, double factor, double offset)
{
    scene_quantity *q = scene_add_quantity(s, name, unit, analysis, scene_coordinate(tip, row));
    q->factor = factor;
    q->offset = offset;
    q->least_order = 1.8;
}

void cantilever_bent(scene *s, int tip)
{
    const int path = cantilever_path(s);
    cantilever_quantity(s, "w_over_L", "1", path, tip, SCENE_UY, 1, 0);
    cantilever_quantity(s, "u_over_L", "1", path, tip, SCENE_UX, -1, 0);
    cantilever_quantity(s, "theta", "rad", path, tip, SCENE_RZ, 1, 0);
}

void cantilever_turning(scene *s, int rotation, int root, int tip)
{
    cantilever_quantity(s, "stretch", "1", rotation, tip, SCENE_UX, 1, 0);
    scene_quantity *pull =
        scene_add_quantity(s, "root_force", "1", rotation, scene_reaction(root, SCENE_UX));
    pull->factor = -1;
    pull->least_order = 1.8;
    scene_meshes_doubled(s, 2, 64);
}
