#include "harness/newton/newton_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/real.h"

enum { WIDTH = PIECE_LANES };

/* Divides the member into groups of full pieces, and two groups of shorter pieces. Returns their
 * number. If `group` is NULL, only counts them. */
static int divide(const condensed_member *of, piece_group group[])
{
    int groups = 0, link = 0, done = 0;
    while (done < of->elements) {
        const int rest = of->elements - done, pieces = rest < WIDTH ? rest : WIDTH,
                  each = rest / pieces < PIECE_ELEMENTS ? rest / pieces : PIECE_ELEMENTS;
        if (group != NULL)
            group[groups] = (piece_group){.first = of->first + done,
                                          .pieces = pieces,
                                          .elements = each,
                                          .link = link,
                                          .blocks = each * (of->form.nodes - 1) - 1};
        groups++;
        link += pieces;
        done += pieces * each;
    }
    return groups;
}

static int group_alloc(const piece_form *p, piece_group *g)
{
    const size_t blocks = (size_t)g->blocks;
    g->kept = malloc((blocks * (size_t)piece_kept(p) + 1) * WIDTH * sizeof *g->kept);
    g->arm = malloc((blocks + 2) * 3 * WIDTH * sizeof *g->arm);
    return g->kept != NULL && g->arm != NULL;
}

status pieces_alloc(condensed_member *of, fault *f)
{
    const int c = of->form.joint;
    of->groups = divide(of, NULL);
    of->group = calloc((size_t)of->groups, sizeof *of->group);
    int good = of->group != NULL;
    if (good)
        divide(of, of->group);
    for (int i = 0; i < of->groups && good; i++) {
        good = group_alloc(&of->form, &of->group[i]);
        of->links += of->group[i].pieces;
    }
    of->r = malloc(((size_t)of->links + 1) * (size_t)c * sizeof *of->r);
    return good && of->r != NULL ? chain_alloc(of->links, c, c, &of->chain, f)
                                 : fault_memory(f, "a member of %d elements", of->elements);
}

void pieces_free(condensed_member *of)
{
    for (int i = 0; i < of->groups && of->group != NULL; i++) {
        free(of->group[i].kept);
        free(of->group[i].arm);
    }
    free(of->group);
    free(of->r);
    chain_free(of->chain);
}

/* Work space for the elimination of a group. */
typedef struct filling {
    const equations *eq;
    const model_state *s;
    condensed_member *of;
    double path;
    double *front, *work, *H, *memory, start[WIDTH][3];
    node_state x[WIDTH * ELEMENT_MAX_NODES];
    double *force; /* [14] */
} filling;

static status filling_alloc(filling *w, fault *f)
{
    const size_t rows = (size_t)piece_rows(&w->of->form), width = rows + PIECE_MARGIN,
                 own = (size_t)model_own_coordinates(w->eq->m),
                 strains = (size_t)w->of->form.strains;
    w->memory =
        malloc((rows * width * WIDTH + 2 * (strains + rows) * width * WIDTH + own * own * WIDTH) *
               sizeof *w->memory);
    if (w->memory == NULL)
        return fault_memory(f, "a member");
    w->front = w->memory;
    w->work = w->front + rows * width * WIDTH;
    w->H = w->work + 2 * (strains + rows) * width * WIDTH;
    return STATUS_OK;
}

/* Adds the loads on element i to H. Stores the internal forces at the ends of the member. */
static void loads_of(filling *w, int i, const node_state x[], double H[])
{
    const model *m = w->eq->m;
    const int own = model_own_coordinates(m), last = w->of->first + w->of->elements - 1,
              q = NODE_COORDINATES * (model_nodes(m) - 1);
    double along[ELEMENT_MAX_COORDINATES] = {0}, force[ELEMENT_MAX_COORDINATES] = {0};
    distributed_add(w->eq, w->s, x, i, w->path, along, H);
    if (i != w->of->first && i != last)
        return;
    dense_add_transpose_mul(own, model_strains(m), 1, linearise_slot(m, &w->eq->run->memory, i).J,
                            &w->s->sigma[(size_t)i * (size_t)model_strains(m)], force);
    for (int k = 0; k < own; k++)
        force[k] -= along[k];
    if (i == w->of->first)
        memcpy(w->force, force, NODE_COORDINATES * sizeof *force);
    if (i == last)
        memcpy(w->force + NODE_COORDINATES, force + q, NODE_COORDINATES * sizeof *force);
}

