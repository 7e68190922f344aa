#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness/model/model.h"
#include "harness/time/time.h"

/* Returns the value; NAN: its relative error leaves no significant digit, and r contains the
 * reason. */
static double known(const analysis_context *c, double value, double error, const char *what,
                    quantity_result *r)
{
    char why[FAULT_TEXT];
    r->rounding = error;
    if (error <= EIGEN_LARGEST_ERROR)
        return value;
    snprintf(why, sizeof why,
             "%s (with %d unknowns) is lost in round-off (error %.1e); use fewer elements", what,
             model_sizes(c->model).free, error);
    quantity_no_value(r, STATUS_NOT_CONVERGED, why);
    return NAN;
}

/* Returns the value from the eigenvalue of the requested mode; NAN: there is no such mode, or the
 * eigenvalue is lost in rounding. */
static double eigenvalue_of(const analysis_context *c, const scene_quantity *q,
                            const rotation_modes *modes, quantity_result *r)
{
    int order = 0;
    char what[64];
    for (int i = 0; i < modes->count; i++)
        if (modes->growth[i] == 0 && modes_in_family(scene_mode_of(q), &modes->shape[i]) &&
            order++ == scene_mode_of(q)->order) {
            const quantity_eigenvalue found = {.value = modes->frequency[i]};
            double part;
            snprintf(what, sizeof what, "frequency %d in rotating axes", i + 1);
            return known(c, quantity_type_of(q)->eigenvalue(q, &found, &part), modes->error[i],
                         what, r);
        }
    return NAN;
}

/* Returns the largest growth rate [1/s]; NAN: there are no modes, or no digit is significant. */
static double growth_of(const analysis_context *c, const rotation_modes *modes, quantity_result *r)
{
    int largest = 0;
    for (int i = 1; i < modes->count; i++)
        if (modes->growth[i] > modes->growth[largest])
            largest = i;
    if (modes->count == 0 || modes->growth[largest] == 0)
        return modes->count > 0 ? 0 : NAN;
    const double growth = modes->growth[largest], size = hypot(growth, modes->frequency[largest]);
    return known(c, growth, modes->error[largest] * size / growth, "the growth rate", r);
}

static const rotation_modes *modes_at(const analysis_outcome *o, int i)
{
    rotation_modes *const modes = outcome_rotation_of(o)->modes;
    return modes != NULL ? &modes[i] : NULL;
}

/* Returns the value that a file of cases/quantities reads from the state; NAN: r contains the
 * reason. */
static double read_at(const analysis_context *c, const scene_quantity *q, const analysis_outcome *o,
                      int i, quantity_result *r)
{
    const outcome_instant *moving =
        o->kind == SCENE_MOTION ? &outcome_motion_of(o)->at_station[i] : NULL;
    const outcome_path *path = outcome_path_of(o);
    reading from = {.eq = &c->eq, .state = path->state != NULL ? path->state[i] : NULL};
    fault f = {""};
    double value = NAN;
    if (moving != NULL) {
        from.v = moving->rate;
        from.a = moving->acceleration;
        from.balance = moving->balance;
    }
    if (o->kind == SCENE_COMPLIANCE)
        from.compliance = &outcome_compliance_of(o)->matrix[36 * i];
    if (reading_is_slope(q))
        value = outcome_motion_of(o)
                    ->slope[(size_t)(q - c->scene->quantity) * (size_t)path->stations + (size_t)i];
    const status outcome = reading_is_slope(q) ? STATUS_OK : reading_whole(&from, q, &value, &f);
    if (outcome != STATUS_OK)
        quantity_no_value(r, outcome, f.text);
    else if (isnan(value) && reading_is_kinematic(q) && o->kind != SCENE_COMPLIANCE)
        quantity_no_value(r, STATUS_NO_VALUE, turns_lost);
    return outcome == STATUS_OK ? value : NAN;
}

/* Returns the value of a quantity at a station of the path; NAN: r may contain the reason. */
static double extracted(const analysis_context *c, const scene_quantity *q,
                        const analysis_outcome *o, int i, quantity_result *r)
{
    const quantity_type *type = quantity_type_of(q);
    if (type->read != NULL)
        return read_at(c, q, o, i, r);
    if (q->what.kind == SCENE_RESPONSE)
        return o->left.harmonic
            .response[(size_t)(q - c->scene->quantity) * (size_t)outcome_path_of(o)->stations +
                      (size_t)i];
    if (o->kind != SCENE_ROTATION || modes_at(o, i) == NULL)
        return NAN;
    return type->eigenvalue != NULL ? eigenvalue_of(c, q, modes_at(o, i), r)
                                    : growth_of(c, modes_at(o, i), r);
}

