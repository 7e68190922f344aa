#include "harness/import_export/import_export_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

/* Returns the position of corner k, between 0 and 1, if n elements divide a length of 1. The
 * elements become smaller towards both ends. */
static double face_graded(int k, int n);
/* Computes the face of a section. constants: those computed from `spec`. REFUSED: the section
 * cannot be divided into bricks. */
static status face_of(const section_spec *spec, const section *constants, face *out, fault *f);

enum { BRICK_NODES = 20, DECK_LINE = 10 };

/* Positions of the nodes of a brick, in half elements: the corners, followed by the mid-edge nodes
 * of the lower face, of the upper face, and between these faces. */
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

/* Returns the fraction of the member at lattice position `at`, from 0 to 1. */
static double share(int at, int n)
{
    return (face_graded(at / 2, n) + face_graded((at + 1) / 2, n)) / 2;
}

/* Returns the coordinate [m] of lattice position `at` along an axis of the face. */
static double across(const double corner[], int at)
{
    return (corner[at / 2] + corner[(at + 1) / 2]) / 2;
}

static int is_filled(const face *s, int y, int z)
{
    for (int i = (y - 1) / 2; i <= y / 2; i++)
        for (int k = (z - 1) / 2; k <= z / 2; k++)
            if (i < s->elements[0] && k < s->elements[1] && s->filled[i][k])
                return 1;
    return 0;
}

/* Returns 1 if a lattice position has a node. */
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

enum { SHEET_RATIO = 4, SHEET_ACROSS = 8, ACROSS = 2, MOST_LINES = 2 * SECTION_MAX_WALLS };

static const double same = 1e-9;

/* A wall as a rectangle: its smallest and largest y and z in the coordinates of the walls. */
typedef struct strip {
    double from[2], to[2];
} strip;

static double face_graded(int k, int n)
{
    return (1 - cos(PI * k / n)) / 2;
}

static int face_across(double side, double other)
{
    if (side >= SHEET_RATIO * other)
        return SHEET_ACROSS;
    return other >= SHEET_RATIO * side ? 1 : ACROSS;
}

static void fill_rectangle(const section_spec *spec, face *out)
{
    const double side[2] = {spec->height, spec->width};
    for (int axis = 0; axis < 2; axis++) {
        const int n = face_across(side[axis], side[1 - axis]);
        out->elements[axis] = n;
        for (int k = 0; k <= n; k++)
            out->corner[axis][k] = side[axis] * (face_graded(k, n) - 0.5);
    }
    for (int i = 0; i < out->elements[0]; i++)
        memset(out->filled[i], 1, (size_t)out->elements[1]);
}

/* Returns the axis along which the wall extends; -1: the wall is oblique. */
static int axis_of(const section_spec *spec, int wall)
{
    const double *p = spec->point[spec->wall[wall].from], *q = spec->point[spec->wall[wall].to];
    const double y = fabs(q[0] - p[0]), z = fabs(q[1] - p[1]);
    if (fmin(y, z) > same * fmax(y, z))
        return -1;
    return y > z ? 0 : 1;
}

/* Returns the extension of the wall beyond its end point, which is half of the largest thickness of
 * the walls at right angles to it. */
static double extension(const section_spec *spec, int wall, int point)
{
    double most = 0;
    for (int i = 0; i < spec->walls; i++)
        if ((spec->wall[i].from == point || spec->wall[i].to == point) &&
            axis_of(spec, i) != axis_of(spec, wall))
            most = fmax(most, spec->wall[i].thickness / 2);
    return most;
}

static strip strip_of(const section_spec *spec, int wall)
{
    const int along = axis_of(spec, wall), side = 1 - along;
    int first = spec->wall[wall].from, last = spec->wall[wall].to;
    if (spec->point[first][along] > spec->point[last][along]) {
        first = spec->wall[wall].to;
        last = spec->wall[wall].from;
    }
    const double half = spec->wall[wall].thickness / 2;
    strip s;
    s.from[along] = spec->point[first][along] - extension(spec, wall, first);
    s.to[along] = spec->point[last][along] + extension(spec, wall, last);
    s.from[side] = spec->point[first][side] - half;
    s.to[side] = spec->point[first][side] + half;
    return s;
}

