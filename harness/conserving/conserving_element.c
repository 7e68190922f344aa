#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/vec3.h"
#include "harness/conserving/conserving_impl.h"
#include "harness/model/kinematics.h"

enum { POINTS = 2, N = ELEMENT_MAX_COORDINATES, M = ELEMENT_MAX_STRAINS };

/* What an element keeps between its equations and the update: behind each other J_1 T_c [strains x
 * coordinates], C, memory, D(x_1) - e, A(dr, c, da) - d. */
typedef struct slot {
    double *J, *C, *memory, *gap_e, *gap_d, *sigma;
} slot;

static slot slot_of(const conserving *s, int i)
{
    const model *m = s->of.c->model;
    const int J = m->strains * m->coordinates, C = m->strains * m->strains;
    double *at = s->slot + (size_t)i * (size_t)s->slot_size;
    return (slot){at,
                  at + J,
                  at + J + C + 3 * m->strains,
                  at + J + C,
                  at + J + C + m->strains,
                  at + J + C + 2 * m->strains};
}

static const double *inner_of(const model *m, const model_state *s, int i)
{
    return m->inner > 0 ? s->inner + (size_t)i * (size_t)m->inner : NULL;
}

static const double *strains_of(const model *m, const double all[], int i)
{
    return all + (size_t)i * (size_t)m->strains;
}

static status outside(const model *m, int i, status outcome, fault *f)
{
    return fault_set(f, outcome, "element %d of member %d: outside what %s can evaluate", i,
                     m->element[i].member, m->type->name);
}

static status stress(const conserving *s, const model_state *at, int i, stress_output *out,
                     fault *f)
{
    model *m = s->of.c->model;
    double none[1] = {0};
    const double *inner = inner_of(m, at, i);
    m->counters.stress_evaluations++;
    const status outcome =
        m->type->stress(m->kind[m->element[i].kind].data, strains_of(m, at->e, i),
                        inner != NULL ? inner : none, out);
    return outcome == STATUS_OK ? outcome : outside(m, i, outcome, f);
}

status conserving_rest(conserving *s, fault *f)
{
    const model *m = s->of.c->model;
    for (int i = 0; i < m->elements; i++)
        TRY(stress(s, m->rest, i,
                   &(stress_output){.C = s->W + (size_t)i * (size_t)(m->strains * m->strains)}, f));
    return STATUS_OK;
}

status conserving_begin(conserving *s, const instant *from, fault *f)
{
    const model *m = s->of.c->model;
    for (int i = 0; i < m->elements; i++)
        TRY(stress(s, from->state, i, &(stress_output){.energy = &s->energy[i]}, f));
    return STATUS_OK;
}

status conserving_scalar(conserving *s, const instant *from, const model_state *now, int iteration,
                         fault *f)
{
    const model *m = s->of.c->model;
    const double wild = 0.3, nothing = 1e-16;
    double lacking = 0, square = 0, size = 0;
    s->largest = 0;
    for (int i = 0; i < m->elements; i++) {
        const double *d = strains_of(m, s->d, i),
                     *W = s->W + (size_t)i * (size_t)(m->strains * m->strains),
                     *before = strains_of(m, from->state->sigma, i);
        double energy, sigma[M];
        TRY(stress(s, now, i, &(stress_output){.energy = &energy, .sigma = sigma}, f));
        lacking += energy - s->energy[i];
        for (int k = 0; k < m->strains; k++) {
            lacking -= (before[k] + sigma[k]) / 2 * d[k];
            s->largest = fmax(s->largest, fabs(sigma[k]));
        }
        square += dense_quadratic(m->strains, W, d);
        size += dense_quadratic(m->strains, W, strains_of(m, now->e, i));
    }
    s->denominator = square;
    s->k = square > nothing * size && iteration > 2 ? lacking / square : 0;
    if (fabs(s->k) > wild)
        s->k = 0;
    return STATUS_OK;
}

void conserving_vertex(const conserving *s, const model_state *from, const model_state *now,
                       int vertex, double dr[3], double c[3])
{
    const model *m = s->of.c->model;
    const mesh_vertex *v = &m->vertex[vertex];
    const int *at = m->vertex[v->body].coordinate;
    double before[3], after[3];
    for (int i = 0; i < 3; i++) {
        dr[i] = at[i] != NONE ? s->step[at[i]] : 0;
        c[i] = at[SCENE_RX + i] != NONE ? s->step[at[SCENE_RX + i]] : 0;
    }
    if (v->body == vertex)
        return;
    kinematics_offset(m, from, vertex, before);
    kinematics_offset(m, now, vertex, after);
    for (int i = 0; i < 3; i++)
        before[i] = (before[i] + after[i]) / 2;
    vec3_cross(c, before, after);
    for (int i = 0; i < 3; i++)
        dr[i] += after[i];
}

