#include "harness/time/stages.h"

#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

/* Free coordinates that the mass of a coordinate couples it with, ascending; how many. */
static int coupled(const model *m, const int frame_of[], const double warping[], int c, int list[6])
{
    int count = 0;
    if (frame_of[c] == NONE) {
        list[0] = c;
        return warping[c] > 0;
    }
    for (int p = 0; p < 6; p++) {
        const int other = model_vertex(m, frame_of[c])->coordinate[p];
        if (other == NONE || other >= model_unknowns(m))
            continue;
        int at = count++;
        for (; at > 0 && list[at - 1] > other; at--)
            list[at] = list[at - 1];
        list[at] = other;
    }
    return count;
}

/* Columns of stage k after each other; returns the entries. NULL row: they are counted. */
static int fill(const equations *eq, const sparse *single, const int frame_of[],
                const carried_masses *masses, stages_matrix *out, int *row)
{
    const model *m = eq->m;
    const int n = out->n, full = model_releases(m) > 0 || eq->run->damping != NULL ||
                                 masses->spread; /* they couple nodes */
    const double *warping = masses->warping;
    int count = 0;
    for (int k = 0; k < STAGES; k++)
        for (int c = 0; c < n; c++) {
            int list[6];
            const int beside = coupled(m, frame_of, warping, c, list);
            if (row != NULL)
                out->whole.column[k * n + c] = count;
            for (int i = 0; i < STAGES; i++) {
                const int entries =
                    i == k || full ? single->column[c + 1] - single->column[c] : beside;
                const int *rows = i == k || full ? single->row + single->column[c] : list;
                if (row != NULL && i == k)
                    out->diagonal[k * n + c] = count;
                for (int e = 0; row != NULL && e < entries; e++)
                    row[count + e] = i * n + rows[e];
                count += entries;
            }
        }
    if (row != NULL)
        out->whole.column[STAGES * n] = count;
    return count;
}

static status make(const equations *eq, const carried_masses *masses, const sparse *single,
                   int frame_of[], stages_matrix *out, fault *f)
{
    const model *m = eq->m;
    for (int c = 0; c < model_unknowns(m); c++)
        frame_of[c] = NONE;
    for (int k = 0; k < masses->masses; k++)
        for (int p = 0; p < 6; p++) {
            const int c = model_vertex(m, masses->mass[k].frame)->coordinate[p];
            if (c != NONE && c < model_unknowns(m))
                frame_of[c] = masses->mass[k].frame;
        }
    const size_t count = (size_t)fill(eq, single, frame_of, masses, out, NULL),
                 columns = STAGES * (size_t)out->n;
    out->whole.n = STAGES * out->n;
    out->whole.column = malloc((columns + 1) * sizeof *out->whole.column);
    out->whole.row = malloc((count + 1) * sizeof *out->whole.row);
    out->whole.value = calloc(count + 1, sizeof *out->whole.value);
    out->diagonal = malloc((columns + 1) * sizeof *out->diagonal);
    if (out->whole.column == NULL || out->whole.row == NULL || out->whole.value == NULL ||
        out->diagonal == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the stages of a step");
    fill(eq, single, frame_of, masses, out, out->whole.row);
    return STATUS_OK;
}

status stages_alloc(const equations *eq, const carried_masses *masses, const sparse *single,
                    stages_matrix *out, fault *f)
{
    const model *m = eq->m;
    memset(out, 0, sizeof *out);
    out->n = model_unknowns(m);
    int *frame_of = malloc(((size_t)model_unknowns(m) + 1) * sizeof *frame_of);
    const status outcome = frame_of != NULL
                               ? make(eq, masses, single, frame_of, out, f)
                               : fault_set(f, STATUS_FAULT, "out of memory for stages");
    free(frame_of);
    return outcome;
}

void stages_free(stages_matrix *s)
{
    free(s->whole.column);
    free(s->whole.row);
    free(s->whole.value);
    free(s->diagonal);
}

void stages_zero(stages_matrix *s)
{
    sparse_zero(&s->whole);
}

void stages_put(stages_matrix *s, int stage, const sparse *K)
{
    for (int c = 0; c < s->n; c++) {
        const int first = K->column[c], count = K->column[c + 1] - first;
        memcpy(s->whole.value + s->diagonal[stage * s->n + c], K->value + first,
               (size_t)count * sizeof *K->value);
    }
}

void stages_add_element(stages_matrix *s, int i, int k, const mesh_pattern *p, int element,
                        const double K[])
{
    const mesh_layout *layout = &p->layout[p->layout_of[element]];
    const int *index = p->element[element].index, *begin = p->matrix.column;
    for (int e = 0; e < layout->entries; e++) {
        const mesh_entry *one = &layout->entry[e];
        const int c = index[one->column];
        s->whole
            .value[s->whole.column[k * s->n + c] + i * (begin[c + 1] - begin[c]) + one->offset] +=
            K[one->local];
    }
}

void stages_add(stages_matrix *s, int i, int k, int row, int column, double value)
{
    if (row < 0 || column < 0 || row >= s->n || column >= s->n)
        return;
    assemble_subtract(&s->whole, i * s->n + row, k * s->n + column, -value);
}
