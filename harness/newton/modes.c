#include "harness/newton/newton.h"

#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"

static void put(const model *m, int row, const row_label *label, row_label out[])
{
    if (row >= 0 && row < model_unknowns(m) && out[row].component == NULL)
        out[row] = *label;
}

static const char *component_of(const model *m, int vertex, int c)
{
    static const char *const plain[] = {"ux", "uy", "uz", "rx", "ry", "rz"},
                             *const angle[] = {"angle 1", "angle 2", "angle 3"},
                             *const kept[] = {"shift 1", "shift 2", "shift 3",
                                              "turn 1",  "turn 2",  "turn 3"};
    if (release_of(m, vertex) != NULL)
        return kept[c];
    return c >= SCENE_RX && model_vertex(m, vertex)->angles > 0 ? angle[c - SCENE_RX] : plain[c];
}

static void put_vertex(const model *m, int vertex, row_label label, row_label out[])
{
    const mesh_vertex *v = model_vertex(m, vertex);
    if (v->body != vertex && release_of(m, vertex) == NULL)
        return;
    for (int c = 0; c < VERTEX_COORDINATES; c++) {
        label.component = component_of(m, vertex, c);
        label.unit = c < SCENE_RX ? "m" : "rad";
        put(m, v->coordinate[c], &label, out);
    }
}

static void put_scalars(const model *m, const mesh_element *el, int k, row_label label,
                        row_label out[])
{
    static const char *const names[ELEMENT_MAX_SCALARS] = {"scalar 1", "scalar 2", "scalar 3",
                                                           "scalar 4", "scalar 5", "scalar 6"};
    for (int i = 0; i < el->scalars; i++) {
        if (mesh_scalar(el, k, i) == NONE)
            continue;
        label.component = names[i];
        label.unit = "1";
        put(m, model_warp(m, mesh_scalar(el, k, i)), &label, out);
    }
}

static void put_element(const model *m, const mesh_element *el, row_label out[])
{
    const int number = (int)(el - model_element(m, model_first_element(m, el->member)));
    for (int k = 0; k < el->nodes; k++) {
        const int vertex = el->vertex[k], is_node = vertex < model_scene(m)->nodes;
        const double at = division_place(model_division(m), el->member, number, model_places(m)[k]);
        row_label label = {
            .node = is_node ? vertex : SCENE_NONE, .member = el->member, .along = at};
        memcpy(label.position, model_vertex(m, vertex)->position, sizeof label.position);
        if (!is_node)
            put_vertex(m, vertex, label, out);
        put_scalars(m, el, k, label, out);
        if (el->warp[k] == NONE)
            continue;
        label.component = "warping";
        label.unit = "rad/m";
        put(m, model_warp(m, el->warp[k]), &label, out);
    }
}

void rows_label(const model *m, row_label out[])
{
    memset(out, 0, (size_t)model_unknowns(m) * sizeof *out);
    for (int i = 0; i < model_scene(m)->nodes; i++) {
        row_label label = {.node = i, .member = SCENE_NONE, .along = NAN};
        memcpy(label.position, model_vertex(m, i)->position, sizeof label.position);
        put_vertex(m, i, label, out);
    }
    for (int i = 0; i < model_elements(m); i++)
        put_element(m, model_element(m, i), out);
}

/* Determines the family of a mode: axial, along y, along z or twist. Each family has a sum of
 * squares: of translations along the member, of translations along its y axis, along its z axis, or
 * of the twist times the radius of gyration. The largest sum decides. The number of half-waves
 * follows from sign changes of the leading component along the first member. */

enum { AXIAL, ALONG_Y, ALONG_Z, TWIST, MEASURES };

/* Computes the components of the motion of a vertex in the axes of the member: x, y, z, and the
 * twist times `radius`. */
static void components(const double R[9], double radius, const double u[7], double out[MEASURES])
{
    for (int k = 0; k < 3; k++)
        out[k] = R[k] * u[0] + R[3 + k] * u[1] + R[6 + k] * u[2];
    out[TWIST] = radius * (R[0] * u[3] + R[3] * u[4] + R[6] * u[5]);
}

/* Computes measures for modes without translation of vertices: rotations of the section about z and
 * y times `radius`, and warping times `radius`^2. */
