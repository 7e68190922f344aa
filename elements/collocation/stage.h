/* Rotations by Wiener-Milenkovic parameters (Rodrigues' modified vectors). The vector x has the
 * magnitude 4 tan(angle/4) and the direction of the rotation axis. This vector is regular up to a
 * full revolution. The rotation matrix is a rational function of x. R^T y, and the curvature kappa
 * of a line along which x varies with the slope x', have the same form:
 *   w . R^T y = B(w, y; x),  w . kappa = B(w, x'; x),
 *   B(w, y; x) = s w . y - p x . (y x w) + q [(x . w)(x . y) - t w . y],
 * where s, p, q are functions of t = |x|^2. */
#ifndef BEAMWORK_COLLOCATION_STAGE_H
#define BEAMWORK_COLLOCATION_STAGE_H

#include "elements/math/vec3.h"
#include "elements/shared/beam_constants.h"

/* The functions s, p, q with their first and second derivatives. */
typedef struct exact_milenkovic_form {
    real s[3], p[3], q[3];
} exact_milenkovic_form;

static inline void exact_milenkovic_forms(real t, exact_milenkovic_form *orientation,
                                          exact_milenkovic_form *curvature)
{
    /* u = cos^2(angle/4), and u' = du/dt = -u^2/16 */
    const real u = 16 / (16 + t), u2 = u * u, u3 = u2 * u;
    const real first[2] = {u2 * (-1.0 / 16), u3 * (-1.0 / 8)},
               second[2] = {u3 * (1.0 / 128), u2 * u2 * (3.0 / 128)};
    *orientation = (exact_milenkovic_form){
        .s = {real_of(1), real_of(0), real_of(0)},
        .p = {2 * u2 - u, 2 * first[1] - first[0], 2 * second[1] - second[0]},
        .q = {u2 * 0.5, first[1] * 0.5, second[1] * 0.5},
    };
    *curvature = (exact_milenkovic_form){
        .s = {u, first[0], second[0]},
        .p = {u2 * 0.5, first[1] * 0.5, second[1] * 0.5},
        .q = {u2 * 0.125, first[1] * 0.125, second[1] * 0.125},
    };
}

/* Computes the vector whose components are B(w, y; x) with w along each axis [3]. */
static inline void exact_milenkovic_vector(const exact_milenkovic_form *f, const real x[3],
                                           const real y[3], real out[3])
{
    real once[3], twice[3];
    vec3_cross(x, y, once);
    vec3_cross(x, once, twice);
    for (int i = 0; i < 3; i++)
        out[i] = f->s[0] * y[i] - f->p[0] * once[i] + f->q[0] * twice[i];
}

/* Computes the gradients of the vector of exact_milenkovic_vector with respect to x and y. Each row
 * belongs to a component of the vector. */
static inline void exact_milenkovic_gradients(const exact_milenkovic_form *f, const real x[3],
                                              const real y[3], real dx[9], real dy[9])
{
    const real t = vec3_dot(x, x), xy = vec3_dot(x, y), p = f->p[0], q = f->q[0];
    const real level = f->s[0] - q * t, bent = q * xy;
    real once[3], along[3];
    vec3_cross(x, y, once);
    for (int i = 0; i < 3; i++)
        along[i] =
            2 * (f->s[1] * y[i] - f->p[1] * once[i] + f->q[1] * (x[i] * xy - t * y[i]) - q * y[i]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            dx[3 * i + j] = along[i] * x[j] + q * (x[i] * y[j]);
            dy[3 * i + j] = q * (x[i] * x[j]);
        }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        dx[4 * i] += bent;
        dy[4 * i] += level;
        dx[3 * i + j] -= p * y[k];
        dx[3 * i + k] += p * y[j];
        dy[3 * i + j] += p * x[k];
        dy[3 * i + k] -= p * x[j];
    }
}

