/* Computes B of field.h. With forces q, moments mu and bimoments b per length, the resultants about
 * the centroid obey
 *   N' = -q_x,  Qy' = -q_y,  Qz' = -q_z,  Mx' = -mu_x,  My' = Qz - mu_y,  Mz' = -Qy - mu_z,
 *   Mw = -W' - b,
 * and C is the compliance of EA, EIy, EIz, GIt (for the torque about the shear centre minus Mw),
 * EIw (for W) and shear (for Qy, Qz, Mw) (J App. A). */
#include <math.h>
#include <string.h>

#include "elements/beamw/modes.h"
#include "elements/field/field.h"
#include "elements/math/dense.h"
#include "elements/math/scalar.h"

enum { N = FIELD_INNER };
enum { NX, QY, QZ, MX, MY, MZ, W, MW, RESULTANTS };
enum { DEGREE = 6, ENDS = 6, MOST = ENDS + DEGREE + 1 + 2 };
enum { POINTS = 8 };
enum { LOADS = 7 }; /* q, mu, b */

typedef struct inside {
    const displacement_field *f;
    const section *c;
    double shear[9];               /* flexibility for (Qy, Qz, Mw) [1/N ...] */
    double inertia[LOADS];         /* [kg/m, kg m, kg m^3] */
    double modes[FIELD_MODES * N]; /* deformation modes e due to v */
    int warps, count;              /* count is the number of columns in use, at most MOST */
} inside;

static void motion_at(const inside *i, double x, double out[LOADS][N])
{
    static const int functional[LOADS] = {-1,          FIELD_NU_Y,  FIELD_NU_Z, FIELD_CHI_X,
                                          FIELD_CHI_Y, FIELD_CHI_Z, -1};
    field_rows at;
    field_at(i->f, x, &at);
    memset(out, 0, LOADS * sizeof out[0]);
    for (int k = 0; k < LOADS - 1; k++) {
        out[k][k] = 1 - x;
        out[k][NODE_COORDINATES + k] = x;
        if (functional[k] >= 0)
            dense_add_transpose_mul(N, FIELD_MODES, 1, i->modes, at.functional[functional[k]],
                                    out[k]);
    }
    if (i->inertia[LOADS - 1] > 0) {
        double psi[FIELD_MODES];
        field_warping_at(i->f, x, psi);
        dense_add_transpose_mul(N, FIELD_MODES, 1, i->modes, psi, out[LOADS - 1]);
    }
}

/* Computes s[RESULTANTS x N] at x, in equilibrium with the inertia forces of the field between 0
 * and x. */
static void loaded_at(const inside *i, double x, double s[RESULTANTS][N])
{
    double y[LOADS][N], point[FIELD_MOST_POINTS], weight[FIELD_MOST_POINTS];
    const double l = i->f->l0;
    const int count = field_points(i->f, 0, x, point, weight);
    memset(s, 0, RESULTANTS * sizeof s[0]);
    for (int g = 0; g < count; g++) {
        const double step = l * weight[g], arm = l * (x - point[g]);
        motion_at(i, point[g], y);
        for (int j = 0; j < N; j++) {
            for (int k = 0; k < 6; k++)
                s[k][j] -= step * i->inertia[k] * y[k][j];
            s[MY][j] -= step * arm * i->inertia[2] * y[2][j];
            s[MZ][j] += step * arm * i->inertia[1] * y[1][j];
        }
    }
    motion_at(i, x, y);
    for (int j = 0; j < N; j++)
        s[MW][j] = -i->inertia[LOADS - 1] * y[LOADS - 1][j];
}

/* Computes s[RESULTANTS x MOST] due to forces and bimoments at the ends. */
static void free_at(const inside *i, double x, double s[RESULTANTS][MOST])
{
    const double l = i->f->l0, y = 2 * x - 1, lambda = i->f->twist.lambda;
    memset(s, 0, RESULTANTS * sizeof s[0]);
    for (int k = 0; k < ENDS; k++)
        s[k][k] = k < 3 ? 1 : l;
    s[MY][QZ] = l * y / 2;
    s[MZ][QY] = -l * y / 2;
    for (int n = 0; n <= DEGREE && i->warps; n++) {
        s[W][ENDS + n] = l * l * pow(y, n);
        s[MW][ENDS + n] = n > 0 ? -2 * l * n * pow(y, n - 1) : 0;
    }
    for (int end = 0; end < 2 && i->count == MOST; end++) {
        const double decay = exp(-lambda * (end == 0 ? x : 1 - x));
        s[W][MOST - 2 + end] = l * l * decay;
        s[MW][MOST - 2 + end] = (end == 0 ? 1 : -1) * l * lambda * decay;
    }
}

/* Computes the deformations [RESULTANTS x columns] due to the resultants s, whose rows are
 * `columns` entries long. */
static void deform(const inside *i, int columns, const double *s, double *out)
{
    const section *c = i->c;
    for (int j = 0; j < columns; j++) {
        const double *at = s + j, Qy = at[QY * columns], Qz = at[QZ * columns],
                     Mw = at[MW * columns],
                     torsion = (at[MX * columns] - c->ys * Qz + c->zs * Qy - Mw) /
                               (c->shear_modulus * c->It);
        double *to = out + j;
        for (int k = 0; k < 3; k++)
            to[(k < 2 ? QY + k : MW) * columns] =
                i->shear[3 * k] * Qy + i->shear[3 * k + 1] * Qz + i->shear[3 * k + 2] * Mw;
        to[QY * columns] += c->zs * torsion;
        to[QZ * columns] -= c->ys * torsion;
        to[MW * columns] -= torsion;
        to[MX * columns] = torsion;
        to[NX * columns] = at[NX * columns] / (c->young * c->A);
        to[MY * columns] = at[MY * columns] / (c->young * c->Iy);
        to[MZ * columns] = at[MZ * columns] / (c->young * c->Iz);
        to[W * columns] = i->warps ? at[W * columns] / (c->young * c->Iw) : 0;
    }
}

