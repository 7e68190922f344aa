#include "harness/records/records_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

enum { RING = 24 };

/* Adds the corners of a wall with thickness t and a mid-line from a to b. */
static void add_wall(outline *out, const double a[2], const double b[2], double t)
{
    const double length = hypot(b[0] - a[0], b[1] - a[1]);
    const double across[2] = {-(b[1] - a[1]) / length * t / 2, (b[0] - a[0]) / length * t / 2};
    double(*corner)[2] = out->corner[out->walls++];
    for (int i = 0; i < 2; i++) {
        corner[0][i] = a[i] + across[i];
        corner[1][i] = a[i] - across[i];
        corner[2][i] = b[i] - across[i];
        corner[3][i] = b[i] + across[i];
    }
}

static void add_side(outline *out, const section_spec *spec, int k)
{
    double(*corner)[2] = out->corner[out->walls++];
    for (int i = 0; i < 4; i++) {
        const int at = i < 2 ? k : k + 1;
        const double angle = 2 * PI * at / RING,
                     r = spec->diameter / 2 - (i == 0 || i == 3 ? spec->wall_thickness : 0);
        corner[i][0] = r * cos(angle);
        corner[i][1] = r * sin(angle);
    }
}

static void principal(const section *s, const double point[2], double out[2])
{
    const double y = point[0] - s->centroid[0], z = point[1] - s->centroid[1],
                 c = cos(s->axes_angle), d = sin(s->axes_angle);
    out[0] = c * y + d * z;
    out[1] = c * z - d * y;
}

/* Computes the lengths along y and z of the sides of a rectangle that represents a section. */
static void sides_of(const section_spec *spec, const section *c, double side[2])
{
    const double ratio = sqrt(c->Iy / c->Iz);
    side[0] = spec->kind == SECTION_MATRICES ? sqrt(12 * c->Iz / c->A) : sqrt(c->A / ratio);
    side[1] = spec->kind == SECTION_MATRICES ? sqrt(12 * c->Iy / c->A) : sqrt(c->A * ratio);
    if (c->rectangle) {
        side[0] = c->height;
        side[1] = c->width;
    }
}

static void add_rectangle(outline *out, const double side[2], int along_y)
{
    const double to[2] = {along_y ? side[0] / 2 : 0, along_y ? 0 : side[1] / 2};
    add_wall(out, (double[2]){-to[0], -to[1]}, to, side[along_y]);
}

void outline_of_far_end(const section_spec *spec, const section *c, const section *near,
                        outline *out)
{
    double side[2];
    out->walls = 0;
    out->equivalent =
        spec->kind == SECTION_MATRICES || (spec->kind == SECTION_CONSTANTS && !c->rectangle);
    if (spec->kind == SECTION_TUBE) {
        for (int k = 0; k < RING; k++)
            add_side(out, spec, k);
        return;
    }
    if (spec->kind == SECTION_WALLS) {
        for (int w = 0; w < spec->walls; w++) {
            double a[2], b[2];
            principal(c, spec->point[spec->wall[w].from], a);
            principal(c, spec->point[spec->wall[w].to], b);
            add_wall(out, a, b, spec->wall[w].thickness);
        }
        return;
    }
    sides_of(spec, near, side);
    const int along_y = side[1] < side[0];
    sides_of(spec, c, side);
    add_rectangle(out, side, along_y);
}

void outline_of(const section_spec *spec, const section *c, outline *out)
{
    outline_of_far_end(spec, c, c, out);
}

void outline_between(const outline *near, const outline *far, double x, outline *out)
{
    *out = *near;
    for (int w = 0; w < near->walls; w++)
        for (int k = 0; k < 4; k++)
            for (int i = 0; i < 2; i++)
                out->corner[w][k][i] += x * (far->corner[w][k][i] - near->corner[w][k][i]);
}

enum { POLY_LINE = 4, QUAD = 9 };