/* Adds d2B/dx2 to XX and sets XY = d2B/dx dy, whose rows belong to x. */
static inline void exact_milenkovic_add_hessian(const exact_milenkovic_form *f, const real x[3],
                                                const real w[3], const real y[3], real XX[9],
                                                real XY[9])
{
    real yw[3], wx[3], slope[3], across[3];
    vec3_cross(y, w, yw);
    vec3_cross(w, x, wx);
    const real t = vec3_dot(x, x), wy = vec3_dot(w, y), xw = vec3_dot(x, w), xy = vec3_dot(x, y),
               p = f->p[0], q = f->q[0];
    const real once = vec3_dot(x, yw), twice = xw * xy - t * wy;
    const real level = 2 * (f->s[1] * wy - f->p[1] * once + f->q[1] * twice - q * wy);
    const real bent = 4 * (f->s[2] * wy - f->p[2] * once + f->q[2] * twice);
    const real turn = f->s[1] - f->q[1] * t - q, along = f->q[1] * xw;
    for (int i = 0; i < 3; i++) { /* the gradient of t is 2 x */
        slope[i] = 2 * (f->q[1] * (w[i] * xy + y[i] * xw - 2 * x[i] * wy) - f->p[1] * yw[i]) +
                   (0.5 * bent) * x[i];
        across[i] = 2 * (turn * w[i] - f->p[1] * wx[i] + along * x[i]);
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            XX[3 * i + j] += slope[i] * x[j] + x[i] * slope[j] + q * (w[i] * y[j] + y[i] * w[j]);
            XY[3 * i + j] = x[i] * across[j] + q * (w[i] * x[j]);
        }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        XX[4 * i] += level;
        XY[4 * i] += q * xw;
        XY[3 * i + j] -= p * w[k]; /* w~ transposed */
        XY[3 * i + k] += p * w[j];
    }
}

/* One Gauss point of a collocation element: geometry, energy, and the derivatives of the energy
 * with respect to x, x' and F, in lanes (real.h). */

enum {
    EXACT_STAGE_MILENKOVIC = 0,
    EXACT_STAGE_SLOPE = 3,
    EXACT_STAGE_FORCE = 6,
    EXACT_STAGE_SPACE = 9
}; /* positions of x, x' and F */

typedef struct exact_stage {
    real x[3], slope[3], kappa[3], N[3]; /* x, its slope, the curvature kappa relative to the
                                            undeformed state, and the force N */
    exact_milenkovic_form orientation, curvature;
} exact_stage;

/* Energy of a point as a function of (kappa, N) with its derivatives. */
typedef struct exact_stage_material {
    real energy, kappa[3], N[3]; /* gradient */
    real kk[9], kN[9], NN[9];    /* Hessian */
} exact_stage_material;

/* Derivatives of the energy of a point with respect to x, x' and F. The members z are the
 * derivatives of the argument of the warping energy. */
typedef struct exact_stage_terms {
    real gradient[EXACT_STAGE_SPACE], z[EXACT_STAGE_SPACE];
    real xx[9], xs[9], ss[9], xF[9], sF[9], FF[9]; /* s: x' */
} exact_stage_terms;

/* Computes the orientation of a point, its curvature kappa relative to rest_kappa, and N = R^T
 * force, from x and x' in p. */
static inline void exact_stage_of(const real force[3], const double rest_kappa[3], exact_stage *p)
{
    exact_milenkovic_forms(vec3_dot(p->x, p->x), &p->orientation, &p->curvature);
    exact_milenkovic_vector(&p->curvature, p->x, p->slope, p->kappa);
    exact_milenkovic_vector(&p->orientation, p->x, force, p->N);
    for (int j = 0; j < 3; j++)
        p->kappa[j] -= rest_kappa[j];
}

/* Returns the argument of the warping energy: kappa_x minus the warping shear due to Q_y and
 * Q_z. */
static inline real exact_stage_twist(const beam_constants *c, const exact_stage *p)
{
    return p->kappa[0] - c->F[6] * p->N[1] - c->F[7] * p->N[2];
}

/* Computes the stationary value over gamma of the energy minus N . (e_x + gamma), and its
 * derivatives, for sections given by matrices. */
static inline void exact_stage_coupled(const beam_constants *c, const real kappa[3],
                                       const real N[3], exact_stage_material *m)
{
    m->energy = -N[0];
    for (int i = 0; i < 3; i++) {
        m->kappa[i] = m->N[i] = real_of(0);
        for (int j = 0; j < 3; j++) {
            m->kk[3 * i + j] = real_of(c->mixed[6 * i + j]);
            m->kN[3 * i + j] = real_of(c->mixed[6 * i + 3 + j]);
            m->NN[3 * i + j] = real_of(c->mixed[6 * (3 + i) + 3 + j]);
            m->kappa[i] += c->mixed[6 * i + j] * kappa[j] + c->mixed[6 * i + 3 + j] * N[j];
            m->N[i] += c->mixed[6 * (3 + i) + j] * kappa[j] + c->mixed[6 * (3 + i) + 3 + j] * N[j];
        }
    }
    for (int i = 0; i < 3; i++) {
        m->energy += (m->kappa[i] * kappa[i] + m->N[i] * N[i]) * 0.5 - c->initial[i] * N[i];
        m->N[i] -= c->initial[i];
    }
    m->N[0] -= 1;
}

