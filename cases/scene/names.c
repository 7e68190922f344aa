#include "cases/scene/scene.h"

#include <stdlib.h>
#include <string.h>

static const char *const word_of[] = {[SCENE_SECTIONS] = "section",
                                      [SCENE_NODES] = "node",
                                      [SCENE_MEMBERS] = "member",
                                      [SCENE_SPRINGS] = "spring",
                                      [SCENE_DRIVERS] = "motion",
                                      [SCENE_LOADS] = "load",
                                      [SCENE_ANALYSES] = "analysis",
                                      [SCENE_QUANTITIES] = "quantity",
                                      [SCENE_CASES] = "case",
                                      [SCENE_COMBINATIONS] = "combination",
                                      [SCENE_CONSTRAINTS] = "constraint",
                                      [SCENE_IMPERFECTIONS] = "imperfection"};

int scene_count(const scene *s, scene_list list)
{
    const int count[] = {[SCENE_SECTIONS] = s->sections,
                         [SCENE_NODES] = s->nodes,
                         [SCENE_MEMBERS] = s->members,
                         [SCENE_SPRINGS] = s->springs,
                         [SCENE_DRIVERS] = s->drivers,
                         [SCENE_LOADS] = s->loads,
                         [SCENE_ANALYSES] = s->analyses,
                         [SCENE_QUANTITIES] = s->quantities,
                         [SCENE_CASES] = s->cases,
                         [SCENE_COMBINATIONS] = s->combinations,
                         [SCENE_CONSTRAINTS] = s->constraints,
                         [SCENE_IMPERFECTIONS] = s->imperfections};
    return count[list];
}

const char *scene_list_word(scene_list list)
{
    return word_of[list];
}

static char *room_of(const scene *s, scene_list list, int i)
{
    if (i < 0 || i >= scene_count(s, list))
        return NULL;
    switch (list) {
    case SCENE_SECTIONS:
        return i < s->computeds ? s->computed[i].name : NULL;
    case SCENE_NODES:
        return s->node[i].name;
    case SCENE_MEMBERS:
        return s->member[i].name;
    case SCENE_SPRINGS:
        return s->spring[i].name;
    case SCENE_DRIVERS:
        return s->driver[i].name;
    case SCENE_LOADS:
        return s->load[i].name;
    case SCENE_ANALYSES:
        return s->analysis[i].name;
    case SCENE_QUANTITIES:
        return s->quantity[i].name;
    case SCENE_CASES:
        return s->load_case[i].name;
    case SCENE_COMBINATIONS:
        return s->combination[i].name;
    case SCENE_CONSTRAINTS:
        return s->constraint[i].name;
    case SCENE_IMPERFECTIONS:
        return s->imperfection[i].name;
    }
    return NULL;
}

void scene_set_name(scene *s, scene_list list, int i, const char *name)
{
    char *room = room_of(s, list, i);
    if (room != NULL)
        snprintf(room, SCENE_NAME, "%s", name);
}

const char *scene_own_name(const scene *s, scene_list list, int i)
{
    const char *name = room_of(s, list, i);
    return name != NULL ? name : "";
}

static int is_taken(const scene *s, scene_list list, const char *text)
{
    const char *other;
    for (int i = 0; (other = room_of(s, list, i)) != NULL; i++)
        if (strcmp(other, text) == 0)
            return 1;
    return 0;
}

scene_words scene_numbered(const scene *s, scene_list list, int i)
{
    scene_words out;
    int end = snprintf(out.text, sizeof out.text, "%s_%d", word_of[list], i);
    for (int k = 0; k < 8 && is_taken(s, list, out.text); k++)
        end += snprintf(out.text + end, sizeof out.text - (size_t)end, "_");
    return out;
}

scene_words scene_name(const scene *s, scene_list list, int i)
{
    scene_words out;
    const char *own = scene_own_name(s, list, i);
    if (own[0] == '\0')
        return scene_numbered(s, list, i);
    snprintf(out.text, sizeof out.text, "%s", own);
    return out;
}

scene_words scene_called(const scene *s, scene_list list, int i)
{
    scene_words out;
    const char *own = scene_own_name(s, list, i);
    if (own[0] != '\0')
        snprintf(out.text, sizeof out.text, "%s %s", word_of[list], own);
    else
        snprintf(out.text, sizeof out.text, "%s %d", word_of[list], i);
    return out;
}

char meaning_axis(int component)
{
    return "xyzxyz"[component];
}

void meaning_node(FILE *to, const scene *s, const char *preposition, int node)
{
    const double *at = s->node[node].position; /* + 0 avoids a minus sign before zero */
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
        fprintf(to, "%s at %.10g of the length", before ? " just before the load" : "", where);
}