/* Stores the vectors from the starts of the pieces to the nodes of their next elements. */
static void place_nodes(filling *w, int count, int step, piece_group *g)
{
    const int nodes = w->of->form.nodes;
    for (int k = 0; k < WIDTH; k++) {
        const node_state *x = w->x + (k < count ? k : 0) * nodes;
        if (step == 0)
            memcpy(w->start[k], x[0].r, sizeof w->start[k]);
        for (int node = step == 0 ? 0 : 1; node < nodes; node++)
            for (int i = 0; i < 3; i++)
                g->arm[(3 * (step * (nodes - 1) + node) + i) * WIDTH + k] =
                    x[node].r[i] - w->start[k][i];
    }
}

static void add_elements(filling *w, piece_group *g, int step)
{
    const model *m = w->eq->m;
    const size_t size = (size_t)model_own_coordinates(m) * (size_t)model_own_coordinates(m);
    piece_element e = {.first = step == 0};
    int element[WIDTH] = {0};
    for (int k = 0; k < g->pieces; k++)
        element[k] = g->first + k * g->elements + step;
    chunk_second_derivatives(w->eq, w->s, g->pieces, element, w->x, w->H);
    place_nodes(w, g->pieces, step, g);
    for (int k = 0; k < g->pieces; k++)
        loads_of(w, element[k], w->x + k * model_nodes(m), w->H + (size_t)k * size);
    for (int k = 0; k < WIDTH; k++) {
        const int from = k < g->pieces ? k : 0;
        const model_slot slot = linearise_slot(m, &w->eq->run->memory, element[from]);
        e.J[k] = slot.J;
        e.C[k] = slot.C;
        e.H[k] = w->H + (size_t)from * size;
    }
    e.arm = g->arm + (ptrdiff_t)3 * WIDTH * step * (w->of->form.nodes - 1);
    REAL_CHOSEN(triangular_pieces_add)(&w->of->form, &e, w->work, w->front);
}

static double front_at(const filling *w, int i, int j, int lane)
{
    const int width = piece_rows(&w->of->form) + PIECE_MARGIN;
    return w->front[(ptrdiff_t)WIDTH * (i > j ? i * width + j : j * width + i) + lane];
}

/* Makes a link of a piece from its front. The first block of the front belongs to the last node of
 * the piece, and the last block to the start. */
static status link_of_piece(const filling *w, const piece_group *g, int lane, int negative,
                            chain_link *out, fault *f)
{
    const int c = w->of->form.joint, start = c * w->of->form.nodes;
    double S[CHAIN_JOINT * CHAIN_JOINT], S_qp[CHAIN_JOINT * CHAIN_JOINT];
    for (int i = 0; i < c; i++)
        for (int j = 0; j < c; j++) {
            S[i * c + j] = front_at(w, i, j, lane);
            S_qp[i * c + j] = front_at(w, i, start + j, lane);
            out->B[i * c + j] = front_at(w, start + i, start + j, lane);
        }
    out->negative = symmetric_inverse(c, S, out->F);
    if (out->negative < 0)
        return fault_set(f, STATUS_SINGULAR,
                         "the stiffness matrix of a part of a member with one end fixed is "
                         "singular; use smaller steps, or correct the section");
    out->negative += negative;
    dense_mul(c, c, c, out->F, S_qp, out->A);
    for (int i = 0; i < c * c; i++)
        out->A[i] = -out->A[i];
    dense_add_transpose_mul(c, c, c, S_qp, out->A, out->B);
    for (int i = 0; i < c; i++)
        for (int j = 0; j < i; j++)
            out->B[i * c + j] = out->B[j * c + i] = (out->B[i * c + j] + out->B[j * c + i]) / 2;
    const double *arm = g->arm + (ptrdiff_t)3 * WIDTH * (g->blocks + 1) + lane,
                 d[3] = {arm[0], arm[WIDTH], arm[2 * WIDTH]};
    for (int i = 0; i < 6; i++)
        out->A[i * c + i] += 1;
    out->A[0 * c + 4] += d[2];
    out->A[0 * c + 5] -= d[1];
    out->A[1 * c + 5] += d[0];
    out->A[1 * c + 3] -= d[2];
    out->A[2 * c + 3] += d[1];
    out->A[2 * c + 4] -= d[0];
    return STATUS_OK;
}