/* Computes the energy of a point with the warping torque T. */
static inline void exact_stage_energy(const beam_constants *c, const real kappa[3], const real N[3],
                                      real T, exact_stage_material *m)
{
    if (c->coupled) {
        exact_stage_coupled(c, kappa, N, m);
        return;
    }
    const real k = kappa[0], kk = k * k, half = kk * 0.5;
    const real ky = kappa[1] + c->bend_y * half, kz = kappa[2] + c->bend_z * half;
    const real My = c->EIy * ky, Mz = c->EIz * kz;
    const real gy = c->F[0] * N[1] + c->F[1] * N[2], gz = c->F[3] * N[1] + c->F[4] * N[2];
    const real torsion = c->GJ + c->trapeze * N[0] + c->bend_y * My + c->bend_z * Mz;
    const real eccentric = c->ys * N[2] - c->zs * N[1], axial = N[0] * (1 / c->EA);
    const real initial = c->initial[0] * N[0] + c->initial[1] * N[1] + c->initial[2] * N[2];
    m->energy = -N[0] - initial - N[0] * axial * 0.5 - (N[1] * gy + N[2] * gz) * 0.5 +
                eccentric * k + c->trapeze * N[0] * half + (My * ky + Mz * kz) * 0.5 +
                c->GJ * half + c->torque * (kk * kk);
    m->kappa[0] = eccentric + torsion * k + (4 * c->torque) * (kk * k) + T;
    m->kappa[1] = My;
    m->kappa[2] = Mz;
    m->N[0] = -1 - c->initial[0] - axial + c->trapeze * half;
    m->N[1] = -gy - c->initial[1] - c->zs * k - c->F[6] * T;
    m->N[2] = -gz - c->initial[2] + c->ys * k - c->F[7] * T;
    real_zero(9, m->kk);
    real_zero(9, m->kN);
    real_zero(9, m->NN);
    m->kk[0] =
        torsion +
        (c->EIy * c->bend_y * c->bend_y + c->EIz * c->bend_z * c->bend_z + 12 * c->torque) * kk;
    m->kk[1] = m->kk[3] = (c->EIy * c->bend_y) * k;
    m->kk[2] = m->kk[6] = (c->EIz * c->bend_z) * k;
    m->kk[4] = real_of(c->EIy);
    m->kk[8] = real_of(c->EIz);
    m->kN[0] = c->trapeze * k;
    m->kN[1] = real_of(-c->zs);
    m->kN[2] = real_of(c->ys);
    m->NN[0] = real_of(-1 / c->EA);
    m->NN[4] = real_of(-c->F[0]);
    m->NN[5] = m->NN[7] = real_of(-c->F[1]);
    m->NN[8] = real_of(-c->F[4]);
}

/* Computes out = kk A. Without section matrices, only the first row and the diagonal of kk are
 * set. */
static inline void exact_stage_bend(const exact_stage_material *m, int coupled, const real A[9],
                                    real out[9])
{
    if (coupled) {
        mat3_mul(m->kk, A, out);
        return;
    }
    for (int j = 0; j < 3; j++) {
        out[j] = m->kk[0] * A[j] + m->kk[1] * A[3 + j] + m->kk[2] * A[6 + j];
        out[3 + j] = m->kk[3] * A[j] + m->kk[4] * A[3 + j];
        out[6 + j] = m->kk[6] * A[j] + m->kk[8] * A[6 + j];
    }
}

/* Computes out = NN A. Without section matrices, axial and shear forces are uncoupled. */
static inline void exact_stage_stretch(const exact_stage_material *m, int coupled, const real A[9],
                                       real out[9])
{
    if (coupled) {
        mat3_mul(m->NN, A, out);
        return;
    }
    for (int j = 0; j < 3; j++) {
        out[j] = m->NN[0] * A[j];
        out[3 + j] = m->NN[4] * A[3 + j] + m->NN[5] * A[6 + j];
        out[6 + j] = m->NN[7] * A[3 + j] + m->NN[8] * A[6 + j];
    }
}

/* Adds kN A to out. Without section matrices, only torsion is coupled. */
static inline void exact_stage_add_mixed(const exact_stage_material *m, int coupled,
                                         const real A[9], real out[9])
{
    for (int i = 0; i < (coupled ? 3 : 1); i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] +=
                m->kN[3 * i] * A[j] + m->kN[3 * i + 1] * A[3 + j] + m->kN[3 * i + 2] * A[6 + j];
}

