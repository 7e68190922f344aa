/* Small motions in axes that rotate with angular velocity w: dx = R y. At the time when R is 1, dx'
 * = y' + w~ y and dx'' = y'' + 2 w~ y' + (w'~ + w~ w~) y. */
#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/vec3.h"

/* Three coordinates of a vertex that form a vector, and the matrices of R' and R'' in their
 * axes. */
typedef struct turning_vector {
    int at[3];
    double once[9], twice[9];
} turning_vector;

typedef struct turning_axes {
    const model *m;
    const outcome_about *about;
    int node; /* node whose axes are used; SCENE_NONE: each node uses its own axes */
} turning_axes;

static void skew(const double v[3], double A[9])
{
    const double all[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    memcpy(A, all, sizeof all);
}

/* Transforms A to the axes of the translations of a vertex. */
static void in_own(const mesh_vertex *v, double A[9])
{
    double half[9], along[9];
    if (!v->turned)
        return;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            along[3 * i + k] = v->along[3 * k + i];
    mat3_mul(along, A, half);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            A[3 * i + k] = vec3_dot(&half[3 * i], &along[3 * k]);
}

/* Finds the vector of the translations (turns 0) or of the rotations (turns 1) of a vertex. Returns
 * 0 if there is none. */
static int vector_of(const turning_axes *t, int vertex, int turns, turning_vector *out)
{
    const model *m = t->m;
    const mesh_vertex *v = model_vertex(m, vertex);
    const int released = vertex >= model_first_release(m);
    double change[9];
    frame_rates r;
    if ((!released && v->body != vertex) || (turns && v->angles > 0) ||
        (released && (!turns || forms_of(m, vertex) != FORM_BODY)))
        return 0;
    for (int k = 0; k < 3; k++) {
        const int component = (turns ? SCENE_RX : SCENE_UX) + k;
        out->at[k] = model_owns(m, vertex, component) ? v->coordinate[component] : NONE;
    }
    vertex_rates(m, t->about->state, t->node != SCENE_NONE ? t->node : vertex, t->about->rate,
                 t->about->acceleration, &r);
    skew(r.w, out->once);
    skew(r.wd, change);
    mat3_mul(out->once, out->once, out->twice);
    for (int i = 0; i < 9; i++)
        out->twice[i] += change[i];
    if (!turns) {
        in_own(v, out->once);
        in_own(v, out->twice);
    }
    return 1;
}

/* Returns 1 if a diaphragm determines both components of a translation. The nodes of a diaphragm
 * have a common rotation about its normal. */
static int moves_together(const model *m, int vertex, const int pair[2])
{
    const scene *s = model_scene(m);
    for (int i = 0; i < s->constraints && vertex < s->nodes; i++) {
        const scene_constraint *c = &s->constraint[i];
        if (c->master != SCENE_NONE && pair[0] != c->normal && pair[1] != c->normal &&
            model_tie(m, vertex, pair[0]) != NULL &&
            model_tie(m, vertex, pair[0])->node == c->master)
            return 1;
    }
    return 0;
}

/* Returns 1 if the rotation mixes a component of the vector with a component that is not free. */
static int is_tied(const turning_axes *t, int vertex, int turns, const turning_vector *v)
{
    double size = 0;
    for (int k = 0; k < 9; k++)
        size = fmax(size, fabs(v->once[k]));
    for (int k = 0; k < 9; k++) {
        const int pair[2] = {k / 3, k % 3};
        const int together = !turns && moves_together(t->m, vertex, pair);
        int free_ones = 0, there = 0;
        for (int i = 0; i < 2; i++) {
            const int c = v->at[pair[i]];
            there += c != NONE;
            if (c == NONE || c >= model_unknowns(t->m))
                continue;
            free_ones += together || vertex >= model_scene(t->m)->nodes ||
                         model_tie(t->m, vertex, (turns ? SCENE_RX : SCENE_UX) + pair[i]) == NULL;
        }
        if (fabs(v->once[k]) > 1e-9 * size && there > 0 && free_ones < 2)
            return 1;
    }
    return 0;
}

static void add_product(const sparse *A, const int at[3], const double W[9], double times,
                        sparse *out)
{
    for (int k = 0; k < 9; k++) {
        const int from = at[k / 3], to = at[k % 3];
        if (from == NONE || to == NONE || W[k] == 0)
            continue;
        for (int e = A->column[from]; e < A->column[from + 1]; e++)
            assemble_subtract(out, A->row[e], to, -times * A->value[e] * W[k]);
    }
}

status about_turning(const model *m, const outcome_about *about, int node, sparse *K, sparse *G,
                     sparse *room, fault *f)
{
    const turning_axes t = {m, about, node};
    for (int i = 0; i < K->column[K->n]; i++)
        room->value[i] = G->value[i] + about->C.value[i];
    for (int i = 0; i < 2 * model_vertices(m); i++) {
        turning_vector v;
        if (!vector_of(&t, i / 2, i % 2, &v))
            continue;
        if (is_tied(&t, i / 2, i % 2, &v)) {
            if (node == SCENE_NONE)
                continue;
            return fault_set(f, STATUS_REFUSED,
                             "%s is held, driven or constrained across the rotation of %s; hold it "
                             "in all components, or replace 'axes_of' by axes: own or fixed",
                             i / 2 < model_scene(m)->nodes
                                 ? scene_called(model_scene(m), SCENE_NODES, i / 2).text
                                 : "a node",
                             scene_called(model_scene(m), SCENE_NODES, node).text);
        }
        add_product(room, v.at, v.once, 1, K);
        add_product(&about->M, v.at, v.twice, 1, K);
        add_product(&about->M, v.at, v.once, 2, G);
    }
    return STATUS_OK;
}
