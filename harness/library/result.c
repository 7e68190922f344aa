#include "harness/library/library_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static status write_json(const bw_result *r, char **json, fault *f)
{
    document_text t;
    if (json != NULL)
        *json = NULL;
    if (r == NULL || json == NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "bw_result_json: an argument is NULL; give a result and a pointer for the text");
    TRY(text_begin(&t, f));
    return text_end(&t, json_write_solution(t.to, &r->sweep, r->truths, f), json, f);
}

bw_status bw_result_json(const bw_result *r, char **json, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, write_json(r, json, &c.fault));
}

const char *bw_result_formulation(const bw_result *r)
{
    return r != NULL ? r->sweep.series[0].formulation.key : NULL;
}

int bw_result_elements(const bw_result *r)
{
    return r != NULL ? r->sweep.series[0].mesh[0] : 0;
}

int bw_result_quantities(const bw_result *r)
{
    return r != NULL ? result_handle_scene(r)->quantities : 0;
}

static const scene_quantity *quantity_at(const bw_result *r, int i)
{
    return i >= 0 && i < bw_result_quantities(r) ? &result_handle_scene(r)->quantity[i] : NULL;
}

const char *bw_result_name(const bw_result *r, int quantity)
{
    const scene_quantity *q = quantity_at(r, quantity);
    return q != NULL ? q->name : NULL;
}

const char *bw_result_unit(const bw_result *r, int quantity)
{
    const scene_quantity *q = quantity_at(r, quantity);
    return q != NULL ? q->unit : NULL;
}

static int index_of(const bw_result *r, const char *name)
{
    for (int i = 0; name != NULL && i < bw_result_quantities(r); i++)
        if (strcmp(quantity_at(r, i)->name, name) == 0)
            return i;
    return -1;
}

static const quantity_result *found_of(const bw_result *r, const char *name)
{
    const int i = index_of(r, name);
    return i >= 0 && i < result_handle_solution(r)->quantities
               ? &result_handle_solution(r)->quantity[i]
               : NULL;
}

double bw_result_value(const bw_result *r, const char *quantity)
{
    const quantity_result *found = found_of(r, quantity);
    return found != NULL && found->status == STATUS_OK ? found->value : NAN;
}

double bw_result_at(const bw_result *r, const char *quantity)
{
    const quantity_result *found = found_of(r, quantity);
    if (found == NULL || found->status != STATUS_OK || found->curve.points > 0)
        return NAN;
    const scene *s = result_handle_scene(r);
    const scene_quantity *q = quantity_at(r, index_of(r, quantity));
    return scene_path_of(&s->analysis[q->analysis]) != NULL ? found->x : NAN;
}

double bw_result_error(const bw_result *r, const char *quantity)
{
    const int i = index_of(r, quantity);
    return i >= 0 ? r->error[i] : NAN;
}

size_t bw_result_curve(const bw_result *r, const char *quantity, const double **x, const double **y)
{
    const quantity_result *found = found_of(r, quantity);
    const int points = found != NULL ? found->curve.points : 0;
    if (x != NULL)
        *x = points > 0 ? found->curve.x : NULL;
    if (y != NULL)
        *y = points > 0 ? found->curve.value : NULL;
    return (size_t)points;
}

/* Returns the index of a numeric field of a type; -1: none. */
static int field_of(const record_type *type, const char *name, const schema_field **out)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = name != NULL ? schema_fields(type, 0, list) : 0;
    for (int i = 0; i < count && i < RESULT_COLUMNS; i++)
        if (strcmp(list[i]->name, name) == 0 && list[i]->kind != FIELD_TEXT &&
            list[i]->kind != FIELD_ENUM && list[i]->count == 0) {
            *out = list[i];
            return i;
        }
    return -1;
}

static double number_of(const subject *s, const schema_field *field)
{
    field_value v;
    schema_read(s, field, &v);
    return field->kind == FIELD_DOUBLE ? *v.numbers : (double)v.whole;
}

static double *read_column(const bw_result *r, const record_type *type, const schema_field *field)
{
    const gathering g = {&r->sweep, NULL, r->truths};
    subjects list = {0};
    gather_mesh(&g, type, 0, 0, &list);
    double *out = list.bad ? NULL : malloc(((size_t)list.count + 1) * sizeof *out);
    for (int i = 0; out != NULL && i < list.count; i++)
        out[i] = number_of(&list.row[i], field);
    gather_free(&list);
    return out;
}

/* Returns a column of `rows` records of a type. kept[RESULT_COLUMNS]: columns that have been
 * requested before. */
static size_t column_of(const bw_result *r, const record_type *type, double *kept[], int rows,
                        const char *name, const double **values)
{
    const schema_field *field = NULL;
    const int i = rows > 0 ? field_of(type, name, &field) : -1;
    if (i >= 0 && kept[i] == NULL)
        kept[i] = read_column(r, type, field);
    const double *found = i >= 0 ? kept[i] : NULL;
    if (values != NULL)
        *values = found;
    return found != NULL ? (size_t)rows : 0;
}

size_t bw_result_steps(bw_result *r, const char *column, const double **values)
{
    return column_of(r, &record_step, r != NULL ? r->step : NULL,
                     r != NULL ? result_handle_solution(r)->steps : 0, column, values);
}

size_t bw_result_motion(bw_result *r, const char *column, const double **values)
{
    return column_of(r, &record_motion, r != NULL ? r->motion : NULL,
                     r != NULL ? result_handle_solution(r)->motions : 0, column, values);
}

static const shapes *shapes_of(const bw_result *r)
{
    static const shapes none = {0};
    return r != NULL ? &result_handle_solution(r)->shapes : &none;
}

static double *read_positions(const shapes *s)
{
    const size_t count = (size_t)s->states * (size_t)s->points;
    double *out = malloc((3 * count + 1) * sizeof *out);
    for (size_t i = 0; out != NULL && i < count; i++)
        memcpy(out + 3 * i, s->point[i].r, sizeof s->point[i].r);
    return out;
}

size_t bw_result_shapes(bw_result *r, size_t *points, const double **position)
{
    const shapes *s = shapes_of(r);
    if (s->states > 0 && r->position == NULL)
        r->position = read_positions(s);
    const double *found = s->states > 0 ? r->position : NULL;
    if (points != NULL)
        *points = found != NULL ? (size_t)s->points : 0;
    if (position != NULL)
        *position = found;
    return found != NULL ? (size_t)s->states : 0;
}

size_t bw_result_members(const bw_result *r, const int **first)
{
    const shapes *s = shapes_of(r);
    if (first != NULL)
        *first = s->states > 0 ? s->first : NULL;
    return s->states > 0 ? (size_t)s->members : 0;
}

const char *bw_result_shape_kind(const bw_result *r, size_t state)
{
    const shapes *s = shapes_of(r);
    return state < (size_t)s->states ? shapes_kind_name(s->state[state].kind) : NULL;
}

double bw_result_shape_value(const bw_result *r, size_t state)
{
    const shapes *s = shapes_of(r);
    return state < (size_t)s->states ? s->state[state].value : NAN;
}
