#include "harness/exchange/face.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"

enum { SHEET_RATIO = 4, SHEET_ACROSS = 8, ACROSS = 2, MOST_LINES = 2 * SECTION_MAX_WALLS };

/* Lengths of a section that are closer to each other, relative to its size, are one. */
static const double same = 1e-9;

/* A wall as a rectangle: its least and largest y and z in wall coordinates. */
typedef struct strip {
    double from[2], to[2];
} strip;

double face_graded(int k, int n)
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

/* The axis that the wall is along; -1: it is oblique. */
static int axis_of(const section_spec *spec, int wall)
{
    const double *p = spec->point[spec->wall[wall].from], *q = spec->point[spec->wall[wall].to];
    const double y = fabs(q[0] - p[0]), z = fabs(q[1] - p[1]);
    if (fmin(y, z) > same * fmax(y, z))
        return -1;
    return y > z ? 0 : 1;
}

/* How far the wall goes on beyond its point: half the thickness of walls at right angles there. */
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

/* The sides of all strips along an axis, each once, ascending; their number. */
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

/* Corners between the lines, at most `step` apart: FACE_MOST has room for them. */
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
                             "wall %d is oblique: only walls along y and z of the section are "
                             "written as solids",
                             i);
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

/* Does the description replace what its sizes come to? */
static int is_overridden(const section_spec *spec)
{
    double given[sizeof spec->given / sizeof(double)];
    memcpy(given, &spec->given, sizeof given);
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++)
        if (!isnan(given[i]))
            return 1;
    return 0;
}

status face_of(const section_spec *spec, const section *constants, face *out, fault *f)
{
    memset(out, 0, sizeof *out);
    if (is_overridden(spec))
        return fault_set(f, STATUS_REFUSED,
                         "a solid has the constants of its sizes; leave out 'given'");
    if (spec->kind == SECTION_WALLS)
        return fill_walls(spec, constants->centroid, out, f);
    if (spec->kind != SECTION_RECTANGLE)
        return fault_set(f, STATUS_REFUSED,
                         "only rectangles and straight walls are written as solids; give it one "
                         "of them");
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
