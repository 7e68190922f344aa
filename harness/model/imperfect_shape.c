#include "harness/model/model_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

/* Rotates an inertia tensor with the components xx, yy, zz, xy, yz, zx. */
static void turn_inertia(const double R[9], double inertia[6])
{
    static const int at[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    double I[9], RI[9], turned[9];
    for (int i = 0; i < 9; i++)
        I[i] = inertia[at[i]];
    mat3_mul(R, I, RI);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            turned[3 * i + j] = vec3_dot(&RI[3 * i], &R[3 * j]);
    for (int i = 0; i < 9; i++)
        inertia[at[i]] = turned[i];
}

static void rotate(const double q[4], double v[3])
{
    const double before[3] = {v[0], v[1], v[2]};
    rotation_apply(q, before, v);
}

/* Moves the nodes by increment[nodes x 6], and rotates bodies, offsets of members and places of
 * loads with them. */
static void move_nodes(const double increment[], model_imperfect *p)
{
    scene *s = &p->own;
    for (int i = 0; i < s->nodes; i++) {
        const double *turn = increment + 6 * i + 3;
        double q[4], R[9];
        rotation_exp(turn, q);
        rotation_matrix(q, R);
        for (int k = 0; k < 3; k++)
            s->node[i].position[k] += increment[6 * i + k];
        rotate(q, s->node[i].body.centre);
        if (vec3_norm(turn) > 0)
            turn_inertia(R, s->node[i].body.inertia);
        for (int k = 0; k < 2 * s->members; k++)
            if ((k % 2 ? s->member[k / 2].q : s->member[k / 2].p) == i)
                rotate(q, s->member[k / 2].offset[k % 2]);
        for (int k = 0; k < s->loads; k++)
            if (!scene_load_along(&s->load[k]) && s->load[k].where == i)
                rotate(q, s->load[k].at);
    }
}

static void add_shifts(const scene *s, scene_node node[])
{
    for (int i = 0; i < s->imperfections; i++) {
        const scene_imperfection *p = &s->imperfection[i];
        for (int k = 0; k < p->nodes; k++)
            for (int j = 0; j < 3; j++)
                node[p->node[k]].position[j] += p->factor * p->shift[k][j];
    }
}

static void fill_member(const model *m, int member, const double increment[], int vertex[],
                        model_imperfect *p)
{
    const int count = model_member_vertices(m, member, vertex), last = m->mesh.nodes - 1;
    for (int j = 0; j < count; j++) {
        const int at = p->first[member] + j;
        p->place[at] = j == count - 1 ? 1
                                      : division_place(&m->division, member, j / last,
                                                       m->mesh.place[j % last]);
        memcpy(p->shift[at], increment + 6 * vertex[j], sizeof p->shift[at]);
        memcpy(p->turn[at], increment + 6 * vertex[j] + 3, sizeof p->turn[at]);
    }
    p->first[member + 1] = p->first[member] + count;
}

static void *copy_of(const void *from, size_t size)
{
    void *to = malloc(size + 1);
    if (to != NULL && size > 0)
        memcpy(to, from, size);
    return to;
}

static status fill(const model *m, const double x[], model_imperfect *p, fault *f)
{
    const scene *s = m->scene;
    double *increment = calloc(6 * (size_t)m->mesh.vertices + 1, sizeof *increment);
    int *vertex = malloc(((size_t)m->mesh.vertices + 1) * sizeof *vertex);
    const int room = increment != NULL && vertex != NULL;
    if (room) {
        centreline_increments(m, x, increment);
        add_shifts(s, p->lines.node);
        add_shifts(s, p->own.node);
        for (int i = 0; i < s->imperfections; i++)
            p->own.imperfection[i].nodes = 0;
        for (int i = 0; i < s->members; i++)
            fill_member(m, i, increment, vertex, p);
        move_nodes(increment, p);
    }
    free(increment);
    free(vertex);
    return room ? STATUS_OK : fault_memory(f, "imperfections");
}

status model_imperfect_alloc(const model *m, const double x[], model_imperfect **out, fault *f)
{
    const scene *s = m->scene;
    size_t points = 1;
    for (int i = 0; i < s->members; i++)
        points += (size_t)model_member_vertices(m, i, NULL);
    model_imperfect *p = calloc(1, sizeof *p);
    *out = p;
    if (p == NULL)
        return fault_memory(f, "imperfections");
    p->own = p->lines = *s;
    p->lines.node = copy_of(s->node, (size_t)s->nodes * sizeof *s->node);
    for (int i = 0; i < s->imperfections; i++)
        p->modes |= s->imperfection[i].analysis != SCENE_NONE;
    p->own.node = copy_of(s->node, (size_t)s->nodes * sizeof *s->node);
    p->own.member = copy_of(s->member, (size_t)s->members * sizeof *s->member);
    p->own.load = copy_of(s->load, (size_t)s->loads * sizeof *s->load);
    p->own.imperfection =
        copy_of(s->imperfection, (size_t)s->imperfections * sizeof *s->imperfection);
    p->first = calloc((size_t)s->members + 1, sizeof *p->first);
    p->place = malloc(points * sizeof *p->place);
    p->shift = malloc(points * sizeof *p->shift);
    p->turn = malloc(points * sizeof *p->turn);
    if (p->lines.node == NULL || p->own.node == NULL || p->own.member == NULL ||
        p->own.load == NULL || p->own.imperfection == NULL || p->first == NULL ||
        p->place == NULL || p->shift == NULL || p->turn == NULL)
        return fault_memory(f, "imperfections");
    return fill(m, x, p, f);
}

void model_imperfect_free(model_imperfect *p)
{
    if (p == NULL)
        return;
    free(p->own.node);
    free(p->lines.node);
    free(p->own.member);
    free(p->own.load);
    free(p->own.imperfection);
    free(p->first);
    free(p->place);
    free(p->shift);
    free(p->turn);
    free(p);
}

status model_imperfect_build(const model *m, const model_imperfect *p, model **out, fault *f)
{
    const model_request request = {&p->own,      m->given,    m->options,
                                   m->requested, m->keep_all, m->omits};
    return model_alloc_imperfect(&request, p->modes ? p : NULL, out, f);
}

typedef struct piece {
    const double *from, *to;
    double line[3];
} piece;

/* Computes the displacement at x in [0, 1] between the two vertices: a cubic with the rotations of
 * the vertices as slopes. Returns the square of its length. */
static double shift_at(const piece *p, double x, double shift[3])
{
    const double a = 1 - x * x * (3 - 2 * x), b = x * (1 - x) * (1 - x), c = x * x * (x - 1);
    double first[3], second[3], square = 0;
    vec3_cross(p->from + 3, p->line, first);
    vec3_cross(p->to + 3, p->line, second);
    for (int i = 0; i < 3; i++) {
        shift[i] = a * p->from[i] + (1 - a) * p->to[i] + b * first[i] + c * second[i];
        square += shift[i] * shift[i];
    }
    return square;
}

static double largest_in(const piece *p)
{
    enum { SAMPLES = 16, CUTS = 60 };
    double best = 0, most = -1, shift[3];
    for (int i = 0; i <= SAMPLES; i++) {
        const double square = shift_at(p, (double)i / SAMPLES, shift);
        if (square > most) {
            most = square;
            best = (double)i / SAMPLES;
        }
    }
    double low = fmax(0, best - 1.0 / SAMPLES), high = fmin(1, best + 1.0 / SAMPLES);
    for (int i = 0; i < CUTS; i++) {
        const double third = (high - low) / 3;
        if (shift_at(p, low + third, shift) < shift_at(p, high - third, shift))
            low += third;
        else
            high -= third;
    }
    return (low + high) / 2;
}

void model_largest_shift(const model *m, const double x[], double shift[3])
{
    const double same = 1e-6; /* relative tolerance for maxima that count as equal */
    double most = 0;
    memset(shift, 0, 3 * sizeof *shift);
    for (int i = 0; i < m->mesh.elements; i++) {
        const mesh_element *el = &m->mesh.element[i];
        double local[ELEMENT_MAX_COORDINATES];
        kinematics_local(m, m->rest, el, x, local);
        for (int k = 0; k + 1 < el->nodes; k++) {
            piece p = {&local[NODE_COORDINATES * k], &local[NODE_COORDINATES * (k + 1)], {0}};
            double there[3];
            for (int j = 0; j < 3; j++)
                p.line[j] = m->mesh.vertex[el->vertex[k + 1]].position[j] -
                            m->mesh.vertex[el->vertex[k]].position[j];
            const double square = shift_at(&p, largest_in(&p), there);
            if (square <= most * (1 + 2 * same))
                continue;
            most = square;
            memcpy(shift, there, sizeof there);
        }
    }
}
