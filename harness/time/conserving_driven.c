#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/vec3.h"

/* Velocity of the centre of a mass, and angular velocity in the axes of its frame. */
typedef struct centre_rates {
    double R[9], J[9], arm[3], v[3], W[3];
} centre_rates;

static void rates_of(const model *m, const model_state *s, const frame_mass *one, const double v[],
                     centre_rates *out)
{
    frame_rates r;
    double centre[3], turned[3];
    frame_mass_step_centre(m, one, centre, out->J);
    forms_rates(m, s, one->frame, v, NULL, &r);
    memcpy(out->R, r.R, sizeof r.R);
    mat3_mul_vec(r.R, centre, out->arm);
    vec3_cross(r.w, out->arm, turned);
    mat3_transpose_mul_vec(r.R, r.w, out->W);
    for (int i = 0; i < 3; i++)
        out->v[i] = r.v[i] + turned[i];
}

static double energy_of(const frame_mass *one, const double J[9], const double v[3],
                        const double W[3])
{
    double sum = dense_quadratic(3, J, W) / 2;
    for (int i = 0; i < 3; i++)
        sum += (one->mass - one->less[i]) * v[i] * v[i] / 2;
    return sum;
}

static void add_momenta(const model *m, const model_state *s, const frame_mass *one,
                        const centre_rates *of, double factor, double out[])
{
    double P[6], H[3], spun[3], lever[3];
    mat3_mul_vec(of->J, of->W, H);
    mat3_mul_vec(of->R, H, spun);
    for (int i = 0; i < 3; i++)
        P[i] = factor * (one->mass - one->less[i]) * of->v[i];
    vec3_cross(of->arm, P, lever);
    for (int i = 0; i < 3; i++)
        H[i] = factor * spun[i] + lever[i];
    if (model_vertex(m, one->frame)->angles > 0)
        memcpy(P + 3, H, sizeof H);
    else
        mat3_transpose_mul_vec(of->R, H, P + 3);
    forms_add_force(m, s, one->frame, P, out);
}

static int is_driven(const model *m, int vertex)
{
    for (int c = 0; c < 6; c++)
        if (model_vertex(m, vertex)->coordinate[c] >= model_unknowns(m))
            return 1;
    return 0;
}

static void momenta_of(const conserving *s, const model_state *now, const double v[], double out[])
{
    const model *m = s->of.c->model;
    memset(out, 0, (size_t)s->all * sizeof *out);
    for (int k = 0; k < s->of.masses->masses; k++) {
        const frame_mass *one = &s->of.masses->mass[k];
        centre_rates of;
        if (one->frame >= model_first_release(m))
            continue;
        rates_of(m, now, one, v, &of);
        add_momenta(m, now, one, &of, 1, out);
    }
}

static void diagonal_of(const conserving *s, const model_state *now, double unit[], double out[])
{
    const model *m = s->of.c->model;
    memset(out, 0, (size_t)s->all * sizeof *out);
    memset(unit, 0, (size_t)s->all * sizeof *unit);
    for (int k = 0; k < s->of.masses->masses; k++) {
        const frame_mass *one = &s->of.masses->mass[k];
        for (int c = 0; c < 6 && one->frame < model_first_release(m); c++) {
            const int at = model_vertex(m, one->frame)->coordinate[c];
            centre_rates of;
            if (at == NONE)
                continue;
            unit[at] = 1;
            rates_of(m, now, one, unit, &of);
            out[at] += 2 * energy_of(one, of.J, of.v, of.W);
            unit[at] = 0;
        }
    }
}

/* Subtracts from out[free + driven] the change of momenta due to the prescribed rates in `to`.
 * Returns the number of masses with prescribed coordinates. */
static int subtract_change(const conserving *s, const motion_state *from, double h,
                           const motion_state *to, double out[])
{
    const model *m = s->of.c->model;
    int driven = 0;
    for (int k = 0; k < s->of.masses->masses; k++) {
        const frame_mass *one = &s->of.masses->mass[k];
        frame_mass_step p;
        centre_rates of;
        if (one->frame >= model_first_release(m) || !is_driven(m, one->frame))
            continue;
        driven++;
        frame_mass_step_of(s, from, to->state, h, one, &p);
        rates_of(m, to->state, one, to->v, &of);
        for (int i = 0; i < 3; i++) {
            of.v[i] -= p.v1[i];
            of.W[i] -= p.W1[i];
        }
        add_momenta(m, to->state, one, &of, -1, out);
    }
    return driven;
}

/* Returns the sum of x^2/diagonal over the free coordinates with inertia. */
static double square_of(const conserving *s, const double x[], const double diagonal[])
{
    double sum = 0;
    for (int c = 0; c < s->free; c++)
        sum += diagonal[c] > 0 ? x[c] * x[c] / diagonal[c] : 0;
    return sum;
}

void conserving_free_rates(conserving *s, const motion_state *from, double h, motion_state *to)
{
    const double rounding = 1e-30,
                 nothing = 1e-10; /* smaller inertia, relative to the largest, counts as none */
    const int most = 60;
    double *r = s->residual, *d = s->column, *Md = s->row, *diagonal = s->dx;
    memset(r, 0, (size_t)s->all * sizeof *r);
    if (s->all == s->free || subtract_change(s, from, h, to, r) == 0)
        return;
    diagonal_of(s, to->state, d, diagonal);
    momenta_of(s, to->state, to->v, Md);
    const double least = rounding * square_of(s, Md, diagonal);
    double square = square_of(s, r, diagonal), ratio = 0;
    memset(d, 0, (size_t)s->all * sizeof *d);
    for (int n = 0; n < most && square > least; n++) {
        double size = 0;
        for (int c = 0; c < s->free; c++) {
            d[c] = diagonal[c] > 0 ? r[c] / diagonal[c] + ratio * d[c] : 0;
            size += diagonal[c] * d[c] * d[c];
        }
        momenta_of(s, to->state, d, Md);
        const double along = dense_dot(s->free, d, Md), part = square / along;
        if (!(along > nothing * size))
            break;
        for (int c = 0; c < s->free; c++) {
            to->v[c] += part * d[c];
            r[c] -= part * Md[c];
        }
        const double last = square;
        square = square_of(s, r, diagonal);
        ratio = square / last;
    }
    for (int c = 0; c < s->free; c++)
        to->a[c] = to->algorithm[c] = (to->v[c] - from->v[c]) / h;
}

double conserving_impulses(const conserving *s, const motion_state *from, double h,
                           const motion_state *to)
{
    const model *m = s->of.c->model;
    const int joined = model_mesh_of(m)->joined != NULL;
    double sum = 0;
    for (int k = 0; k < s->of.masses->masses && s->all > s->free; k++) {
        const frame_mass *one = &s->of.masses->mass[k];
        frame_mass_step p;
        centre_rates of;
        if (one->frame >= model_first_release(m) || !(joined || is_driven(m, one->frame)))
            continue;
        frame_mass_step_of(s, from, to->state, h, one, &p);
        rates_of(m, to->state, one, to->v, &of);
        sum += energy_of(one, p.J, of.v, of.W) - energy_of(one, p.J, p.v1, p.W1);
    }
    return sum;
}
