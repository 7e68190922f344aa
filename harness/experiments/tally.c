#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int least_of(long a, long b)
{
    return (int)(a < b ? a : b);
}

/* Returns the number of fields along an axis of the map, at most `most`. */
static int places_of(const parameter_ranges *r, int index, int most)
{
    if (index >= r->design.axes)
        return 1;
    const sweep_axis *a = &r->axis[index];
    if (a->count > 0)
        return least_of(a->count, most);
    const double fields =
        r->design.axes > 1 ? sqrt((double)r->design.points / 4) : (double)r->design.points / 2;
    return least_of((long)fmax(1, fields), most);
}

status tally_alloc(const parameter_ranges *r, tally *out, fault *f)
{
    const size_t cells = (size_t)r->formulations * (size_t)r->meshes,
                 row = (size_t)r->formulations * (size_t)(r->quantities + 1);
    memset(out, 0, sizeof *out);
    out->of = r;
    out->first_without = -1;
    if (r->design.axes <= 2) {
        out->columns = places_of(r, 0, TALLY_COLUMNS);
        out->lines = places_of(r, 1, TALLY_ROWS);
    }
    out->series = calloc(row, sizeof *out->series);
    out->map = calloc(row * (size_t)(out->columns * out->lines) + 1, sizeof *out->map);
    out->failed = calloc(cells, sizeof *out->failed);
    out->ran = calloc(cells, sizeof *out->ran);
    out->cost = calloc(cells, sizeof *out->cost);
    out->seconds = calloc(cells, sizeof *out->seconds);
    return out->series != NULL && out->map != NULL && out->failed != NULL && out->ran != NULL &&
                   out->cost != NULL && out->seconds != NULL
               ? STATUS_OK
               : fault_memory(f, "the results of a sweep");
}

void tally_free(tally *t)
{
    free(t->series);
    free(t->map);
    free(t->failed);
    free(t->ran);
    free(t->cost);
    free(t->seconds);
    memset(t, 0, sizeof *t);
}

const tally_series *tally_of(const tally *t, int which, int quantity)
{
    return &t->series[which * (t->of->quantities + 1) + quantity];
}

const tally_place *tally_at(const tally *t, int which, int quantity, int line, int column)
{
    const int row = which * (t->of->quantities + 1) + quantity;
    return &t->map[(row * t->lines + line) * t->columns + column];
}

double tally_edge(const tally *t, int axis_index, int place)
{
    const sweep_axis *a = &t->of->axis[axis_index];
    const int places = axis_index == 0 ? t->columns : t->lines;
    if (a->count > 0)
        return axis_value(a, (int)(((long)place * a->count + places - 1) / places));
    return axis_at(a, (double)place / places);
}

static int frame_motion_of(const tally *t, int axis_index, double value)
{
    const int places = axis_index == 0 ? t->columns : t->lines;
    int low = 0;
    if (axis_index >= t->of->design.axes)
        return 0;
    const sweep_axis *a = &t->of->axis[axis_index];
    if (a->value != NULL) {
        while (low < a->count - 1 && a->value[low] != value)
            low++;
        return (int)((long)low * places / a->count);
    }
    const int falls = a->to < a->from;
    while (low < places - 1) {
        const double next = tally_edge(t, axis_index, low + 1);
        if (falls ? value > next : value < next)
            break;
        low++;
    }
    return low;
}

typedef struct seen {
    int requested; /* 1: the point has a reference */
    int proven;    /* 1: the reference is a stored or computed reference value, not a limit */
    int open;      /* 1: there is a value without a reference */
    int other;
    int least; /* number of elements of the coarsest mesh within the tolerance; 0: none */
    char within[SERIES_MAX_MESHES];
} seen;

static seen look_at(const tally *t, const rows *w, int here, int which, int quantity)
{
    const int kind = w->kind[rows_quantity(w, here, quantity)];
    seen s = {.requested = kind != ROWS_NONE && kind != ROWS_DISPUTED,
              .least = w->least[rows_least(w, here, which, quantity)]};
    for (int k = 0; k < t->of->meshes; k++) {
        const size_t at = rows_value(w, here, which, k, quantity);
        s.open |= isfinite(w->value[at]) && isnan(w->error[at]);
        if (w->status[rows_cell(w, here, which, k)] == ROWS_NOT_OFFERED)
            s.requested = 0;
        s.within[k] = fabs(w->error[at]) <= t->of->request.tolerance;
    }
    s.other = w->lacks[rows_lacks(w, here, which)] != 0;
    s.open &= !s.other;
    s.requested &= !s.open && !s.other;
    s.proven = s.requested && (kind == ROWS_STORED || kind == ROWS_DERIVED);
    return s;
}

