#include "harness/study/cell.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/algebra/clock.h"

static status copy_left_out(const model *m, cell_result *out, fault *f)
{
    const char *const *lines;
    const int count = model_left_out(m, &lines);
    out->left_out = calloc((size_t)count + 1, sizeof *out->left_out);
    for (int i = 0; i < count && out->left_out != NULL; i++)
        if ((out->left_out[out->left_out_lines] = strdup(lines[i])) != NULL)
            out->left_out_lines++;
    return out->left_out_lines == count ? STATUS_OK : fault_set(f, STATUS_FAULT, "out of memory");
}

status cell_run(const cell_request *request, cell_result *out, fault *f)
{
    model *m = NULL;
    const double start = clock_processor_seconds();
    memset(out, 0, sizeof *out);
    scene_init(&out->scene, request->type->name);
    status outcome = request->type->build(request->parameter, &out->scene, f);
    if (outcome == STATUS_OK)
        outcome = scene_edit_apply(&out->scene, &request->edit, f);
    if (outcome == STATUS_OK)
        outcome = scene_validate(&out->scene, f);
    const model_request what = {&out->scene, request->formulation, request->option, request->elements, request->keep_all};
    if (outcome == STATUS_OK)
        outcome = model_alloc(&what, &m, f);
    if (outcome == STATUS_OK)
        outcome = model_set_threads(m, request->threads, f);
    if (outcome == STATUS_OK) {
        out->size = model_sizes(m);
        outcome = copy_left_out(m, out, f);
    }
    const double prepared = clock_processor_seconds() - start;
    if (outcome == STATUS_OK) {
        outcome = solve_scene(&out->scene, m, &request->solve, &out->solve, f);
        out->counters = *model_counters(m);
    }
    if (outcome != STATUS_OK && out->solve.status == STATUS_OK) {
        out->solve.status = outcome;
        snprintf(out->solve.reason, sizeof out->solve.reason, "%s", f != NULL ? f->text : "");
    }
    out->solve.seconds_setup += prepared;
    model_free(m);
    return outcome;
}

void cell_result_free(cell_result *r)
{
    for (int i = 0; i < r->left_out_lines; i++)
        free(r->left_out[i]);
    free(r->left_out);
    result_free(&r->solve);
    scene_free(&r->scene);
    memset(r, 0, sizeof *r);
}
