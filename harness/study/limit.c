#include "harness/study/study_impl.h"

#include <math.h>

/* Finds by bisection the order from three values, at most bisected_order; NAN: no order fits the
 * changes. */
static double richardson_order(const double n[3], const double f[3]);
/* Returns Richardson's limit f from the last two of three values, which are assumed to be f + c
 * n^-p for n elements. */
static double richardson_limit(const double n[3], const double f[3], double p);
/* Returns the factor by which errors of the values are amplified: the Euclidean norm of the
 * gradient of the extrapolated limit with respect to the values. */
static double richardson_amplification(const double n[3], const double f[3], double p);

/* smallest ratio of the numbers of elements of successive meshes; for smaller ratios, changes are
 * mostly scatter */
static const double least_refinement = 1.4;
static const double unmeasured_noise = 3e-11,
                    least_noise = 2.3e-16; /* relative scatter that is assumed if it was not
                                              measured, and smallest relative scatter */
/* changes below this multiple of the scatter do not give an order */
static const double noisy_changes = 10;
static const double least_seen_order = 0.5; /* smallest observed order that is accepted */
/* order that is assumed for the remaining error */
static const double remaining_order = 1;
static const double converged_part = 1e-4;
/* smallest change of the limit if scatter was not measured, as a fraction of the extrapolation
 * step */
static const double uncertain_step = 0.02;
static const double safety_small = 1.25, safety_large = 3;
static const double end_factor =
    4; /* uncertainty of a value without extrapolation, as a multiple of the scatter */

typedef struct meshes {
    int count;
    double n[LIMIT_MESHES], f[LIMIT_MESHES];
    double change[LIMIT_MESHES]; /* f[i + 1] - f[i] */
    double order[LIMIT_MESHES];  /* order from meshes i, i + 1, i + 2; NAN: none */
    double scale, noise;         /* [unit of f] */
} meshes;

const char *limit_kind_name(limit_kind kind)
{
    static const char *const names[LIMIT_KINDS] = {"none",       "noise-dominated", "settled",
                                                   "asymptotic", "oscillating",     "not yet"};
    return names[kind];
}

/* Among the meshes that have a value and are coarser than `fine` elements by at least the factor
 * least_refinement, returns the index of the finest; -1: none. */
static int coarser_than(const limit_sequence *s, double fine)
{
    int best = -1;
    for (int i = 0; i < s->count; i++)
        if (isfinite(s->value[i]) && fine >= least_refinement * s->n[i] &&
            (best < 0 || s->n[i] > s->n[best]))
            best = i;
    return best;
}

static void thin(const limit_sequence *s, meshes *m)
{
    int kept[LIMIT_MESHES];
    m->count = 0;
    for (int i = coarser_than(s, INFINITY); i >= 0 && m->count < LIMIT_MESHES;
         i = coarser_than(s, s->n[i]))
        kept[m->count++] = i;
    for (int i = 0; i < m->count; i++) {
        m->n[i] = s->n[kept[m->count - 1 - i]];
        m->f[i] = s->value[kept[m->count - 1 - i]];
    }
}

static double largest(int count, const double f[])
{
    double size = 0;
    for (int i = 0; i < count; i++)
        size = fmax(size, fabs(f[i]));
    return size;
}

static void prepare(const limit_sequence *s, meshes *m)
{
    thin(s, m);
    const int last = m->count - 1;
    m->scale = m->count > 0 ? fmax(fabs(m->f[last]), s->near_zero) : 0;
    if (m->scale == 0)
        m->scale = largest(m->count, m->f);
    m->noise = fmax(isnan(s->noise) ? unmeasured_noise : s->noise, least_noise) * m->scale;
    for (int i = 0; i < last; i++)
        m->change[i] = m->f[i + 1] - m->f[i];
    for (int i = 0; i + 1 < last; i++) {
        const int seen =
            fmin(fabs(m->change[i]), fabs(m->change[i + 1])) > noisy_changes * m->noise;
        m->order[i] = seen ? richardson_order(m->n + i, m->f + i) : NAN;
    }
}

static int is_good(double order, const limit_sequence *s)
{
    return order >= least_seen_order && order <= 1.1 * s->highest_order + 0.5; /* false for NAN */
}

static double refinement(const meshes *m, int before_last)
{
    const int i = m->count - 1 - before_last;
    return m->n[i] / m->n[i - 1];
}

