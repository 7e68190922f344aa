#include <string.h>

#include "harness/model/model.h"
#include "harness/time/place.h"

enum { SIX = 6 };

static int index_of(int column, int at, int own)
{
    return column < SIX ? at + column : own + column - SIX;
}

/* out[columns] = A^T of, A[6 x columns] */
static void transposed(const frame_place *p, const double A[], const double of[SIX], double out[])
{
    memset(out, 0, (size_t)p->columns * sizeof *out);
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < p->columns; k++)
            out[k] += A[i * p->columns + k] * of[i];
}

static void along(const frame_place *p, const double A[], int at, int own, int stride, double v[])
{
    double of[SIX], out[PLACE_MOST];
    for (int i = 0; i < SIX; i++)
        of[i] = v[(at + i) * stride];
    transposed(p, A, of, out);
    for (int k = 0; k < p->columns; k++)
        v[index_of(k, at, own) * stride] = out[k];
}

void place_forces(const frame_place *p, int at, int own, double forces[])
{
    along(p, p->work, at, own, 1, forces);
}

void place_row(const frame_place *p, int at, int own, double row[])
{
    along(p, p->moved, at, own, 1, row);
}

void place_matrix(const frame_place *p, int n, int at, int own, double K[])
{
    for (int r = 0; r < n; r++)
        along(p, p->moved, at, own, 1, K + r * n);
    for (int c = 0; c < n; c++)
        along(p, p->work, at, own, n, K + c);
    for (int i = 0; i < p->columns; i++)
        for (int k = 0; k < p->columns; k++)
            K[index_of(i, at, own) * n + index_of(k, at, own)] += p->curved[i * p->columns + k];
}

/* Global coordinates of the columns. */
static int index_place(const model *m, int vertex, int index[PLACE_MOST])
{
    const mesh_vertex *v = model_vertex(m, vertex);
    const mesh_release *r = release_of(m, vertex);
    int n = SIX;
    for (int i = 0; i < SIX; i++)
        index[i] = model_vertex(m, v->body)->coordinate[i];
    for (int k = 0; r != NULL && k < r->turns; k++)
        index[n++] = v->coordinate[SCENE_RX + k];
    for (int k = 0; r != NULL && k < r->slides; k++)
        index[n++] = v->coordinate[k];
    return n;
}

void place_add(conserving *s, const model_state *from, const model_state *now, int vertex,
               const double F[6], const double K[36], double out[])
{
    const model *m = s->of.c->model;
    double forces[PLACE_MOST], all[PLACE_MOST * PLACE_MOST] = {0};
    int index[PLACE_MOST];
    const int n = index_place(m, vertex, index);
    memcpy(forces, F, SIX * sizeof *forces);
    for (int i = 0; i < SIX * SIX; i++)
        all[i / SIX * n + i % SIX] = K[i];
    if (!place_plain(m, vertex)) {
        frame_place p;
        place_of(s, from, now, vertex, F, &p);
        for (int i = 0; i < n * n; i++)
            p.curved[i] = -p.curved[i];
        place_forces(&p, 0, SIX, forces);
        place_matrix(&p, n, 0, SIX, all);
    }
    for (int i = 0; i < n; i++) {
        if (index[i] == NONE)
            continue;
        out[index[i]] += forces[i];
        for (int j = 0; j < n; j++)
            if (all[i * n + j] != 0)
                assemble_subtract(&s->S, index[i], index[j], -all[i * n + j]);
    }
}
