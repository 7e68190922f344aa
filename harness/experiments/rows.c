#include "harness/experiments/rows.h"

#include <stdlib.h>

/* Cuts the piece into columns, the widest numbers first; its size [bytes]. */
static size_t lay_out(rows *r)
{
    const size_t points = (size_t)r->points, f = (size_t)r->shape.formulations,
                 m = (size_t)r->shape.meshes, q = (size_t)r->shape.quantities;
    const size_t known = points * q, cells = points * f * m, values = cells * q,
                 leasts = points * f * q, models = points * f;
    double *at = r->first;
    double **const column[] = {&r->reference, &r->doubt, &r->value,
                               &r->error,     &r->cost,  &r->seconds};
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
        return fault_set(f, STATUS_FAULT, "out of memory for the results of a sweep");
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

size_t rows_cell(const rows *r, int point, int contestant, int mesh)
{
    return ((size_t)point * (size_t)r->shape.formulations + (size_t)contestant) *
               (size_t)r->shape.meshes +
           (size_t)mesh;
}

size_t rows_value(const rows *r, int point, int contestant, int mesh, int quantity)
{
    return rows_cell(r, point, contestant, mesh) * (size_t)r->shape.quantities + (size_t)quantity;
}

size_t rows_lacks(const rows *r, int point, int contestant)
{
    return (size_t)point * (size_t)r->shape.formulations + (size_t)contestant;
}

size_t rows_least(const rows *r, int point, int contestant, int quantity)
{
    return ((size_t)point * (size_t)r->shape.formulations + (size_t)contestant) *
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
