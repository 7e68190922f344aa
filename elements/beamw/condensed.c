#include <stddef.h>
#include <string.h>

#include "elements/beamw/equilibrium.h"
#include "elements/beamw/variants.h"
#include "elements/math/dense.h"

/* Quadratic parts of the modified modes, as products of linear functionals of e. */

typedef struct term {
    int mode, i, j; /* the term c e_i e_j of ebar_mode, numbered from 1 as in the paper */
    double c;
} term;

static void add_term(element_data *d, const term *t, double scale)
{
    double a[8] = {0}, b[8] = {0};
    a[t->i - 1] = b[t->j - 1] = 1;
    beamw_variants_add_product(d->Q[t->mode - 1], t->c * scale, a, b);
}

/* Coefficients of the quadratic part of J Eq. 66, multiplied by l0. */
static const term eq66[] = {
    {1, 3, 3, 2 / 30.0},  {1, 3, 4, 1 / 30.0},  {1, 4, 4, 2 / 30.0},  {1, 5, 5, 2 / 30.0},
    {1, 5, 6, 1 / 30.0},  {1, 6, 6, 2 / 30.0},  {2, 4, 5, 1},         {2, 3, 6, -1},
    {3, 2, 5, 1 / 10.0},  {3, 2, 6, 1 / 5.0},   {3, 5, 7, 1 / 10.0},  {3, 5, 8, -1 / 30.0},
    {3, 6, 8, -1 / 30.0}, {4, 2, 5, -1 / 5.0},  {4, 2, 6, -1 / 10.0}, {4, 5, 7, 1 / 30.0},
    {4, 6, 7, 1 / 30.0},  {4, 6, 8, -1 / 10.0}, {5, 2, 3, -1 / 10.0}, {5, 2, 4, -1 / 5.0},
    {5, 3, 7, -1 / 10.0}, {5, 3, 8, 1 / 30.0},  {5, 4, 8, 1 / 30.0},  {6, 2, 3, 1 / 5.0},
    {6, 2, 4, 1 / 10.0},  {6, 3, 7, -1 / 30.0}, {6, 4, 7, -1 / 30.0}, {6, 4, 8, 1 / 10.0},
};

void beamw_modified_printed(const section *c, unsigned features, element_data *d)
{
    const double l = d->l0, l3 = l * l * l;
    for (size_t i = 0; i < sizeof eq66 / sizeof eq66[0]; i++)
        add_term(d, &eq66[i], 1 / l);
    const double e2[8] = {0, 1}, A[8] = {[6] = 0.5, [7] = -0.5},
                 t[8] = {[1] = 1, [6] = -0.5, [7] = -0.5};
    if (features & FEATURE_TRAPEZE) {
        const double k = c->Ip / c->A / (2 * l3);
        beamw_variants_add_product(d->Q[0], k, e2, e2);
        beamw_variants_add_product(d->Q[0], k / 3, A, A);
        beamw_variants_add_product(d->Q[0], k / 5, t, t);
    }
    beamw_variants_add_product(d->Q[0], -(c->ys * c->ys + c->zs * c->zs) / (10 * l3), e2, e2);
}

/* Choice of strains. For a given stress, the energy is accurate to third order if the second-order
 * strains are evaluated for the linear solution and weighted with its stresses: e1 = int gx, e2 = l
 * int kx, e3 = int [(l-s) ky - gz], e4 = int [s ky + gz], e5 = int [(l-s) kz + gy], e6 = int [s kz
 * - gy]. Here g = gamma and k = kappa are the strains of the Simo-Reissner beam at the centroid. e7
 * and e8 are not modified, because in any frame the amplitude at a node is the twist rate kx minus
 * the warping shear. This choice gives the closed form for uniform moment and axial load. gamma
 * rotates with the section, so the stress resultants couple through the rotation of the section
 * (Haringx). The slope w' of the fibre (Engesser, J) appears only if the squares of the shear
 * strains are added to gamma_x, as in the kinematics of J (fibres_at below). */

enum { N = BEAMW_MODIFIED_VARIABLES, Z = BEAMW_STRAINS };

static void add_product(double Q[N * N], double c, const double a[N], const double b[N])
{
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            Q[N * i + j] += c * (a[i] * b[j] + b[i] * a[j]);
}

/* Linear fields of J section 3.2 at a point, as functionals of e and z. The fields are the rotation
 * of the section relative to the middle of the element, the twist rate and curvatures [1/m], the
 * shear strains at the centroid, and the extension. */
