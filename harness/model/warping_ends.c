#include "harness/model/warping_ends.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/names.h"
#include "harness/model/features.h"

enum { HELD, SHARED, FREE, STATES };
enum { ENDS_MOST_NAMES = 8 };

typedef struct ends_tally {
    int of[STATES], all; /* ends of members that warp */
} ends_tally;

typedef struct held_ends {
    const scene *scene;
    const scene *other; /* NULL: all; else those that this one leaves free and the scene does not */
    ends_tally *node;
} held_ends;

static int warp_of(const scene *s, int member, int end)
{
    return end == 0 ? s->member[member].warp_p : s->member[member].warp_q;
}

/* Does the section at this end warp? */
static int warps(const scene *s, int member, int end)
{
    const scene_member *m = &s->member[member];
    section c;
    return scene_constants(s, end == 0 ? m->section : m->section_q, &c, NULL) == STATUS_OK &&
           c.Iw > 0;
}

/* HELD, SHARED or FREE; STATES: not asked for. */
static int state_of(const held_ends *e, int member, int end)
{
    const int warp = warp_of(e->scene, member, end);
    if (!warps(e->scene, member, end) ||
        (e->other != NULL &&
         (warp == SCENE_WARP_FREE || warp_of(e->other, member, end) != SCENE_WARP_FREE)))
        return STATES;
    return warp == SCENE_WARP_FIXED ? HELD : warp >= 0 ? SHARED : FREE;
}

/* The names of one state after the other. */
typedef struct ends_words {
    char *text;
    size_t room, used;
    int names; /* of the state */
} ends_words;

static void ends_put(ends_words *w, const char *before, const char *text)
{
    if (w->used < w->room)
        w->used += (size_t)snprintf(w->text + w->used, w->room - w->used, "%s%s", before, text);
}

static void add(ends_words *w, const char *text)
{
    if (w->names > 0 && w->names < ENDS_MOST_NAMES)
        ends_put(w, ", ", text);
    else if (w->names == 0)
        ends_put(w, "", text);
    w->names++;
}

/* The node where all of its ends are in this state, else each of them. */
static void add_node(const held_ends *e, int node, int state, ends_words *out)
{
    const scene *s = e->scene;
    const scene_words where = scene_name(s, SCENE_NODES, node);
    if (e->node[node].of[state] == e->node[node].all) {
        add(out, where.text);
        return;
    }
    for (int i = 0; i < 2 * s->members; i++) {
        char text[2 * sizeof where.text + 8];
        const scene_member *m = &s->member[i / 2];
        if ((i % 2 == 0 ? m->p : m->q) != node || state_of(e, i / 2, i % 2) != state)
            continue;
        snprintf(text, sizeof text, "%s at %s", scene_name(s, SCENE_MEMBERS, i / 2).text,
                 where.text);
        add(out, text);
    }
}

static void write_ends(const held_ends *e, ends_words *out)
{
    static const char *const word[STATES] = {"held at ", "shared at ", "free at "};
    for (int state = 0; state < STATES; state++) {
        char more[40];
        int any = 0;
        for (int i = 0; i < e->scene->nodes; i++)
            any |= e->node[i].of[state] > 0;
        if (!any)
            continue;
        ends_put(out, out->used > 0 ? "; " : "", word[state]);
        out->names = 0;
        for (int i = 0; i < e->scene->nodes; i++)
            if (e->node[i].of[state] > 0)
                add_node(e, i, state, out);
        snprintf(more, sizeof more, " and %d more", out->names - ENDS_MOST_NAMES);
        if (out->names > ENDS_MOST_NAMES)
            ends_put(out, "", more);
    }
}

static void tell(const scene *s, const scene *other, char *text, size_t room)
{
    held_ends e = {s, other, NULL};
    ends_words out = {text, room, 0, 0};
    text[0] = '\0';
    if (!(features_needed(s) & FEATURE_WARPING))
        return;
    e.node = calloc((size_t)s->nodes + 1, sizeof *e.node);
    if (e.node == NULL)
        return;
    for (int i = 0; i < 2 * s->members; i++) {
        const scene_member *m = &s->member[i / 2];
        const int node = i % 2 == 0 ? m->p : m->q, state = state_of(&e, i / 2, i % 2);
        if (node < 0 || node >= s->nodes)
            continue; /* scene_validate tells it */
        e.node[node].all += warps(s, i / 2, i % 2);
        if (state < STATES)
            e.node[node].of[state]++;
    }
    write_ends(&e, &out);
    free(e.node);
}

void warping_ends(const scene *s, char *text, size_t room)
{
    tell(s, NULL, text, room);
}

void warping_ends_freed(const scene *s, const scene *other, char *text, size_t room)
{
    text[0] = '\0';
    if (s->members == other->members)
        tell(s, other, text, room);
}
