#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/library/call.h"
#include "harness/library/result_handle.h"
#include "harness/library/text.h"
#include "harness/records/records.h"

static status write_json(const bw_result *r, char **json, fault *f)
{
    document_text t;
    if (json != NULL)
        *json = NULL;
    if (r == NULL || json == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "bw_result_json: give a result and a place for the text");
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

/* -1: there is no such quantity. */
static int index_of(const bw_result *r, const char *name)
{
    for (int i = 0; name != NULL && i < bw_result_quantities(r); i++)
        if (strcmp(quantity_at(r, i)->name, name) == 0)
            return i;
    return -1;
}

/* What was found of it; NULL: nothing. */
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
