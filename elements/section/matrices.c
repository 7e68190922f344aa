#include "elements/section/section.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

enum { N = 6 };

static const char *const stress[N] = {"N", "Qy", "Qz", "Mx", "My", "Mz"};

/* Makes A symmetric. Replaces *asymmetry by the asymmetry of A relative to its diagonal, if the
 * latter is larger. */
static status make_symmetric(double A[36], const char *name, double *asymmetry, fault *f)
{
    double mean[36];
    for (int i = 0; i < 36; i++)
        if (!isfinite(A[i]))
            return fault_set(f, STATUS_REFUSED,
                             "section: the %s matrix has an entry that is NaN or Inf; give 36 "
                             "finite entries, or the six of the diagonal",
                             name);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < i; j++)
            if (fabs(A[N * i + j] - A[N * j + i]) >
                SECTION_MATRICES_SYMMETRIC * sqrt(fabs(A[7 * i] * A[7 * j])))
                return fault_set(
                    f, STATUS_REFUSED,
                    "section: the %s matrix is not symmetric within %g of its diagonal: entry (%d, "
                    "%d) is %.17g, but entry (%d, %d) is %.17g; make both equal",
                    name, SECTION_MATRICES_SYMMETRIC, j + 1, i + 1, A[N * j + i], i + 1, j + 1,
                    A[N * i + j]);
    memcpy(mean, A, sizeof mean);
    *asymmetry = fmax(*asymmetry, dense_symmetrise(N, mean));
    memcpy(A, mean, sizeof mean);
    return STATUS_OK;
}

static status check_stiffness(const double C[36], fault *f)
{
    double scaled[36];
    for (int i = 0; i < N; i++)
        if (!(C[7 * i] > 0))
            return fault_set(f, STATUS_REFUSED,
                             "section: the stiffness of %s, entry (%d, %d), is %g; give a "
                             "positive value",
                             stress[i], i + 1, i + 1, C[7 * i]);
    for (int i = 0; i < 36; i++)
        scaled[i] = C[i] / sqrt(C[7 * (i / N)] * C[7 * (i % N)]);
    if (dense_cholesky(N, scaled) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "section: the stiffness matrix is not positive definite, so some strain "
                         "would have negative energy; reduce the off-diagonal entries");
    return STATUS_OK;
}

void section_matrices_centre(const section *c, double centre[3])
{
    const double *M = c->mass, m = M[0];
    centre[0] = 0;
    centre[1] = m > 0 ? M[N * 2 + 3] / m : 0; /* entries (1, 5) = m cz and (3, 4) = m cy */
    centre[2] = m > 0 ? M[4] / m : 0;
}

static int is_semidefinite(const double J[9])
{
    const double small = 1e-9 * (J[0] + J[4] + J[8]);
    double minors = 1;
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3;
        minors = fmin(minors, J[4 * i] >= -small ? 1 : -1);
        minors = fmin(minors, J[4 * i] * J[4 * k] - J[3 * i + k] * J[3 * i + k] >=
                                      -small * (J[0] + J[4] + J[8])
                                  ? 1
                                  : -1);
    }
    const double determinant = J[0] * (J[4] * J[8] - J[5] * J[5]) -
                               J[1] * (J[1] * J[8] - J[5] * J[2]) +
                               J[2] * (J[1] * J[5] - J[4] * J[2]);
    return minors > 0 && determinant >= -small * pow(J[0] + J[4] + J[8], 2);
}

/* Replaces M by the nearest mass matrix of a slice. Returns 0 if the difference exceeds
 * SECTION_MATRICES_SYMMETRIC, if the mass is negative, or if a centre of mass is given without
 * mass. */
static int make_slice(double M[36])
{
    const double m = M[0] == M[7] && M[7] == M[14] ? M[0] : (M[0] + M[7] + M[14]) / 3,
                 z = M[4] == -M[N + 3] ? M[4] : (M[4] - M[N + 3]) / 2,
                 y = -M[5] == M[2 * N + 3] ? -M[5] : (M[2 * N + 3] - M[5]) / 2;
    double S[36] = {[0] = m, [7] = m, [14] = m, [4] = z, [N + 3] = -z, [5] = -y, [2 * N + 3] = y};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            S[N * (3 + i) + j] = S[N * j + 3 + i];
            S[N * (3 + i) + 3 + j] = M[N * (3 + i) + 3 + j];
        }
    for (int i = 0; i < 36; i++)
        if (!(fabs(S[i] - M[i]) <=
              SECTION_MATRICES_SYMMETRIC * sqrt(fabs(M[7 * (i / N)] * M[7 * (i % N)]))))
            return 0;
    for (int i = 0; i < 36; i++)
        M[i] = S[i] + 0.0;
    return m >= 0 && (m > 0 || (z == 0 && y == 0));
}

static status check_mass(section *c, fault *f)
{
    double *M = c->mass, centre[3], J[9];
    TRY(make_symmetric(M, "mass", &c->asymmetry, f));
    const int slice = make_slice(M);
    const double m = M[0];
    if (!slice)
        return fault_set(f, STATUS_REFUSED,
                         "section: the mass matrix is not that of a rigid cross-section; give m in "
                         "the first three diagonal entries, (1, 5) = -(2, 4) = m cz, -(1, 6) = (3, "
                         "4) = m cy, and moments of inertia in the last three rows and columns");
    section_matrices_centre(c, centre);
    const double square = vec3_dot(centre, centre);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            J[3 * i + j] =
                M[N * (3 + i) + 3 + j] - m * ((i == j ? square : 0) - centre[i] * centre[j]);
    if (!is_semidefinite(J))
        return fault_set(
            f, STATUS_REFUSED,
            "section: the mass matrix has a negative moment of inertia about the centre of mass "
            "(0, %g, %g) m; increase the entries in the last three rows",
            centre[1], centre[2]);
    return STATUS_OK;
}

status section_matrices(const section_spec *spec, section *out, fault *f)
{
    const double *C = spec->constants.stiffness, *M = spec->constants.mass;
    for (int i = 0; i < 36; i++) { /* replaces -0 by 0 */
        out->stiffness[i] = C[i] + 0.0;
        out->mass[i] = M[i] + 0.0;
    }
    out->matrices = 1;
    TRY(make_symmetric(out->stiffness, "stiffness", &out->asymmetry, f));
    TRY(check_stiffness(out->stiffness, f));
    TRY(check_mass(out, f));
    C = out->stiffness;
    M = out->mass;
    out->young = out->shear_modulus = 1;
    out->A = C[0];
    out->It = C[21];
    out->Iy = C[28];
    out->Iz = C[35];
    out->density = M[0] / out->A;
    out->Ip = M[0] > 0 && M[21] > 0 ? M[21] / out->density : out->Iy + out->Iz;
    out->F[0] = 1 / C[7];
    out->F[4] = 1 / C[14];
    out->D[0] = C[7];
    out->D[4] = C[14];
    return STATUS_OK;
}

static int is_diagonal(const double A[36])
{
    for (int i = 0; i < 36; i++)
        if (i % 7 != 0 && A[i] != 0)
            return 0;
    return 1;
}

static int differ(double a, double b)
{
    return fabs(a - b) > 1e-12 * fmax(fabs(a), fabs(b));
}

int section_matrices_couple(const section *c, int inertia, int rotary)
{
    const double *M = c->mass;
    if (!is_diagonal(c->stiffness))
        return 1;
    if (!inertia)
        return 0;
    return !is_diagonal(M) || !(M[21] > 0) || differ(M[28], rotary ? c->density * c->Iy : 0) ||
           differ(M[35], rotary ? c->density * c->Iz : 0);
}