static status fill_group(filling *w, piece_group *g, fault *f)
{
    const piece_form *p = &w->of->form;
    const size_t rows = (size_t)piece_rows(p), size = (size_t)piece_kept(p) * WIDTH;
    int negative[WIDTH] = {0}, regular = 1;
    double *kept = g->kept;
    memset(w->front, 0, rows * (rows + PIECE_MARGIN) * WIDTH * sizeof *w->front);
    for (int step = 0; step < g->elements; step++) {
        add_elements(w, g, step);
        for (int node = 0; node < p->nodes - 1; node++) {
            const int start = step == 0 && node == 0;
            regular &=
                REAL_CHOSEN(triangular_pieces_next)(p, w->front, start ? NULL : kept, negative);
            kept += start ? 0 : size;
        }
    }
    for (int k = 0; k < g->pieces; k++) {
        chain_link link;
        if (!regular)
            return fault_set(f, STATUS_SINGULAR,
                             "the stiffness matrix of a part of a member with both ends fixed is "
                             "singular; use smaller steps, or correct the section");
        TRY(link_of_piece(w, g, k, negative[k], &link, f));
        TRY(chain_add(w->of->chain, &link, f));
    }
    return STATUS_OK;
}

/* Returns the work of an elimination, and of the expansion of a solution. */
static numerics_work work_of(const condensed_member *of)
{
    const int c = of->form.joint, rows = piece_rows(&of->form), strains = of->form.strains;
    double block = 0;
    for (int k = 0; k < c; k++)
        block += (double)(rows - 1 - k) * (rows + 1 - k);
    const double element = (double)strains * rows * (2 * strains + rows + 1),
                 link = 13.0 * c * c * c; /* products and inverse of chain_add */
    numerics_work out = {.factor_flops = of->links * link,
                         .solved_entries = (double)of->links * chain_kept_size(c, c)};
    for (int i = 0; i < of->groups; i++) {
        const piece_group *g = &of->group[i];
        out.solved_entries += (double)g->pieces * g->blocks * piece_kept(&of->form);
        out.factor_flops += g->pieces * (g->blocks * block + g->elements * element);
    }
    return out;
}

status pieces_fill(const equations *eq, const model_state *s, condensed_member *of, double path,
                   double force[], fault *f)
{
    filling w = {.eq = eq, .s = s, .of = of, .path = path, .force = force};
    status outcome = filling_alloc(&w, f);
    chain_begin(of->chain);
    for (int i = 0; i < of->groups && outcome == STATUS_OK; i++)
        outcome = fill_group(&w, &of->group[i], f);
    free(w.memory);
    numerics_work_add(&(numerics_work){.factor_flops = work_of(of).factor_flops});
    return outcome;
}

/* Returns the index of a coordinate of a node of a piece; NONE: it is fixed. */
static const int *coordinates_of(const model *m, const piece_form *p, int first, int node)
{
    const int element = first + (node - 1) / (p->nodes - 1), at = (node - 1) % (p->nodes - 1) + 1;
    return &model_element(m, element)->index[NODE_COORDINATES * at];
}

enum { MOST_VALUES = PIECE_ELEMENTS * (ELEMENT_MAX_NODES - 1) * CHAIN_JOINT * WIDTH };

