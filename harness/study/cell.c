#include "harness/study/cell.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/newton/newton.h"
#include "harness/numerics/numerics.h"

static status copy_left_out(const model *m, cell_result *out, fault *f)
{
    const char *const *lines;
    const int count = model_left_out(m, &lines);
    out->left_out = calloc((size_t)count + 1, sizeof *out->left_out);
    if (out->left_out != NULL)
        for (int i = 0; i < count; i++)
            if ((out->left_out[out->left_out_lines] = strdup(lines[i])) != NULL)
                out->left_out_lines++;
    return out->left_out_lines == count ? STATUS_OK : fault_set(f, STATUS_FAULT, "out of memory");
}

status cell_scene(const case_type *type, const double parameter[], const scene_edit *edit,
                  scene *out, fault *f)
{
    scene_init(out, type->name);
    TRY(case_build(type, parameter, out, f));
    if (edit != NULL)
        TRY(scene_edit_apply(out, edit, f));
    return scene_validate(out, f);
}

static status set_up(const cell_request *request, const scene *s, model **m, cell_result *out,
                     fault *f)
{
    const model_request what = {s,
                                request->formulation,
                                request->option,
                                request->elements,
                                request->keep_all,
                                request->omit};
    TRY(model_alloc(&what, m, f));
    out->size = model_sizes(*m);
    return copy_left_out(*m, out, f);
}

/* The scene of the request, or one of its own, which stays in the result. */
static status scene_of(const cell_request *request, const scene **s, cell_result *out, fault *f)
{
    *s = request->scene;
    if (*s != NULL)
        return STATUS_OK;
    *s = &out->scene;
    return cell_scene(request->type, request->parameter, &request->edit, &out->scene, f);
}

static status run(const cell_request *request, model **m, cell_result *out, fault *f)
{
    const scene *s;
    TRY(scene_of(request, &s, out, f));
    const double start = clock_processor_seconds();
    const status ready = set_up(request, s, m, out, f);
    const double prepared = clock_processor_seconds() - start;
    out->solve.seconds_setup = prepared;
    TRY(ready);
    if (request->is_known != NULL && request->is_known(request->context, *m))
        return STATUS_OK;
    solve_options options = request->solve;
    options.threads = request->threads;
    const status outcome = solve_scene(s, *m, &options, &out->solve, f);
    out->solve.seconds_setup += prepared;
    out->counters = out->solve.counters;
    return outcome;
}

void cell_formulation(cell_request *request, const formulation *chosen)
{
    request->formulation = chosen->type;
    memcpy(request->option, chosen->option, sizeof request->option);
    request->solve.newton = formulation_newton(chosen);
}

/* Whatever came of it. */
static status nothing_counts(const char *trouble, solve_result *out, fault *f)
{
    out->status = STATUS_NOT_CONVERGED;
    snprintf(out->reason, sizeof out->reason, "%s", trouble);
    for (int i = 0; i < out->quantities; i++)
        quantity_no_value(&out->quantity[i], out->status, trouble);
    return fault_set(f, out->status, "%s", trouble);
}

status cell_run(const cell_request *request, cell_result *out, fault *f)
{
    model *m = NULL;
    memset(out, 0, sizeof *out);
    status outcome = run(request, &m, out, f);
    const char *trouble = m != NULL ? model_trouble(m) : NULL;
    if (trouble != NULL)
        outcome = nothing_counts(trouble, &out->solve, f);
    if (outcome != STATUS_OK && out->solve.status == STATUS_OK) {
        out->solve.status = outcome;
        snprintf(out->solve.reason, sizeof out->solve.reason, "%s", f != NULL ? f->text : "");
    }
    model_free(m);
    return outcome;
}

int cell_values(const cell_result *r)
{
    int count = 0;
    for (int i = 0; i < r->solve.quantities; i++)
        count += r->solve.quantity[i].status == STATUS_OK;
    return count;
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
