#include "harness/experiments/known.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/write.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/study/study.h"

/* Rows of the request that hold at the point: few of many, which every quantity looks through. */
static status borrow(const truths *all, const sweep_point *p, known_truths *out, fault *f)
{
    out->borrowed = 1;
    out->stored.row = calloc((size_t)all->rows + 1, sizeof *out->stored.row);
    if (out->stored.row == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for truths");
    for (int i = 0; i < all->rows; i++)
        if (truth_holds(&all->row[i], p->type, p->parameter))
            out->stored.row[out->stored.rows++] = all->row[i];
    return STATUS_OK;
}

static status find_stored(const parameter_ranges *r, const sweep_point *p, known_truths *out,
                          fault *f)
{
    const ranges_request *q = &r->request;
    fault why;
    if (q->file == NULL)
        return q->truths != NULL ? borrow(q->truths, p, out, f) : STATUS_OK;
    if (!scene_file_states(q->file, "truths"))
        return STATUS_OK;
    if (scene_truths_add(q->file, p->parameter, &out->stored, &why) == STATUS_OK)
        return STATUS_OK;
    truths_free(&out->stored); /* expressions that have no value here */
    out->stored = (truths){0};
    return STATUS_OK;
}

/* Of loads at which it buckles, the theory of shear that the scene follows. */
static const char *theory_of(const scene *s, const char *quantity)
{
    const unsigned both = FEATURE_ENGESSER | FEATURE_HARINGX, needs = features_needed(s) & both;
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, quantity) == 0 &&
            s->quantity[i].what.kind != SCENE_CRITICAL_FACTOR)
            return "";
    if (needs == FEATURE_ENGESSER)
        return "engesser";
    return needs == FEATURE_HARINGX ? "haringx" : "";
}

static status add_row(const sweep_point *p, const derived_value *v, truths *t, fault *f)
{
    truth *row = &t->row[t->rows++];
    *row = (truth){.type = p->type,
                   .value = v->value,
                   .uncertainty = v->uncertainty,
                   .at = NAN,
                   .met = 1,
                   .judged = 1,
                   .formulation = strdup(""),
                   .theory = strdup(theory_of(&p->scene, v->quantity)),
                   .quantity = strdup(v->quantity),
                   .unit = strdup(v->unit),
                   .kind = strdup("exact"),
                   .model = strdup("same"),
                   .convention = strdup(v->convention),
                   .source = strdup(v->source)};
    memcpy(row->parameter, p->parameter, sizeof row->parameter);
    return row->formulation != NULL && row->theory != NULL && row->quantity != NULL &&
                   row->unit != NULL && row->kind != NULL && row->model != NULL &&
                   row->convention != NULL && row->source != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for truths");
}

static status ask_scene(const char *script, const sweep_point *p, derived_value **value, int *count,
                        fault *f)
{
    FILE *text = tmpfile();
    const write_head head = {p->type->name, p->type->summary, p->type->source};
    if (text == NULL)
        return fault_set(f, STATUS_FAULT, "no temporary file for the scene");
    status outcome = write_scene(text, &p->scene, &head, f);
    if (outcome == STATUS_OK)
        outcome = derive_scene(script, text, value, count, f);
    fclose(text);
    return outcome;
}

static status derive(const parameter_ranges *r, const sweep_point *p, known_truths *out, fault *f)
{
    derived_value *value = NULL;
    int count = 0;
    char text[PARAMETERS_TEXT];
    fault why;
    parameters_source_text(p->type, p->parameter, text, sizeof text);
    if (case_omits_nothing(p->type, p->parameter))
        return STATUS_OK; /* derived is what the source has */
    const status outcome =
        r->request.file != NULL
            ? ask_scene(r->request.derive, p, &value, &count, &why)
            : derive_values(r->request.derive, p->type->name, text, &value, &count, &why);
    if (outcome != STATUS_OK)
        return STATUS_OK;
    out->derived.row = calloc((size_t)count + 1, sizeof *out->derived.row);
    status added = out->derived.row != NULL
                       ? STATUS_OK
                       : fault_set(f, STATUS_FAULT, "out of memory for truths");
    for (int i = 0; i < count && added == STATUS_OK; i++)
        added = add_row(p, &value[i], &out->derived, f);
    free(value);
    return added;
}

/* Has every quantity that is asked for one of the same model? */
static int all_stored(const parameter_ranges *r, const sweep_point *p, const truths *t)
{
    for (int i = 0; i < r->quantities; i++)
        if (truth_of(t, p->type, p->parameter, r->quantity[i].name, "same") == NULL)
            return 0;
    return 1;
}

status known_at(const parameter_ranges *r, const sweep_point *p, known_truths *out, fault *f)
{
    memset(out, 0, sizeof *out);
    status outcome = find_stored(r, p, out, f);
    if (outcome == STATUS_OK && r->request.derive != NULL && !all_stored(r, p, &out->stored))
        outcome = derive(r, p, out, f);
    if (outcome != STATUS_OK)
        known_free(out);
    return outcome;
}

void known_free(known_truths *k)
{
    if (k->borrowed)
        free(k->stored.row);
    else
        truths_free(&k->stored);
    truths_free(&k->derived);
    memset(k, 0, sizeof *k);
}
