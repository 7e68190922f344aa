#include "harness/experiments/reference.h"

#include <math.h>

#include "harness/model/model.h"
#include "harness/study/study.h"

enum { MOST = 64 };

static double scale_of(const scene_quantity *q, double value)
{
    const double scale = fmax(fabs(value), q->near_zero);
    return scale > 0 ? scale : 1;
}

static point_reference of_truth(const scene_quantity *q, const truth *t, rows_reference kind)
{
    return (point_reference){kind, t->value, t->uncertainty / scale_of(q, t->value)};
}

/* Does another formulation solve the same problem? Theories of shear in stability differ. */
static int same_physics(const sweep *s, int a, int b)
{
    const series *one = &s->series[a], *other = &s->series[b];
    const scene *here = &s->point[one->point].scene;
    if (one->point != other->point || other->missing[0] != '\0' || other->without.other)
        return 0;
    return one->without.other || features_theory(here, one->formulation.type) ==
                                     features_theory(here, other->formulation.type);
}

typedef struct known_limit {
    double value, uncertainty;
} known_limit;

static int known_limits(const sweep *s, int index, int quantity, known_limit out[MOST])
{
    int count = 0;
    for (int i = 0; i < s->seriess && count < MOST; i++) {
        if (!same_physics(s, index, i))
            continue;
        const mesh_limit fit = verdict_limit(s, i, quantity, 0);
        if (isfinite(fit.limit) && isfinite(fit.limit_uncertainty))
            out[count++] = (known_limit){fit.limit, fit.limit_uncertainty};
    }
    return count;
}

static point_reference of_limits(const sweep *s, int index, int quantity, double tolerance)
{
    const scene_quantity *q = &s->point[s->series[index].point].scene.quantity[quantity];
    const point_reference none = {ROWS_NONE, NAN, NAN};
    known_limit all[MOST];
    const int count = known_limits(s, index, quantity, all);
    int best = 0;
    if (count == 0)
        return none;
    for (int i = 1; i < count; i++)
        if (all[i].uncertainty < all[best].uncertainty)
            best = i;
    double doubt = all[best].uncertainty;
    for (int i = 0; i < count; i++)
        doubt = fmax(doubt, fabs(all[i].value - all[best].value) - all[i].uncertainty);
    const double scale = scale_of(q, all[best].value), most = tolerance / 2;
    if (!(all[best].uncertainty / scale <= most))
        return none;
    if (!(doubt / scale <= most))
        return (point_reference){ROWS_DISPUTED, NAN, NAN};
    return (point_reference){ROWS_LIMIT, all[best].value, doubt / scale};
}

point_reference reference_of(const sweep *s, int series_index, int quantity, const truths *stored,
                             const truths *derived, double tolerance)
{
    const series *one = &s->series[series_index];
    const sweep_point *p = &s->point[one->point];
    const scene_quantity *q = &p->scene.quantity[quantity];
    const truth *row =
        stored != NULL ? verdict_truth(stored, p, &one->formulation, quantity) : NULL;
    point_reference found = {ROWS_NONE, NAN, NAN};
    if (row != NULL)
        found = of_truth(q, row, ROWS_STORED);
    if (found.doubt <= tolerance / 2) /* NAN is not */
        return found;
    row = derived != NULL ? verdict_truth(derived, p, &one->formulation, quantity) : NULL;
    if (row != NULL)
        found = of_truth(q, row, ROWS_DERIVED);
    return found.doubt <= tolerance / 2 ? found : of_limits(s, series_index, quantity, tolerance);
}