typedef struct point_fields {
    double rotation[3][N], rate[3][N], shear_y[N], shear_z[N], extension[N];
} point_fields;

/* The rotation is the mean rotation rate times x - 1/2, plus the contributions of antisymmetric
 * bending and nonuniform twist. The shear strain at the shear centre is a constant minus `lag`
 * times the nonuniform part of the twist rate. */
static void fields_at(const section *c, double l, double x, const beamw_twist *t,
                      const beamw_stiffness_fields *s, point_fields *out)
{
    const double bubble = x * (1 - x), odd = 1 - 2 * x;
    const beamw_twist_shapes shape = beamw_twist_at(t, x);
    const double mean[3][N] = {{0, 1 / l}, {0, 0, 1 / l, 1 / l}, {0, 0, 0, 0, 1 / l, 1 / l}};
    for (int k = 0; k < N; k++) {
        const int own =
            k >= Z; /* 1 for the entries of z: the bending parts (y, z) and the warping part of h */
        const double bend[3] = {0, k == Z + 1 ? -6 : 0, k == Z ? 6 : 0},
                     tw = k == Z + 2 ? l * l : 0;
        const double A = own ? 0 : s->A[k],
                     g[2] = {own ? -(k == Z) : s->h[0][k], own ? -(k == Z + 1) : s->h[1][k]};
        for (int i = 0; i < 3; i++) {
            out->rotation[i][k] = mean[i][k] * (x - 0.5) + bend[i] * bubble;
            out->rate[i][k] = (mean[i][k] + bend[i] * odd) / l;
        }
        const double uneven = (A * shape.odd + tw * shape.even) / (l * l);
        out->rotation[0][k] += (A * shape.odd_integral + tw * shape.even_integral) / l;
        out->rate[0][k] += uneven;
        out->shear_y[k] = g[0] - t->lag[0] * uneven + c->zs * out->rate[0][k];
        out->shear_z[k] = g[1] - t->lag[1] * uneven - c->ys * out->rate[0][k];
        out->extension[k] = k == 0 ? 1 / l : 0;
    }
}

/* Second-order parts of the strains of the Simo-Reissner beam. With r' = R (e_x + gamma), R =
 * exp(w~) and the rotation w, the strains are kappa = w' - 1/2 w x w' and gamma = u' - w x e_x +
 * 1/2 w x (w x e_x) - w x u'. */
typedef struct point_strains {
    double gamma[3][N * N], kappa[3][N * N];
} point_strains;

static void strains_at(const point_fields *f, point_strains *out)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        add_product(out->kappa[i], -0.5, f->rotation[j], f->rate[k]);
        add_product(out->kappa[i], 0.5, f->rotation[k], f->rate[j]);
    }
    add_product(out->gamma[0], 0.5, f->rotation[1], f->rotation[1]);
    add_product(out->gamma[0], 0.5, f->rotation[2], f->rotation[2]);
    add_product(out->gamma[0], 1, f->rotation[2], f->shear_y);
    add_product(out->gamma[0], -1, f->rotation[1], f->shear_z);
    add_product(out->gamma[1], -0.5, f->rotation[0], f->rotation[1]);
    add_product(out->gamma[1], 1, f->rotation[0], f->shear_z);
    add_product(out->gamma[1], -1, f->rotation[2], f->extension);
    add_product(out->gamma[2], -0.5, f->rotation[0], f->rotation[2]);
    add_product(out->gamma[2], -1, f->rotation[0], f->shear_y);
    add_product(out->gamma[2], 1, f->rotation[1], f->extension);
}

/* Fibres elongate by gamma_x + z kappa_y - y kappa_z plus half the square of their inclination to
 * the section normal. For Engesser's theory, the inclination is (shear_y - z kx, shear_z + y kx).
 * For Haringx's theory, shear is excluded, and the inclination is kx times the distance from the
 * shear centre. The function uses the mean and the first moments over the section. */
