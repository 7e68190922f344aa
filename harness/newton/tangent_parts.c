#include "harness/newton/newton_impl.h"

#include <float.h>
#include <string.h>

#include "elements/math/dense.h"

static void reduce(condensation *s, double x[])
{
    for (int i = 0; i < s->members; i++) {
        condensed_member *of = &s->member[i];
        const int c = of->form.joint;
        double ends[2 * CHAIN_JOINT], force[MODEL_MAX_COORDINATES] = {0};
        pieces_reduce(s->m, of, x, ends);
        for (int k = 0; k < 2 * c; k++)
            force[NODE_COORDINATES * (k / c) + k % c] = ends[k];
        eliminate_forces(s->m, s->at, &of->ends, force);
        memcpy(s->end + i * MEMBER_COLUMNS, force, MEMBER_COLUMNS * sizeof *force);
    }
    for (int i = 0; i < s->members; i++)
        assemble_vector(&s->member[i].ends, s->end + i * MEMBER_COLUMNS, x);
}

static void expand(condensation *s, double x[])
{
    for (int i = 0; i < s->members; i++) {
        condensed_member *of = &s->member[i];
        const int c = of->form.joint;
        double ends[2 * CHAIN_JOINT], local[2 * NODE_COORDINATES];
        kinematics_local(s->m, s->at, &of->ends, x, local);
        for (int k = 0; k < 2 * c; k++)
            ends[k] = local[NODE_COORDINATES * (k / c) + k % c];
        pieces_expand(s->m, of, ends, x);
    }
}

void condensation_solve(condensation *s, int transposed, double x[])
{
    const int free_count = model_unknowns(s->m);
    const size_t driven = (size_t)model_driven(s->m) * sizeof *x;
    memcpy(s->driven, x + free_count, driven);
    reduce(s, x);
    for (int i = 0; i < s->unknowns; i++)
        s->small[i] = x[s->unknown[i]];
    if (transposed)
        factor_solve_transposed(s->factor, s->small);
    else
        factor_solve(s->factor, s->small);
    memset(x + free_count, 0, driven);
    for (int i = 0; i < s->unknowns; i++)
        x[s->unknown[i]] = s->small[i];
    expand(s, x);
    for (int i = 0; i < s->unknowns; i++)
        if (s->unknown[i] >= free_count)
            s->driven[s->unknown[i] - free_count] = s->small[i];
    memcpy(x + free_count, s->driven, driven);
}

static void solve_with(void *context, int transposed, double x[])
{
    condensation_solve(context, transposed, x);
}

static factor_counts count_of(const void *context)
{
    return condensation_count(context);
}

static void free_of(void *context)
{
    condensation_free(context);
}

status condensation_as_factor(condensation *s, matrix_factor **out, fault *f)
{
    return factor_of(&(factor_operator){s, solve_with, count_of, free_of}, out, f);
}

factor_counts condensation_count(const condensation *s)
{
    factor_counts counts = factor_count(s->factor);
    if (counts.negative_pivots >= 0)
        counts.negative_pivots += s->negative;
    if (s->negative % 2 != 0)
        counts.determinant = -counts.determinant;
    counts.factorisations = s->factorisations;
    return counts;
}

enum { TOGETHER = 4 };

#define INLINED static inline __attribute__((always_inline))

/* Computes out[m x width] = A x[n x width]. */
INLINED void mul(int width, int m, int n, const double A[], const double x[], double out[])
{
    for (int i = 0; i < m; i++) {
        double sum[TOGETHER] = {0};
        for (int j = 0; j < n; j++)
            for (int c = 0; c < width; c++)
                sum[c] += A[i * n + j] * x[width * j + c];
        for (int c = 0; c < width; c++)
            out[width * i + c] = sum[c];
    }
}

INLINED void mul_transposed(int width, int m, int n, const double A[], const double x[],
                            double out[])
{
    memset(out, 0, (size_t)(n * width) * sizeof *out);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++)
            for (int c = 0; c < width; c++)
                out[width * j + c] += A[i * n + j] * x[width * i + c];
}

/* Adds the products of an element with at most `width` columns. */
INLINED void add_material(int width, const model *m, const linear_memory *memory,
                          const model_state *s, int i, int columns, const double *const x[],
                          double *const y[])
{
    const mesh_element *el = model_element(m, i);
    const model_slot w = linearise_slot(m, memory, i);
    const int own = model_own_coordinates(m), n = model_strains(m);
    double local[ELEMENT_MAX_COORDINATES * TOGETHER], e[ELEMENT_MAX_STRAINS * TOGETHER],
        sigma[ELEMENT_MAX_STRAINS * TOGETHER];
    memset(local, 0, (size_t)(own * width) * sizeof *local);
    for (int c = 0; c < columns; c++) {
        double one[ELEMENT_MAX_COORDINATES];
        kinematics_local(m, s, el, x[c], one);
        for (int k = 0; k < own; k++)
            local[width * k + c] = one[k];
    }
    mul(width, n, own, w.J, local, e);
    mul(width, n, n, w.C, e, sigma);
    mul_transposed(width, n, own, w.J, sigma, local);
    for (int c = 0; c < columns; c++) {
        double force[MODEL_MAX_COORDINATES] = {0};
        for (int k = 0; k < own; k++)
            force[k] = local[width * k + c];
        eliminate_forces(m, s, el, force);
        assemble_vector(el, force, y[c]);
    }
}

