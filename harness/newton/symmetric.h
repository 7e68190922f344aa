/* Small symmetric matrices whose rows may have different units. */
#ifndef BEAMWORK_SYMMETRIC_H
#define BEAMWORK_SYMMETRIC_H

enum { SYMMETRIC_MOST = 14 };

/* Negative eigenvalues of A[n x n], which is overwritten; -1: singular, a pivot is
 * a rounding error. LDL^T without pivoting,
 * which units of the rows do not change. */
int symmetric_negative(int n, double A[]);
/* inverse[n x n]; returns the negative eigenvalues, or -1: singular. */
int symmetric_inverse(int n, const double A[], double inverse[]);

#endif
