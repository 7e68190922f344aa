/* Forces A^T sigma_m of elements and springs and their tangent. Geometric terms, all that a stress
 * is a factor of, take s + k W d and never the false stresses of the gaps. */
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/time/deformable.h"
#include "harness/time/place.h"

enum { N = ELEMENT_MAX_COORDINATES, M = DEFORMABLE_STRAINS };

/* What is known before strains are asked: (sigma_n + P'(e))/2 + k W d, and of damping eta S0 d/h.
 */
static void middle_of(const conserving *s, evaluation *v)
{
    const deformable *of = &v->of;
    double Wd[M];
    dense_mul_vec(of->strains, of->strains, of->W, of->d, Wd);
    for (int k = 0; k < of->strains; k++)
        v->middle[k] = (of->before[k] + of->present[k]) / 2 + s->k * Wd[k];
    if (of->S == NULL)
        return;
    dense_mul_vec(of->strains, of->strains, of->S, of->d, Wd);
    for (int k = 0; k < of->strains; k++)
        v->middle[k] += of->damping / s->h * Wd[k];
}

/* Gaps, and sigma_m with what they add. */
static double gaps_of(const conserving *s, const double J[], evaluation *v, double sigma[])
{
    const deformable *of = &v->of;
    double d[M], C_e[M], W_d[M], largest = 0;
    dense_mul_vec(of->strains, of->coordinates, J, v->step.y, d);
    for (int k = 0; k < of->strains; k++) {
        of->gap_e[k] = v->D[k] - of->e[k];
        of->gap_d[k] = d[k] - of->d[k];
        largest = fmax(largest, fabs(of->gap_e[k]) / of->length);
    }
    memcpy(sigma, v->middle, (size_t)of->strains * sizeof *sigma);
    if (s->settled)
        return largest;
    dense_mul_vec(of->strains, of->strains, of->C, of->gap_e, C_e);
    dense_mul_vec(of->strains, of->strains, of->W, of->gap_d, W_d);
    for (int k = 0; k < of->strains; k++)
        sigma[k] += C_e[k] / 2 + s->k * W_d[k];
    if (of->S != NULL) {
        dense_mul_vec(of->strains, of->strains, of->S, of->gap_d, W_d);
        for (int k = 0; k < of->strains; k++)
            sigma[k] += of->damping / s->h * W_d[k];
    }
    return largest;
}

/* H + 1/2 of what the spin does to moments, times how x(s) moves: out[n x n] +=. */
static void add_curved_strains(const cayley_slopes *by, int g, evaluation *v, double out[])
{
    const deformable *of = &v->of;
    const int n = of->coordinates;
    double f[N] = {0};
    dense_add_transpose_mul(n, of->strains, 1, v->J[g], v->middle, f);
    for (int j = 0; j < of->el->nodes; j++) {
        const int at = NODE_COORDINATES * j + 3;
        double spun[9];
        cayley_skew(f + at, spun);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                v->H[g][(at + i) * n + at + k] -= spun[3 * i + k] / 2;
    }
    cayley_slopes_columns(&v->step, by, &v->point[g], 1.0 / DEFORMABLE_POINTS, n, v->H[g], out);
}

/* Derivatives of k, times the denominator: into s->missing and the row. */
static void add_scalar(conserving *s, const double J[], evaluation *v)
{
    const deformable *of = &v->of;
    const int n = of->coordinates, strains = of->strains;
    double Wd[M], Cd[M], k_e[M], k_d[M];
    memset(v->column, 0, sizeof v->column);
    memset(v->row, 0, sizeof v->row);
    if (s->k == 0)
        return;
    dense_mul_vec(strains, strains, of->W, of->d, Wd);
    dense_mul_vec(strains, strains, of->C, of->d, Cd);
    for (int r = 0; r < strains; r++) {
        k_e[r] = (of->present[r] - Cd[r] / 2) / s->denominator;
        k_d[r] = (-(of->before[r] + of->present[r]) / 2 - 2 * s->k * Wd[r]) / s->denominator;
        s->missing += k_e[r] * of->gap_e[r] + k_d[r] * of->gap_d[r];
        k_e[r] += k_d[r];
    }
    dense_add_transpose_mul(n, strains, 1, J, Wd, v->column);
    cayley_forces(&v->step, 1, v->column);
    dense_add_transpose_mul(n, strains, 1, of->J, k_e, v->row);
}

