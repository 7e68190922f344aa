/* How a frame moves over a step with the coordinates of the body that it belongs to and with those
 * that a released end keeps to itself: exactly, so that forces do the same work on either. With
 * means m of both ends of the step,
 *   beside a body:        dr = dr_b + c x rho_m,   forces f, m + rho_m x f;
 *   by angles, or released to turn, each about b, with tau = 2 tan(d angle/2):
 *                         c_k = c_(k-1) + tau_k x_k,  x = [b + c x b/2 + c (c.b)/4]/(1 - tau c.b/4)
 *                         with b at the begin: along the mean axis, about which no moment acts;
 *   released to slide:    dr = .. + c x (a s)_m + [a_m - c x (a_1 - a_n)/4] ds. */
#ifndef BEAMWORK_PLACE_H
#define BEAMWORK_PLACE_H

#include "harness/time/conserving_impl.h"

enum { PLACE_MOST = 6 + SCENE_RELEASED };

typedef struct frame_place {
    int columns;                  /* the six of the node; behind them own turns, then slides */
    double work[6 * PLACE_MOST];  /* [6 x columns] forces F on the frame are work^T F on these */
    double moved[6 * PLACE_MOST]; /* derivative of (dr, c) of the frame by these */
    double curved[PLACE_MOST * PLACE_MOST]; /* that of work^T F at fixed F */
    double measure[PLACE_MOST];             /* work times it is (dr, c): what forces work on */
} frame_place;

/* 1: the frame moves by its own dr, c; nothing else is set. F[6]: NULL: zero. */
int place_plain(const model *, int vertex);
void place_of(const conserving *, const model_state *from, const model_state *now, int vertex,
              const double F[6], frame_place *);
/* dr, c of a frame. */
void place_step(const conserving *, const model_state *from, const model_state *now, int vertex,
                double dr[3], double c[3]);

/* Forces[n] of a frame whose six begin at `at`, its own ones at `own`, become those of its
 * coordinates; so do rows; and K[n x n] on both sides. */
void place_forces(const frame_place *, int at, int own, double forces[]);
void place_row(const frame_place *, int at, int own, double row[]);
void place_matrix(const frame_place *, int n, int at, int own, double K[]);
/* Forces F[6] that act on a frame go to out[free + driven], and K[6 x 6] = -dF by its dr, c to the
 * tangent. */
void place_add(conserving *, const model_state *from, const model_state *now, int vertex,
               const double F[6], const double K[36], double out[]);

#endif
