/* Nodes, coordinates and ordinals in words. */
#include "cases/scene/meaning_words.h"

#include "cases/scene/names.h"

char meaning_axis(int component)
{
    return "xyzxyz"[component];
}

void meaning_node(FILE *to, const scene *s, const char *preposition, int node)
{
    const double *at = s->node[node].position; /* + 0: no minus before a zero */
    fprintf(to, " %s %s (%.4g, %.4g, %.4g)", preposition, scene_name(s, SCENE_NODES, node).text,
            at[0] + 0, at[1] + 0, at[2] + 0);
}

void meaning_ordinal(FILE *to, int order)
{
    static const char *const word[] = {"first", "second",  "third",  "fourth", "fifth",
                                       "sixth", "seventh", "eighth", "ninth",  "tenth"};
    if (order < 10)
        fputs(word[order], to);
    else
        fprintf(to, "%dth", order + 1);
}

void meaning_coordinate(FILE *to, const scene *s, int node, int component)
{
    const int turn = component >= SCENE_RX;
    fputs(turn ? "rotation" : "displacement", to);
    meaning_node(to, s, "of", node);
    if (turn)
        fprintf(to, ", component %c of its rotation vector", meaning_axis(component));
    else
        fprintf(to, " along %c", meaning_axis(component));
}

const char *meaning_load(int component)
{
    return component < SCENE_RX ? "force along" : "moment about";
}

void meaning_member(FILE *to, const scene *s, int index)
{
    fprintf(to, " of %s (%s to %s)", scene_name(s, SCENE_MEMBERS, index).text,
            scene_name(s, SCENE_NODES, s->member[index].p).text,
            scene_name(s, SCENE_NODES, s->member[index].q).text);
}

void meaning_place(FILE *to, double where, int before)
{
    if (where == 0 || where == 1)
        fprintf(to, " at the %s", where == 0 ? "beginning" : "end");
    else
        fprintf(to, "%s at %.10g of the length", before ? " right before what acts" : "", where);
}