typedef struct grid {
    const scene *scene;
    const shapes *shapes;
    outline *outline;
    /* [members] outlines at the far ends of tapered members; NULL: no member is tapered */
    outline *far;
    int points, cells, ids;
    int states, *state;
} grid;

static const outline *outline_at(const grid *g, int member)
{
    return &g->outline[g->scene->member[member].section];
}

static int points_of(const grid *g, int member)
{
    return g->shapes->first[member + 1] - g->shapes->first[member];
}

static void count(grid *g)
{
    for (int i = 0; i < g->shapes->members; i++) {
        const int along = points_of(g, i), walls = outline_at(g, i)->walls;
        g->points += along * (1 + 2 * walls);
        g->cells += 1 + (along - 1) * walls;
        g->ids += along + 4 * (along - 1) * walls;
    }
}

static void choose_states(grid *g)
{
    int paths = 0, frames = 0;
    for (int i = 0; i < g->shapes->states; i++) {
        paths += g->shapes->state[i].kind == SHAPE_PATH;
        frames += g->shapes->state[i].kind == SHAPE_MOTION;
    }
    for (int i = 0; i < g->shapes->states; i++) {
        const shape_kind kind = g->shapes->state[i].kind;
        if (frames > 0
                ? kind == SHAPE_MOTION
                : paths == 0 || kind == SHAPE_PATH || (kind == SHAPE_UNDEFORMED && paths > 1))
            g->state[g->states++] = i;
    }
}

static void put_cells(record_file *r, hid_t at, const grid *g)
{
    int64_t *ids = malloc(((size_t)g->ids + 1) * sizeof *ids),
            *offset = malloc(((size_t)g->cells + 1) * sizeof *offset);
    uint8_t *type = malloc((size_t)g->cells + 1);
    int *member = malloc(((size_t)g->cells + 1) * sizeof *member);
    r->bad |= ids == NULL || offset == NULL || type == NULL || member == NULL;
    int64_t id = 0, base = 0;
    int cell = 0;
    for (int i = 0; i < g->shapes->members && !r->bad; i++) {
        const int along = points_of(g, i), walls = outline_at(g, i)->walls, width = 1 + 2 * walls;
        member[cell] = i;
        type[cell] = POLY_LINE;
        offset[cell++] = id;
        for (int k = 0; k < along; k++)
            ids[id++] = base + (int64_t)k * width;
        for (int k = 0; k + 1 < along; k++)
            for (int w = 0; w < walls; w++) {
                const int64_t edge = base + (int64_t)k * width + 1 + 2 * w;
                const int64_t corner[4] = {edge, edge + 1, edge + 1 + width, edge + width};
                member[cell] = i;
                type[cell] = QUAD;
                offset[cell++] = id;
                memcpy(ids + id, corner, sizeof corner);
                id += 4;
            }
        base += (int64_t)along * width;
    }
    if (!r->bad) {
        offset[cell] = id;
        const hsize_t cells = (hsize_t)g->cells, ends = cells + 1, all = (hsize_t)g->ids;
        H5Dclose(record_array(r, at, "Connectivity", H5T_NATIVE_INT64, 1, &all, ids));
        H5Dclose(record_array(r, at, "Offsets", H5T_NATIVE_INT64, 1, &ends, offset));
        H5Dclose(record_array(r, at, "Types", H5T_NATIVE_UINT8, 1, &cells, type));
        const hid_t data = record_group(r, at, "CellData");
        H5Dclose(record_array(r, data, "member", H5T_NATIVE_INT, 1, &cells, member));
        H5Gclose(data);
    }
    free(ids);
    free(offset);
    free(type);
    free(member);
}

