/* Strains of the ends and between them take what Newton found. */
#include <math.h>

#include "elements/math/dense.h"
#include "elements/math/larger.h"
#include "harness/model/model.h"
#include "harness/time/deformable.h"
#include "harness/time/place.h"

/* Increments dr, dc, da of an element's nodes. */
static void own_increments(const conserving *s, const instant *from, const model_state *now,
                           const mesh_element *el, double local[])
{
    const model *m = s->of.c->model;
    int own = NODE_COORDINATES * el->nodes;
    for (int k = 0; k < own; k++)
        local[k] = el->index[k] == NONE ? 0 : s->dx[el->index[k]];
    for (int j = 0; j < el->nodes && !el->plain; j++) {
        double moved[PLACE_MOST], *at = local + NODE_COORDINATES * j;
        frame_place p;
        if (place_plain(m, el->vertex[j]))
            continue;
        place_of(s, from->state, now, el->vertex[j], NULL, &p);
        for (int k = 0; k < p.columns; k++) {
            const int index = el->index[k < 6 ? NODE_COORDINATES * j + k : own++];
            moved[k] = index == NONE ? 0 : s->dx[index];
        }
        dense_mul_vec(6, p.columns, p.moved, moved, at);
    }
}

double conserving_update(conserving *s, const instant *from, model_state *now)
{
    const model *m = s->of.c->model;
    double largest = 0;
    s->change = 0;
    for (int i = 0; i < deformable_count(s); i++) {
        const deformable of = deformable_at(s, from, now, i);
        double local[ELEMENT_MAX_COORDINATES], more[DEFORMABLE_STRAINS], de[DEFORMABLE_STRAINS],
            dsigma[DEFORMABLE_STRAINS];
        own_increments(s, from, now, of.el, local);
        dense_mul_vec(of.strains, of.coordinates, of.J, local, more);
        for (int k = 0; k < of.strains; k++) {
            de[k] = of.gap_e[k] + more[k];
            of.e[k] += de[k];
            of.d[k] += of.gap_d[k] + more[k];
        }
        dense_mul_vec(of.strains, of.strains, of.C, de, dsigma);
        for (int k = 0; k < of.strains; k++) {
            const double next = of.present[k] + dsigma[k];
            s->change = fmax(s->change, fabs(next - of.sigma[k]));
            of.sigma[k] = next;
        }
        if (of.spring == NULL && model_type(m)->update != NULL)
            largest = larger(
                largest, model_type(m)->update(model_kind(m, of.el->kind)->data, de, of.memory,
                                               &now->inner[(size_t)i * (size_t)model_inner(m)]));
    }
    return largest;
}