static void add_some(const model *m, const linear_memory *memory, const model_state *s, int i,
                     int columns, const double *const x[], double *const y[])
{
    if (columns == 1)
        add_material(1, m, memory, s, i, 1, x, y);
    else if (columns == 2)
        add_material(2, m, memory, s, i, 2, x, y);
    else
        add_material(TOGETHER, m, memory, s, i, columns, x, y);
}

void stiffness_parts_material_products(const model *m, const linear_memory *memory,
                                       const model_state *s, int columns, const double *const x[],
                                       double *const y[])
{
    for (int i = 0; i < model_elements(m); i++)
        for (int c = 0; c < columns; c += TOGETHER)
            add_some(m, memory, s, i, columns - c < TOGETHER ? columns - c : TOGETHER, x + c,
                     y + c);
    for (int c = 0; c < columns; c++)
        discrete_material_product(m, s, x[c], y[c]);
}

/* Strains have the rounding errors of their terms, and stresses also those of the entries of P''.
 * The errors of different elements are similar, so they add up. */
double stiffness_parts_material_rounding(const model *m, const linear_memory *memory,
                                         const model_state *s, const double x[])
{
    double sum = 0;
    for (int i = 0; i < model_elements(m); i++) {
        const model_slot w = linearise_slot(m, memory, i);
        double local[ELEMENT_MAX_COORDINATES], e[ELEMENT_MAX_STRAINS];
        kinematics_local(m, s, model_element(m, i), x, local);
        dense_mul_vec(model_strains(m), model_own_coordinates(m), w.J, local, e);
        for (int k = 0; k < model_strains(m); k++) {
            double sigma = 0, sigma_terms = 0, terms = 0;
            for (int j = 0; j < model_strains(m); j++) {
                sigma += w.C[k * model_strains(m) + j] * e[j];
                sigma_terms += fabs(w.C[k * model_strains(m) + j] * e[j]);
            }
            for (int j = 0; j < model_own_coordinates(m); j++)
                terms += fabs(w.J[k * model_own_coordinates(m) + j] * local[j]);
            sum += DBL_EPSILON * (2 * fabs(sigma) * terms + fabs(e[k]) * sigma_terms);
        }
    }
    return sum + discrete_material_rounding(m, s, x);
}

double stiffness_parts_assembled_rounding(const model *m, const linear_memory *memory,
                                          const model_state *s, const double x[])
{
    const int n = model_strains(m);
    double sum = 0;
    for (int i = 0; i < model_elements(m); i++) {
        const model_slot w = linearise_slot(m, memory, i);
        double local[ELEMENT_MAX_COORDINATES], terms[ELEMENT_MAX_STRAINS] = {0};
        kinematics_local(m, s, model_element(m, i), x, local);
        for (int k = 0; k < n; k++)
            for (int j = 0; j < model_own_coordinates(m); j++)
                terms[k] += fabs(w.J[k * model_own_coordinates(m) + j] * local[j]);
        for (int k = 0; k < n; k++)
            for (int j = 0; j < n; j++)
                sum += fabs(w.C[k * n + j]) * terms[k] * terms[j];
    }
    return DBL_EPSILON * sum;
}

/* Adds the geometric stiffness of an element. H[own x own coordinates]: as of
 * chunk_second_derivatives */
static status add_geometric(const equations *eq, const linear_memory *memory, const model_state *s,
                            int i, const node_state x[], const double own_H[], sparse *G, fault *f)
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, i);
    const size_t own = (size_t)model_own_coordinates(m);
    double H[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES], present[ELEMENT_MAX_COORDINATES] = {0};
    memcpy(H, own_H, own * own * sizeof *H);
    eq->run->counters.strain_evaluations++;
    if (eq->loading.rotates)
        TRY(rotating_frame_add(eq, x, i, s->path, present, H, f));
    dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1,
                            linearise_slot(m, memory, i).J,
                            &s->sigma[(size_t)i * (size_t)model_strains(m)], present);
    eliminate_matrix(m, s, el, present, H);
    assemble_matrix(assemble_of(eq->run->patterns, G), i, H, G);
    return STATUS_OK;
}

status stiffness_parts_geometric(const equations *eq, const linear_memory *memory,
                                 const model_state *s, sparse *G, fault *f)
{
    const element_rotating_frame frame = loading_frame(&eq->loading, s->path);
    const model *m = eq->m;
    const size_t size = (size_t)model_own_coordinates(m) * (size_t)model_own_coordinates(m);
    status outcome = STATUS_OK;
    sparse_zero(G);
    ahead_strains(eq, s, AHEAD_H, s->sigma);
    for (int first = 0; first < model_elements(m) && outcome == STATUS_OK; first += TOGETHER) {
        const int rest = model_elements(m) - first, count = rest < TOGETHER ? rest : TOGETHER;
        int index[TOGETHER];
        node_state x[TOGETHER * ELEMENT_MAX_NODES];
        double H[TOGETHER * ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
        for (int k = 0; k < count; k++)
            index[k] = first + k;
        chunk_second_derivatives(eq, s, count, index, x, H);
        for (int k = 0; k < count && outcome == STATUS_OK; k++)
            outcome = add_geometric(eq, memory, s, index[k], x + k * model_nodes(m),
                                    H + (size_t)k * size, G, f);
    }
    ahead_end(eq);
    TRY(outcome);
    discrete_geometric(m, s, &frame, G);
    loads_subtract_stiffness(eq, s, s->path, G);
    linearise_add_held_moments(eq, s, s->path, G);
    return STATUS_OK;
}
