#include "harness/experiments/experiments_impl.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

const char *design_name(design_kind kind)
{
    static const char *const names[] = {"grid", "sobol", "halton", "random"};
    return names[kind];
}

static status count_grid(design *d, fault *f)
{
    d->points = 1;
    for (int i = 0; i < d->axes; i++) {
        const sweep_axis *a = &d->axis[i];
        if (a->count == 0)
            return fault_set(f, STATUS_REFUSED,
                             "--vary %s: the number of parts is missing; write, for example, "
                             "%s=%g..%g/4%s, or add --design sobol --points 100",
                             a->of->name, a->of->name, a->from, a->to,
                             a->kind == AXIS_LOG ? ":log" : "");
        if (d->points > DESIGN_MOST_POINTS / a->count)
            return fault_set(f, STATUS_REFUSED,
                             "the grid has more than %d points; give --vary fewer parts, or give "
                             "ranges without parts, such as A..B, and --design sobol --points 100",
                             DESIGN_MOST_POINTS);
        d->points *= a->count;
    }
    return STATUS_OK;
}

static status check_box(const design *d, fault *f)
{
    const int most = d->kind == DESIGN_SOBOL ? (int)gsl_qrng_sobol->max_dimension
                                             : (int)gsl_qrng_halton->max_dimension;
    for (int i = 0; i < d->axes; i++)
        if (d->axis[i].count > 0 && d->axis[i].value == NULL)
            return fault_set(
                f, STATUS_REFUSED,
                "--vary %s: '/%d' applies only to a grid, and --design gives another kind of "
                "points; remove it, and give the number of points, such as --points 100",
                d->axis[i].of->name, d->axis[i].count - 1);
    if (d->kind != DESIGN_RANDOM && d->axes > most)
        return fault_set(f, STATUS_REFUSED,
                         "--design %s supports at most %d parameters; use --design random",
                         design_name(d->kind), most);
    return STATUS_OK;
}

static void next(const design *d, const design_mark *m, double share[])
{
    if (m->quasi != NULL)
        gsl_qrng_get(m->quasi, share);
    else
        for (int i = 0; i < d->axes; i++)
            share[i] = gsl_rng_uniform(m->random);
}

static design_mark begin(const design *d)
{
    design_mark m = {NULL, NULL};
    if (d->kind == DESIGN_RANDOM) {
        m.random = gsl_rng_alloc(gsl_rng_mt19937);
        if (m.random != NULL)
            gsl_rng_set(m.random, d->seed);
        return m;
    }
    m.quasi = gsl_qrng_alloc(d->kind == DESIGN_SOBOL ? gsl_qrng_sobol : gsl_qrng_halton,
                             (unsigned)d->axes);
    return m;
}

static design_mark copy(const design_mark *m)
{
    return (design_mark){m->quasi != NULL ? gsl_qrng_clone(m->quasi) : NULL,
                         m->random != NULL ? gsl_rng_clone(m->random) : NULL};
}

static int is_there(const design_mark *m)
{
    return m->quasi != NULL || m->random != NULL;
}

static void end(design_mark *m)
{
    if (m->quasi != NULL)
        gsl_qrng_free(m->quasi);
    if (m->random != NULL)
        gsl_rng_free(m->random);
    *m = (design_mark){NULL, NULL};
}

static status set_marks(design *d, fault *f)
{
    const long least = (d->points + DESIGN_MARKS - 1) / DESIGN_MARKS;
    d->stride = least > DESIGN_STRIDE ? least : DESIGN_STRIDE;
    const long wanted = (d->points + d->stride - 1) / d->stride;
    double share[CASE_MAX_PARAMETERS];
    d->mark = calloc((size_t)wanted, sizeof *d->mark);
    if (d->mark == NULL)
        return fault_memory(f, "the points of a sweep");
    for (; d->marks < wanted; d->marks++) {
        design_mark *here = &d->mark[d->marks];
        *here = d->marks == 0 ? begin(d) : copy(here - 1);
        if (!is_there(here))
            return fault_memory(f, "the points of a sweep");
        for (long i = 0; d->marks > 0 && i < d->stride; i++)
            next(d, here, share);
    }
    return STATUS_OK;
}

static status fill_box(design *d, long points, fault *f)
{
    if (points < 1 || points > DESIGN_MOST_POINTS)
        return fault_set(
            f, STATUS_REFUSED,
            "--design %s: the number of points is missing; add, for example, --points 100",
            design_name(d->kind));
    d->points = points;
    TRY(check_box(d, f));
    return set_marks(d, f);
}

status design_make(design_kind kind, int axes, const sweep_axis list[], long points,
                   unsigned long seed, design *out, fault *f)
{
    *out = (design){.kind = kind, .axes = axes, .axis = list, .seed = seed};
    const status outcome = kind == DESIGN_GRID ? count_grid(out, f) : fill_box(out, points, f);
    if (outcome != STATUS_OK)
        design_free(out);
    return outcome;
}