static inline void exact_stage_add_mixed_transposed(const exact_stage_material *m, int coupled,
                                                    const real A[9], real out[9])
{
    if (coupled) {
        mat3_add_transpose_mul(m->kN, A, out);
        return;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] += m->kN[i] * A[j];
}

/* Derivatives of kappa with respect to x (Kx) and x' (Ks), and of N with respect to x (Nx) and F
 * (NF). */
typedef struct exact_stage_rows {
    real Kx[9], Ks[9], Nx[9], NF[9];
} exact_stage_rows;

static inline void exact_stage_rows_of(const exact_stage *p, const real force[3],
                                       exact_stage_rows *D)
{
    exact_milenkovic_gradients(&p->curvature, p->x, p->slope, D->Kx, D->Ks);
    exact_milenkovic_gradients(&p->orientation, p->x, force, D->Nx, D->NF);
}

/* Computes w times the sum of D^T M D and the second derivatives of kappa and N contracted with the
 * gradient. */
static inline void exact_stage_terms_of(const beam_constants *c, const exact_stage *p,
                                        const real force[3], const exact_stage_material *m,
                                        double w, exact_stage_terms *t)
{
    const int coupled = c->coupled;
    exact_stage_rows D;
    real A[9], B[9], C[9], E[9], F[9];
    exact_stage_rows_of(p, force, &D);
    exact_stage_bend(m, coupled, D.Kx, A);
    exact_stage_add_mixed(m, coupled, D.Nx, A);
    exact_stage_stretch(m, coupled, D.Nx, B);
    exact_stage_add_mixed_transposed(m, coupled, D.Kx, B);
    exact_stage_bend(m, coupled, D.Ks, C);
    exact_stage_stretch(m, coupled, D.NF, E);
    real_zero(9, F);
    exact_stage_add_mixed(m, coupled, D.NF, F);
    real_zero(9, t->xx);
    exact_milenkovic_add_hessian(&p->curvature, p->x, m->kappa, p->slope, t->xx, t->xs);
    exact_milenkovic_add_hessian(&p->orientation, p->x, m->N, force, t->xx, t->xF);
    real_zero(9, t->ss);
    real_zero(9, t->sF);
    real_zero(9, t->FF);
    mat3_add_transpose_mul(D.Kx, A, t->xx);
    mat3_add_transpose_mul(D.Nx, B, t->xx);
    mat3_add_transpose_mul(A, D.Ks, t->xs);
    mat3_add_transpose_mul(B, D.NF, t->xF);
    mat3_add_transpose_mul(D.Ks, C, t->ss);
    mat3_add_transpose_mul(D.Ks, F, t->sF);
    mat3_add_transpose_mul(D.NF, E, t->FF);
    for (int j = 0; j < 9; j++) {
        t->xx[j] *= w;
        t->xs[j] *= w;
        t->ss[j] *= w;
        t->xF[j] *= w;
        t->sF[j] *= w;
        t->FF[j] *= w;
    }
    for (int j = 0; j < 3; j++) {
        t->gradient[EXACT_STAGE_MILENKOVIC + j] =
            w * (m->kappa[0] * D.Kx[j] + m->kappa[1] * D.Kx[3 + j] + m->kappa[2] * D.Kx[6 + j] +
                 m->N[0] * D.Nx[j] + m->N[1] * D.Nx[3 + j] + m->N[2] * D.Nx[6 + j]);
        t->gradient[EXACT_STAGE_SLOPE + j] =
            w * (m->kappa[0] * D.Ks[j] + m->kappa[1] * D.Ks[3 + j] + m->kappa[2] * D.Ks[6 + j]);
        t->gradient[EXACT_STAGE_FORCE + j] =
            w * (m->N[0] * D.NF[j] + m->N[1] * D.NF[3 + j] + m->N[2] * D.NF[6 + j]);
        t->z[EXACT_STAGE_MILENKOVIC + j] = D.Kx[j] - c->F[6] * D.Nx[3 + j] - c->F[7] * D.Nx[6 + j];
        t->z[EXACT_STAGE_SLOPE + j] = D.Ks[j];
        t->z[EXACT_STAGE_FORCE + j] = -c->F[6] * D.NF[3 + j] - c->F[7] * D.NF[6 + j];
    }
}

#endif
