/* K += J^T S J with sums along rows in registers: the bits of plain loops, in the same order. */
#ifndef BEAMWORK_CONGRUENCE_H
#define BEAMWORK_CONGRUENCE_H

enum { CONGRUENCE_WIDEST = 24 };

/* K(n x n) += J^T S J with J(m x n), S(m x m); m and n at most CONGRUENCE_WIDEST. The second is for
 * processors with AVX2: real.h. */
void congruence_add_plain(int m, int n, const double *J, const double *S, double *K);
void congruence_add_avx2(int m, int n, const double *J, const double *S, double *K);

#endif
