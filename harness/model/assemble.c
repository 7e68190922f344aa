/* Patterns, and where every entry of an element goes in them. */
#include "harness/model/assemble.h"

#include <stdlib.h>
#include <string.h>

#include "harness/model/model_impl.h"

static int compare(const void *a, const void *b)
{
    const long x = *(const long *)a, y = *(const long *)b;
    return (x > y) - (x < y);
}

/* Only conservative tangents are stored as a triangle: dead moments about fixed axes and some
 * formulations are not. */
static int is_symmetric(const model *m)
{
    int moments = 0, nonlinear = 0;
    for (int i = 0; i < m->scene->loads; i++)
        moments |= m->scene->load[i].kind == SCENE_MOMENT;
    for (int i = 0; i < m->scene->analyses; i++)
        nonlinear |= m->scene->analysis[i].kind == SCENE_STATIC ||
                     m->scene->analysis[i].kind == SCENE_CONTINUATION ||
                     m->scene->analysis[i].kind == SCENE_ROTATION;
    return !(nonlinear && (moments || (m->type->limits & LIMIT_UNSYMMETRIC_TANGENT)));
}

/* Is the pair stored, and at which row and column? */
static int stored(const mesh_pattern *p, int row, int column)
{
    return row >= 0 && column >= 0 && row < p->matrix.n && column < p->matrix.n &&
           (!p->matrix.symmetric || row <= column);
}

/* Keys column * n + row of all stored pairs, with repetitions; counts when key is NULL. */
static size_t collect(const model *m, const mesh_pattern *p, long *key)
{
    size_t count = 0;
    const long n = p->matrix.n;
    for (int i = 0; i < m->elements; i++)
        for (int a = 0; a < m->coordinates; a++)
            for (int b = 0; b < m->coordinates; b++)
                if (stored(p, m->element[i].index[a], m->element[i].index[b])) {
                    if (key != NULL)
                        key[count] = n * m->element[i].index[b] + m->element[i].index[a];
                    count++;
                }
    return count;
}

double *assemble_entry(sparse *a, int row, int column)
{
    int low = a->column[column], high = a->column[column + 1] - 1;
    while (low <= high) {
        const int middle = (low + high) / 2;
        if (a->row[middle] == row)
            return &a->value[middle];
        if (a->row[middle] < row)
            low = middle + 1;
        else
            high = middle - 1;
    }
    return NULL;
}

static status compress(const model *m, mesh_pattern *p, fault *f)
{
    const size_t all = collect(m, p, NULL);
    long *key = malloc((all > 0 ? all : 1) * sizeof *key);
    p->matrix.column = calloc((size_t)p->matrix.n + 1, sizeof *p->matrix.column);
    p->matrix.row = malloc((all > 0 ? all : 1) * sizeof *p->matrix.row);
    if (key == NULL || p->matrix.column == NULL || p->matrix.row == NULL) {
        free(key);
        return fault_set(f, STATUS_FAULT, "out of memory for a matrix of %d coordinates",
                         p->matrix.n);
    }
    collect(m, p, key);
    qsort(key, all, sizeof *key, compare);
    int entries = 0;
    for (size_t i = 0; i < all; i++) {
        if (i > 0 && key[i] == key[i - 1])
            continue;
        p->matrix.row[entries++] = (int)(key[i] % p->matrix.n);
        p->matrix.column[key[i] / p->matrix.n + 1] = entries;
    }
    for (int j = 0; j < p->matrix.n; j++)
        if (p->matrix.column[j + 1] < p->matrix.column[j])
            p->matrix.column[j + 1] = p->matrix.column[j];
    free(key);
    return STATUS_OK;
}

static status find_places(const model *m, mesh_pattern *p, fault *f)
{
    const size_t all = collect(m, p, NULL);
    p->start = malloc(((size_t)m->elements + 1) * sizeof *p->start);
    p->local = malloc((all > 0 ? all : 1) * sizeof *p->local);
    p->place = malloc((all > 0 ? all : 1) * sizeof *p->place);
    if (p->start == NULL || p->local == NULL || p->place == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a matrix of %d coordinates",
                         p->matrix.n);
    double base;
    sparse probe = p->matrix;
    probe.value = &base;
    int count = 0;
    for (int i = 0; i < m->elements; i++) {
        p->start[i] = count;
        for (int a = 0; a < m->coordinates; a++)
            for (int b = 0; b < m->coordinates; b++)
                if (stored(p, m->element[i].index[a], m->element[i].index[b])) {
                    int low = probe.column[m->element[i].index[b]];
                    while (probe.row[low] != m->element[i].index[a])
                        low++;
                    p->local[count] = a * m->coordinates + b;
                    p->place[count++] = low;
                }
    }
    p->start[m->elements] = count;
    return STATUS_OK;
}

void assemble_pattern_free(mesh_pattern *p)
{
    free(p->matrix.column);
    free(p->matrix.row);
    free(p->start);
    free(p->local);
    free(p->place);
    memset(p, 0, sizeof *p);
}

status model_pattern(model *m, int with_driven, const sparse **out, fault *f)
{
    mesh_pattern *p = &m->pattern[with_driven];
    *out = &p->matrix;
    if (p->made)
        return STATUS_OK;
    p->matrix.n = with_driven ? m->free + m->driven : m->free;
    p->matrix.symmetric = is_symmetric(m);
    status outcome = compress(m, p, f);
    if (outcome == STATUS_OK)
        outcome = find_places(m, p, f);
    p->made = outcome == STATUS_OK;
    if (!p->made)
        assemble_pattern_free(p); /* the next analysis tries again */
    return outcome;
}

void assemble_matrix(const mesh_pattern *p, int element, const double K[], sparse *out)
{
    for (int i = p->start[element]; i < p->start[element + 1]; i++)
        out->value[p->place[i]] += K[p->local[i]];
}

void assemble_vector(const mesh_element *el, int coordinates, const double local[], double out[])
{
    for (int i = 0; i < coordinates; i++)
        if (el->index[i] != NONE)
            out[el->index[i]] += local[i];
}
