#include "harness/newton/rows.h"

#include <math.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/equations_impl.h"

static void put(const model *m, int row, const row_label *label, row_label out[])
{
    if (row >= 0 && row < model_unknowns(m) && out[row].component == NULL)
        out[row] = *label;
}

/* Names of a vertex' six coordinates. */
static const char *component_of(const model *m, int vertex, int c)
{
    static const char *const plain[] = {"ux", "uy", "uz", "rx", "ry", "rz"},
                             *const angle[] = {"angle 1", "angle 2", "angle 3"},
                             *const kept[] = {"shift 1", "shift 2", "shift 3",
                                              "turn 1",  "turn 2",  "turn 3"};
    if (release_of(m, vertex) != NULL)
        return kept[c];
    return c >= SCENE_RX && model_vertex(m, vertex)->angles > 0 ? angle[c - SCENE_RX] : plain[c];
}

/* The coordinates of a vertex; label: where it is. */
static void put_vertex(const model *m, int vertex, row_label label, row_label out[])
{
    const mesh_vertex *v = model_vertex(m, vertex);
    if (v->body != vertex && release_of(m, vertex) == NULL)
        return;
    for (int c = 0; c < VERTEX_COORDINATES; c++) {
        label.component = component_of(m, vertex, c);
        label.unit = c < SCENE_RX ? "m" : "rad";
        put(m, v->coordinate[c], &label, out);
    }
}

static void put_element(const model *m, const mesh_element *el, row_label out[])
{
    const int number = (int)(el - model_element(m, model_first_element(m, el->member)));
    for (int k = 0; k < el->nodes; k++) {
        const int vertex = el->vertex[k], is_node = vertex < model_scene(m)->nodes;
        const double at =
            division_place(model_division(m), el->member, number, (double)k / (el->nodes - 1));
        row_label label = {
            .node = is_node ? vertex : SCENE_NONE, .member = el->member, .along = at};
        memcpy(label.position, model_vertex(m, vertex)->position, sizeof label.position);
        if (!is_node)
            put_vertex(m, vertex, label, out);
        if (el->warp[k] == NONE)
            continue;
        label.component = "warping";
        label.unit = "rad/m";
        put(m, model_warp(m, el->warp[k]), &label, out);
    }
}

void rows_label(const model *m, row_label out[])
{
    memset(out, 0, (size_t)model_unknowns(m) * sizeof *out);
    for (int i = 0; i < model_scene(m)->nodes; i++) {
        row_label label = {.node = i, .member = SCENE_NONE, .along = NAN};
        memcpy(label.position, model_vertex(m, i)->position, sizeof label.position);
        put_vertex(m, i, label, out);
    }
    for (int i = 0; i < model_elements(m); i++)
        put_element(m, model_element(m, i), out);
}
