/* Nodes of a scene: supports, rigid bodies, rotations. */
#include <math.h>
#include <string.h>

#include "cases/format/builder.h"
#include "cases/format/expression.h"

/* Lengths of a unit vector below it are round-off. */
static const double round_off = 1e-12;

/* Of the instance's component c that of the scene, and whether it has the same sign; SCENE_NONE: it
 * is along none. */
static int component_of(const fields *f, int c, int *same)
{
    double axis[3] = {0};
    int along = SCENE_NONE, others = 0;
    axis[c % 3] = 1;
    placement_turn(f->placed, axis);
    for (int k = 0; k < 3; k++)
        if (fabs(axis[k]) > round_off) {
            others += along != SCENE_NONE;
            along = k;
        }
    *same = along != SCENE_NONE && axis[along] > 0;
    return others > 0 || along == SCENE_NONE ? SCENE_NONE : c - c % 3 + along;
}

/* Components are along the axes of the scene. */
static void refuse_components(const fields *f, const char *key)
{
    document_mistake(f->b->mistakes, document_find(f->map, key), 0,
                     "%s: components that are not along axes of the scene, in a part that is "
                     "turned; name them at a node of the scene, and connect it",
                     key);
}

static void read_hold(const fields *f, int node)
{
    static const char choices[] = "all|ux|uy|uz|rx|ry|rz";
    const unsigned held = fields_words(f, "hold", choices);
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        int same;
        const int ours = held & 1u ? c : component_of(f, c, &same);
        if (!(held & 1u || held >> (c + 1) & 1u))
            continue;
        if (ours == SCENE_NONE)
            refuse_components(f, "hold");
        else
            scene_hold(f->b->scene, node, ours, ours);
    }
}

static void read_drive(const fields *f, int node)
{
    static const char *const component[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
    const fields drive = fields_below(f, "drive");
    const scene_node *n = scene_node_at(f->b->scene, node);
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        const int motion = fields_entry(&drive, component[c], SCENE_DRIVERS);
        int same = 1;
        const int ours = component_of(f, c, &same);
        if (motion < 0)
            continue;
        if (ours == SCENE_NONE || !same) {
            refuse_components(f, "drive");
            continue;
        }
        if ((ours < SCENE_RX ? n->translation[ours] : n->angle[ours - SCENE_RX]) == SCENE_HELD)
            document_mistake(f->b->mistakes, document_find(drive.map, component[c]), 0,
                             "%s is fixed and prescribed; remove one", component[c]);
        scene_drive(f->b->scene, node, ours, motion);
    }
}

/* free, held or a motion. */
static int angle_of(const fields *f, const document_node *n)
{
    if (n->kind == DOCUMENT_TEXT && strcmp(n->text, "free") == 0)
        return SCENE_FREE;
    if (n->kind == DOCUMENT_TEXT && strcmp(n->text, "held") == 0)
        return SCENE_HELD;
    return fields_entry_of(f, n, SCENE_DRIVERS);
}

static void read_axis(const fields *f, double axis[3])
{
    const document_node *n = document_find(f->map, "axis");
    if (n->kind == DOCUMENT_LIST)
        expression_vector(n, 3, f->names, f->b->mistakes, axis);
    else
        axis[fields_word_of(f, n, "axis", "x|y|z", 0)] = 1;
    placement_turn(f->placed, axis);
    if (axis[0] == 0 && axis[1] == 0 && axis[2] == 0)
        document_mistake(f->b->mistakes, n, 0, "an axis of no length; give x, y, z or a direction");
}

static void read_sequence(const fields *f, const document_node *list, scene_node *n)
{
    unrolled *turns;
    const int count = unroll_entries(list, f->names, f->b->arena, f->b->mistakes, &turns);
    if (count < 1 || count > 3) {
        document_mistake(f->b->mistakes, list, 0, "%d turns; give one to three", count);
        return;
    }
    n->rotation = SCENE_ROTATION_SEQUENCE;
    for (int i = 0; i < count; i++) {
        const fields turn = fields_of(f->b, &turns[i]);
        read_axis(&turn, n->axis[i]);
        n->angle[i] = angle_of(&turn, document_find(turn.map, "angle"));
    }
}

static void read_rotation(const fields *f, scene_node *n)
{
    const fields rotation = fields_below(f, "rotation");
    const document_node *sequence = document_find(rotation.map, "sequence"),
                        *vector = document_find(rotation.map, "vector");
    if (sequence != NULL)
        read_sequence(&rotation, sequence, n);
    if (vector == NULL)
        return;
    if (vector->kind != DOCUMENT_LIST || vector->count != 3) {
        document_mistake(f->b->mistakes, vector, 0, "vector: three motions are expected");
        return;
    }
    n->rotation = SCENE_ROTATION_VECTOR;
    for (int i = 0; i < 3; i++)
        n->angle[i] = fields_entry_of(&rotation, vector->item[i], SCENE_DRIVERS);
}

/* Rotations have one master: components, a rotation or a fork. */
static void check_masters(const fields *f, const scene_node *n)
{
    const int held =
        n->angle[0] != SCENE_FREE || n->angle[1] != SCENE_FREE || n->angle[2] != SCENE_FREE;
    const document_node *rotation = document_find(f->map, "rotation");
    if (document_find(rotation, "vector") != NULL && f->placed != NULL && f->placed->turned)
        refuse_components(f, "rotation");
    if (rotation != NULL && (held || fields_have(f, "fork")))
        document_mistake(f->b->mistakes, rotation, 0,
                         "'rotation' says all about turns; leave out rx, ry, rz and forks");
}

/* Of the body at rest; it turns with the instance it is in: I <- A I A^T, row by row. */
static void turn_inertia(const placement *placed, double I[6])
{
    double row[3][3] = {{I[0], I[3], I[5]}, {I[3], I[1], I[4]}, {I[5], I[4], I[2]}};
    if (placed == NULL)
        return;
    for (int pass = 0; pass < 2; pass++) {
        double column[3][3];
        for (int i = 0; i < 3; i++)
            placement_turn(placed, row[i]);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                column[i][j] = row[j][i];
        memcpy(row, column, sizeof row);
    }
    const double turned[6] = {row[0][0], row[1][1], row[2][2], row[0][1], row[1][2], row[2][0]};
    memcpy(I, turned, sizeof turned);
}

void builder_nodes(builder *b)
{
    for (int i = 0; i < b->list[SCENE_NODES].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_NODES].entry[i]);
        const int node = scene_add_node(b->scene, 0, 0, 0);
        scene_node *n = scene_node_at(b->scene, node);
        builder_call(b, SCENE_NODES, node, i);
        fields_read(&f, entry_node, n);
        turn_inertia(f.placed, n->body.inertia);
        read_hold(&f, node);
        read_drive(&f, node);
        check_masters(&f, n);
        read_rotation(&f, n);
    }
}