static void fibres_at(const section *c, unsigned features, const point_fields *f,
                      point_strains *out)
{
    const double *kx = f->rate[0];
    if (features & FEATURE_HARINGX) {
        add_product(out->gamma[0], (c->ys * c->ys + c->zs * c->zs) / 2, kx, kx);
        add_product(out->kappa[1], -c->zs, kx, kx);
        add_product(out->kappa[2], c->ys, kx, kx);
    } else {
        add_product(out->gamma[0], 0.5, f->shear_y, f->shear_y);
        add_product(out->gamma[0], 0.5, f->shear_z, f->shear_z);
        add_product(out->kappa[1], -1, f->shear_y, kx);
        add_product(out->kappa[2], -1, f->shear_z, kx);
    }
    if (features & FEATURE_TRAPEZE)
        add_product(out->gamma[0], c->Ip / c->A / 2, kx, kx);
    if (features & FEATURE_WAGNER_MOMENTS) {
        add_product(out->kappa[1], c->wagner_z / c->Iy / 2, kx, kx);
        add_product(out->kappa[2], -c->wagner_y / c->Iz / 2, kx, kx);
    }
}

void beamw_modified_consistent(const section *c, unsigned features, double l, const beamw_twist *t,
                               const beamw_stiffness_fields *fields,
                               double Q[BEAMW_MODIFIED][N * N])
{
    double x[BEAMW_TWIST_MAX_POINTS], w[BEAMW_TWIST_MAX_POINTS];
    const int points = beamw_twist_points(t, 0, 1, x, w);
    memset(Q, 0, BEAMW_MODIFIED * sizeof Q[0]);
    for (int p = 0; p < points; p++) {
        point_fields at;
        point_strains strain;
        fields_at(c, l, x[p], t, fields, &at);
        strains_at(&at, &strain);
        fibres_at(c, features, &at, &strain);
        const double ds = w[p] * l, to_q = (1 - x[p]) * l, from_p = x[p] * l;
        for (int i = 0; i < N * N; i++) {
            Q[0][i] += ds * strain.gamma[0][i];
            Q[1][i] += ds * l * strain.kappa[0][i];
            Q[2][i] += ds * (to_q * strain.kappa[1][i] - strain.gamma[2][i]);
            Q[3][i] += ds * (from_p * strain.kappa[1][i] + strain.gamma[2][i]);
            Q[4][i] += ds * (to_q * strain.kappa[2][i] + strain.gamma[1][i]);
            Q[5][i] += ds * (from_p * strain.kappa[2][i] - strain.gamma[1][i]);
        }
    }
    /* The helicoidal strains e already contain the second-order term -1/24 psi x (psi x U), the
     * difference between chord and arc. */
    const double psi[3][N] = {{0, 1 / l}, {0, 0, 1 / l, 1 / l}, {0, 0, 0, 0, 1 / l, 1 / l}};
    add_product(Q[0], -l / 24, psi[1], psi[1]);
    add_product(Q[0], -l / 24, psi[2], psi[2]);
    for (int sign = -1; sign <= 1; sign += 2) {
        add_product(Q[sign < 0 ? 2 : 3], sign * l / 24, psi[0], psi[2]);
        add_product(Q[sign < 0 ? 5 : 4], sign * l / 24, psi[0], psi[1]);
    }
}

/* Computes Q as a function of e alone: T^T Q T with T = (1, hg). */
void beamw_modified_reduce(const beamw_stiffness_fields *fields, double Q[BEAMW_MODIFIED][N * N],
                           element_data *d)
{
    double T[N * BEAMW_STRAINS] = {0}, work[N * BEAMW_STRAINS];
    for (int i = 0; i < BEAMW_STRAINS; i++) {
        T[(BEAMW_STRAINS + 1) * i] = 1;
        for (int k = 0; k < 3; k++)
            T[BEAMW_STRAINS * (Z + k) + i] = fields->hg[k][i];
    }
    for (int k = 0; k < BEAMW_MODIFIED; k++)
        dense_add_congruence(N, BEAMW_STRAINS, T, Q[k], d->Q[k], work);
}

enum {
    E = BEAMW_STRAINS,
    M = BEAMW_MODIFIED,
    EVEN = BEAMW_CONDENSED_EVEN,
    ALL = BEAMW_CONDENSED_ALL
};

/* (u, h) as functions of (e, z). */
typedef struct parts {
    double P[ALL][E], Q[ALL][N * N];
} parts;

/* Removes warping for uniform torsion: A, the warping part of h, and the rows and columns of
 * z_w. */
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
    out->share = of.P[ALL - 1][1]; /* with modified modes, h_w and u2 depend on e only through e2 */
    if (!warping)
        without_warping(out, &of);
    list(&of, out);
}

status beamw_condensed_stress(const beamw_condensed *d, const double e[E], stress_output *out)
{
    return beamw_equilibrium_stress(d, e, out) ? STATUS_OK : STATUS_NOT_CONVERGED;
}
