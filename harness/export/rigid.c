#include "harness/export/rigid.h"

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