static void few(const meshes *m, mesh_limit *out)
{
    out->kind = LIMIT_NOT_YET;
    out->limit = m->f[m->count - 1];
    out->from = (int)m->n[0];
    if (m->count == 2)
        out->limit_uncertainty =
            safety_large * fabs(m->change[0]) / (pow(refinement(m, 0), remaining_order) - 1) +
            end_factor * m->noise;
}

/* Sets the limit and returns 1 if the last change is within the scatter. Returns 0 otherwise, and
 * if the previous change is so large that the last change may be small by accident. */
static int at_noise(const limit_sequence *s, const meshes *m, mesh_limit *out)
{
    const double a = fabs(m->change[m->count - 2]), b = fabs(m->change[m->count - 3]),
                 noise = noisy_changes * m->noise;
    if (a > noise || b > noise * pow(refinement(m, 1), s->highest_order + 1))
        return 0;
    out->kind = b <= noise ? LIMIT_NOISE_DOMINATED : LIMIT_CONVERGED;
    out->limit = m->f[m->count - 1];
    out->limit_uncertainty = a + end_factor * m->noise;
    out->order = m->count > 3 && is_good(m->order[m->count - 4], s) ? m->order[m->count - 4] : NAN;
    out->from = (int)m->n[m->count - 3];
    return 1;
}

static double own_limit(const meshes *m, int first)
{
    return richardson_limit(m->n + first, m->f + first, m->order[first]);
}

/* Returns the change of the limit due to the last mesh, and the factor for the uncertainty of the
 * limit. k > 0: first of the last three meshes. */
static double change_of_limit(const limit_sequence *s, const meshes *m, int k, double *factor)
{
    const double R = refinement(m, 0), value = own_limit(m, k);
    const int measured = !isnan(s->noise);
    double change = fabs(value - own_limit(m, k - 1));
    *factor = safety_small;
    if (k > 1 && is_good(m->order[k - 2], s)) {
        const double before = fabs(own_limit(m, k - 1) - own_limit(m, k - 2));
        if (!measured && change > before / pow(R, remaining_order)) {
            change = fmax(change, before);
            *factor = safety_large;
        }
        const double next =
            m->order[k] <= 1.1 * s->highest_order ? m->order[k] + 2 : s->nominal_order;
        change = fmax(change, before / pow(R, next));
    }
    return measured ? change : fmax(change, uncertain_step * fabs(value - m->f[k + 2]));
}

/* Returns 1 if the middle order is the smallest or the largest by more than the scatter that orders
 * of a single error term have. */
static int turns(double a, double b, double c)
{
    static const double scatter = 0.1;
    return (a - b) * (b - c) < 0 && fmin(fabs(a - b), fabs(b - c)) > scatter;
}

static int asymptotic(const limit_sequence *s, const meshes *m, mesh_limit *out)
{
    const int k = m->count - 3;
    if (m->count < 4 || !is_good(m->order[k], s) || !is_good(m->order[k - 1], s))
        return 0;
    const double p = m->order[k], apart = fabs(p - m->order[k - 1]);
    if (apart > fmax(0.25, 0.15 * p))
        return 0;
    double factor;
    const double change = change_of_limit(s, m, k, &factor);
    out->kind = LIMIT_ASYMPTOTIC;
    out->limit = own_limit(m, k);
    out->limit_uncertainty = factor * change / (pow(refinement(m, 0), remaining_order) - 1) +
                             m->noise * (1 + 2 * richardson_amplification(m->n + k, m->f + k, p));
    out->order = p;
    out->order_uncertainty = apart;
    out->earlier_order = k > 1 ? m->order[k - 2] : NAN;
    out->order_turns = k > 1 && turns(m->order[k - 2], m->order[k - 1], m->order[k]);
    out->from = (int)m->n[k - 1];
    return 1;
}

/* Sets the limit and returns 1 if the order still changes or if there are only three meshes.
 * Returns 0 if an order is missing or not plausible. The uncertainty follows from the largest of
 * the last changes and the smallest plausible order. */
