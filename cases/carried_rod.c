/* A bent and twisted rod carried around as a whole: nothing but its direction may change. L = 1 m,
 * EI = GJ = 1 N m^2.
 *
 * An isotropic rod that carries a moment only has a constant moment in space: with its tip turned
 * by the rotation vector phi it is phi EI/L, turned with the rod. */
#include "cases/shared/cantilever.h"
#include "elements/math/pi.h"

#include <math.h>
#include <stddef.h>

enum { TURNS, STRAIN };

static const parameter_type parameters[] = {
    [TURNS] = {"turns", "1", 1, 0, 100, NULL, "turns about (1, 2, 3) after the rod was strained"},
    [STRAIN] = {"strain", "rad", 1, -1.5, 1.5, NULL,
                "rotation of the tip against the root, about (0.6, 0, 0.8)"},
    {0},
};

static void add_turn(scene *s, int node, int driver, const double axis[3])
{
    scene_node *n = scene_node_at(s, node);
    int k = 0;
    n->rotation = SCENE_ROTATION_SEQUENCE;
    while (k < 2 && n->angle[k] >= 0)
        k++;
    n->angle[k] = driver;
    for (int i = 0; i < 3; i++)
        n->axis[k][i] = axis[i];
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    static const char *const moment[3] = {"M_x", "M_y", "M_z"}, *const displacement[3] = {
                                                                    "u_x", "u_y", "u_z"};
    const cantilever_stiffness k = {.EA = 1e4, .GJ = 1, .EI = 1};
    const double path[3] = {0, 1, 2}, way[3] = {1, 2, 3}, bend[3] = {0.6, 0, 0.8};
    const double strain[3] = {0, value[STRAIN], value[STRAIN]},
                 carry[3] = {0, 0, 2 * PI * value[TURNS]};
    int root, tip;
    cantilever_build(1, &k, s, &root, &tip);
    const int carried = scene_add_driver(s, "carried", 3, path, carry),
              strained = scene_add_driver(s, "strained", 3, path, strain);
    for (int i = 0; i < 3; i++)
        scene_node_at(s, root)->angle[i] = SCENE_FREE;
    add_turn(s, root, carried, way);
    add_turn(s, tip, carried, way);
    add_turn(s, tip, strained, bend);

    const int carrying = scene_add_static(s, 2, path + 1, 2 + (int)ceil(12 * value[TURNS]));
    for (int i = 0; i < 3; i++) {
        scene_quantity *q =
            scene_add_quantity(s, moment[i], "N m", carrying, scene_reaction(tip, SCENE_RX + i));
        q->near_zero = 1;
        q->least_order = 1.8;
    }
    for (int i = 0; i < 3; i++) {
        cantilever_quantity(s, displacement[i], "m", carrying, tip, SCENE_UX + i, 1, 0);
        s->quantity[s->quantities - 1].near_zero = 1;
    }
    return STATUS_OK;
}

const case_type case_carried_rod = {
    .name = "carried_rod",
    .summary = "bent and twisted rod carried around by whole turns",
    .source = "exact: a helix of constant moment, and rigid motion",
    .parameters = {parameters, case_omit},
    .build = build,
};