static void gather(const model *m, const condensed_member *of, const piece_group *g,
                   const double x[], double r[])
{
    const int c = of->form.joint;
    for (int k = 0; k < WIDTH; k++)
        for (int node = 1; node <= g->blocks; node++) {
            const int *index = coordinates_of(
                m, &of->form, g->first + (k < g->pieces ? k : 0) * g->elements, node);
            for (int i = 0; i < c; i++)
                r[((node - 1) * c + i) * WIDTH + k] = index[i] == NONE ? 0 : x[index[i]];
        }
}

static void scatter(const model *m, const condensed_member *of, const piece_group *g,
                    const double r[], double x[])
{
    const int c = of->form.joint;
    for (int k = 0; k < g->pieces; k++)
        for (int node = 1; node <= g->blocks; node++) {
            const int *index = coordinates_of(m, &of->form, g->first + k * g->elements, node);
            for (int i = 0; i < c; i++)
                if (index[i] != NONE)
                    x[index[i]] = r[((node - 1) * c + i) * WIDTH + k];
        }
}

static const int *end_of(const model *m, const condensed_member *of, const piece_group *g, int k)
{
    return coordinates_of(m, &of->form, g->first + k * g->elements, g->blocks + 1);
}

void pieces_reduce(const model *m, condensed_member *of, double x[], double ends[])
{
    const int c = of->form.joint;
    double r[MOST_VALUES], at[2 * CHAIN_JOINT * WIDTH], own[2 * CHAIN_JOINT] = {0};
    memset(of->r, 0, (size_t)of->links * (size_t)c * sizeof *of->r);
    for (int n = 0; n < of->groups; n++) {
        const piece_group *g = &of->group[n];
        gather(m, of, g, x, r);
        REAL_CHOSEN(triangular_pieces_reduce)(&of->form, g->blocks, g->kept, g->arm, r, at);
        scatter(m, of, g, r, x);
        for (int k = 0; k < g->pieces; k++) {
            const int link = g->link + k, *index = end_of(m, of, g, k);
            double *p = link > 0 ? of->r + (ptrdiff_t)(link - 1) * c : own,
                   *q = link + 1 < of->links ? of->r + (ptrdiff_t)link * c : own + c;
            for (int i = 0; i < c; i++) {
                p[i] += at[i * WIDTH + k];
                q[i] += at[(c + i) * WIDTH + k];
                if (link + 1 < of->links && index[i] != NONE)
                    q[i] += x[index[i]];
            }
        }
    }
    chain_reduce(of->chain, of->r, ends);
    for (int i = 0; i < 2 * c; i++)
        ends[i] += own[i];
}

void pieces_expand(const model *m, condensed_member *of, const double ends[], double x[])
{
    const int c = of->form.joint;
    double r[MOST_VALUES], at[2 * CHAIN_JOINT * WIDTH];
    numerics_work_add(&(numerics_work){.solved_entries = work_of(of).solved_entries});
    chain_expand(of->chain, of->r, ends, of->r);
    for (int n = 0; n < of->groups; n++) {
        const piece_group *g = &of->group[n];
        for (int k = 0; k < WIDTH; k++) {
            const int link = g->link + (k < g->pieces ? k : 0);
            const double *p = link > 0 ? of->r + (ptrdiff_t)(link - 1) * c : ends,
                         *q = of->r + (ptrdiff_t)link * c;
            for (int i = 0; i < c; i++) {
                at[i * WIDTH + k] = p[i];
                at[(c + i) * WIDTH + k] = q[i];
            }
        }
        gather(m, of, g, x, r);
        REAL_CHOSEN(triangular_pieces_expand)(&of->form, g->blocks, g->kept, g->arm, at, r);
        scatter(m, of, g, r, x);
        for (int k = 0; k < g->pieces; k++) {
            const int link = g->link + k, *index = end_of(m, of, g, k);
            for (int i = 0; i < c && link + 1 < of->links; i++)
                if (index[i] != NONE)
                    x[index[i]] = of->r[link * c + i];
        }
    }
}