static double at_station(const analysis_context *c, const scene_quantity *q,
                         const analysis_outcome *o, int i, quantity_result *r)
{
    return quantity_scaled(q, extracted(c, q, o, i, r));
}

/* Returns the rounding error of an acceleration or a jerk at a station. Returns 0 for an
 * acceleration at the end of a step, because it comes from the integrator. */
static double rounding_at(const analysis_context *c, const scene_quantity *q,
                          const analysis_outcome *o, int i)
{
    const outcome_motion *m = outcome_motion_of(o);
    const double time = m->path.value[i];
    int first = 0, last = m->steps - 1;
    while (first < last) {
        const int middle = (first + last) / 2;
        if (m->step[middle].time < time)
            first = middle + 1;
        else
            last = middle;
    }
    if (m->steps < 2 || (m->step[first].time == time && !reading_is_slope(q)))
        return 0;
    return fabs(q->factor) *
           reading_rounding(c->model, q, m->path.state[i], m->step[first > 0 ? first : 1].step);
}

/* Returns an error bound of a response or of a rate at a station, or 0 for other quantities. */
static double bound_at(const analysis_context *c, const scene_quantity *q,
                       const analysis_outcome *o, int i)
{
    const size_t stations = (size_t)outcome_path_of(o)->stations;
    if (o->kind == SCENE_MOTION && q->what.kind == SCENE_RATE)
        return rounding_at(c, q, o, i);
    return q->what.kind == SCENE_RESPONSE
               ? fabs(q->factor) *
                     o->left.harmonic.bound[(size_t)(q - c->scene->quantity) * stations + (size_t)i]
               : 0;
}

static double relative(double error, double value)
{
    return value != 0 ? error / fabs(value) : 0;
}

/* Rejects a rate of which rounding leaves no digit. size: magnitude of the rate, or the largest
 * magnitude of its curve. */
static void check_rate(const scene_quantity *q, double size, quantity_result *r)
{
    const double most = 0.1;
    char why[FAULT_TEXT];
    if (q->what.kind != SCENE_RATE || r->status != STATUS_OK || !(r->rounding > most))
        return;
    snprintf(why, sizeof why,
             "no digit of the value is known: the rounding error is up to %.1e %s, and grows as "
             "steps get shorter; give a longer step",
             r->rounding * size, q->unit);
    quantity_no_value(r, STATUS_NO_VALUE, why);
    r->curve.points = 0;
}

static void take_curve(const analysis_context *c, const scene_quantity *q,
                       const analysis_outcome *o, quantity_result *r)
{
    const outcome_path *p = outcome_path_of(o);
    if (!quantity_curve(r, p->reached))
        return;
    double bound = 0, largest = 0;
    for (int i = 0; i < p->reached; i++) {
        r->curve.x[i] = quantity_abscissa(q, p->value[i]);
        r->curve.value[i] = at_station(c, q, o, i, r);
        bound = fmax(bound, bound_at(c, q, o, i));
        largest = fmax(largest, fabs(r->curve.value[i]));
    }
    r->rounding = fmax(r->rounding, relative(bound, largest)); /* modes: set by known() */
    r->value = p->reached > 0 ? r->curve.value[p->reached - 1] : NAN;
    check_rate(q, largest, r);
}

static void take_spectrum(const analysis_context *c, const scene_quantity *q,
                          const analysis_outcome *o, quantity_result *r)
{
    const outcome_path *p = outcome_path_of(o);
    int first, count;
    fault f = {""};
    const status known = scene_spectrum_stations(c->scene, q, &first, &count, &f);
    double *value = calloc((size_t)(count > 0 ? count : 0) + 1, sizeof *value);
    if (known != STATUS_OK || value == NULL) {
        quantity_no_value(r, known != STATUS_OK ? known : STATUS_FAULT,
                          known != STATUS_OK ? f.text : "out of memory for a spectrum");
        free(value);
        return;
    }
    for (int i = 0; i < count; i++)
        value[i] = at_station(c, q, o, first + i, r);
    spectrum_take(q, count - 1, (p->value[first + count - 1] - p->value[first]) / (count - 1),
                  value, r);
    free(value);
}