enum { FIELDS = 8 };
static const struct {
    const char *name, *unit;
    int size;
} field[FIELDS] = {{"Points", "m", 3},
                   {"displacement", "m", 3},
                   {"axis_x", "1", 3},
                   {"axis_y", "1", 3},
                   {"axis_z", "1", 3},
                   {"force (N, Qy, Qz)", "N", 3},
                   {"moment (Mx, My, Mz)", "N m", 3},
                   {"bimoment", "N m^2", 1}};

/* Fills the fields of a point at (0, y, z) of the section at a point of a centre line. rest: the
 * same point in the undeformed state. */
static void fill_point(const centreline_point *p, const centreline_point *rest, double y, double z,
                       double *out[FIELDS])
{
    double R[9], R0[9];
    rotation_matrix(p->q, R);
    rotation_matrix(rest->q, R0);
    for (int i = 0; i < 3; i++) {
        const double now = p->r[i] + y * R[3 * i + 1] + z * R[3 * i + 2];
        *out[0]++ = now;
        *out[1]++ = now - (rest->r[i] + y * R0[3 * i + 1] + z * R0[3 * i + 2]);
        for (int axis = 0; axis < 3; axis++)
            *out[2 + axis]++ = R[3 * i + axis];
        *out[5]++ = p->force[i];
        *out[6]++ = p->moment[i];
    }
    *out[7]++ = p->bimoment;
}

