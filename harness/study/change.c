#include "harness/study/study_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/section/section.h"

/* Scales for strains, for positions and rotations, and for other values. Rounding errors are below
 * a thousandth of the scale. */
static const double small_strain = 1e-14, small_part = 1e-12, small_beside = 1e-9;

double change_size(const scene *s)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double least = INFINITY, most = -INFINITY;
        for (int i = 0; i < s->nodes; i++) {
            least = fmin(least, s->node[i].position[k]);
            most = fmax(most, s->node[i].position[k]);
        }
        sum += s->nodes > 0 ? (most - least) * (most - least) : 0;
    }
    return sqrt(sum);
}

/* Returns the largest EA of the sections [N]. */
static double stiffness_of(const scene *s)
{
    double largest = 0;
    for (int i = 0; i < s->sections; i++) {
        section c;
        if (section_compute(&s->section[i], &c, NULL) == STATUS_OK)
            largest = fmax(largest, c.matrices ? c.stiffness[0] : c.young * c.A);
    }
    return largest;
}

static double youngs_of(const scene *s)
{
    double largest = 0;
    for (int i = 0; i < s->sections; i++)
        largest = fmax(largest, fmax(s->section[i].young, s->section[i].constants.young));
    return largest;
}

static double of_compliance(const scene *s, const scene_entry *e)
{
    const double size = change_size(s), EA = stiffness_of(s);
    double out = EA > 0 ? small_part / EA : 0;
    if (e->row < SCENE_RX && e->column < SCENE_RX)
        out *= size;
    if (e->row >= SCENE_RX && e->column >= SCENE_RX && size > 0)
        out /= size;
    return out;
}

static double of_resultant(const scene *s, scene_resultant which)
{
    const double force = small_strain * stiffness_of(s), size = change_size(s);
    if (which == SCENE_BIMOMENT)
        return force * size * size;
    return which <= SCENE_QZ ? force : force * size;
}

/* Returns the scale of a reading in this unit: a position, a rotation or a dimensionless number.
 * Returns 0 (unknown) for rates and other values. */
static double of_reading(const scene *s, const char *unit)
{
    if (strcmp(unit, "m") == 0)
        return small_part * change_size(s);
    return strcmp(unit, "rad") == 0 || strcmp(unit, "1") == 0 ? small_part : 0;
}

static double physical_scale(const scene *s, const scene_quantity *q)
{
    switch (q->what.kind) {
    case SCENE_COORDINATE:
        return scene_component_of(q)->component < SCENE_RX ? small_part * change_size(s)
                                                           : small_part;
    case SCENE_DEFLECTION:
        return q->what.of.deflection.component < SCENE_RX ? small_part * change_size(s)
                                                          : small_part;
    case SCENE_RELATIVE:
        return scene_relative_of(q)->component < SCENE_RX ? small_part * change_size(s)
                                                          : small_part;
    case SCENE_REACTION:
        return of_resultant(s, scene_component_of(q)->component < SCENE_RX ? SCENE_N : SCENE_MX);
    case SCENE_INTERNAL:
        return of_resultant(s, scene_internal_of(q)->resultant);
    case SCENE_STRESS:
        return small_strain * youngs_of(s);
    case SCENE_COMPLIANCE_ENTRY:
        return of_compliance(s, scene_entry_of(q));
    case SCENE_READING:
        return of_reading(s, quantity_type_of(q)->unit(s, q));
    default:
        return 0;
    }
}

/* Returns 1 if the value of the quantity is a time, a period or the reciprocal of a period. */
static int is_of_time(const scene_quantity *q)
{
    return q->reduction >= SCENE_MAX_TIME && q->reduction <= SCENE_PER_SECOND;
}

double change_scale(const scene *s, int quantity, const solve_result *r)
{
    const scene_quantity *q = &s->quantity[quantity];
    double out = q->near_zero;
    for (int i = 0; i < s->quantities && i < r->quantities; i++) {
        const scene_quantity *other = &s->quantity[i];
        if (other->analysis == q->analysis && strcmp(other->unit, q->unit) == 0 &&
            isfinite(r->quantity[i].value))
            out = fmax(out, small_beside * fabs(r->quantity[i].value));
    }
    return is_of_time(q) ? out : fmax(out, fabs(q->factor) * physical_scale(s, q));
}