static int ascending(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* Lists the sides of all strips along an axis, without repetition, in ascending order. Returns
 * their number. */
static int lines_of(const strip strips[], int count, int axis, double line[MOST_LINES])
{
    int lines = 0;
    double all[MOST_LINES];
    for (int i = 0; i < count; i++) {
        all[2 * i] = strips[i].from[axis];
        all[2 * i + 1] = strips[i].to[axis];
    }
    qsort(all, 2 * (size_t)count, sizeof all[0], ascending);
    const double size = all[2 * count - 1] - all[0];
    for (int i = 0; i < 2 * count; i++)
        if (lines == 0 || all[i] - line[lines - 1] > same * size)
            line[lines++] = all[i];
    return lines;
}

static void divide(const double line[], int lines, double step, int axis, face *out)
{
    int n = 0;
    out->corner[axis][0] = line[0];
    for (int i = 1; i < lines; i++) {
        const double length = line[i] - line[i - 1];
        const int parts = (int)fmax(1, ceil(length / step - same));
        for (int k = 1; k <= parts; k++)
            out->corner[axis][++n] = line[i - 1] + length * k / parts;
    }
    out->elements[axis] = n;
}

static int is_inside(const strip *s, double y, double z)
{
    return y > s->from[0] && y < s->to[0] && z > s->from[1] && z < s->to[1];
}

static void fill_strips(const strip strips[], int count, face *out)
{
    for (int i = 0; i < out->elements[0]; i++)
        for (int k = 0; k < out->elements[1]; k++) {
            const double y = (out->corner[0][i] + out->corner[0][i + 1]) / 2,
                         z = (out->corner[1][k] + out->corner[1][k + 1]) / 2;
            for (int s = 0; s < count; s++)
                out->filled[i][k] |= (unsigned char)is_inside(&strips[s], y, z);
        }
}

static status fill_walls(const section_spec *spec, const double centroid[2], face *out, fault *f)
{
    strip strips[SECTION_MAX_WALLS];
    double line[2][MOST_LINES], size = 0;
    int lines[2];
    for (int i = 0; i < spec->walls; i++) {
        if (axis_of(spec, i) < 0)
            return fault_set(f, STATUS_REFUSED,
                             "wall number %d of the section is oblique, but only walls along its y "
                             "and z axes can be written as solids; change the ends of the wall",
                             i + 1);
        strips[i] = strip_of(spec, i);
    }
    for (int axis = 0; axis < 2; axis++) {
        lines[axis] = lines_of(strips, spec->walls, axis, line[axis]);
        size = fmax(size, line[axis][lines[axis] - 1] - line[axis][0]);
    }
    for (int axis = 0; axis < 2; axis++)
        divide(line[axis], lines[axis], size / FACE_WALLS, axis, out);
    fill_strips(strips, spec->walls, out);
    for (int axis = 0; axis < 2; axis++)
        for (int k = 0; k <= out->elements[axis]; k++)
            out->corner[axis][k] -= centroid[axis];
    return STATUS_OK;
}

static int is_overridden(const section_spec *spec)
{
    double given[sizeof spec->given / sizeof(double)];
    memcpy(given, &spec->given, sizeof given);
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++)
        if (!isnan(given[i]))
            return 1;
    return 0;
}

static status face_of(const section_spec *spec, const section *constants, face *out, fault *f)
{
    memset(out, 0, sizeof *out);
    if (is_overridden(spec))
        return fault_set(f, STATUS_REFUSED,
                         "the stiffnesses of a solid follow from its dimensions; remove 'given' "
                         "from the section");
    if (spec->kind == SECTION_WALLS)
        return fill_walls(spec, constants->centroid, out, f);
    if (spec->kind != SECTION_RECTANGLE)
        return fault_set(f, STATUS_REFUSED,
                         "only rectangles and straight walls can be written as solids; give the "
                         "member a section with 'rectangle' or 'walls'");
    fill_rectangle(spec, out);
    return STATUS_OK;
}

double face_area(const face *s)
{
    double area = 0;
    for (int i = 0; i < s->elements[0]; i++)
        for (int k = 0; k < s->elements[1]; k++)
            if (s->filled[i][k])
                area += (s->corner[0][i + 1] - s->corner[0][i]) *
                        (s->corner[1][k + 1] - s->corner[1][k]);
    return area;
}
