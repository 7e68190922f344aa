#include "elements/math/offset.h"

#include <stddef.h>

#include "elements/math/dense.h"

void offset_force(const double rho[3], double force[6])
{
    double moment[3];
    vec3_cross(rho, force, moment);
    for (int i = 0; i < 3; i++)
        force[3 + i] += moment[i];
}

/* Rotation columns += translation columns times -rho~, then the same for rows: K <- A^T K A. */
void offset_matrix(int n, int at, const double rho[3], const double force[3], double K[])
{
    for (int i = 0; i < n; i++) {
        double moment[3];
        vec3_cross(rho, &K[i * n + at], moment);
        for (int c = 0; c < 3; c++)
            K[i * n + at + 3 + c] += moment[c];
    }
    for (int j = 0; j < n; j++) {
        const double column[3] = {K[at * n + j], K[(at + 1) * n + j], K[(at + 2) * n + j]};
        double moment[3];
        vec3_cross(rho, column, moment);
        for (int c = 0; c < 3; c++)
            K[(at + 3 + c) * n + j] += moment[c];
    }
    if (force == NULL)
        return;
    const double dot = vec3_dot(force, rho);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[(at + 3 + i) * n + at + 3 + j] +=
                (force[i] * rho[j] + rho[i] * force[j]) / 2 - (i == j ? dot : 0);
}
