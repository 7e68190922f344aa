#include "harness/exchange/rigid.h"

int rigid_body(const scene *s, int node)
{
    while (s->node[node].attached != SCENE_NONE)
        node = s->node[node].attached;
    return node;
}

int rigid_moves(const scene *s, int node)
{
    int ends = 0;
    for (int i = 0; i < s->members; i++)
        ends += rigid_body(s, s->member[i].p) == node || rigid_body(s, s->member[i].q) == node;
    return ends > 0 && s->node[node].attached == SCENE_NONE;
}

static int rigid_is_zero(const double v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

int rigid_single_axis(const scene_node *n)
{
    if (n->rotation != SCENE_ROTATION_SEQUENCE || !rigid_is_zero(n->axis[1]))
        return SCENE_NONE;
    for (int i = 0; i < 3; i++)
        if (n->axis[0][i] > 0 && n->axis[0][(i + 1) % 3] == 0 && n->axis[0][(i + 2) % 3] == 0)
            return i;
    return SCENE_NONE;
}