static void fill_state(const grid *g, int state, double *out[FIELDS])
{
    const shapes *s = g->shapes;
    for (int member = 0; member < s->members; member++)
        for (int i = s->first[member]; i < s->first[member + 1]; i++) {
            const centreline_point *p = &s->point[(size_t)state * (size_t)s->points + (size_t)i],
                                   *rest = &s->point[i];
            const outline *o = outline_at(g, member);
            outline between;
            if (scene_member_tapers(&g->scene->member[member])) {
                outline_between(o, &g->far[member],
                                (double)(i - s->first[member]) / (points_of(g, member) - 1),
                                &between);
                o = &between;
            }
            fill_point(p, rest, 0, 0, out);
            for (int w = 0; w < o->walls; w++)
                for (int end = 0; end < 2; end++) {
                    const double *a = o->corner[w][2 * end], *b = o->corner[w][2 * end + 1];
                    fill_point(p, rest, (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, out);
                }
        }
}

static void put_fields(record_file *r, hid_t at, const grid *g)
{
    const size_t rows = (size_t)g->points * (size_t)g->states;
    double *all[FIELDS], *next[FIELDS];
    for (int k = 0; k < FIELDS; k++) {
        next[k] = all[k] = malloc((rows + 1) * (size_t)field[k].size * sizeof(double));
        r->bad |= all[k] == NULL;
    }
    for (int i = 0; i < g->states && !r->bad; i++)
        fill_state(g, g->state[i], next);
    const hid_t data = record_group(r, at, "PointData");
    for (int k = 0; k < FIELDS; k++) {
        const hsize_t size[2] = {rows, (hsize_t)field[k].size};
        if (!r->bad)
            H5Dclose(record_values(r, k == 0 ? at : data, field[k].name, field[k].size > 1 ? 2 : 1,
                                   size, all[k], field[k].unit));
        free(all[k]);
    }
    H5Gclose(data);
}

/* Writes offsets [states] or [states x 1]: start, start + step, start + 2 step, ... */
static void put_offsets(record_file *r, hid_t at, const char *name, const grid *g, int rank,
                        int64_t start, int64_t step)
{
    const hsize_t size[2] = {(hsize_t)g->states, 1};
    int64_t *value = calloc((size_t)g->states + 1, sizeof *value);
    r->bad |= value == NULL;
    if (value != NULL)
        for (int i = 0; i < g->states; i++)
            value[i] = start + i * step;
    H5Dclose(record_array(r, at, name, H5T_NATIVE_INT64, rank, size, value));
    free(value);
}

static void put_steps(record_file *r, hid_t at, const grid *g)
{
    const hid_t steps = record_group(r, at, "Steps");
    const hsize_t size = (hsize_t)g->states;
    double *value = calloc((size_t)g->states + 1, sizeof *value);
    r->bad |= value == NULL;
    const shape_kind kind = g->shapes->state[g->state[g->states - 1]].kind;
    const int path = kind == SHAPE_PATH || kind == SHAPE_MOTION;
    if (value != NULL)
        for (int i = 0; i < g->states; i++)
            value[i] = path ? g->shapes->state[g->state[i]].value : i;
    record_count(r, steps, "NSteps", g->states);
    H5Dclose(record_values(r, steps, "Values", 1, &size, value, NULL));
    put_offsets(r, steps, "PartOffsets", g, 1, 0, 0);
    put_offsets(r, steps, "NumberOfParts", g, 1, 1, 0);
    put_offsets(r, steps, "PointOffsets", g, 1, 0, g->points);
    put_offsets(r, steps, "CellOffsets", g, 2, 0, 0);
    put_offsets(r, steps, "ConnectivityIdOffsets", g, 2, 0, 0);
    const hid_t points = record_group(r, steps, "PointDataOffsets"),
                cells = record_group(r, steps, "CellDataOffsets");
    for (int k = 1; k < FIELDS; k++)
        put_offsets(r, points, field[k].name, g, 1, 0, g->points);
    put_offsets(r, cells, "member", g, 1, 0, 0);
    H5Gclose(points);
    H5Gclose(cells);
    H5Gclose(steps);
    free(value);
}

static void put_grid(record_file *r, const grid *g)
{
    const hid_t at = record_group(r, r->file, "VTKHDF");
    const int version[2] = {g->states > 1 ? 2 : 1, 0};
    const hsize_t one = 1;
    const struct {
        const char *name;
        int64_t value;
    } total[] = {{"NumberOfPoints", g->points},
                 {"NumberOfCells", g->cells},
                 {"NumberOfConnectivityIds", g->ids}};
    record_version(r, at, "Version", version);
    record_ascii(r, at, "Type", "UnstructuredGrid");
    for (int i = 0; i < 3; i++)
        H5Dclose(record_array(r, at, total[i].name, H5T_NATIVE_INT64, 1, &one, &total[i].value));
    put_cells(r, at, g);
    put_fields(r, at, g);
    if (g->states > 1)
        put_steps(r, at, g);
    H5Gclose(at);
}

static void make_outlines(record_file *r, grid *g)
{
    const scene *sc = g->scene;
    g->outline = calloc((size_t)sc->sections + 1, sizeof *g->outline);
    r->bad |= g->outline == NULL;
    for (int i = 0; i < sc->sections && !r->bad; i++) {
        section c;
        r->bad |= scene_constants(sc, i, &c, NULL) != STATUS_OK;
        if (!r->bad)
            outline_of(&sc->section[i], &c, &g->outline[i]);
    }
    if (!scene_tapers(sc))
        return;
    g->far = calloc((size_t)sc->members + 1, sizeof *g->far);
    r->bad |= g->far == NULL;
    for (int i = 0; i < sc->members && !r->bad; i++) {
        const scene_member *m = &sc->member[i];
        section near, far;
        r->bad |= scene_constants(sc, m->section, &near, NULL) != STATUS_OK ||
                  scene_constants(sc, m->section_q, &far, NULL) != STATUS_OK;
        if (!r->bad)
            outline_of_far_end(&sc->section[m->section_q], &far, &near, &g->far[i]);
    }
}

void vtkhdf_write(record_file *r, const scene *sc, const shapes *s)
{
    grid g = {.scene = sc, .shapes = s};
    make_outlines(r, &g);
    g.state = calloc((size_t)s->states + 1, sizeof *g.state);
    r->bad |= g.state == NULL;
    if (!r->bad) {
        count(&g);
        choose_states(&g);
        put_grid(r, &g);
    }
    free(g.outline);
    free(g.far);
    free(g.state);
}