static void turns(const double R[9], double radius, const double u[7], double out[MEASURES])
{
    out[AXIAL] = 0;
    out[ALONG_Y] = radius * (R[2] * u[3] + R[5] * u[4] + R[8] * u[5]);
    out[ALONG_Z] = -radius * (R[1] * u[3] + R[4] * u[4] + R[7] * u[5]);
    out[TWIST] = radius * radius * u[6];
}

/* Returns the number of half-waves. value[MEASURES i]: value at vertex i. */
static int count_half_waves(int vertices, const double *value)
{
    double largest = 0, last = 0;
    int waves = 0;
    for (int i = 0; i < vertices; i++)
        largest = fmax(largest, fabs(value[MEASURES * i]));
    for (int i = 0; i < vertices; i++) {
        if (fabs(value[MEASURES * i]) <= 1e-6 * largest)
            continue;
        if (waves == 0 || value[MEASURES * i] * last < 0)
            waves++;
        last = value[MEASURES * i];
    }
    return waves;
}

typedef struct motion {
    int points, first_member; /* number of points of all members, and of the first member */
    double *part;             /* [points x MEASURES] */
    double *turn;             /* [points x MEASURES] the measures of turns() */
} motion;

static int points_of(const model *m, const scene *s)
{
    int points = 0;
    for (int member = 0; member < s->members; member++)
        points += model_member_vertices(m, member, NULL);
    return points;
}

static void fill_motion(const model *m, const scene *s, const double *u, int *index, motion *out)
{
    for (int member = 0; member < s->members; member++) {
        const scene_member *sm = &s->member[member];
        const section *p = model_section(m, sm->section), *q = model_section(m, sm->section_q);
        const double radius = (sqrt(p->Ip / p->A) + sqrt(q->Ip / q->A)) / 2;
        double d[3], R[9];
        scene_chord(s, member, d);
        rotation_triad(d, sm->y_axis, R);
        const int count = model_member_vertices(m, member, index);
        for (int i = 0; i < count; i++, out->points++) {
            components(R, radius, &u[NODE_COORDINATES * index[i]],
                       &out->part[MEASURES * out->points]);
            turns(R, radius, &u[NODE_COORDINATES * index[i]], &out->turn[MEASURES * out->points]);
        }
    }
}

static status motion_alloc(const model *m, const scene *s, const double mode[], motion *out,
                           fault *f)
{
    const size_t vertices = (size_t)model_shape(m, NULL, NULL, NULL),
                 points = (size_t)points_of(m, s);
    double *u = malloc((vertices * NODE_COORDINATES + 1) * sizeof *u);
    int *index = malloc((vertices + 1) * sizeof *index);
    out->points = 0;
    out->first_member = s->members > 0 ? model_member_vertices(m, 0, NULL) : 0;
    out->part = malloc((2 * points * MEASURES + 1) * sizeof *out->part);
    out->turn = out->part + points * MEASURES;
    const int good = u != NULL && index != NULL && out->part != NULL;
    if (good) {
        model_shape(m, mode, u, NULL);
        fill_motion(m, s, u, index, out);
    }
    free(u);
    free(index);
    if (good)
        return STATUS_OK;
    free(out->part);
    out->part = NULL;
    return fault_memory(f, "a mode");
}

static void squares(int points, const double *part, double sum[MEASURES])
{
    memset(sum, 0, MEASURES * sizeof *sum);
    for (int i = 0; i < points; i++)
        for (int k = 0; k < MEASURES; k++)
            sum[k] += part[MEASURES * i + k] * part[MEASURES * i + k];
}

static int largest_of(const double sum[MEASURES])
{
    int leading = 0;
    for (int k = 1; k < MEASURES; k++)
        leading = sum[k] > sum[leading] ? k : leading;
    return leading;
}

/* If the sum of squares of the components is below this fraction of that of the measures of
 * turns(), the components are rounding errors and those measures decide instead. */
static const double in_place_part = 1e-16;