static int is_coupled(const section *c)
{
    int coupled = 0;
    for (int i = 0; i < 36 && c->matrices; i++)
        coupled |= i % 7 != 0 && (c->stiffness[i] != 0 || c->mass[i] != 0);
    return coupled;
}

/* Sets the inertia per length [kg/m, kg m, kg m^3]. */
static void set_inertia(const section *c, unsigned features, double out[LOADS])
{
    const lumped_mass line = lumped_of(c, features, 1);
    for (int i = 0; i < 3; i++) {
        out[i] = line.mass;
        out[3 + i] = c->matrices ? c->mass[7 * (3 + i)] : line.rotary[i];
    }
    out[LOADS - 1] = line.warping;
}

static int prepare(const element_request *r, const displacement_field *f, const section *c,
                   inside *out)
{
    const double stiffness[] = {c->young * c->A, c->young * c->Iy, c->young * c->Iz,
                                c->shear_modulus * c->It};
    node_state x[2] = {{.R = {1, 0, 0, 0, 1, 0, 0, 0, 1}}, {.R = {1, 0, 0, 0, 1, 0, 0, 0, 1}}};
    *out = (inside){.f = f, .c = c, .warps = f->warps && c->Iw > 0};
    out->count = ENDS + (out->warps ? DEGREE + 1 : 0) + (out->warps && f->twist.lambda > 1 ? 2 : 0);
    for (size_t i = 0; i < sizeof stiffness / sizeof *stiffness; i++)
        if (!(stiffness[i] > 0) || is_coupled(c))
            return 0;
    for (int i = 0; i < 9 && r->features & FEATURE_SHEAR; i++)
        out->shear[i] = (out->warps || (i % 3 < 2 && i < 6)) ? c->F[i] / c->shear_modulus : 0;
    set_inertia(c, r->features, out->inertia);
    x[1].r[0] = f->l0;
    beamw_modes_evaluate(f->l0, x, &(strain_output){.J = out->modes});
    return 1;
}

/* Adds weight s_r^T C s_r to gram[count x count], and the corresponding products with s_p to
 * `mixed` and B. */
static void gather(const inside *i, double x, double weight, double gram[MOST * MOST],
                   double mixed[MOST * N], double B[N * N])
{
    double loaded[RESULTANTS][N], free[RESULTANTS][MOST], deformed[RESULTANTS][N],
        free_deformed[RESULTANTS][MOST];
    loaded_at(i, x, loaded);
    free_at(i, x, free);
    deform(i, N, loaded[0], deformed[0]);
    deform(i, MOST, free[0], free_deformed[0]);
    for (int k = 0; k < RESULTANTS; k++) {
        for (int a = 0; a < i->count; a++) {
            for (int b = 0; b < i->count; b++)
                gram[a * i->count + b] += weight * free[k][a] * free_deformed[k][b];
            for (int j = 0; j < N; j++)
                mixed[a * N + j] += weight * free[k][a] * deformed[k][j];
        }
        for (int a = 0; a < N; a++)
            for (int b = 0; b < N; b++)
                B[a * N + b] += weight * loaded[k][a] * deformed[k][b];
    }
}

static void scale(int count, double gram[], double mixed[])
{
    double root[MOST];
    for (int a = 0; a < count; a++)
        root[a] = sqrt(gram[a * count + a]);
    for (int a = 0; a < count; a++) {
        for (int b = 0; b < count; b++)
            gram[a * count + b] /= root[a] * root[b];
        for (int j = 0; j < N; j++)
            mixed[a * N + j] /= root[a];
    }
}

void field_inner(const element_request *request, const displacement_field *f,
                 double B[FIELD_INNER * FIELD_INNER])
{
    double gram[MOST * MOST] = {0}, mixed[MOST * N] = {0}, solved[MOST * N], x[FIELD_MOST_POINTS],
                       weight[FIELD_MOST_POINTS], product[N * N] = {0};
    inside i;
    const section c = field_section(request);
    int count = POINTS;
    memset(B, 0, N * N * sizeof *B);
    if (f->nodes != 2 || !prepare(request, f, &c, &i))
        return;
    if (f->twist.lambda > 0)
        count = field_points(f, 0, 1, x, weight);
    else
        quadrature_points(POINTS, x, weight);
    for (int g = 0; g < count; g++)
        gather(&i, x[g], f->l0 * weight[g], gram, mixed, B);
    scale(i.count, gram, mixed);
    memcpy(solved, mixed, sizeof solved);
    if (dense_cholesky(i.count, gram) != 0) {
        memset(B, 0, N * N * sizeof *B);
        return;
    }
    dense_cholesky_solve(i.count, N, gram, solved);
    dense_add_transpose_mul(N, i.count, N, mixed, solved, product);
    for (int k = 0; k < N * N; k++)
        B[k] -= product[k];
    dense_symmetrise(N, B);
}
