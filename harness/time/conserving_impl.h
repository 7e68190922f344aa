/* Inside of the conserving step. */
#ifndef BEAMWORK_CONSERVING_IMPL_H
#define BEAMWORK_CONSERVING_IMPL_H

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/cayley.h"
#include "harness/time/complement.h"
#include "harness/time/inertia.h"
#include "harness/time/massive.h"
#include "harness/time/scheme.h"

typedef struct evaluation evaluation; /* deformable.h */

typedef struct conserving {
    motion_scheme base;
    scheme_request of;
    int free, all;
    sparse S;
    matrix_factor *factor;
    double *step; /* [free + driven] dr, Cayley vectors c, da; of single angles and of what released
                     ends keep to themselves the increments, of balls c */
    double *residual, *column, *row, *dx; /* [free + driven]; the tangent is S + column row^T */
    double *weight;
    massive massive;
    int strains;      /* most of an element or a spring */
    double *W;        /* [deformables x strains^2] mean of P'' at the ends of the step */
    double *C;        /* [deformables x strains^2] P''(e_n) */
    double *energy;   /* [deformables] P(e_n) */
    double *d;        /* [deformables x strains] */
    double *elastic;  /* [elements x strains] P'(e_n), where damped members' states have more than
                         that for a stress; NULL: none is damped */
    double *massless; /* [masses x 9] onto turns without inertia, in the frames' axes */
    double *spring;   /* [springs x 3 x SPRING_STRAINS] e and sigma of the end, sigma_n */
    double *slot;     /* [deformables x slot_size] what one keeps from its evaluation to update */
    int slot_size;
    complement *complement;
    evaluation *evaluation;         /* [CHUNK_MOST] work space */
    double h;                       /* [s] of the step */
    double k, denominator, missing; /* missing: of sum k_e . gap_e + k_d . gap_d */
    int settled;                    /* 1: what is left of gaps is rounding, no stresses */
    int wild;                       /* 1: k was too large to be used */
    double largest, change;         /* stresses */
    arrival arrival;
    long counted;
} conserving;

/* conserving_strain.c: of all elements and springs. */
/* Energies of the begin, and springs as they are there; d is zero. */
status conserving_begin(conserving *, const instant *from, fault *);
/* Stresses of the present strains, and k; 0 as long as it is not to be trusted. */
status conserving_stresses(conserving *, const instant *from, model_state *now, int iteration,
                           fault *);
/* The strains of the end and d take dx; the largest inner change. */
double conserving_update(conserving *, const instant *from, model_state *now);

/* conserving_forces.c: residual -= forces, S += tangent, column and row, of all of them. */
void conserving_forces(conserving *, const instant *from, model_state *now,
                       double *incompatibility);

/* conserving_inertia.c: residual -= forces of inertia, S += theirs. */
void conserving_inertia(conserving *, const instant *from, const model_state *now, double h);

/* conserving_rates.c */
/* What turns without inertia; REFUSED: all that turns does. */
status conserving_massless(conserving *, fault *);
/* Work of what takes driven masses from the rates of the step to the prescribed ones at its end. */
double conserving_impulses(const conserving *, const instant *from, double h, const instant *to);
/* Rates at the end. */
void conserving_rates(conserving *, const instant *from, double h, instant *to);

/* conserving_loads.c: out[free + driven] += the loads at the middle, S += what they add. */
void conserving_loads(conserving *, const instant *from, const model_state *now, double h,
                      double out[]);

/* conserving_predict.c: the step, to begin with; as increments of coordinates (increment.h). */
void conserving_predict(conserving *, const instant *from, double h);
void conserving_increment(const conserving *, const model_state *from, double inc[]);

/* conserving_work.c: what work and dissipation of `to` have become. */
status conserving_work(conserving *, const instant *from, instant *to, double h, fault *);
/* Rates of strains at the end; stresses of damped members gain eta S0 e'. */
void conserving_damped(const conserving *, const instant *from, double h, instant *to);

#endif
