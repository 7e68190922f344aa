#include "elements/exact/stage.h"

#include <string.h>

#include "elements/exact/coupled.h"
#include "elements/math/dense.h"

void exact_stage_at(int nodes, const double N[], const double dN[], const double x[],
                    const double force[3], const double rest_kappa[3], exact_stage *p)
{
    for (int j = 0; j < 3; j++) {
        p->x[j] = p->slope[j] = 0;
        for (int k = 0; k < nodes; k++) {
            p->x[j] += N[k] * x[3 * k + j];
            p->slope[j] += dN[k] * x[3 * k + j];
        }
    }
    exact_milenkovic_forms(vec3_dot(p->x, p->x), &p->orientation, &p->curvature);
    exact_milenkovic_vector(&p->curvature, p->x, p->slope, p->kappa);
    exact_milenkovic_vector(&p->orientation, p->x, force, p->N);
    for (int j = 0; j < 3; j++)
        p->kappa[j] -= rest_kappa[j];
}

double exact_stage_material(const beam_constants *c, const double kappa[3], const double N[3],
                            double T, double gradient[6], double M[36])
{
    if (c->coupled)
        return exact_coupled_material(c, kappa, N, gradient, M);
    const double k = kappa[0];
    const double ky = kappa[1] + c->bend_y * k * k / 2, kz = kappa[2] + c->bend_z * k * k / 2,
                 My = c->EIy * ky, Mz = c->EIz * kz;
    const double gy = c->F[0] * N[1] + c->F[1] * N[2], gz = c->F[3] * N[1] + c->F[4] * N[2];
    const double torsion = c->GJ + c->trapeze * N[0] + c->bend_y * My + c->bend_z * Mz;
    const double eccentric = c->ys * N[2] - c->zs * N[1];
    gradient[0] = eccentric + torsion * k + 4 * c->torque * k * k * k + T;
    gradient[1] = My;
    gradient[2] = Mz;
    gradient[3] = -1 - c->initial[0] - N[0] / c->EA + c->trapeze * k * k / 2;
    gradient[4] = -gy - c->initial[1] - c->zs * k - c->F[6] * T;
    gradient[5] = -gz - c->initial[2] + c->ys * k - c->F[7] * T;
    memset(M, 0, 36 * sizeof *M);
    M[0] =
        torsion +
        (c->EIy * c->bend_y * c->bend_y + c->EIz * c->bend_z * c->bend_z + 12 * c->torque) * k * k;
    M[1] = M[6] = c->EIy * c->bend_y * k;
    M[2] = M[12] = c->EIz * c->bend_z * k;
    M[3] = M[18] = c->trapeze * k;
    M[4] = M[24] = -c->zs;
    M[5] = M[30] = c->ys;
    M[7] = c->EIy;
    M[14] = c->EIz;
    M[21] = -1 / c->EA;
    M[28] = -c->F[0];
    M[29] = M[34] = -c->F[1];
    M[35] = -c->F[4];
    const double initial = c->initial[0] * N[0] + c->initial[1] * N[1] + c->initial[2] * N[2];
    return -N[0] - initial - N[0] * N[0] / (2 * c->EA) - (N[1] * gy + N[2] * gz) / 2 +
           eccentric * k + c->trapeze * N[0] * k * k / 2 + My * ky / 2 + Mz * kz / 2 +
           c->GJ * k * k / 2 + c->torque * k * k * k * k;
}

void exact_stage_rows(const exact_stage *p, const double force[3], double D[6][EXACT_STAGE_SPACE])
{
    memset(D, 0, 6 * sizeof *D);
    for (int i = 0; i < 3; i++) {
        double unit[3] = {0};
        unit[i] = 1;
        exact_milenkovic_gradient(&p->curvature, p->x, unit, p->slope,
                                  &D[i][EXACT_STAGE_MILENKOVIC], &D[i][EXACT_STAGE_SLOPE]);
        exact_milenkovic_gradient(&p->orientation, p->x, unit, force,
                                  &D[3 + i][EXACT_STAGE_MILENKOVIC], &D[3 + i][EXACT_STAGE_FORCE]);
    }
}

void exact_stage_hessian(const exact_stage *p, const double force[3], const double gradient[6],
                         const double M[36], double w, double D[6][EXACT_STAGE_SPACE],
                         double H[EXACT_STAGE_SPACE][EXACT_STAGE_SPACE])
{
    double MD[6][EXACT_STAGE_SPACE], PP[9] = {0}, PS[9] = {0}, PF[9] = {0};
    exact_milenkovic_add_hessian(&p->curvature, p->x, gradient, p->slope, PP, PS);
    exact_milenkovic_add_hessian(&p->orientation, p->x, gradient + 3, force, PP, PF);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < EXACT_STAGE_SPACE; j++) {
            MD[i][j] = 0;
            for (int k = 0; k < 6; k++)
                MD[i][j] += w * M[6 * i + k] * D[k][j];
        }
    for (int i = 0; i < EXACT_STAGE_SPACE; i++)
        for (int j = 0; j < EXACT_STAGE_SPACE; j++) {
            H[i][j] = 0;
            for (int k = 0; k < 6; k++)
                H[i][j] += D[k][i] * MD[k][j];
        }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            H[EXACT_STAGE_MILENKOVIC + i][EXACT_STAGE_MILENKOVIC + j] += w * PP[3 * i + j];
            H[EXACT_STAGE_MILENKOVIC + i][EXACT_STAGE_SLOPE + j] += w * PS[3 * i + j];
            H[EXACT_STAGE_SLOPE + j][EXACT_STAGE_MILENKOVIC + i] += w * PS[3 * i + j];
            H[EXACT_STAGE_MILENKOVIC + i][EXACT_STAGE_FORCE + j] += w * PF[3 * i + j];
            H[EXACT_STAGE_FORCE + j][EXACT_STAGE_MILENKOVIC + i] += w * PF[3 * i + j];
        }
}