/* The element's step, and what its J at the end is multiplied with: d x_1 = T_c of its own
 * coordinates. */
static void begin_element(const conserving *s, const instant *from, const model_state *now,
                          const mesh_element *el, node_state first[], cayley_step *step)
{
    const model *m = s->of.c->model;
    double dr[ELEMENT_MAX_NODES][3], c[ELEMENT_MAX_NODES][3], da[ELEMENT_MAX_NODES];
    kinematics_gather(m, from->state, el, first);
    for (int j = 0; j < el->nodes; j++) {
        conserving_vertex(s, from->state, now, el->vertex[j], dr[j], c[j]);
        da[j] = el->warp[j] == NONE ? 0 : s->step[m->warp[el->warp[j]].coordinate];
    }
    cayley_begin(el->nodes, first, dr, c, da, step);
}

/* J <- J T_c on the columns of rotations. */
static void behind_turns(const model *m, const cayley_step *step, double J[])
{
    for (int j = 0; j < step->nodes; j++) {
        double T[9];
        cayley_tangent(step->c[j], T);
        for (int r = 0; r < m->strains; r++) {
            double *at = J + r * m->coordinates + NODE_COORDINATES * j + 3, row[3];
            mat3_transpose_mul_vec(T, at, row);
            memcpy(at, row, sizeof row);
        }
    }
}

/* Of an element: rows by forces on dr, c, da of its nodes. */
typedef struct element_equations {
    double force[N], K[N * N], column[N], row[N];
    double incompatibility;
} element_equations;

/* Shapes of sigma by the gaps. */
static void stresses_of(const conserving *s, int i, const double sigma_n[], const slot *w,
                        const double present[], double middle[], double all[])
{
    const model *m = s->of.c->model;
    const double *W = s->W + (size_t)i * (size_t)(m->strains * m->strains),
                 *d = strains_of(m, s->d, i);
    for (int r = 0; r < m->strains; r++) {
        double Wd = 0, gaps = 0;
        for (int c = 0; c < m->strains; c++) {
            Wd += W[r * m->strains + c] * d[c];
            gaps += w->C[r * m->strains + c] * w->gap_e[c] / 2 +
                    s->k * W[r * m->strains + c] * w->gap_d[c];
        }
        middle[r] = (sigma_n[r] + present[r]) / 2 + s->k * Wd;
        all[r] = middle[r] + gaps;
    }
}

/* A^T for stresses as columns: forces of each. */
static void forces_of(const model *m, const cayley_step *step, double J[POINTS][M * N],
                      const double sigma[], double f[], double F[])
{
    memset(f, 0, (size_t)m->coordinates * sizeof *f);
    for (int g = 0; g < POINTS; g++)
        dense_add_transpose_mul(m->coordinates, m->strains, 1, J[g], sigma, f);
    for (int k = 0; k < m->coordinates; k++)
        f[k] /= POINTS;
    cayley_forces(step, f, F);
}

static const double place[POINTS] = {0.21132486540518711775, 0.78867513459481288225};

/* dA^T (middle): K[7n x 7n] += */
static void add_geometric(const model *m, const cayley_step *step, double J[POINTS][M * N],
                          double H[POINTS][N * N], const double middle[], const double f[],
                          double K[])
{
    const int n = m->coordinates;
    double at_point[POINTS][N];
    memset(at_point, 0, sizeof at_point);
    for (int g = 0; g < POINTS; g++)
        dense_add_transpose_mul(n, m->strains, 1, J[g], middle, at_point[g]);
    for (int q = 0; q < n; q++) {
        cayley_change by;
        double df[N] = {0}, y[N], Hy[N], dF[N];
        cayley_change_by(step, q, &by);
        for (int g = 0; g < POINTS; g++) {
            cayley_change_between(step, &by, place[g], y);
            dense_mul_vec(n, n, H[g], y, Hy);
            for (int j = 0; j < step->nodes; j++) {
                double turned[3];
                const int at = NODE_COORDINATES * j + 3;
                vec3_cross(y + at, at_point[g] + at, turned);
                for (int k = 0; k < 3; k++)
                    Hy[at + k] += turned[k] / 2;
            }
            for (int k = 0; k < n; k++)
                df[k] += Hy[k] / POINTS;
        }
        cayley_change_forces(step, &by, f, df, dF);
        for (int k = 0; k < n; k++)
            K[k * n + q] += dF[k];
    }
}

