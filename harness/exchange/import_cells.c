#include "harness/exchange/import_cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Nothing is known of another program's order. */
static element_order any_order(element_analysis analysis, const double options[])
{
    (void)analysis;
    (void)options;
    return (element_order){1, 8};
}

static int by_place(const void *a, const void *b)
{
    const imported_row *p = a, *q = b;
    if (p->elements != q->elements)
        return (p->elements > q->elements) - (p->elements < q->elements);
    const int order = strcmp(p->quantity, q->quantity);
    if (order != 0)
        return order;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : p->line - q->line;
}

void import_cells_order(imported *found)
{
    if (found->rows > 1)
        qsort(found->row, (size_t)found->rows, sizeof *found->row, by_place);
}

static status find_meshes(series *one, const imported *found, fault *f)
{
    for (int i = 0; i < found->rows; i++) {
        if (one->meshes > 0 && one->mesh[one->meshes - 1] == found->row[i].elements)
            continue;
        if (one->meshes == SERIES_MAX_MESHES)
            return fault_set(f, STATUS_REFUSED, "%.60s: more than %d meshes; remove some",
                             found->program, SERIES_MAX_MESHES);
        one->mesh[one->meshes++] = found->row[i].elements;
    }
    return STATUS_OK;
}

static int add_to_curve(curve *c, const imported_row *row)
{
    double *x = realloc(c->x, (size_t)(c->points + 1) * sizeof *x);
    if (x == NULL)
        return 0;
    c->x = x;
    double *value = realloc(c->value, (size_t)(c->points + 1) * sizeof *value);
    if (value == NULL)
        return 0;
    c->value = value;
    c->x[c->points] = row->x;
    c->value[c->points++] = row->value;
    return 1;
}

static int quantity_index(const scene *s, const char *name)
{
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, name) == 0)
            return i;
    return -1;
}

static int take_row(const scene *s, series *one, const imported_row *row)
{
    int mesh = 0;
    while (one->mesh[mesh] != row->elements)
        mesh++;
    cell_result *cell = &one->cell[mesh];
    const int index = quantity_index(s, row->quantity);
    if (index < 0)
        return 1;
    quantity_result *q = &cell->solve.quantity[index];
    if (row->unknowns > 0)
        cell->size.free = row->unknowns;
    if (isfinite(row->seconds))
        cell->solve.seconds_solve = row->seconds;
    q->status = STATUS_OK;
    q->reason[0] = '\0';
    if (s->quantity[index].reduction == SCENE_CURVE)
        return add_to_curve(&q->curve, row);
    q->value = row->value;
    if (mesh == one->meshes - 1 && isfinite(row->uncertainty)) {
        const double size = fmax(fabs(row->value), s->quantity[index].near_zero);
        one->noise[index] = size > 0 ? row->uncertainty / size : NAN;
    }
    return 1;
}

static int make_cells(const scene *s, series *one)
{
    one->cell = calloc((size_t)one->meshes + 1, sizeof *one->cell);
    one->noise = malloc(((size_t)s->quantities + 1) * sizeof *one->noise);
    if (one->cell == NULL || one->noise == NULL)
        return 0;
    for (int q = 0; q < s->quantities; q++)
        one->noise[q] = NAN;
    for (int k = 0; k < one->meshes; k++) {
        solve_result *r = &one->cell[k].solve;
        r->seconds_solve = NAN;
        r->quantity = calloc((size_t)s->quantities + 1, sizeof *r->quantity);
        if (r->quantity == NULL)
            return 0;
        r->quantities = s->quantities;
        for (int q = 0; q < s->quantities; q++) {
            r->quantity[q].value = r->quantity[q].x = r->quantity[q].change = NAN;
            r->quantity[q].status = STATUS_NO_VALUE;
            strcpy(r->quantity[q].reason, "not in the file");
        }
    }
    return 1;
}

static status fill(const scene *s, series *one, fault *f)
{
    TRY(find_meshes(one, one->imported, f));
    if (!make_cells(s, one))
        return fault_set(f, STATUS_FAULT, "out of memory for imported values");
    for (int i = 0; i < one->imported->rows; i++)
        if (!take_row(s, one, &one->imported->row[i]))
            return fault_set(f, STATUS_FAULT, "out of memory for imported values");
    return STATUS_OK;
}

/* Behind the last series of the point. */
static int place_of(const sweep *s, int point_index)
{
    int place = s->seriess;
    while (place > 0 && s->series[place - 1].point > point_index)
        place--;
    return place;
}

status import_cells_add(sweep *s, int point_index, imported *found, fault *f)
{
    series *more = realloc(s->series, (size_t)(s->seriess + 1) * sizeof *more);
    if (more == NULL) {
        imported_free(found);
        return fault_set(f, STATUS_FAULT, "out of memory for series");
    }
    s->series = more;
    const int place = place_of(s, point_index);
    memmove(&more[place + 1], &more[place], (size_t)(s->seriess - place) * sizeof *more);
    s->seriess++;
    series *one = &more[place];
    memset(one, 0, sizeof *one);
    found->type = (element_type){.name = found->program,
                                 .summary = "another program: its values were imported",
                                 .source = found->file,
                                 .abi = ELEMENT_ABI,
                                 .order = any_order};
    import_cells_order(found);
    one->point = point_index;
    one->imported = found;
    one->formulation.type = &found->type;
    memcpy(one->formulation.key, found->program, sizeof one->formulation.key);
    return fill(&s->point[point_index].scene, one, f);
}
