#include "harness/experiments/convergence.h"

#include <string.h>

#include "harness/records/records.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

static status plan(const void *asked, void *found, fault *f)
{
    const convergence_request *r = asked;
    convergence *c = found;
    c->level = r->level;
    c->verbose = r->verbose;
    TRY(plan_one(r->type, r->parameter, r->cells.formulation, r->cells.formulations, r->mesh,
                 r->meshes, &c->sweep, f));
    c->made = environment_now(r->cells.jobs);
    return narrow_to(&c->sweep, r->cells.select, f);
}

static status run(const void *asked, void *found, fault *f)
{
    const convergence_request *r = asked;
    convergence *c = found;
    return run_sweep(&r->cells, &c->sweep, f);
}

static status judge(const void *asked, void *found, fault *f)
{
    convergence *c = found;
    (void)asked;
    TRY(families_add_truths(&c->sweep, 0, &c->truths, f));
    return judgement_make(&c->sweep, &c->truths, 0, &c->judgement, f);
}

/* How many of the formulations run. */
static int running(const sweep *s)
{
    int count = 0;
    for (int i = 0; i < s->seriess; i++)
        count += s->series[i].missing[0] == '\0';
    return count;
}

/* What it comes to, in lines of words. */
static void write_answer(FILE *to, double level, const sweep *s, const truths *t)
{
    paragraph words;
    reach_line_write(paragraph_begin(&words, to), s, t, level);
    paragraph_end(&words, 0, 0);
}

static void write_text(FILE *to, const convergence *c)
{
    if (c->verbose || running(&c->sweep) == 1) {
        table_convergence(to, &c->sweep, &c->truths);
        fputc('\n', to);
    } else if (running(&c->sweep) > 1)
        table_beside(to, &c->sweep, &c->truths);
    write_answer(to, c->level, &c->sweep, &c->truths);
}

static status write_form(FILE *to, const char *format, const void *found, fault *f)
{
    const convergence *c = found;
    if (strcmp(format, "json") == 0)
        return json_convergence_write(to, &c->sweep, &c->truths, c->level, f);
    if (strcmp(format, "csv") == 0)
        csv_convergence(to, &c->sweep, &c->truths);
    else
        write_text(to, c);
    return STATUS_OK;
}

static experiment_cells cells(const void *found)
{
    const convergence *c = found;
    return (experiment_cells){&c->sweep, &c->judgement, &c->made};
}

void convergence_free(convergence *c)
{
    judgement_free(&c->judgement);
    sweep_free(&c->sweep);
    truths_free(&c->truths);
}

const experiment_type experiment_converge = {.name = "converge",
                                             .plan = plan,
                                             .run = run,
                                             .judge = judge,
                                             .cells = cells,
                                             .write = write_form};