status modes_identify(const model *m, const scene *s, const double mode[], mode_shape *out,
                      fault *f)
{
    static const scene_family family[MEASURES] = {SCENE_AXIAL, SCENE_BENDING_Y, SCENE_BENDING_Z,
                                                  SCENE_TORSION};
    motion shape;
    TRY(motion_alloc(m, s, mode, &shape, f));
    double moved[MEASURES], turned[MEASURES], all = 0, in_place = 0;
    squares(shape.points, shape.part, moved);
    squares(shape.points, shape.turn, turned);
    for (int k = 0; k < MEASURES; k++) {
        all += moved[k];
        in_place += turned[k];
    }
    const int stays = !(all > in_place_part * in_place),
              leading = largest_of(stays ? turned : moved);
    out->family = family[leading];
    out->half_waves =
        count_half_waves(shape.first_member, (stays ? shape.turn : shape.part) + leading);
    free(shape.part);
    return STATUS_OK;
}

static void bends_and_twists(const model *m, const scene *s, const motion *shape, int stays,
                             double *bends, double *twists)
{
    *bends = *twists = 0;
    for (int member = 0, point = 0; member < s->members; member++) {
        const section *p = model_section(m, s->member[member].section),
                      *q = model_section(m, s->member[member].section_q);
        const double radius = (sqrt(p->Ip / p->A) + sqrt(q->Ip / q->A)) / 2,
                     back = radius > 0 && !stays ? 1 / radius : 0;
        for (int i = model_member_vertices(m, member, NULL); i > 0; i--, point++) {
            const double *x = (stays ? shape->turn : shape->part) + MEASURES * point,
                         turn = x[TWIST] * back, y = x[ALONG_Y] - turn * (p->zs + q->zs) / 2,
                         z = x[ALONG_Z] + turn * (p->ys + q->ys) / 2;
            *bends += y * y + z * z;
            *twists += x[TWIST] * x[TWIST];
        }
    }
}

status modes_kind(const model *m, const scene *s, const double mode[], const char **kind, fault *f)
{
    const double pure = 1e-4; /* fraction of the sum of squares below which a motion is neglected */
    double moved[MEASURES], turned[MEASURES], all = 0, in_place = 0, bends, twists;
    motion shape;
    TRY(motion_alloc(m, s, mode, &shape, f));
    squares(shape.points, shape.part, moved);
    squares(shape.points, shape.turn, turned);
    for (int k = 0; k < MEASURES; k++) {
        all += moved[k];
        in_place += turned[k];
    }
    bends_and_twists(m, s, &shape, !(all > in_place_part * in_place), &bends, &twists);
    free(shape.part);
    *kind = twists <= pure * (bends + twists)  ? "flexural"
            : bends <= pure * (bends + twists) ? "torsional"
                                               : "flexural-torsional";
    return STATUS_OK;
}

int modes_in_family(const scene_mode *wanted, const mode_shape *shape)
{
    const int family = wanted->family == SCENE_ANY ||
                       (wanted->family == SCENE_NOT_AXIAL ? shape->family != SCENE_AXIAL
                                                          : shape->family == wanted->family);
    return family && (wanted->half_waves == 0 || shape->half_waves == wanted->half_waves);
}

const char *modes_family_name(scene_family family)
{
    switch (family) {
    case SCENE_AXIAL:
        return "axial";
    case SCENE_BENDING_Y:
        return "bending along y";
    case SCENE_BENDING_Z:
        return "bending along z";
    case SCENE_TORSION:
        return "torsion";
    case SCENE_ANY:
    case SCENE_NOT_AXIAL:
        break;
    }
    return "any";
}

enum { MOST = 8 };

static status motions_alloc(const model *m, const scene *s, int count, size_t n, const double *mode,
                            motion shape[], fault *f)
{
    for (int i = 0; i < count; i++)
        TRY(motion_alloc(m, s, mode + (size_t)i * n, &shape[i], f));
    return STATUS_OK;
}

static void products(int count, const motion shape[], double along_z[], double all[])
{
    memset(along_z, 0, (size_t)(count * count) * sizeof *along_z);
    memset(all, 0, (size_t)(count * count) * sizeof *all);
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
            for (int k = 0; k < shape[i].points * MEASURES; k++) {
                const double product = shape[i].part[k] * shape[j].part[k];
                all[i * count + j] += product;
                along_z[i * count + j] += k % MEASURES == ALONG_Z ? product : 0;
            }
}

