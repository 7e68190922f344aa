#include "harness/model/model_impl.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"

enum { N = NODE_COORDINATES };

enum { X = ELEMENT_MAX_COORDINATES };

static void begin(const int nodes, const int vertex[], mesh_discrete *d)
{
    memset(d, 0, sizeof *d);
    d->el.kind = d->el.member = NONE;
    d->el.nodes = nodes;
    d->el.triad = d->triad;
    for (int k = 0; k < nodes; k++) {
        d->el.vertex[k] = vertex[k];
        d->el.warp[k] = NONE;
        for (int i = 0; i < 3; i++)
            d->triad[k][4 * i] = 1;
    }
}

static mesh_discrete *add_spring(model *m, const scene_spring *spring)
{
    const int both[2] = {spring->p, spring->q}, one = spring->p == SCENE_NONE;
    mesh_discrete *d = &m->mesh.discrete[m->mesh.discretes++];
    begin(one ? 1 : 2, one ? &both[1] : both, d);
    d->spring = spring;
    m->mesh.springs++;
    return d;
}

static int founded_vertices(const model *m)
{
    int count = 0;
    for (int i = 0; i < m->scene->members; i++)
        if (scene_is_founded(&m->scene->member[i]))
            count +=
                (m->mesh.first_element[i + 1] - m->mesh.first_element[i]) * (m->mesh.nodes - 1) + 1;
    return count;
}

/* Adds to K the stiffness of a piece of a foundation. foundation: stiffnesses per length. length
 * [m]: length of the piece. R: axes of the foundation. */