/* Of the coordinates that move its nodes; F[7 nodes]: forces of `middle`. */
static void to_coordinates(const conserving *s, const instant *from, const model_state *now,
                           const double F[], evaluation *v)
{
    const mesh_element *el = v->of.el;
    const model *m = s->of.c->model;
    int own = NODE_COORDINATES * el->nodes;
    if (el->plain)
        return;
    if (el->columns > own)
        release_widen(el, v->K);
    for (int j = 0; j < el->nodes; j++) {
        const int at = NODE_COORDINATES * j;
        frame_place p;
        if (place_plain(m, el->vertex[j]))
            continue;
        place_of(s, from->state, now, el->vertex[j], F + at, &p);
        place_forces(&p, at, own, v->force);
        place_forces(&p, at, own, v->column);
        place_row(&p, at, own, v->row);
        place_matrix(&p, el->columns, at, own, v->K);
        own += p.columns - 6;
    }
}

/* The equations of what was evaluated; its incompatibility. */
static double equations_of(conserving *s, const instant *from, const model_state *now,
                           evaluation *v)
{
    const deformable *of = &v->of;
    const int n = of->coordinates, strains = of->strains;
    double J[M * N], sigma[M], tangent[M * M], inside[M * N], f[N] = {0}, F[N];
    cayley_slopes by;
    for (int k = 0; k < strains * n; k++)
        J[k] = (v->J[0][k] + v->J[1][k]) / DEFORMABLE_POINTS;
    const double incompatibility = gaps_of(s, J, v, sigma);
    for (int k = 0; k < strains * strains; k++)
        tangent[k] =
            of->C[k] / 2 + s->k * of->W[k] + (of->S != NULL ? of->damping / s->h * of->S[k] : 0);
    dense_mul(strains, strains, n, tangent, of->J, inside);
    memset(v->K, 0, (size_t)(n * n) * sizeof *v->K);
    dense_add_transpose_mul(n, strains, n, J, inside, v->K);
    cayley_slopes_of(&v->step, &by);
    for (int g = 0; g < DEFORMABLE_POINTS; g++)
        add_curved_strains(&by, g, v, v->K);
    cayley_forces(&v->step, n, v->K);
    dense_add_transpose_mul(n, strains, 1, J, v->middle, f);
    cayley_slopes_forces(&v->step, &by, f, v->K);
    memcpy(F, f, sizeof F);
    cayley_forces(&v->step, 1, F);
    memset(v->force, 0, sizeof v->force);
    dense_add_transpose_mul(n, strains, 1, J, sigma, v->force);
    cayley_forces(&v->step, 1, v->force);
    add_scalar(s, J, v);
    to_coordinates(s, from, now, F, v);
    return incompatibility;
}

static void add(conserving *s, evaluation *v)
{
    const mesh_element *el = v->of.el;
    if (v->of.spring != NULL)
        assemble_discrete(el, v->K, &s->S);
    else
        assemble_matrix(assemble_of(s->of.c->run->patterns, &s->S), v->of.index, v->K, &s->S);
    for (int k = 0; k < el->columns; k++)
        v->force[k] = -v->force[k];
    assemble_vector(el, v->force, s->residual);
    assemble_vector(el, v->column, s->column);
    assemble_vector(el, v->row, s->row);
}

void conserving_forces(conserving *s, const instant *from, model_state *now,
                       double *incompatibility)
{
    const int all = deformable_count(s);
    s->missing = 0;
    for (int first = 0; first < all;) {
        const int count = deformable_together(s, first);
        for (int k = 0; k < count; k++) {
            s->evaluation[k].of = deformable_at(s, from, now, first + k);
            middle_of(s, &s->evaluation[k]);
        }
        deformable_evaluate(s, from, now, count, s->evaluation);
        for (int k = 0; k < count; k++) {
            *incompatibility =
                fmax(*incompatibility, equations_of(s, from, now, &s->evaluation[k]));
            add(s, &s->evaluation[k]);
        }
        first += count;
    }
}
