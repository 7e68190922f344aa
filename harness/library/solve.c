#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/experiments.h"
#include "harness/library/call.h"
#include "harness/library/options.h"
#include "harness/library/result_handle.h"
#include "harness/numerics/numerics.h"
#include "harness/study/study.h"

enum { STEPS_MOST = 1000000 };

static status read_options(const char *json, solution_request *out, fault *f)
{
    const call_option table[] = {{"keep_all", OPTION_SWITCH, &out->keep_all, 0, 1},
                                 {"steps", OPTION_WHOLE, &out->steps, 1, STEPS_MOST},
                                 {"shapes", OPTION_WHOLE, &out->shapes, 0, SHAPES_ALL},
                                 {"threads", OPTION_WHOLE, &out->threads, 1, TEAM_MOST},
                                 {"error", OPTION_SHARE, &out->error, 0, 0},
                                 {.name = NULL}};
    json_t *kept;
    const status outcome = options_read(json, table, &kept, f);
    json_decref(kept);
    return outcome;
}

/* The truths of the result; there need not be any for a case. */
static status know(bw_result *r, const double parameter[], fault *f)
{
    const scene_file *file = source_file(r->from);
    if (file != NULL) {
        r->truths = &r->own;
        return scene_truths_add(file, parameter, &r->own, f);
    }
    source_known(r->from, &r->truths, NULL);
    return STATUS_OK;
}

/* Formulation and elements, given or chosen. */
static status choose(const bw_result *r, const char *name, solution_request *out,
                     solution_choice *why, fault *f)
{
    const truths *ledger = NULL;
    if (name != NULL)
        TRY(formulation_parse(name, &out->formulation, f));
    else
        source_known(r->from, &ledger, NULL);
    return solution_choose(out, ledger != NULL ? ledger->rule : NULL,
                           ledger != NULL ? ledger->rules : 0, 1, why, f);
}

static double error_of(const subject *s)
{
    const quantity_result *found = s->record;
    return s->truth != NULL
               ? verdict_error(&s->point->scene.quantity[s->index], found->value, s->truth->value)
               : NAN;
}

/* Errors as the record of a quantity has them. */
static status compare(bw_result *r, fault *f)
{
    const gathering g = {&r->sweep, NULL, r->truths};
    const int count = result_handle_scene(r)->quantities;
    subjects list = {0};
    r->error = malloc(((size_t)count + 1) * sizeof *r->error);
    if (r->error == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for errors");
    for (int i = 0; i < count; i++)
        r->error[i] = NAN;
    gather_mesh(&g, &record_quantity, 0, 0, &list);
    for (int i = 0; i < list.count; i++)
        r->error[list.row[i].index] = error_of(&list.row[i]);
    const int bad = list.bad;
    gather_free(&list);
    return bad ? fault_set(f, STATUS_FAULT, "out of memory for errors") : STATUS_OK;
}

/* *solved: how the solution ended, in f too. */
static status fill(bw_result *r, const bw_scene *from, const char *name, solution_request *what,
                   solution_choice *why, status *solved, fault *f)
{
    fault lost = {""};
    TRY(know(r, from->parameter, f));
    TRY(choose(r, name, what, why, f));
    TRY(solution_plan(what, &r->sweep, f));
    *solved = solution_run(what, why, &r->sweep, f);
    if (*solved == STATUS_REFUSED || *solved == STATUS_FAULT)
        return *solved;
    const status compared = compare(r, &lost);
    if (compared != STATUS_OK)
        *f = lost;
    return compared;
}

static status solve(const bw_scene *from, const char *name, int elements, const char *options,
                    bw_result **out, fault *f)
{
    status solved = STATUS_OK;
    if (out != NULL)
        *out = NULL;
    if (from == NULL || out == NULL)
        return fault_set(f, STATUS_REFUSED, "bw_solve: give a scene and a place for the result");
    if (elements < 0 || elements > MESHES_FINEST)
        return fault_set(f, STATUS_REFUSED,
                         "number of elements %d: give a whole number from 1 to %d, or 0: chosen",
                         elements, MESHES_FINEST);
    solution_request what = {
        .type = source_case(from->from), .parameter = from->parameter, .elements = elements};
    TRY(read_options(options, &what, f));
    bw_result *r = calloc(1, sizeof *r);
    if (r == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a result");
    r->from = source_hold(from->from);
    solution_choice why = {.formulation = ""};
    const status filled = fill(r, from, name, &what, &why, &solved, f);
    solution_choice_free(&why);
    if (filled == STATUS_OK)
        *out = r;
    else
        bw_result_free(r);
    return filled == STATUS_OK ? solved : filled;
}

bw_status bw_solve(const bw_scene *from, const char *name, int elements, const char *options,
                   bw_result **out, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, solve(from, name, elements, options, out, &c.fault));
}

void bw_result_free(bw_result *r)
{
    if (r == NULL)
        return;
    sweep_free(&r->sweep);
    truths_free(&r->own);
    source_release(r->from);
    free(r->error);
    for (int i = 0; i < RESULT_COLUMNS; i++) {
        free(r->step[i]);
        free(r->motion[i]);
    }
    free(r->position);
    free(r);
}
