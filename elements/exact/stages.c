#include "elements/exact/stages.h"

#include <math.h>
#include <string.h>

#include "elements/exact/line.h"
#include "elements/exact/sums.h"
#include "elements/math/arc.h"
#include "elements/math/dense.h"
#include "elements/math/pi.h"
#include "elements/math/quadrature.h"
#include "elements/math/rotation.h"

/* Without bimoments: amplitudes, if there are any, that nothing depends on. */
static void no_warping(const exact_stages *s, const double e[], exact_stages_derivatives *out)
{
    const int n = s->unknowns + EXACT_STAGES_OUTER;
    if (s->c.warping)
        for (int i = s->unknowns + 6; i < n; i++) {
            out->hessian[i * (n + 1)] = s->c.GJ;
            out->gradient[i] = s->c.GJ * e[i - s->unknowns];
            out->P += s->c.GJ * e[i - s->unknowns] * e[i - s->unknowns] / 2;
        }
}

void exact_stages_evaluate(const exact_stages *s, const double e[], const double inner[],
                           exact_stages_derivatives *out)
{
    const int last = s->stages, n = s->unknowns + EXACT_STAGES_OUTER;
    double x[EXACT_STAGES_NODES][3], Sz[EXACT_WARPING_MAX] = {0};
    exact_stage p[EXACT_STAGES_MAX];
    exact_sums a;
    memset(&a, 0, sizeof a);
    memset(out, 0, sizeof *out);
    memcpy(x[1], inner + 3, 3 * (size_t)(last - 1) * sizeof(double));
    for (int i = 0; i < 3; i++) {
        x[last][i] = (s->line.rest[0][3 + i] + e[3 + i]) / 2;
        x[0][i] = -x[last][i];
    }
    for (int i = 0; i < last; i++)
        exact_stage_at(last + 1, s->N[i], s->dN[i], x[0], inner, s->rest_kappa[i], &p[i]);
    if (s->warps)
        exact_sums_warping(s, e, p, &a, Sz);
    for (int i = 0; i < last; i++) {
        double gradient[6], M[36];
        out->P +=
            s->w[i] * exact_stage_material(&s->c, p[i].kappa, p[i].N, Sz[i] / s->w[i], gradient, M);
        exact_sums_add(s, i, &p[i], inner, gradient, M, &a);
    }
    exact_sums_gather(s, &a, out->gradient, out->hessian);
    for (int i = 0; i < 3; i++) {
        const double v = s->rest_v[i] + e[i];
        out->P += inner[i] * v;
        out->gradient[i] += v;
        out->gradient[s->unknowns + i] += inner[i];
        out->hessian[i * n + s->unknowns + i] += 1;
        out->hessian[(s->unknowns + i) * n + i] += 1;
    }
    if (!s->warps) {
        no_warping(s, e, out);
        return;
    }
    for (int i = 0; i < last + 2; i++)
        out->P += a.z[i] * Sz[i] / 2;
    out->gradient[s->unknowns + 6] +=
        Sz[last]; /* the points' part of the gradient is there already */
    out->gradient[s->unknowns + 7] += Sz[last + 1];
}

/* v -= what initial strains add to it, int R g in the axes half way: strains are counted from the
 * arc without them. */
static void less_initial_strain(const element_request *request, double v[3])
{
    double rotation[3], back[3], added[3], q[4], R[9], middle[3];
    for (int i = 0; i < 3; i++) {
        rotation[i] = request->curvature[i] * request->length;
        back[i] = -rotation[i] / 2;
    }
    arc_at(rotation, request->strain, 1, added, q);
    rotation_exp(back, q);
    rotation_matrix(q, R);
    mat3_mul_vec(R, added, middle);
    for (int i = 0; i < 3; i++)
        v[i] -= middle[i];
}

status exact_stages_prepare(const element_request *request, int count, exact_stages *out, fault *f)
{
    double point[EXACT_STAGES_MAX], at[EXACT_STAGES_NODES];
    memset(out, 0, sizeof *out);
    TRY(beam_constants_of(request, &out->c, f));
    out->stages = count;
    out->unknowns = 3 * count;
    const double none[3] = {0};
    exact_strain_prepare(2, 1, request->length, request->curvature, none, EXACT_MEASURE_EIGHTH,
                         &out->line);
    quadrature_points(count, point, out->w);
    const double angle = vec3_norm(request->curvature) * request->length;
    for (int k = 0; k <= count; k++) {
        at[k] = (1 - cos(PI * k / count)) /
                2; /* any distinct points would do: Chebyshev's keep the numbers of a size */
        const double length = angle > 0 ? 4 * tan(angle * (at[k] - 0.5) / 4) / angle : 0;
        for (int i = 0; i < 3; i++)
            out->rest_x[k][i] = request->curvature[i] * request->length * length;
    }
    for (int i = 0; i < count; i++) {
        exact_stage p;
        double axis[3];
        const double unit[3] = {1, 0, 0},
                     strained[3] = {1 + request->strain[0], request->strain[1], request->strain[2]};
        exact_line_lagrange(count + 1, at, point[i], out->N[i], out->dN[i]);
        exact_stage_at(count + 1, out->N[i], out->dN[i], out->rest_x[0], unit, none, &p);
        memcpy(out->rest_kappa[i], p.kappa, sizeof p.kappa);
        for (int j = 0; j < 3; j++)
            p.x[j] = -p.x[j];
        exact_milenkovic_vector(&p.orientation, p.x, strained, axis); /* R (e_x + g) */
        for (int j = 0; j < 3; j++)
            out->rest_v[j] += out->w[i] * axis[j];
    }
    less_initial_strain(request, out->rest_v);
    out->warps = out->c.warping && out->c.EIw > 0;
    if (out->warps)
        exact_warping_energy(&out->c, count, point, out->w, out->S);
    return STATUS_OK;
}