static status equations(conserving *s, int i, const instant *from, const model_state *now,
                        cayley_step *step, element_equations *out, fault *f)
{
    model *m = s->of.c->model;
    const mesh_element *el = &m->element[i];
    const element_data *data = m->kind[el->kind].data;
    const int n = m->coordinates, strains = m->strains;
    const double *W = s->W + (size_t)i * (size_t)(strains * strains), *d = strains_of(m, s->d, i),
                 *e = strains_of(m, now->e, i), *sigma_n = strains_of(m, from->state->sigma, i);
    node_state first[ELEMENT_MAX_NODES], last[ELEMENT_MAX_NODES], x[POINTS][ELEMENT_MAX_NODES];
    double D[M], J[POINTS][M * N], H[POINTS][N * N], present[M], middle[M], all[M], forces[N],
        A[N * M], f_of[N];
    const slot w = slot_of(s, i);
    begin_element(s, from, now, el, first, step);
    kinematics_gather(m, now, el, last);
    m->type->strain(data, last, &(strain_output){.e = D, .J = w.J});
    TRY(stress(s, now, i, &(stress_output){.sigma = present, .C = w.C, .memory = w.memory}, f));
    behind_turns(m, step, w.J);
    memset(w.gap_d, 0, (size_t)strains * sizeof *w.gap_d);
    for (int g = 0; g < POINTS; g++) {
        double part[M];
        cayley_between(step, place[g], x[g]);
        m->type->strain(data, x[g], &(strain_output){.J = J[g]});
        dense_mul_vec(strains, n, J[g], step->y, part);
        for (int k = 0; k < strains; k++)
            w.gap_d[k] += part[k] / POINTS;
    }
    m->counters.strain_evaluations += 1 + 2 * POINTS;
    out->incompatibility = 0;
    for (int k = 0; k < strains; k++) {
        w.gap_e[k] = D[k] - e[k];
        w.gap_d[k] -= d[k];
        out->incompatibility =
            fmax(out->incompatibility, fabs(w.gap_e[k]) / m->kind[el->kind].length);
    }
    stresses_of(s, i, sigma_n, &w, present, middle, all);
    memcpy(w.sigma, present, (size_t)strains * sizeof *present);
    for (int g = 0; g < POINTS; g++)
        m->type->strain(data, x[g], &(strain_output){.s = middle, .H = H[g]});
    forces_of(m, step, J, all, forces, out->force);
    /* columns of A^T, for all stresses */
    for (int k = 0; k < strains; k++) {
        double unit[M] = {0}, F[N], ignored[N];
        unit[k] = 1;
        forces_of(m, step, J, unit, ignored, F);
        for (int r = 0; r < n; r++)
            A[r * strains + k] = F[r];
    }
    double tangent[M * M], inside[M * N], Wd[M], k_e[M], k_d[M];
    for (int k = 0; k < strains * strains; k++)
        tangent[k] = w.C[k] / 2 + s->k * W[k];
    dense_mul(strains, strains, n, tangent, w.J, inside);
    dense_mul(n, strains, n, A, inside, out->K);
    forces_of(m, step, J, middle, f_of, forces);
    add_geometric(m, step, J, H, middle, f_of, out->K);
    memset(out->column, 0, sizeof out->column);
    memset(out->row, 0, sizeof out->row);
    if (s->k == 0 || s->denominator <= 0)
        return STATUS_OK;
    dense_mul_vec(strains, strains, W, d, Wd);
    for (int r = 0; r < strains; r++) {
        double Cd = 0;
        for (int c = 0; c < strains; c++)
            Cd += w.C[r * strains + c] * d[c];
        k_e[r] = (present[r] - Cd / 2) / s->denominator;
        k_d[r] = (-(sigma_n[r] + present[r]) / 2 - 2 * s->k * Wd[r]) / s->denominator;
        s->missing += k_e[r] * w.gap_e[r] + k_d[r] * w.gap_d[r];
        k_e[r] += k_d[r];
    }
    dense_mul_vec(n, strains, A, Wd, out->column);
    dense_add_transpose_mul(n, strains, 1, w.J, k_e, out->row);
    return STATUS_OK;
}

/* Of a vertex beside its body: dr_s = dr_b + c x rho_m, whose derivative is T_c dc x rho_1; forces
 * on the body: f, M + rho_m x f, with the derivative of rho_m. */