static void count(const tally *t, tally_series *to, tally_place *place, const seen *s)
{
    if (place != NULL) {
        place->points++;
        place->other += s->other;
    }
    to->open += s->open;
    if (!s->requested)
        return;
    to->requested++;
    to->proven += s->proven;
    for (int k = 0; k < t->of->meshes; k++)
        to->within[k] += s->within[k];
    to->never += s->least == 0;
    to->everywhere = s->least > to->everywhere ? s->least : to->everywhere;
    if (place == NULL)
        return;
    place->requested++;
    place->proven += s->proven;
    place->never += s->least == 0;
    place->least = s->least > place->least ? s->least : place->least;
}

static void join(const tally *t, seen *all, const seen *one)
{
    const int open = all->open | one->open, proven = all->proven | one->proven,
              other = all->other | one->other;
    if (one->requested && !all->requested)
        *all = *one;
    all->other = other;
    all->open = open;
    all->proven = proven;
    if (!one->requested)
        return;
    for (int k = 0; k < t->of->meshes; k++)
        all->within[k] = all->within[k] && one->within[k];
    if (all->least != 0 && (one->least == 0 || one->least > all->least))
        all->least = one->least;
}

static void close_counts(seen *all)
{
    if (!all->open)
        return;
    all->requested &= all->least == 0;
    all->proven &= all->requested;
    memset(all->within, 0, sizeof all->within);
}

/* Returns 1 if a is worse than b. A missing value is worse than any error. */
static int is_worse(const tally_worst *a, const tally_worst *b)
{
    if (isnan(a->error) || isnan(b->error))
        return isnan(a->error) && !isnan(b->error);
    return fabs(a->error) > fabs(b->error);
}

static void keep_worst(tally *t, int which, const tally_worst *one)
{
    tally_worst *list = t->worst[which];
    int *have = &t->worsts[which], at = *have;
    while (at > 0 && is_worse(one, &list[at - 1]))
        at--;
    if (at == TALLY_WORST)
        return;
    *have += *have < TALLY_WORST;
    for (int i = *have - 1; i > at; i--)
        list[i] = list[i - 1];
    list[at] = *one;
}

static void look_for_worst(tally *t, const rows *w, int here, long index, int which)
{
    const int finest = t->of->meshes - 1;
    const int how = w->status[rows_cell(w, here, which, finest)];
    tally_worst one = {.point = index, .quantity = -1, .status = how, .error = NAN};
    if (how == ROWS_NOT_OFFERED || how == ROWS_NO_SCENE ||
        w->lacks[rows_lacks(w, here, which)] != 0)
        return;
    for (int q = 0; q < t->of->quantities && how == STATUS_OK; q++) {
        const double error = w->error[rows_value(w, here, which, finest, q)];
        if (isnan(error) || (one.quantity >= 0 && fabs(error) <= fabs(one.error)))
            continue;
        one.quantity = q;
        one.error = error;
    }
    if (how != STATUS_OK || one.quantity >= 0)
        keep_worst(t, which, &one);
}

static void count_cells(tally *t, const rows *w, int here, int which)
{
    for (int k = 0; k < t->of->meshes; k++) {
        const size_t from = rows_cell(w, here, which, k);
        const int to = which * t->of->meshes + k, how = w->status[from];
        if (how == ROWS_NOT_OFFERED || how == ROWS_NO_SCENE)
            continue;
        t->failed[to] += how != STATUS_OK;
        t->ran[to]++;
        t->cost[to] += w->cost[from];
        t->seconds[to] += w->seconds[from];
    }
}

static void count_formulation(tally *t, const rows *w, int here, int which, int line, int column)
{
    const int quantities = t->of->quantities, first = which * (quantities + 1);
    const int mapped = t->columns > 0;
    seen all = {.requested = 0};
    for (int q = 0; q <= quantities; q++) {
        if (q == quantities)
            close_counts(&all);
        const seen one = q < quantities ? look_at(t, w, here, which, q) : all;
        tally_place *place =
            mapped ? &t->map[((first + q) * t->lines + line) * t->columns + column] : NULL;
        count(t, &t->series[first + q], place, &one);
        if (q < quantities)
            join(t, &all, &one);
    }
    count_cells(t, w, here, which);
}

static void count_references(tally *t, const rows *w, int here)
{
    for (int q = 0; q < t->of->quantities; q++) {
        const size_t at = rows_quantity(w, here, q);
        t->kind[q][w->kind[at] < ROWS_REFERENCES ? w->kind[at] : ROWS_NONE]++;
        t->uncertainty[q] = fmax(t->uncertainty[q], w->uncertainty[at]);
    }
}