/* Returns the change of a quantity relative to the value or, if larger, to the scale. NAN: the
 * value is missing in both results; INFINITY: in one of them. */
static double change_of(const scene *s, int index, const solve_result *a, const solve_result *b)
{
    const double x = index < a->quantities ? a->quantity[index].value : (double)NAN,
                 y = index < b->quantities ? b->quantity[index].value : (double)NAN;
    if (s->quantity[index].reduction == SCENE_CURVE)
        return curve_error_between(s, index, a, b, NULL);
    if (isnan(x) && isnan(y))
        return NAN;
    if (isnan(x) || isnan(y))
        return INFINITY;
    const double scale = fmax(fabs(x), change_scale(s, index, a));
    return scale > 0 ? fabs(y - x) / scale : fabs(y - x);
}

static int reports_errors(const scene_quantity *q)
{
    return q->what.kind == SCENE_BALANCE && q->what.of.balance == SCENE_DRIFT;
}

void change_between(const scene *s, const cell_result *before, const cell_result *now,
                    value_change *out)
{
    const int values = cell_values(before) > 0 && cell_values(now) > 0;
    out->largest = values ? -1 : INFINITY;
    out->which = -1;
    out->missing = 0;
    for (int q = 0; q < s->quantities; q++) {
        const int evaluated = values && !reports_errors(&s->quantity[q]);
        const double one = evaluated ? change_of(s, q, &before->solve, &now->solve) : (double)NAN;
        out->of_each[q] = one;
        out->missing |= evaluated && isnan(one) && s->quantity[q].reduction != SCENE_CURVE;
        if (one > out->largest) {
            out->largest = one;
            out->which = q;
        }
    }
    if (out->largest < 0)
        out->largest = INFINITY;
}

static int has_own_points(const scene *s, const scene_quantity *q)
{
    return s->analysis[q->analysis].kind == SCENE_CONTINUATION;
}

static const quantity_result *whole_of(const solve_result *r, int quantity)
{
    const quantity_result *q = quantity < r->quantities ? &r->quantity[quantity] : NULL;
    return q != NULL && q->status == STATUS_OK && q->curve.points > 0 ? q : NULL;
}

static int point_at(const curve *c, double x, double size)
{
    for (int i = 0; i < c->points; i++)
        if (fabs(c->x[i] - x) <= 1e-9 * size)
            return i;
    return -1;
}

static double largest_of(int count, const double value[])
{
    double largest = 0;
    for (int i = 0; i < count; i++)
        largest = fmax(largest, fabs(value[i]));
    return largest;
}

double curve_error_between(const scene *s, int quantity, const solve_result *one,
                           const solve_result *two, int *at)
{
    const quantity_result *p = whole_of(one, quantity), *q = whole_of(two, quantity);
    if (p == NULL || q == NULL)
        return NAN;
    const int own = has_own_points(s, &s->quantity[quantity]);
    const double size = largest_of(q->curve.points, q->curve.value),
                 width = largest_of(q->curve.points, q->curve.x);
    double largest = NAN;
    if (!own && p->curve.points != q->curve.points)
        return NAN;
    for (int i = 0; i < p->curve.points; i++) {
        const int k = own ? point_at(&q->curve, p->curve.x[i], width) : i;
        const double apart = k >= 0 ? fabs(p->curve.value[i] - q->curve.value[k]) : NAN;
        if (isnan(apart) || !(isnan(largest) || apart > largest))
            continue;
        largest = apart;
        if (at != NULL)
            *at = i;
    }
    return largest > 0 ? largest / size : largest;
}

int curve_error_finest(const series *one, int quantity)
{
    for (int k = one->meshes - 1; k >= 0 && one->missing[0] == '\0'; k--)
        if (whole_of(&one->cell[k].solve, quantity) != NULL)
            return k;
    return -1;
}

int curve_error_reference(const sweep *s, int quantity)
{
    int found = -1;
    double least = INFINITY;
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const int finest = curve_error_finest(one, quantity);
        if (finest < 0)
            continue;
        const double change =
            finest > 0
                ? curve_error_between(&s->point[one->point].scene, quantity,
                                      &one->cell[finest - 1].solve, &one->cell[finest].solve, NULL)
                : NAN;
        if (found < 0 || change < least) {
            found = i;
            least = isnan(change) ? INFINITY : change;
        }
    }
    return found;
}
