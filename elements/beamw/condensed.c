#include "elements/beamw/condensed.h"

#include <string.h>

#include "elements/beamw/equilibrium.h"

enum {
    E = BEAMW_STRAINS,
    N = BEAMW_MODIFIED_VARIABLES,
    M = BEAMW_MODIFIED,
    EVEN = BEAMW_CONDENSED_EVEN,
    ALL = BEAMW_CONDENSED_ALL
};

/* (u, h) of (e, z). */
typedef struct parts {
    double P[ALL][E], Q[ALL][N * N];
} parts;

/* Uniform torsion: no A, no warping part, rows and columns of z_w empty. */
static void without_warping(beamw_condensed *out, parts *of)
{
    for (int r = 0; r < ALL; r++) {
        of->P[r][1] += of->P[r][6] + of->P[r][7];
        of->P[r][6] = of->P[r][7] = 0;
        beamw_variants_merge_torsion(N, of->Q[r]);
        for (int i = 0; i < N; i++)
            of->Q[r][N * i + N - 1] = of->Q[r][N * (N - 1) + i] = 0;
    }
    memset(of->P[ALL - 1], 0, sizeof of->P[0]);
    out->share = 0;
    for (int i = 0; i < 3; i++) {
        out->f[6 + i] = out->f[3 * i + 2] = 0;
        out->hg[E * i + 1] += out->hg[E * i + 6] + out->hg[E * i + 7];
        out->hg[E * i + 6] = out->hg[E * i + 7] = 0;
    }
    memset(out->hg + 2 * E, 0, E * sizeof(double));
}

/* Terms with as many variables of z as are asked for. */
static void list_terms(const parts *of, int inside, beamw_condensed *out)
{
    static const short from[BEAMW_CONDENSED_ROWS] = {0, 1, 2, 3, EVEN, EVEN + 1};
    for (int r = 0; r < BEAMW_CONDENSED_ROWS; r++)
        for (int i = 0; i < N; i++)
            for (int j = i; j < N; j++) {
                const double c = of->Q[from[r]][N * i + j];
                const int entry[] = {E * i + j, E * (j - E) + i, 3 * (i - E) + j - E};
                if (c != 0 && (i >= E) + (j >= E) == inside)
                    out->term[out->terms++] =
                        beamw_quadratic_of(c, BEAMW_CONDENSED_ROWS, N, r, i, j, entry[inside]);
            }
}

static void list(const parts *of, beamw_condensed *out)
{
    out->linears = out->terms = 0;
    for (int r = 0; r < ALL; r++)
        for (int i = 0; i < E; i++)
            if (of->P[r][i] != 0)
                out->linear[out->linears++] =
                    (beamw_condensed_linear){of->P[r][i], (short)r, (short)i};
    list_terms(of, 0, out);
    out->mixed = out->terms;
    list_terms(of, 1, out);
    out->own = out->terms;
    list_terms(of, 2, out);
    for (int i = 0; i < E * E; i++)
        out->odd[i] = out->k[EVEN - 1] * of->P[EVEN - 1][i / E] * of->P[EVEN - 1][i % E];
}

void beamw_condensed_prepare(const section *c, double l, int shear, int warping,
                             const beamw_twist *t, const beamw_stiffness_fields *fields,
                             double Q[BEAMW_MODIFIED][N * N], beamw_condensed *out)
{
    const double l3 = l * l * l;
    const double k[EVEN] = {c->young * c->A / l, c->shear_modulus * c->It / l3,
                            c->young * c->Iy / l3, c->young * c->Iz / l3, t->opposite};
    const double Ka[3] = {12 * c->young * c->Iz / l, 12 * c->young * c->Iy / l, t->uneven};
    parts of = {
        .P = {{1}, {0, 1}, {0, 0, 1, 1}, {0, 0, 0, 0, 1, 1}, {0, 0, 0, 0, 0, 0, 0.5, -0.5}}};
    memcpy(out->k, k, sizeof k);
    memcpy(out->Ka, Ka, sizeof Ka);
    memcpy(of.P[EVEN], fields->h, 3 * sizeof of.P[0]);
    memcpy(out->hg, fields->hg, sizeof out->hg);
    for (int i = 0; i < 9; i++)
        out->f[i] = shear ? c->F[i] / (c->shear_modulus * l) : 0;
    for (int r = 0; r < ALL; r++)
        for (int j = 0; j < M; j++)
            if (of.P[r][j] != 0)
                for (int i = 0; i < N * N; i++)
                    of.Q[r][i] += of.P[r][j] * Q[j][i];
    out->share = of.P[ALL - 1][1]; /* of the modes that are modified h_w has e2 alone, as u2 has */
    if (!warping)
        without_warping(out, &of);
    list(&of, out);
}

status beamw_condensed_stress(const beamw_condensed *d, const double e[E], stress_output *out)
{
    return beamw_equilibrium_stress(d, e, out) ? STATUS_OK : STATUS_NOT_CONVERGED;
}
