#include "elements/beamw/screw.h"

#include <math.h>

const double beamw_screw_power[SCREW_POWERS] = {
    0.041666666666666664,   0.0012152777777777778, 3.2035383597883595e-05, 8.202608300264551e-07,
    2.0835982071876168e-08, 5.281609967721337e-10, 1.3380902920268335e-11, 3.389576851489321e-13,
    8.585996549822947e-15,  2.174864550325223e-16, 5.509000201462976e-18,  1.3954463022310702e-19,
};

void beamw_screw_far_factors(double square, double f[SCREW_FACTORS])
{
    const double a = sqrt(square), s = sin(a), c = cos(a), tangent = tan(a / 2),
                 p = (s - a * c) / (s * s);
    const double slope =
        (a * s * s - 2 * c * (s - a * c)) / (s * s * s); /* of p, itself the slope of a/sin a */
    double *nu = f + SCREW_NU, *mu = f + SCREW_MU, *tau = f + SCREW_TAU;
    mu[0] = a / s;
    mu[1] = p / (2 * a);
    nu[0] = (1 - mu[0]) / square;
    nu[1] = -(mu[1] + nu[0]) / square;
    nu[2] = -((slope - p / a) / (4 * square) + 2 * nu[1]) / square;
    tau[0] = tangent / a;
    tau[1] = ((1 + tangent * tangent) / 2 - tau[0]) / (2 * square);
}
