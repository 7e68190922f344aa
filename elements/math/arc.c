#include "elements/math/arc.h"

#include <math.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

void arc_at(const double rotation[3], const double e[3], double x, double r[3], double q[4])
{
    const double part[3] = {rotation[0] * x, rotation[1] * x, rotation[2] * x};
    const double w = vec3_norm(part), half = sin(w / 2);
    /* (1 - cos w)/w^2 and (w - sin w)/w^3 */
    const double a = w < 1e-4 ? 0.5 - w * w / 24 : 2 * half * half / (w * w);
    const double b =
        w < 0.3 ? (1 - w * w / 20 * (1 - w * w / 42 * (1 - w * w / 72 * (1 - w * w / 110)))) / 6
                : (w - sin(w)) / (w * w * w);
    double once[3], twice[3];
    vec3_cross(part, e, once);
    vec3_cross(part, once, twice);
    for (int i = 0; i < 3; i++)
        r[i] = x * (e[i] + a * once[i] + b * twice[i]);
    rotation_exp(part, q);
}