/* Returns the reason why a path ended before a station, from the analysis that computed the
 * path. */
static const char *reason_of_path(const analysis_context *c, const scene_quantity *q)
{
    const int follows = c->scene->analysis[q->analysis].follows;
    return follows != SCENE_NONE && c->outcomes[follows].status != STATUS_OK
               ? c->outcomes[follows].reason
               : "the path does not reach this station; request an earlier one";
}

static void path_ends(const analysis_context *c, const scene_quantity *q, const analysis_outcome *o,
                      quantity_result *r)
{
    const int of_frequencies = c->scene->analysis[q->analysis].kind == SCENE_HARMONIC;
    char text[FAULT_TEXT];
    if (o->status == STATUS_OK && of_frequencies && q->reduction == SCENE_AT) {
        snprintf(text, sizeof text, "%.10g Hz is not one of the frequencies of %s; add it", q->at,
                 scene_called(c->scene, SCENE_ANALYSES, q->analysis).text);
        quantity_no_value(r, STATUS_NOT_CONVERGED, text);
    } else if (o->status != STATUS_OK)
        quantity_no_value(r, o->status, o->reason);
    else
        quantity_no_value(r, STATUS_NOT_CONVERGED, reason_of_path(c, q));
}

/* Returns 1 if the quantity is evaluated at this station, which is the requested one, or the last
 * one if none is requested. */
static int is_taken_at(const scene_quantity *q, int stations, const double path[], int station)
{
    if (q->reduction == SCENE_AT)
        return fabs(path[station] - q->at) <= 1e-12 * fmax(1, fabs(q->at));
    return station == stations - 1;
}

static int takes_station(const scene_quantity *q, int stations, const double path[], int station)
{
    return q->reduction == SCENE_MAX || q->reduction == SCENE_MIN ||
           is_taken_at(q, stations, path, station);
}

int extract_path_has(const analysis_context *c, int analysis, int stations, const double path[],
                     int station)
{
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (q->analysis == analysis && q->reduction != SCENE_CURVE &&
            takes_station(q, stations, path, station))
            return 1;
    }
    return 0;
}

int extract_path_needs(const analysis_context *c, int analysis, int stations, const double path[],
                       int station)
{
    return !c->options->values_only || extract_path_has(c, analysis, stations, path, station);
}

extern const quantity_type quantity_hinge;

/* Returns 1 if an analysis that follows the path starts from this state. */
static int begins_with(const analysis_context *c, int analysis, int path, int station)
{
    const scene_analysis *a = &c->scene->analysis[analysis];
    if (a->follows != path || !context_runs(c, analysis))
        return 0;
    if (a->kind != SCENE_COMPLIANCE)
        return 1;
    const scene_path *along = scene_path_of(&c->scene->analysis[path]);
    const station_matrices *taken = c->outcomes[analysis].left.compliance.taken;
    return !(taken != NULL && taken[station].known) &&
           extract_path_needs(c, analysis, along->stations, along->value, station);
}

int extract_path_whole(const analysis_context *c, int analysis, int station)
{
    const scene *s = c->scene;
    if (c->options->shapes > 0 || c->options->systems ||
        s->analysis[analysis].kind == SCENE_ROTATION)
        return 1;
    const scene_path *along = scene_path_of(&s->analysis[analysis]);
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *q = &s->quantity[i];
        if (q->analysis == analysis &&
            (scene_reads_forces(q) || quantity_type_of(q) == &quantity_hinge) &&
            (q->reduction == SCENE_CURVE ||
             takes_station(q, along->stations, along->value, station)))
            return 1;
    }
    for (int i = 0; i < s->analyses; i++)
        if (begins_with(c, i, analysis, station))
            return 1;
    return 0;
}

