/* Solutions on all coordinates by way of the ends. */
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/condensation_impl.h"

/* Loads between the ends of a member, in the order of its links. */
static void gather_loads(const condensation *s, const condensed_member *of, const double x[])
{
    const int c = of->joint, nodes = model_nodes(s->m);
    for (int i = 0; i < of->links; i++)
        for (int k = 1; k < nodes; k++)
            for (int j = 0; j < c; j++) {
                const int index =
                    model_element(s->m, of->first + i)->index[NODE_COORDINATES * k + j];
                const int end = i + 1 == of->links && k + 1 == nodes;
                s->r[(i * (nodes - 1) + k - 1) * c + j] = end || index == NONE ? 0 : x[index];
            }
}

static void scatter_motions(const condensation *s, const condensed_member *of, double x[])
{
    const int c = of->joint, nodes = model_nodes(s->m);
    for (int i = 0; i < of->links; i++)
        for (int k = 1; k < nodes; k++)
            for (int j = 0; j < c && !(i + 1 == of->links && k + 1 == nodes); j++) {
                const int index =
                    model_element(s->m, of->first + i)->index[NODE_COORDINATES * k + j];
                if (index != NONE)
                    x[index] = s->r[(i * (nodes - 1) + k - 1) * c + j];
            }
}

static void reduce(condensation *s, double x[])
{
    for (int i = 0; i < s->members; i++) {
        const condensed_member *of = &s->member[i];
        const int c = of->joint;
        double ends[CHAIN_LINK], force[MODEL_MAX_COORDINATES] = {0};
        gather_loads(s, of, x);
        chain_reduce(of->chain, s->r, ends);
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
        const condensed_member *of = &s->member[i];
        const int c = of->joint;
        double ends[CHAIN_LINK], local[2 * NODE_COORDINATES];
        kinematics_local(s->m, s->at, &of->ends, x, local);
        for (int k = 0; k < 2 * c; k++)
            ends[k] = local[NODE_COORDINATES * (k / c) + k % c];
        gather_loads(s, of, x);
        chain_expand(of->chain, s->r, ends, s->r);
        scatter_motions(s, of, x);
    }
}

void condensation_solve(condensation *s, int transposed, double x[])
{
    const int free_count = model_unknowns(s->m);
    const size_t driven = (size_t)model_driven(s->m) * sizeof *x;
    memcpy(s->driven, x + free_count, driven); /* those that are known stay */
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