static int drifting(const limit_sequence *s, const meshes *m, mesh_limit *out)
{
    const int k = m->count - 3;
    const double p = m->order[k], before = k > 0 ? m->order[k - 1] : NAN,
                 nominal = s->nominal_order, highest = s->highest_order;
    const double a = fabs(m->change[k + 1]), b = fabs(m->change[k]), R = refinement(m, 0);
    double q, rest, factor = safety_large;
    if (!is_good(p, s) || (k > 0 && isnan(before)))
        return 0;
    if (k == 0) {
        q = fmin(p, nominal);
        rest = fmax(a, b * pow(R, -nominal));
    } else if (before >= least_seen_order && before <= p && p <= 1.1 * nominal) {
        q = p;
        rest = a;
        factor = p >= 0.9 * nominal ? safety_small : safety_large;
    } else {
        q = fmax(fmin(fmin(p, highest), fmin(before, 2 * before - p)), fmin(remaining_order, p));
        rest = fmax(a, b * pow(R, -fmax(before, q)));
    }
    out->kind = LIMIT_NOT_YET;
    out->limit = richardson_limit(m->n + k, m->f + k, fmin(p, highest));
    out->limit_uncertainty = factor * rest / (pow(R, q) - 1) + end_factor * m->noise;
    out->order = p;
    out->order_uncertainty = isnan(before) ? NAN : fabs(p - before);
    return 1;
}

/* Sets the limit to the last value, if no plausible order was observed. The uncertainty follows
 * from the largest of the last three changes, each reduced according to the nominal order. */
static void disorderly(const limit_sequence *s, const meshes *m, mesh_limit *out)
{
    const int last = m->count - 1;
    const double a = fabs(m->change[last - 1]), b = fabs(m->change[last - 2]), most = 10;
    double rest = 0;
    for (int i = last - 1; i >= 0 && i > last - 4; i--)
        rest = fmax(rest, fabs(m->change[i]) * pow(m->n[i + 1] / m->n[last], s->nominal_order));
    double growth = 1;
    if (!(a <= b))
        growth = b > 0 ? fmin(a / b, most) : most;
    out->kind = m->change[last - 1] * m->change[last - 2] < 0 ? LIMIT_OSCILLATING : LIMIT_NOT_YET;
    out->limit = m->f[last];
    out->limit_uncertainty = safety_large * rest * growth + end_factor * m->noise;
}

mesh_limit limit_of(const limit_sequence *s)
{
    mesh_limit out = {.limit = NAN,
                      .limit_uncertainty = INFINITY,
                      .order = NAN,
                      .order_uncertainty = NAN,
                      .earlier_order = NAN,
                      .last_change = NAN};
    meshes m;
    prepare(s, &m);
    out.noise = m.noise;
    out.meshes = m.count;
    if (m.count == 0)
        return out;
    if (m.count > 1)
        out.last_change = fabs(m.change[m.count - 2]);
    if (m.count < 3) {
        few(&m, &out);
        return out;
    }
    out.from = (int)m.n[m.count - 3];
    if (at_noise(s, &m, &out) || asymptotic(s, &m, &out))
        return out;
    if (!drifting(s, &m, &out))
        disorderly(s, &m, &out);
    if (out.limit_uncertainty <= converged_part * m.scale)
        out.kind = LIMIT_CONVERGED;
    return out;
}

static const double lowest_order = 0.05, bisected_order = 40;

/* Returns (n0^-p - n1^-p)/(n1^-p - n2^-p), which increases with p. */
static double ratio_at(double p, const double n[3])
{
    const double a = pow(n[2] / n[0], p), b = pow(n[2] / n[1], p);
    return (a - b) / (b - 1);
}

static double richardson_order(const double n[3], const double f[3])
{
    const double ratio = (f[0] - f[1]) / (f[1] - f[2]);
    double low = lowest_order, high = bisected_order;
    if (!(ratio > ratio_at(low, n)) || isinf(ratio))
        return NAN;
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2;
        *(ratio_at(middle, n) < ratio ? &low : &high) = middle;
    }
    return (low + high) / 2;
}

static double richardson_limit(const double n[3], const double f[3], double p)
{
    return f[2] + (f[2] - f[1]) / (pow(n[2] / n[1], p) - 1);
}

static double richardson_amplification(const double n[3], const double f[3], double p)
{
    const double h = 1e-4 * fmin(fabs(f[1] - f[0]), fabs(f[2] - f[1])),
                 base = richardson_limit(n, f, p), lost = 100;
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double g[3] = {f[0], f[1], f[2]};
        g[i] += h;
        const double q = richardson_order(n, g),
                     slope = isnan(q) ? lost : (richardson_limit(n, g, q) - base) / h;
        sum += slope * slope;
    }
    return sqrt(sum);
}