static void count_point(tally *t, const rows *w, int here, long index, const double at[])
{
    const int mapped = t->columns > 0, column = mapped ? frame_motion_of(t, 0, at[0]) : 0,
              line = mapped ? frame_motion_of(t, 1, t->of->design.axes > 1 ? at[1] : 0) : 0;
    t->points++;
    if (w->status[rows_cell(w, here, 0, 0)] == ROWS_NO_SCENE) {
        t->first_without = t->without_scene++ == 0 ? index : t->first_without;
        return;
    }
    count_references(t, w, here);
    for (int i = 0; i < t->of->formulations; i++) {
        const unsigned lacks = (unsigned)w->lacks[rows_lacks(w, here, i)];
        t->others[i] += lacks != 0;
        t->lacks[i] |= lacks;
        count_formulation(t, w, here, i, line, column);
        look_for_worst(t, w, here, index, i);
    }
}

status tally_add(tally *t, long first, const rows *w, fault *f)
{
    const int axes = t->of->design.axes;
    double *at = malloc((size_t)w->points * (size_t)axes * sizeof *at);
    const status outcome = at != NULL ? design_points(&t->of->design, first, w->points, at, f)
                                      : fault_memory(f, "points");
    for (int i = 0; i < w->points && outcome == STATUS_OK; i++)
        count_point(t, w, i, first + i, at + (size_t)i * (size_t)axes);
    free(at);
    return outcome;
}

static size_t lay_out(rows *r)
{
    const size_t points = (size_t)r->points, f = (size_t)r->shape.formulations,
                 m = (size_t)r->shape.meshes, q = (size_t)r->shape.quantities;
    const size_t known = points * q, cells = points * f * m, values = cells * q,
                 leasts = points * f * q, models = points * f;
    double *at = r->first;
    double **const column[] = {&r->reference, &r->uncertainty, &r->value,
                               &r->error,     &r->cost,        &r->seconds};
    const size_t length[] = {known, known, values, values, cells, cells};
    size_t doubles = 0;
    for (size_t i = 0; i < sizeof length / sizeof length[0]; i++) {
        *column[i] = at != NULL ? at + doubles : NULL;
        doubles += length[i];
    }
    r->lacks = at != NULL ? (int32_t *)(void *)(at + doubles) : NULL;
    r->least = at != NULL ? r->lacks + models : NULL;
    r->kind = at != NULL ? (uint8_t *)(void *)(r->least + leasts) : NULL;
    r->status = at != NULL ? r->kind + known : NULL;
    return doubles * sizeof *at + (models + leasts) * sizeof *r->least + known + cells;
}

status rows_alloc(const rows_shape *shape, int points, rows *out, fault *f)
{
    *out = (rows){.shape = *shape, .points = points};
    out->size = lay_out(out);
    out->first = calloc(1, out->size + sizeof(double));
    if (out->first == NULL)
        return fault_memory(f, "the results of a sweep");
    lay_out(out);
    return STATUS_OK;
}

void rows_free(rows *r)
{
    free(r->first);
    *r = (rows){.first = NULL};
}

int rows_write(FILE *to, const rows *r)
{
    return fwrite(r->first, 1, r->size, to) == r->size ? 0 : -1;
}

int rows_read(FILE *from, rows *r)
{
    return fread(r->first, 1, r->size, from) == r->size ? 0 : -1;
}

size_t rows_quantity(const rows *r, int point, int quantity)
{
    return (size_t)point * (size_t)r->shape.quantities + (size_t)quantity;
}

size_t rows_cell(const rows *r, int point, int compared_run, int mesh)
{
    return ((size_t)point * (size_t)r->shape.formulations + (size_t)compared_run) *
               (size_t)r->shape.meshes +
           (size_t)mesh;
}

size_t rows_value(const rows *r, int point, int compared_run, int mesh, int quantity)
{
    return rows_cell(r, point, compared_run, mesh) * (size_t)r->shape.quantities + (size_t)quantity;
}

size_t rows_lacks(const rows *r, int point, int compared_run)
{
    return (size_t)point * (size_t)r->shape.formulations + (size_t)compared_run;
}

size_t rows_least(const rows *r, int point, int compared_run, int quantity)
{
    return ((size_t)point * (size_t)r->shape.formulations + (size_t)compared_run) *
               (size_t)r->shape.quantities +
           (size_t)quantity;
}

const char *rows_reference_name(int kind)
{
    static const char *const names[ROWS_REFERENCES] = {"truth stored", "truth derived",
                                                       "limit of the meshes of all", "none",
                                                       "none: formulations disagree"};
    return names[kind];
}

const char *rows_status_name(int status_)
{
    static const char *const others[] = {"not_offered", "no_scene", "not_computed"};
    return status_ < ROWS_NOT_OFFERED ? status_name((status)status_)
                                      : others[status_ - ROWS_NOT_OFFERED];
}
