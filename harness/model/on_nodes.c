#include "harness/model/on_nodes.h"

#include <stdarg.h>
#include <stdio.h>

#include "cases/scene/analysis.h"
#include "cases/scene/names.h"
#include "harness/model/features.h"

enum { MOST_NAMES = 6 };

typedef struct nodes_words {
    char *text;
    size_t room, used;
} nodes_words;

__attribute__((format(printf, 2, 3))) static void put(nodes_words *w, const char *format, ...)
{
    va_list arguments;
    if (w->used >= w->room)
        return;
    va_start(arguments, format);
    w->used += (size_t)vsnprintf(w->text + w->used, w->room - w->used, format, arguments);
    va_end(arguments);
}

static void put_loads(nodes_words *w, const scene *s)
{
    int count = 0;
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].lumped && ++count <= MOST_NAMES)
            put(w, "%s%s", count > 1 ? ", " : "", scene_called(s, SCENE_LOADS, i).text);
    if (count > MOST_NAMES)
        put(w, " and %d more", count - MOST_NAMES);
}

static int is_heavy(const scene *s)
{
    section c;
    int heavy = 0;
    for (int i = 0; i < s->sections && !heavy; i++)
        heavy = scene_constants(s, i, &c, NULL) == STATUS_OK && (c.density > 0 || c.matrices);
    return heavy;
}

/* What of the loads along members goes to the nodes with the mass of a motion (newton/loads.c).
 */
static const char *goes_with(const scene *s, const scene_motion *how)
{
    int weight = 0, other = 0;
    for (int i = 0; i < s->loads; i++) {
        const int along = scene_load_along(&s->load[i]) && !s->load[i].lumped;
        weight |= along && s->load[i].kind == SCENE_GRAVITY;
        other |= along && s->load[i].kind != SCENE_GRAVITY;
    }
    if (how->scheme == SCENE_CONSERVING && (weight || other))
        return " and loads along members";
    return weight ? " and weight" : "";
}

/* Analyses but motions that have a mass. */
static int is_lumped(const scene *s, const scene_analysis *a)
{
    return s->lumped && (a->kind == SCENE_MODAL || a->kind == SCENE_ROTATION || scene_rotates(a));
}

static int put_masses(nodes_words *w, const scene *s, const element_type *type,
                      const double options[])
{
    int count = 0;
    for (int i = 0; i < s->analyses; i++) {
        const scene_analysis *a = &s->analysis[i];
        const int motion = a->kind == SCENE_MOTION && !features_spreads(s, i, type, options);
        if (!motion && !is_lumped(s, a))
            continue;
        put(w, "%smass%s of %s",
            count++ > 0   ? ", "
            : w->used > 0 ? "; "
                          : "",
            motion ? goes_with(s, scene_motion_of(a)) : "",
            scene_called(s, SCENE_ANALYSES, i).text);
    }
    return count;
}

void on_nodes(const scene *s, const element_type *type, const double options[], char *text,
              size_t room)
{
    nodes_words w = {text, room, 0};
    text[0] = '\0';
    put_loads(&w, s);
    if (w.used > 0)
        put(&w, ": half of an element's at both its nodes, of order 2 in its length (at three "
                "nodes 1/6, 4/6, 1/6, of order 4)");
    if (is_heavy(s) && put_masses(&w, s, type, options) > 0)
        put(&w, ": at nodes, weighted along each member, of order 4 in slender bending from 6 "
                "elements on, of 2 with shear, stretch and twist (at three nodes 1/6, 4/6, 1/6, "
                "of order 4)");
}