static void to_body(const conserving *s, const instant *from, const model_state *now, int vertex,
                    int at, const double c[3], element_equations *q)
{
    const model *m = s->of.c->model;
    const int n = m->coordinates;
    double before[3], rho[3], mean[3], T[9], B[9], moved[9], lever[3];
    if (m->vertex[vertex].body == vertex)
        return;
    kinematics_offset(m, from->state, vertex, before);
    kinematics_offset(m, now, vertex, rho);
    cayley_tangent(c, T);
    const double skew[9] = {0, -rho[2], rho[1], rho[2], 0, -rho[0], -rho[1], rho[0], 0};
    mat3_mul(skew, T, B);
    for (int i = 0; i < 3; i++)
        mean[i] = (before[i] + rho[i]) / 2;
    for (int i = 0; i < 9; i++)
        moved[i] = -B[i]; /* d(dr_s)/dc, and of rho_1 */
    for (int r = 0; r < n; r++)
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                q->K[r * n + at + 3 + k] += q->K[r * n + at + i] * moved[3 * i + k];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            q->row[at + 3 + k] += q->row[at + i] * moved[3 * i + k];
    for (int j = 0; j < n; j++) {
        const double column[3] = {q->K[at * n + j], q->K[(at + 1) * n + j], q->K[(at + 2) * n + j]};
        vec3_cross(mean, column, lever);
        for (int i = 0; i < 3; i++)
            q->K[(at + 3 + i) * n + j] += lever[i];
    }
    for (int k = 0; k < 3; k++) {
        const double half[3] = {moved[k] / 2, moved[3 + k] / 2, moved[6 + k] / 2};
        vec3_cross(half, q->force + at, lever);
        for (int i = 0; i < 3; i++)
            q->K[(at + 3 + i) * n + at + 3 + k] += lever[i];
    }
    vec3_cross(mean, q->force + at, lever);
    for (int i = 0; i < 3; i++)
        q->force[at + 3 + i] += lever[i];
    vec3_cross(mean, q->column + at, lever);
    for (int i = 0; i < 3; i++)
        q->column[at + 3 + i] += lever[i];
}

status conserving_elements(conserving *s, const instant *from, const model_state *now,
                           double *incompatibility, fault *f)
{
    const model *m = s->of.c->model;
    const mesh_pattern *pattern = &m->pattern[0];
    s->missing = 0;
    for (int i = 0; i < m->elements; i++) {
        const mesh_element *el = &m->element[i];
        element_equations q;
        cayley_step step;
        TRY(equations(s, i, from, now, &step, &q, f));
        for (int j = 0; j < el->nodes; j++)
            to_body(s, from, now, el->vertex[j], NODE_COORDINATES * j, step.c[j], &q);
        *incompatibility = fmax(*incompatibility, q.incompatibility);
        assemble_matrix(pattern, i, q.K, &s->S);
        for (int k = 0; k < el->columns; k++)
            q.force[k] = -q.force[k];
        assemble_vector(el, q.force, s->residual);
        assemble_vector(el, q.column, s->column);
        assemble_vector(el, q.row, s->row);
    }
    return STATUS_OK;
}

/* Own increments of an element's nodes: dr, dc, da. */
static void own_increments(const conserving *s, const model_state *now, const mesh_element *el,
                           double local[])
{
    const model *m = s->of.c->model;
    for (int j = 0; j < el->nodes; j++) {
        const int v = el->vertex[j];
        double *at = local + NODE_COORDINATES * j, rho[3], T[9], turn[3], moved[3], c[3];
        const int *body = m->vertex[m->vertex[v].body].coordinate;
        for (int k = 0; k < NODE_COORDINATES; k++) {
            const int index = el->index[NODE_COORDINATES * j + k];
            at[k] = index == NONE ? 0 : s->dx[index];
        }
        if (m->vertex[v].body == v)
            continue;
        for (int k = 0; k < 3; k++)
            c[k] = body[SCENE_RX + k] != NONE ? s->step[body[SCENE_RX + k]] : 0;
        kinematics_offset(m, now, v, rho);
        cayley_tangent(c, T);
        mat3_mul_vec(T, at + 3, turn);
        vec3_cross(turn, rho, moved);
        for (int k = 0; k < 3; k++)
            at[k] += moved[k];
    }
}

double conserving_update(conserving *s, const instant *from, model_state *now)
{
    model *m = s->of.c->model;
    double largest = 0;
    (void)from;
    s->change = 0;
    for (int i = 0; i < m->elements; i++) {
        const mesh_element *el = &m->element[i];
        const slot w = slot_of(s, i);
        double local[N], more[M], de[M], *e = now->e + (size_t)i * (size_t)m->strains,
                                         *sigma = now->sigma + (size_t)i * (size_t)m->strains,
                                         *d = s->d + (size_t)i * (size_t)m->strains, dsigma[M];
        own_increments(s, now, el, local);
        dense_mul_vec(m->strains, m->coordinates, w.J, local, more);
        for (int k = 0; k < m->strains; k++) {
            de[k] = w.gap_e[k] + more[k];
            e[k] += de[k];
            d[k] += w.gap_d[k] + more[k];
        }
        dense_mul_vec(m->strains, m->strains, w.C, de, dsigma);
        for (int k = 0; k < m->strains; k++) {
            const double next = w.sigma[k] + dsigma[k];
            s->change = fmax(s->change, fabs(next - sigma[k]));
            sigma[k] = next;
        }
        if (m->type->update != NULL)
            largest = fmax(largest, m->type->update(m->kind[el->kind].data, de, w.memory,
                                                    &now->inner[(size_t)i * (size_t)m->inner]));
    }
    return largest;
}
