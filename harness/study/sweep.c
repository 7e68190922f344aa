#include "harness/study/sweep.h"

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"

#include <stdlib.h>
#include <string.h>

/* Does the quantity depend on what the formulation's options change? */
static int option_matters(const sweep_point *p, const formulation *chosen, const char *quantity)
{
    const unsigned features = formulation_bears_on(chosen);
    if (features != 0)
        for (int q = 0; q < p->scene.quantities; q++)
            if (strcmp(p->scene.quantity[q].name, quantity) == 0)
                return (features & features_needed_by_quantity(&p->scene, q)) != 0;
    return 1;
}

void sweep_text(const sweep_point *p, const formulation *chosen, const char *quantity,
                char text[SWEEP_TEXT])
{
    snprintf(text, SWEEP_TEXT, "%s/%s/%s/%s", p->type->name,
             p->text[0] != '\0' ? p->text : "default", chosen->key, quantity);
}

int sweep_selects(const sweep *s, const sweep_point *p, const formulation *chosen,
                  const char *quantity)
{
    if (!option_matters(p, chosen, quantity))
        return 0;
    char text[SWEEP_TEXT];
    sweep_text(p, chosen, quantity, text);
    return s->select == NULL || select_matches(s->select, text) > 0;
}

int sweep_gates(const sweep *s, const series *one)
{
    const element_type *type = one->formulation.type;
    if (one->imported != NULL)
        return one->imported->gates;
    return s->named || formulations_is_loaded(type) || !formulations_is_new(type);
}

int sweep_cells(const sweep *s)
{
    int cells = 0;
    for (int i = 0; i < s->seriess; i++)
        cells += s->series[i].missing[0] == '\0' && s->series[i].imported == NULL &&
                         s->point[s->series[i].point].status == STATUS_OK
                     ? s->series[i].meshes
                     : 0;
    return cells;
}

void sweep_series_free(series *one)
{
    if (one->cell != NULL)
        for (int k = 0; k < one->meshes; k++)
            cell_result_free(&one->cell[k]);
    free(one->cell);
    free(one->noise);
    free(one->timing);
    imported_free(one->imported);
}

void sweep_free(sweep *s)
{
    for (int i = 0; i < s->seriess; i++)
        sweep_series_free(&s->series[i]);
    for (int i = 0; i < s->points; i++)
        scene_free(&s->point[i].scene);
    free(s->point);
    free(s->series);
    memset(s, 0, sizeof *s);
}

cell_request sweep_cell(const sweep *s, int series_index, int mesh)
{
    const series *one = &s->series[series_index];
    const sweep_point *p = &s->point[one->point];
    cell_request out = {.scene = &p->scene, .elements = one->mesh[mesh]};
    cell_formulation(&out, &one->formulation);
    out.solve.steps_between = p->steps;
    out.solve.condition = p->condition;
    out.solve.values_only = s->values_only;
    out.solve.whole_steps = p->whole_steps;
    out.solve.shapes = p->shapes;
    out.threads = s->threads;
    if (p->shapes == 0 && p->text[0] == '\0' && mesh == one->meshes - 1)
        out.solve.shapes = s->shapes;
    return out;
}