static void add_founded(const double foundation[6], double length, const double R[9], double K[36])
{
    for (int block = 0; block < 2; block++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                for (int k = 0; k < 3; k++)
                    K[6 * (3 * block + i) + 3 * block + j] +=
                        length * foundation[3 * block + k] * R[3 * i + k] * R[3 * j + k];
}

static status found_member(model *m, int member, scene_spring *spring, int *used, fault *f)
{
    const scene_member *sm = &m->scene->member[member];
    const int first = m->mesh.first_element[member], last = m->mesh.nodes - 1;
    member_arc arc;
    TRY(member_arc_of(m->scene, member, 0, &arc, f));
    for (int i = first; i < m->mesh.first_element[member + 1]; i++) {
        const mesh_element *el = &m->mesh.element[i];
        for (int k = 0; k <= last; k++) {
            const double place = division_place(&m->division, member, i - first, m->mesh.place[k]);
            double position[3], R[9];
            member_arc_at(&arc, place * arc.length, position, R);
            if (k > 0 || i == first) {
                spring[*used].p = SCENE_NONE;
                spring[(*used)++].q = el->vertex[k];
            }
            add_founded(sm->foundation, el->share[k] * m->mesh.kind[el->kind].length, R,
                        spring[*used - 1].stiffness);
        }
    }
    return STATUS_OK;
}

static status found_members(model *m, fault *f)
{
    int used = 0;
    for (int i = 0; i < m->scene->members; i++) {
        const int before = used;
        if (!scene_is_founded(&m->scene->member[i]))
            continue;
        TRY(found_member(m, i, m->founded, &used, f));
        for (int k = before; k < used; k++)
            add_spring(m, &m->founded[k])->el.member = i;
    }
    return STATUS_OK;
}

scene_words model_spring_called(const model *m, int spring)
{
    scene_words out;
    if (spring < m->scene->springs)
        return scene_called(m->scene, SCENE_SPRINGS, spring);
    const mesh_discrete *d = &m->mesh.discrete[m->mesh.discretes - m->mesh.springs + spring];
    snprintf(out.text, sizeof out.text, "foundation of %.40s",
             scene_called(m->scene, SCENE_MEMBERS, d->el.member).text);
    return out;
}

status discrete_build(model *m, fault *f)
{
    const int founded = founded_vertices(m);
    int count = m->scene->springs + founded;
    for (int i = 0; i < m->scene->nodes; i++)
        count += scene_has_body(&m->scene->node[i]);
    if (count == 0)
        return STATUS_OK;
    m->mesh.discrete = calloc((size_t)count, sizeof *m->mesh.discrete);
    m->founded = calloc((size_t)founded + 1, sizeof *m->founded);
    if (m->mesh.discrete == NULL || m->founded == NULL)
        return fault_memory(f, "rigid bodies and springs");
    for (int i = 0; i < m->scene->nodes; i++)
        if (scene_has_body(&m->scene->node[i])) {
            begin(1, &i, &m->mesh.discrete[m->mesh.discretes]);
            m->mesh.discrete[m->mesh.discretes++].body = &m->scene->node[i].body;
        }
    for (int i = 0; i < m->scene->springs; i++)
        add_spring(m, &m->scene->spring[i]);
    return found_members(m, f);
}

typedef struct spring_state {
    double e[SPRING_STRAINS], sigma[SPRING_STRAINS], S[SPRING_STRAINS * SPRING_STRAINS],
        J[SPRING_STRAINS * X], H[X * X];
} spring_state;

static int number_of(const model *m, const mesh_discrete *d)
{
    return (int)(d - m->mesh.discrete) - (m->mesh.discretes - m->mesh.springs);
}

static const mesh_discrete *numbered(const model *m, int spring)
{
    return &m->mesh.discrete[m->mesh.discretes - m->mesh.springs + spring];
}

/* Adds the dashpot forces (damping times rate) to sigma. */
static void damp(const scene_spring *p, const double rate[], double sigma[])
{
    double more[SPRING_STRAINS];
    dense_mul_vec(SPRING_STRAINS, SPRING_STRAINS, p->damping, rate, more);
    for (int k = 0; k < SPRING_STRAINS; k++)
        sigma[k] += more[k];
}

static void spring_at(const model *m, const model_state *s, const mesh_discrete *d,
                      const spring_rates *r, spring_state *out)
{
    node_state x[ELEMENT_MAX_NODES];
    const int i = number_of(m, d);
    const double *turn = turns_of_spring(m, s, i);
    kinematics_gather(m, s, &d->el, x);
    spring_strain(d->el.nodes, x, turn, &(strain_output){.e = out->e, .J = out->J});
    spring_law(d->spring, out->e, out->sigma, out->S);
    if (r != NULL) {
        double rate[SPRING_STRAINS];
        for (int k = 0; k < SPRING_STRAINS; k++)
            rate[k] = r->known[SPRING_STRAINS * i + k] +
                      r->g * (out->e[k] - r->from[SPRING_STRAINS * i + k]);
        damp(d->spring, rate, out->sigma);
    }
    spring_strain(d->el.nodes, x, turn, &(strain_output){.s = out->sigma, .H = out->H});
}

/* Computes the force and the tangent of a spring or rigid body at its nodes. material 1: the
 * tangent of a spring includes J^T S J. */
static void evaluate(const model *m, const model_state *s, const mesh_discrete *d,
                     const element_rotating_frame *frame, const spring_rates *r, int material,
                     double force[], double K[])
{
    const int n = NODE_COORDINATES * d->el.nodes;
    node_state x[ELEMENT_MAX_NODES];
    if (d->spring != NULL) {
        spring_state p;
        double work[SPRING_STRAINS * X];
        spring_at(m, s, d, r, &p);
        memset(force, 0, (size_t)n * sizeof *force);
        dense_add_transpose_mul(n, SPRING_STRAINS, 1, p.J, p.sigma, force);
        memcpy(K, p.H, (size_t)(n * n) * sizeof *K);
        if (material)
            dense_add_congruence(SPRING_STRAINS, n, p.J, p.S, K, work);
        if (material && r != NULL && r->g != 0) {
            double C[SPRING_STRAINS * SPRING_STRAINS];
            for (int k = 0; k < SPRING_STRAINS * SPRING_STRAINS; k++)
                C[k] = r->g * d->spring->damping[k];
            dense_add_congruence(SPRING_STRAINS, n, p.J, C, K, work);
        }
        return;
    }
    kinematics_gather(m, s, &d->el, x);
    body_inertia(d->body, x, frame, &(inertia_output){.force = force, .N = K});
    for (int k = 0; k < n; k++)
        force[k] = -force[k];
}

static void eliminated(const model *m, const model_state *s, const mesh_discrete *d,
                       const element_rotating_frame *frame, const spring_rates *r, int material,
                       double force[], double K[])
{
    evaluate(m, s, d, frame, r, material, force, K);
    eliminate_matrix(m, s, &d->el, force, K);
    eliminate_forces(m, s, &d->el, force);
}

void discrete_equations(const model *m, const model_state *s, const mesh_discrete *d,
                        const element_rotating_frame *frame, const spring_rates *r, double force[],
                        double K[])
{
    eliminated(m, s, d, frame, r, 1, force, K);
}

void discrete_inertia(const model *m, const model_state *s, const element_rotating_frame *frame,
                      sparse *M, sparse *G)
{
    for (int i = 0; i < m->mesh.discretes - m->mesh.springs; i++) {
        const mesh_discrete *d = &m->mesh.discrete[i];
        node_state x[ELEMENT_MAX_NODES];
        double mass[X * X], gyroscopic[X * X];
        kinematics_gather(m, s, &d->el, x);
        body_inertia(d->body, x, frame, &(inertia_output){.M = mass, .G = gyroscopic});
        eliminate_matrix(m, s, &d->el, NULL, mass);
        assemble_discrete(&d->el, mass, M);
        if (G == NULL)
            continue;
        eliminate_matrix(m, s, &d->el, NULL, gyroscopic);
        assemble_discrete(&d->el, gyroscopic, G);
    }
}

void discrete_material_product(const model *m, const model_state *s, const double x[], double y[])
{
    for (int i = m->mesh.discretes - m->mesh.springs; i < m->mesh.discretes; i++) {
        const mesh_discrete *d = &m->mesh.discrete[i];
        const int n = NODE_COORDINATES * d->el.nodes;
        double local[X], e[SPRING_STRAINS], sigma[SPRING_STRAINS], force[X] = {0};
        spring_state p;
        spring_at(m, s, d, NULL, &p);
        kinematics_local(m, s, &d->el, x, local);
        dense_mul_vec(SPRING_STRAINS, n, p.J, local, e);
        dense_mul_vec(SPRING_STRAINS, SPRING_STRAINS, p.S, e, sigma);
        dense_add_transpose_mul(n, SPRING_STRAINS, 1, p.J, sigma, force);
        eliminate_forces(m, s, &d->el, force);
        assemble_vector(&d->el, force, y);
    }
}

void discrete_geometric(const model *m, const model_state *s, const element_rotating_frame *frame,
                        sparse *out)
{
    for (int i = 0; i < m->mesh.discretes; i++) {
        double force[X], K[X * X];
        eliminated(m, s, &m->mesh.discrete[i], frame, NULL, 0, force, K);
        assemble_discrete(&m->mesh.discrete[i].el, K, out);
    }
}

double discrete_material_rounding(const model *m, const model_state *s, const double x[])
{
    double sum = 0;
    for (int i = m->mesh.discretes - m->mesh.springs; i < m->mesh.discretes; i++) {
        const mesh_discrete *d = &m->mesh.discrete[i];
        const int n = NODE_COORDINATES * d->el.nodes;
        double local[X], e[SPRING_STRAINS], sigma[SPRING_STRAINS];
        spring_state p;
        spring_at(m, s, d, NULL, &p);
        kinematics_local(m, s, &d->el, x, local);
        dense_mul_vec(SPRING_STRAINS, n, p.J, local, e);
        dense_mul_vec(SPRING_STRAINS, SPRING_STRAINS, p.S, e, sigma);
        for (int k = 0; k < SPRING_STRAINS; k++)
            for (int j = 0; j < n; j++)
                sum += DBL_EPSILON * 2 * fabs(sigma[k] * p.J[k * n + j] * local[j]);
    }
    return sum;
}

double discrete_stored(const model *m, const model_state *s)
{
    double sum = 0;
    for (int i = m->mesh.discretes - m->mesh.springs; i < m->mesh.discretes; i++) {
        spring_state p;
        spring_at(m, s, &m->mesh.discrete[i], NULL, &p);
        sum += spring_energy(m->mesh.discrete[i].spring, p.e);
    }
    return sum;
}

static void add_at_node(const model *m, const model_state *s, const mesh_discrete *d,
                        double force[], int node, double F[6])
{
    for (int k = 0; k < d->el.nodes; k++) {
        double *at = force + (ptrdiff_t)NODE_COORDINATES * k, rho[3];
        if (m->mesh.vertex[d->el.vertex[k]].body != node)
            continue;
        kinematics_offset(m, s, d->el.vertex[k], rho);
        if (d->el.vertex[k] != node)
            offset_force(rho, at);
        for (int c = 0; c < 6; c++)
            F[c] += at[c];
    }
}

void discrete_node_force(const model *m, const model_state *s, const element_rotating_frame *frame,
                         int node, double F[6])
{
    for (int i = 0; i < m->mesh.discretes; i++) {
        const mesh_discrete *d = &m->mesh.discrete[i];
        double force[X], K[X * X];
        evaluate(m, s, d, frame, NULL, 1, force, K);
        add_at_node(m, s, d, force, node, F);
    }
}

void dashpots_deformations(const model *m, const model_state *s, double d[])
{
    for (int i = 0; i < m->mesh.springs; i++) {
        spring_state p;
        spring_at(m, s, numbered(m, i), NULL, &p);
        memcpy(d + (ptrdiff_t)SPRING_STRAINS * i, p.e, sizeof p.e);
    }
}

void dashpots_rates(const model *m, const model_state *s, const double dx[], double rate[])
{
    for (int i = 0; i < m->mesh.springs; i++) {
        const mesh_discrete *d = numbered(m, i);
        double local[X];
        spring_state p;
        spring_at(m, s, d, NULL, &p);
        kinematics_local(m, s, &d->el, dx, local);
        dense_mul_vec(SPRING_STRAINS, NODE_COORDINATES * d->el.nodes, p.J, local,
                      rate + (ptrdiff_t)SPRING_STRAINS * i);
    }
}

double spring_circulated(const model *m, int spring, const double d[6], const double change[6])
{
    const double *K = numbered(m, spring)->spring->stiffness;
    double sum = 0;
    for (int a = 0; a < SPRING_STRAINS; a++)
        for (int b = 0; b < a; b++)
            sum += (K[SPRING_STRAINS * a + b] - K[SPRING_STRAINS * b + a]) / 2 *
                   (change[a] * d[b] - change[b] * d[a]);
    return sum;
}

double dashpots_power(const model *m, const double rate[])
{
    double sum = 0;
    for (int i = 0; i < m->mesh.springs; i++)
        sum += dense_quadratic(SPRING_STRAINS, numbered(m, i)->spring->damping,
                               rate + (ptrdiff_t)SPRING_STRAINS * i);
    return sum;
}

/* Computes the forces of a dashpot on its nodes. rate: [springs x 6] deformation rates. */
static void force_of(const model *m, const model_state *s, int spring, const double rate[],
                     double force[])
{
    const mesh_discrete *d = numbered(m, spring);
    const int n = NODE_COORDINATES * d->el.nodes;
    double sigma[SPRING_STRAINS] = {0};
    spring_state p;
    spring_at(m, s, d, NULL, &p);
    damp(d->spring, rate + (ptrdiff_t)SPRING_STRAINS * spring, sigma);
    memset(force, 0, (size_t)n * sizeof *force);
    dense_add_transpose_mul(n, SPRING_STRAINS, 1, p.J, sigma, force);
}

void dashpots_add_forces(const model *m, const model_state *s, const double rate[], double out[])
{
    for (int i = 0; i < m->mesh.springs; i++) {
        double force[X];
        force_of(m, s, i, rate, force);
        eliminate_forces(m, s, &numbered(m, i)->el, force);
        assemble_vector(&numbered(m, i)->el, force, out);
    }
}

void dashpots_node_force(const model *m, const model_state *s, const double rate[], int node,
                         double F[6])
{
    for (int i = 0; i < m->mesh.springs; i++) {
        double force[X];
        force_of(m, s, i, rate, force);
        add_at_node(m, s, numbered(m, i), force, node, F);
    }
}

void spring_slopes(const model *m, const model_state *s, int spring, double S[36])
{
    spring_state p;
    spring_at(m, s, numbered(m, spring), NULL, &p);
    memcpy(S, p.S, sizeof p.S);
}

void dashpots_matrix(const model *m, const model_state *s, double more, sparse *C)
{
    for (int i = 0; i < m->mesh.springs; i++) {
        const mesh_discrete *d = numbered(m, i);
        double K[X * X], work[SPRING_STRAINS * X], c[SPRING_STRAINS * SPRING_STRAINS],
            sigma[SPRING_STRAINS], S[SPRING_STRAINS * SPRING_STRAINS];
        spring_state p;
        memset(K, 0, (size_t)(d->el.columns * d->el.columns) * sizeof *K);
        spring_at(m, s, d, NULL, &p);
        spring_law(d->spring, p.e, sigma, S);
        for (int k = 0; k < SPRING_STRAINS * SPRING_STRAINS; k++)
            c[k] = d->spring->damping[k] + more * S[k];
        dense_add_congruence(SPRING_STRAINS, NODE_COORDINATES * d->el.nodes, p.J, c, K, work);
        eliminate_matrix(m, s, &d->el, NULL, K);
        assemble_discrete(&d->el, K, C);
    }
}

void dashpots_strains(const model *m, const model_state *s, int spring, double d[], double J[])
{
    const mesh_element *el = &numbered(m, spring)->el;
    spring_state p;
    spring_at(m, s, numbered(m, spring), NULL, &p);
    memcpy(d, p.e, sizeof p.e);
    memcpy(J, p.J, (size_t)(SPRING_STRAINS * el->columns) * sizeof *J);
    for (int k = 0; k < SPRING_STRAINS; k++)
        eliminate_forces(m, s, el, J + (ptrdiff_t)k * el->columns);
}

void dashpots_stressed(const model *m, const model_state *s, int spring, const double sigma[],
                       double force[], double K[])
{
    const mesh_discrete *d = numbered(m, spring);
    const int n = NODE_COORDINATES * d->el.nodes;
    double J[SPRING_STRAINS * X];
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, s, &d->el, x);
    spring_strain(d->el.nodes, x, turns_of_spring(m, s, spring),
                  &(strain_output){.J = J, .s = sigma, .H = K});
    memset(force, 0, (size_t)n * sizeof *force);
    dense_add_transpose_mul(n, SPRING_STRAINS, 1, J, sigma, force);
    eliminate_matrix(m, s, &d->el, force, K);
    eliminate_forces(m, s, &d->el, force);
}