/* Computes mode[count x n] <- C mode, where C[count x count] is stored by rows. */
static void combine(int count, size_t n, const double C[], double *mode)
{
    for (size_t k = 0; k < n; k++) {
        double old[MOST] = {0};
        for (int i = 0; i < count; i++)
            old[i] = mode[(size_t)i * n + k];
        for (int i = 0; i < count; i++) {
            mode[(size_t)i * n + k] = 0;
            for (int j = 0; j < count; j++)
                mode[(size_t)i * n + k] += C[i * count + j] * old[j];
        }
    }
}

static status separate_cluster(const model *m, const scene *s, int count, size_t n, double *mode,
                               fault *f)
{
    double along_z[MOST * MOST], all[MOST * MOST], w[MOST];
    motion shape[MOST] = {{0}};
    const int size = count < MOST ? count : MOST;
    const status outcome = motions_alloc(m, s, size, n, mode, shape, f);
    if (outcome == STATUS_OK)
        products(size, shape, along_z, all);
    for (int i = 0; i < size; i++)
        free(shape[i].part);
    TRY(outcome);
    if (LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'U', size, along_z, size, all, size, w) == 0)
        combine(size, n, along_z, mode);
    return STATUS_OK;
}

static int cluster_end(int first, int count, const double value[])
{
    const double equal = 1e-8; /* largest relative difference between values that count as equal */
    int end = first + 1;
    while (end < count && fabs(value[end] - value[first]) <= equal * fabs(value[first]))
        end++;
    return end;
}

status modes_separate(const model *m, const scene *s, int count, const double value[], size_t n,
                      double *mode, fault *f)
{
    for (int first = 0, end; first < count; first = end) {
        end = cluster_end(first, count, value);
        if (end - first > 1)
            TRY(separate_cluster(m, s, end - first, n, mode + (size_t)first * n, f));
    }
    return STATUS_OK;
}

identity identity_begin(void)
{
    return (identity){{14695981039346656037ull, 0x9e3779b97f4a7c15ull}};
}

void identity_add(identity *out, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++) {
        out->part[0] = (out->part[0] ^ at[i]) * 1099511628211ull;
        out->part[1] = (out->part[1] + at[i] + 1) * 0xd6e8feb86659fd93ull;
        out->part[1] ^= out->part[1] >> 32;
    }
}

static void add_number(identity *out, long number)
{
    identity_add(out, &number, sizeof number);
}

static void add_type(identity *out, const element_type *type)
{
    element_type t;
    memcpy(&t, type, sizeof t);
    t.name = t.summary = t.source = t.family = t.lacks_by = t.own_theory = NULL;
    t.offers = t.lacks = t.shear_theories = 0;
    t.data_size = NULL;
    t.prepare = NULL;
    t.order = NULL;
    t.judged = NULL;
    memset(t.options, 0, sizeof t.options);
    identity_add(out, &t, sizeof t);
}

static void add_elements(identity *out, const model *m)
{
    for (int i = 0; i < model_kinds(m); i++) {
        identity_add(out, &model_kind(m, i)->length, sizeof model_kind(m, i)->length);
        identity_add(out, model_kind(m, i)->data, model_kind(m, i)->data_size);
    }
    for (int i = 0; i < model_elements(m); i++) {
        add_number(out, model_element(m, i)->kind);
        identity_add(out, model_element(m, i)->warp, sizeof model_element(m, i)->warp);
        identity_add(out, model_element(m, i)->scalar, sizeof model_element(m, i)->scalar);
        identity_add(out, model_element(m, i)->held, sizeof model_element(m, i)->held);
        identity_add(out, model_element(m, i)->triad, (size_t)model_nodes(m) * sizeof(mesh_triad));
    }
}

int identity_add_model(identity *out, const model *m)
{
    const char *const *line;
    const int lines = model_left_out(m, &line);
    if (model_type(m)->trouble != NULL)
        return 0;
    add_type(out, model_type(m));
    add_number(out, model_features(m));
    add_number(out, model_features(m) & model_type(m)->offers);
    add_number(out, model_keeps_all(m));
    add_number(out, model_elements(m));
    add_number(out, model_unknowns(m));
    add_number(out, model_driven(m));
    for (int i = 0; i < ELEMENT_MAX_OPTIONS; i++)
        identity_add(out, &model_options(m)[i], sizeof model_options(m)[i]);
    for (int i = 0; i < lines; i++)
        identity_add(out, line[i], strlen(line[i]) + 1);
    add_elements(out, m);
    return 1;
}