void design_free(design *d)
{
    for (long i = 0; i < d->marks; i++)
        end(&d->mark[i]);
    free(d->mark);
    d->mark = NULL;
    d->marks = 0;
}

static void grid_point(const design *d, long index, double out[])
{
    for (int i = d->axes - 1; i >= 0; i--) {
        out[i] = axis_value(&d->axis[i], (int)(index % d->axis[i].count));
        index /= d->axis[i].count;
    }
}

static status box_points(const design *d, long first, long count, double out[], fault *f)
{
    double share[CASE_MAX_PARAMETERS];
    design_mark at = copy(&d->mark[first / d->stride]);
    if (!is_there(&at))
        return fault_memory(f, "the points of a sweep");
    for (long i = 0; i < first % d->stride; i++)
        next(d, &at, share);
    for (long i = 0; i < count; i++) {
        next(d, &at, share);
        for (int k = 0; k < d->axes; k++)
            out[i * d->axes + k] = axis_at(&d->axis[k], share[k]);
    }
    end(&at);
    return STATUS_OK;
}

status design_points(const design *d, long first, long count, double out[], fault *f)
{
    if (d->kind != DESIGN_GRID)
        return box_points(d, first, count, out, f);
    for (long i = 0; i < count; i++)
        grid_point(d, first + i, out + i * d->axes);
    return STATUS_OK;
}

enum { TEXT = 128 };

const char *axis_kind_name(axis_kind kind)
{
    static const char *const names[] = {"linear", "log", "list", "words"};
    return names[kind];
}

double axis_value(const sweep_axis *a, int i)
{
    if (a->value != NULL)
        return a->value[i];
    if (i == a->count - 1)
        return a->to;
    const int parts = a->count - 1;
    if (a->kind == AXIS_LOG)
        return i == 0 ? a->from : a->from * pow(a->to / a->from, (double)i / parts);
    const double step = (a->to - a->from) / parts; /* as in cases/format/expression.c */
    return a->from + i * step;
}

double axis_at(const sweep_axis *a, double share)
{
    if (a->value != NULL) {
        const int i = (int)(share * a->count);
        return a->value[i < a->count ? i : a->count - 1];
    }
    return a->kind == AXIS_LOG ? a->from * pow(a->to / a->from, share)
                               : a->from + share * (a->to - a->from);
}

void axis_text(const sweep_axis *a, double value, char *text, int size)
{
    assignment_value_text(a->of, value, text, size);
}

static status check(const case_type *type, const sweep_axis *a, double value, fault *f)
{
    const assignment_list list = parameters_list(type);
    double values[CASE_MAX_PARAMETERS] = {0};
    char text[TEXT + 40], word[ASSIGNMENT_VALUE];
    axis_text(a, value, word, sizeof word);
    snprintf(text, sizeof text, "%.60s=%s", a->of->name, word);
    return assignment_set(&list, text, values, NULL, NULL, f);
}

