#include "harness/exchange/body.h"

#include "cases/scene/along_path.h"
#include "harness/exchange/rigid.h"

enum { BODY_TRANSLATIONS = 3, BODY_COMPONENTS = 6 };

int body_node(const body_numbers *b, int node, int component)
{
    return b->first + 2 * node + (component >= BODY_TRANSLATIONS);
}

int body_direction(int component)
{
    return component % BODY_TRANSLATIONS + 1;
}

void body_write_nodes(const body_numbers *b, const scene *s, FILE *to)
{
    for (int i = 0; i < s->nodes; i++)
        if (rigid_moves(s, i))
            for (int k = 0; k < BODY_COMPONENTS; k += BODY_TRANSLATIONS) {
                const double *p = s->node[i].position;
                fprintf(to, "%d,%.12e,%.12e,%.12e\n", body_node(b, i, k), p[0], p[1], p[2]);
            }
}

static void write_body(const body_numbers *b, const scene *s, int node, const brick bricks[],
                       FILE *to)
{
    fprintf(to, "*NSET,NSET=BODY%d\n", node);
    for (int i = 0; i < s->members; i++) {
        if (rigid_body(s, s->member[i].p) == node)
            brick_write_face(&bricks[i], 0, to);
        if (rigid_body(s, s->member[i].q) == node)
            brick_write_face(&bricks[i], 1, to);
    }
    fprintf(to, "*RIGID BODY,NSET=BODY%d,REF NODE=%d,ROT NODE=%d\n", node,
            body_node(b, node, SCENE_UX), body_node(b, node, SCENE_RX));
}

void body_write(const body_numbers *b, const scene *s, const brick bricks[], FILE *to)
{
    for (int i = 0; i < s->nodes; i++)
        if (rigid_moves(s, i))
            write_body(b, s, i, bricks, to);
    fputs("*NSET,NSET=BODIES\n", to);
    for (int i = 0; i < s->nodes; i++)
        if (rigid_moves(s, i))
            for (int k = 0; k < BODY_COMPONENTS; k += BODY_TRANSLATIONS)
                fprintf(to, "%d,\n", body_node(b, i, k));
}

/* SCENE_FREE, SCENE_HELD or a driver. */
static int mover(const scene_node *n, int component)
{
    const int axis = rigid_single_axis(n), turn = component - BODY_TRANSLATIONS;
    if (component < BODY_TRANSLATIONS)
        return n->translation[component];
    if (axis == SCENE_NONE)
        return n->angle[turn];
    return turn == axis ? n->angle[0] : SCENE_HELD;
}

/* path NULL: a small motion, in which they stay. */
static void write_boundary(const body_numbers *b, const scene *s, const double *path, int node,
                           unsigned released, FILE *to)
{
    fputs("*BOUNDARY,OP=NEW\n", to);
    for (int i = 0; i < s->nodes; i++)
        if (rigid_moves(s, i))
            for (int k = 0; k < BODY_COMPONENTS; k++) {
                const int by = mover(&s->node[i], k), direction = body_direction(k);
                if (by == SCENE_FREE || (i == node && (released >> k & 1)))
                    continue;
                const int stays = by == SCENE_HELD || path == NULL;
                fprintf(to, "%d,%d,%d,%.12e\n", body_node(b, i, k), direction, direction,
                        stays ? 0 : along_path_value(&s->driver[by], *path));
            }
}

void body_write_state(const body_numbers *b, const scene *s, double path, FILE *to)
{
    write_boundary(b, s, &path, SCENE_NONE, 0, to);
}

void body_write_held(const body_numbers *b, const scene *s, int node, unsigned released, FILE *to)
{
    write_boundary(b, s, NULL, node, released, to);
}
