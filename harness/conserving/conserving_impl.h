/* Inside of the conserving step. */
#ifndef BEAMWORK_CONSERVING_IMPL_H
#define BEAMWORK_CONSERVING_IMPL_H

#include "harness/conserving/cayley.h"
#include "harness/inertia/inertia.h"
#include "harness/model/model_impl.h"
#include "harness/scheme/scheme.h"
#include "harness/solver/arrival.h"

typedef struct conserving {
    scheme base;
    scheme_request of;
    int free, all;
    sparse S;
    factor *factor;
    double *step;                         /* [free + driven] dr, Cayley vector c, da */
    double *residual, *column, *row, *dx; /* [free + driven]; the tangent is S + column row^T */
    double *weight;
    double *W;      /* [elements x strains^2] P'' at rest */
    double *energy; /* [elements] P(e_n) */
    double *d;      /* [elements x strains] */
    double *slot;   /* [elements x slot_size] what an element keeps from equations to update */
    int slot_size;
    double k, denominator, missing; /* missing: of sum k_e . gap_e + k_d . gap_d */
    double largest, change;         /* stresses */
    arrival arrival;
    long counted;
} conserving;

/* conserving_element.c */
status conserving_rest(conserving *, fault *);
/* Energies of the begin. */
status conserving_begin(conserving *, const instant *from, fault *);
/* k of the present strains; 0 as long as it is not to be trusted. */
status conserving_scalar(conserving *, const instant *from, const model_state *now, int iteration,
                         fault *);
/* residual -= forces, S += tangent, column and row, of all elements. */
status conserving_elements(conserving *, const instant *from, const model_state *now,
                           double *incompatibility, fault *);
/* The strains of the end and d take dx; the largest inner change. */
double conserving_update(conserving *, const instant *from, model_state *now);

/* conserving_inertia.c: residual -= forces of inertia, S += theirs. */
void conserving_inertia(conserving *, const instant *from, const model_state *now, double h);
/* Rates at the end. */
void conserving_rates(conserving *, const instant *from, double h, instant *to);

/* Step of a vertex: dr, c of its own frame or of the body that moves it. */
void conserving_vertex(const conserving *, const model_state *from, const model_state *now,
                       int vertex, double dr[3], double c[3]);

#endif