static status add_value(sweep_axis *a, double value, fault *f)
{
    char text[ASSIGNMENT_VALUE];
    for (int i = 0; i < a->count; i++)
        if (a->value[i] == value) {
            axis_text(a, value, text, sizeof text);
            return fault_set(f, STATUS_REFUSED,
                             "--vary %s: the value %s is given twice; give it once", a->of->name,
                             text);
        }
    double *more = realloc(a->value, (size_t)(a->count + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "the values of --vary");
    a->value = more;
    a->value[a->count++] = value;
    return STATUS_OK;
}

static status read_list(const case_type *type, const char *text, sweep_axis *a, fault *f)
{
    const assignment_list list = parameters_list(type);
    double values[CASE_MAX_PARAMETERS] = {0};
    a->kind = a->of->choices != NULL ? AXIS_WORDS : AXIS_LIST;
    for (const char *at = text;; at += strcspn(at, ",") + 1) {
        const int length = (int)strcspn(at, ",");
        char one[2 * TEXT];
        if (length == 0 || length >= TEXT - 1)
            return fault_set(f, STATUS_REFUSED,
                             "--vary %s=%.60s: a value is missing or too long; write a range such "
                             "as %s=1..2/4, or values such as %s=1,2,4",
                             a->of->name, text, a->of->name, a->of->name);
        snprintf(one, sizeof one, "%.60s=%.*s", a->of->name, length, at);
        TRY(assignment_set(&list, one, values, NULL, NULL, f));
        TRY(add_value(a, values[a->index], f));
        if (at[length] == '\0')
            return STATUS_OK;
    }
}

static status read_end(const sweep_axis *a, const char *text, size_t length, double *out, fault *f)
{
    char one[TEXT];
    const char *end;
    snprintf(one, sizeof one, "%.*s", (int)(length < TEXT ? length : TEXT - 1), text);
    if (length > 0 && length < TEXT && number_read(one, &end, out) && *end == '\0')
        return STATUS_OK;
    char unit[PARAMETER_UNIT_WORDS];
    parameter_unit_words(a->of, unit);
    return fault_set(
        f, STATUS_REFUSED,
        "--vary %s: '%.60s' is not a number; write a range such as %s=1..2/4, with numbers%s",
        a->of->name, one, a->of->name, unit);
}

static status read_parts(const char *text, size_t length, sweep_axis *a, fault *f)
{
    char one[TEXT], *end;
    snprintf(one, sizeof one, "%.*s", (int)(length < TEXT ? length : TEXT - 1), text);
    errno = 0;
    const long parts = strtol(one, &end, 10);
    if (end == one || *end != '\0' || errno != 0 || parts < 1 || parts >= AXIS_MOST_VALUES)
        return fault_set(f, STATUS_REFUSED,
                         "--vary %s: '%.40s' is not a valid number of parts; give a whole number "
                         "from 1 to %d, such as 4",
                         a->of->name, one, AXIS_MOST_VALUES - 1);
    a->count = (int)parts + 1;
    return STATUS_OK;
}

static status check_ends(const case_type *type, const sweep_axis *a, fault *f)
{
    if (a->kind == AXIS_LOG && !(a->from > 0 && a->to > 0) && !(a->from < 0 && a->to < 0))
        return fault_set(f, STATUS_REFUSED,
                         "--vary %s: equal ratios from %g to %g do not exist; give two nonzero "
                         "ends of the same sign, or remove ':log'",
                         a->of->name, a->from, a->to);
    if (a->from == a->to)
        return fault_set(f, STATUS_REFUSED,
                         "--vary %s: the range from %g to %g is a single value; replace the option "
                         "by --set with this value, or give two different ends",
                         a->of->name, a->from, a->to);
    TRY(check(type, a, a->from, f));
    TRY(check(type, a, a->to, f));
    return check(type, a, a->count > 2 || a->count == 0 ? axis_at(a, 0.5) : a->to, f);
}

/* Reads a range "A..B/N:log", in which "/N" and ":log" are optional. dots: position of "..". */
static status read_range(const case_type *type, const char *text, const char *dots, sweep_axis *a,
                         fault *f)
{
    const char *to = dots + 2, *colon = strchr(to, ':');
    const size_t rest = colon != NULL ? (size_t)(colon - to) : strlen(to);
    const size_t end = strcspn(to, "/:");
    if (a->of->choices != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "--vary %s: the values are words, which have no range; list some of the "
                         "words %s, separated by commas",
                         a->of->name, a->of->choices);
    if (colon != NULL && strcmp(colon, ":log") != 0)
        return fault_set(
            f, STATUS_REFUSED,
            "--vary %s: the kind of steps '%.40s' is unknown; remove it for equal steps, as in "
            "%s=1..2/4, or write :log for equal ratios, as in %s=1..2/4:log",
            a->of->name, colon, a->of->name, a->of->name);
    a->kind = colon != NULL ? AXIS_LOG : AXIS_LINEAR;
    TRY(read_end(a, text, (size_t)(dots - text), &a->from, f));
    TRY(read_end(a, to, end, &a->to, f));
    if (to[end] == '/')
        TRY(read_parts(to + end + 1, rest - end - 1, a, f));
    return check_ends(type, a, f);
}

static status read_values(const case_type *type, const char *text, sweep_axis *a, fault *f)
{
    const char *dots = strstr(text, "..");
    return dots != NULL ? read_range(type, text, dots, a, f) : read_list(type, text, a, f);
}

status axis_read(const case_type *type, const char *text, sweep_axis *out, fault *f)
{
    const assignment_list list = parameters_list(type);
    double values[CASE_MAX_PARAMETERS] = {0};
    int any[CASE_MAX_PARAMETERS] = {0};
    char name[TEXT], shown[ASSIGNMENT_SHOWN];
    const size_t length = strcspn(text, "=");
    parameters_shown(type, shown);
    *out = (sweep_axis){.index = -1};
    if (length == 0 || length > 60 || text[length] == '\0' || text[length + 1] == '\0')
        return fault_set(f, STATUS_REFUSED,
                         "--vary '%.60s' is not valid; write a range such as NAME=1..2/4, or "
                         "values such as NAME=1,2,4; 'beamwork list %.170s' shows the names",
                         text, shown);
    snprintf(name, sizeof name, "%.*s=*", (int)length, text);
    TRY(assignment_set(&list, name, values, any, &out->index, f));
    out->of = parameter_at(type->parameters, out->index);
    const status outcome = read_values(type, text + length + 1, out, f);
    if (outcome != STATUS_OK)
        axis_free(out);
    return outcome;
}

void axis_free(sweep_axis *a)
{
    free(a->value);
    a->value = NULL;
}
