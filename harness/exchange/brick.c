#include "harness/exchange/brick.h"

#include <math.h>
#include <string.h>

#include "elements/math/rotation.h"

enum { BRICK_NODES = 20, DECK_LINE = 10 };

/* Corners, then middles of the edges of the lower face, of the upper face and between them, in
 * half steps. */
static const int places[BRICK_NODES][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2},
                                           {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
                                           {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2},
                                           {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};

status brick_init(brick *out, const scene *s, int member, int along, int first_node,
                  int first_element, fault *f)
{
    const scene_member *m = &s->member[member];
    section constants;
    TRY(scene_constants(s, m->section, &constants, f));
    TRY(face_of(&s->section[m->section], &constants, &out->face, f));
    double x[3], squared = 0;
    for (int i = 0; i < 3; i++) {
        out->origin[i] = s->node[m->p].position[i];
        x[i] = s->node[m->q].position[i] - out->origin[i];
        squared += x[i] * x[i];
    }
    rotation_triad(x, m->y_axis, out->axes);
    out->length = sqrt(squared);
    out->elements[BRICK_ALONG] = along;
    out->elements[BRICK_Y] = out->face.elements[0];
    out->elements[BRICK_Z] = out->face.elements[1];
    out->first_node = first_node;
    out->first_element = first_element;
    return STATUS_OK;
}

static int places_along(const brick *b, int axis)
{
    return 2 * b->elements[axis] + 1;
}

static int number_of(const brick *b, const int at[3])
{
    return b->first_node +
           (at[BRICK_ALONG] * places_along(b, BRICK_Y) + at[BRICK_Y]) * places_along(b, BRICK_Z) +
           at[BRICK_Z];
}

int brick_next_node(const brick *b)
{
    return b->first_node +
           places_along(b, BRICK_ALONG) * places_along(b, BRICK_Y) * places_along(b, BRICK_Z);
}

int brick_next_element(const brick *b)
{
    int filled = 0;
    for (int i = 0; i < b->elements[BRICK_Y]; i++)
        for (int k = 0; k < b->elements[BRICK_Z]; k++)
            filled += b->face.filled[i][k];
    return b->first_element + b->elements[BRICK_ALONG] * filled;
}

/* Place `at` of the lattice along the member, from 0 to 1. */
static double share(int at, int n)
{
    return (face_graded(at / 2, n) + face_graded((at + 1) / 2, n)) / 2;
}

/* Place `at` of the lattice along an axis of the face [m]. */
static double across(const double corner[], int at)
{
    return (corner[at / 2] + corner[(at + 1) / 2]) / 2;
}

/* Is there a brick at this place of the face? */
static int is_filled(const face *s, int y, int z)
{
    for (int i = (y - 1) / 2; i <= y / 2; i++)
        for (int k = (z - 1) / 2; k <= z / 2; k++)
            if (i < s->elements[0] && k < s->elements[1] && s->filled[i][k])
                return 1;
    return 0;
}

/* A place between corners in two directions has no node. */
static int has_node(const brick *b, const int at[3])
{
    return at[0] % 2 + at[1] % 2 + at[2] % 2 < 2 && is_filled(&b->face, at[BRICK_Y], at[BRICK_Z]);
}

static void write_node(const brick *b, const int at[3], FILE *to)
{
    const double local[3] = {
        b->length * share(at[BRICK_ALONG], b->elements[BRICK_ALONG]),
        across(b->face.corner[0], at[BRICK_Y]),
        across(b->face.corner[1], at[BRICK_Z]),
    };
    double p[3];
    for (int i = 0; i < 3; i++) {
        p[i] = b->origin[i];
        for (int k = 0; k < 3; k++)
            p[i] += b->axes[3 * i + k] * local[k];
    }
    fprintf(to, "%d,%.12e,%.12e,%.12e\n", number_of(b, at), p[0], p[1], p[2]);
}

/* What is done with every node of the lattice from `first` to `last` along the member. */
typedef void visit(const brick *, const int at[3], FILE *to);
static void each_node(const brick *b, int first, int last, visit *what, FILE *to)
{
    int at[3];
    for (at[0] = first; at[0] <= last; at[0]++)
        for (at[1] = 0; at[1] < places_along(b, BRICK_Y); at[1]++)
            for (at[2] = 0; at[2] < places_along(b, BRICK_Z); at[2]++)
                if (has_node(b, at))
                    what(b, at, to);
}

static void write_values_number(const brick *b, const int at[3], FILE *to)
{
    fprintf(to, "%d,\n", number_of(b, at));
}

void brick_write_nodes(const brick *b, FILE *to)
{
    each_node(b, 0, 2 * b->elements[BRICK_ALONG], write_node, to);
}

void brick_write_face(const brick *b, int end, FILE *to)
{
    const int at = end ? 2 * b->elements[BRICK_ALONG] : 0;
    each_node(b, at, at, write_values_number, to);
}

static void write_element(const brick *b, int number, const int cell[3], FILE *to)
{
    fprintf(to, "%d", number);
    for (int n = 0; n < BRICK_NODES; n++) {
        int at[3];
        for (int i = 0; i < 3; i++)
            at[i] = 2 * cell[i] + places[n][i];
        fprintf(to, n == DECK_LINE ? ",\n%d" : ",%d", number_of(b, at));
    }
    fputc('\n', to);
}

void brick_write_elements(const brick *b, FILE *to)
{
    int number = b->first_element, cell[3];
    for (cell[0] = 0; cell[0] < b->elements[0]; cell[0]++)
        for (cell[1] = 0; cell[1] < b->elements[1]; cell[1]++)
            for (cell[2] = 0; cell[2] < b->elements[2]; cell[2]++)
                if (b->face.filled[cell[BRICK_Y]][cell[BRICK_Z]])
                    write_element(b, number++, cell, to);
}