static void extract_passing(const analysis_context *c, const scene_quantity *q,
                            const analysis_outcome *o, quantity_result *r)
{
    const outcome_motion *m = outcome_motion_of(o);
    const outcome_passing *found = m->passing != NULL ? &m->passing[q - c->scene->quantity] : NULL;
    const int known = found != NULL && found->known == 1;
    if (found != NULL && found->known == PASSING_LOST) {
        quantity_no_value(r, STATUS_NO_VALUE, turns_lost);
    } else if (found != NULL && found->known == PASSING_UNSOLVED) {
        quantity_no_value(r, STATUS_NOT_CONVERGED,
                          "no solution was found at an instant inside a step; give a shorter step");
    } else if (o->status != STATUS_OK && !(known && q->reduction == SCENE_CROSSING)) {
        path_ends(c, q, o, r);
    } else if (!known) {
        quantity_no_value(r, STATUS_NO_VALUE,
                          q->reduction >= SCENE_CROSSING && q->reduction <= SCENE_PER_SECOND
                              ? "the quantity crosses the level too few times in the time window; "
                                "extend the window, or change the level"
                              : "no part of the motion is in the time window; change the window");
    } else {
        r->value = quantity_scaled(q, found->value);
        r->x = quantity_abscissa(q, found->time);
        r->rounding = r->value != 0 ? fabs(q->factor * found->error / r->value) : 0;
        if (!scene_is_timed(q->reduction) && q->reduction != SCENE_MEAN)
            check_rate(q, fabs(r->value), r);
    }
}

/* Replaces the value by the extreme between the frequencies of the analysis if it exceeds the
 * values at these frequencies. */
static void extract_peak(const scene_quantity *q, const outcome_peak *peak, quantity_result *r)
{
    char why[FAULT_TEXT];
    if (!peak->known)
        return;
    snprintf(why, sizeof why,
             "the response is unbounded at %.6g Hz, where it is not damped; add damping, or write "
             "take: curve",
             peak->hertz);
    if (peak->unbounded) {
        quantity_no_value(r, STATUS_NO_VALUE, why);
        return;
    }
    r->value = quantity_scaled(q, peak->value);
    r->rounding = relative(fabs(q->factor) * peak->bound, r->value);
    r->x = quantity_abscissa(q, peak->hertz);
}

static void take_loops(const analysis_context *c, const scene_quantity *q, quantity_result *r)
{
    for (int i = 0; q->what.kind == SCENE_RESPONSE && i < c->scene->loads; i++)
        if (scene_closes_loop(c->scene, q->analysis, i))
            snprintf(r->meaning, sizeof r->meaning, "loop closed");
}

void extract_path(const analysis_context *c, const scene_quantity *q, const analysis_outcome *o,
                  quantity_result *r)
{
    if (extract_continued(c, q, r))
        return;
    if (scene_is_passed(q, o->kind)) {
        extract_passing(c, q, o, r);
        return;
    }
    const outcome_path *p = outcome_path_of(o);
    const int complete = p->reached == p->stations;
    int chosen = -1;
    take_loops(c, q, r);
    for (int i = 0; i < p->reached; i++) {
        const double value =
            q->reduction == SCENE_MAX || q->reduction == SCENE_MIN ? at_station(c, q, o, i, r) : 0;
        const int better = q->reduction == SCENE_MAX ? value > r->value : value < r->value;
        const int here = is_taken_at(q, p->stations, p->value, i);
        if ((q->reduction == SCENE_MAX || q->reduction == SCENE_MIN) ? chosen < 0 || better
                                                                     : here) {
            chosen = i;
            r->value = value;
        }
    }
    if (q->transform != SCENE_HISTORY && complete) {
        take_spectrum(c, q, o, r);
        return;
    }
    if (q->reduction == SCENE_CURVE) {
        if (q->transform == SCENE_HISTORY) {
            take_curve(c, q, o, r);
            check_rate(q, fabs(r->value), r);
        }
        if (!complete)
            path_ends(c, q, o, r);
        return;
    }
    if (chosen < 0 || (q->reduction != SCENE_AT && !complete)) {
        path_ends(c, q, o, r);
        return;
    }
    r->value = at_station(c, q, o, chosen, r);
    r->rounding = fmax(r->rounding, relative(bound_at(c, q, o, chosen), r->value));
    check_rate(q, fabs(r->value), r);
    r->x = quantity_abscissa(q, p->value[chosen]);
    if (q->what.kind == SCENE_RESPONSE)
        extract_peak(q, &o->left.harmonic.peak[q - c->scene->quantity], r);
}
