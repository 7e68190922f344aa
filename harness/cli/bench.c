/* Error against run time: every formulation and mesh of a case, one process bound to one processor. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/run/clock.h"
#include "harness/run/output.h"
#include "harness/run/registry.h"
#include "harness/run/sweep.h"
#include "harness/run/verdict.h"

static const double levels[] = {0.1, 0.01, 0.001, 0.0001};
enum { LEVELS = sizeof levels / sizeof levels[0], MOST_MESHES = 24 };
static const double floor_seconds = 0.05;

/* The cheapest cell within a level, from which on every finer mesh stays within it. */
typedef struct champion {
    char key[CELL_KEY];
    int n;
    double seconds;
} champion;

typedef struct lap {
    int n;
    double seconds, error; /* error of the first judged quantity */
} lap;

static const truth *first_truth(const truths *t, const point *p, int *quantity)
{
    for (*quantity = 0; *quantity < p->scene.quantities; (*quantity)++) {
        const truth *row = truth_of(t, p->type, p->parameter, p->scene.quantity[*quantity].name, "same");
        if (row != NULL)
            return row;
    }
    return NULL;
}

static void heading(FILE *to)
{
    fprintf(to, "case,parameters,formulation,elements,free,quantity,error,seconds_setup,seconds_solve,spread,repeats,iterations,"
                "strain_evaluations,stress_evaluations,factorisations,factor_entries,factor_flops,status\n");
}

static void row(FILE *to, const point *p, const series *one, int n, const char *quantity, double error, const clock_reading *c,
                const cell_result *cell)
{
    const counters *k = &cell->counters;
    fprintf(to, "%s,\"%s\",\"%s\",%d,%d,%s,", p->type->name, p->text, one->formulation.key, n, cell->size.free, quantity);
    if (isfinite(error))
        fprintf(to, "%.6e", error);
    fprintf(to, ",%.6e,%.6e,%.3f,%d,%ld,%ld,%ld,%ld,%ld,%.6e,%s\n", c->setup, c->solve, c->spread, c->repeats, k->iterations,
            k->strain_evaluations, k->stress_evaluations, k->factorisations, k->factor_entries, k->factor_flops,
            status_name(cell->solve.status));
}

static void crown(champion best[LEVELS], const char *key, int count, const lap laps[])
{
    for (int level = 0; level < LEVELS; level++)
        for (int i = 0; i < count; i++) {
            int within = 1;
            for (int k = i; k < count; k++)
                within &= fabs(laps[k].error) <= levels[level]; /* NAN is not */
            if (!within || (best[level].n > 0 && laps[i].seconds >= best[level].seconds))
                continue;
            snprintf(best[level].key, sizeof best[level].key, "%s", key);
            best[level].n = laps[i].n;
            best[level].seconds = laps[i].seconds;
        }
}

static status bench_series(const sweep *s, const series *one, const truth *t, int quantity, champion best[LEVELS], FILE *csv,
                           fault *f)
{
    const point *p = &s->point[one->point];
    lap laps[MOST_MESHES];
    int count = 0;
    for (int i = 0; i < one->meshes && count < MOST_MESHES; i++) {
        cell_request request = {.type = p->type, .formulation = one->formulation.type, .elements = one->mesh[i]};
        clock_reading c;
        cell_result cell;
        memcpy(request.parameter, p->parameter, sizeof request.parameter);
        memcpy(request.option, one->formulation.option, sizeof request.option);
        request.solve.newton = one->formulation.newton;
        const status outcome = clock_cell(&request, floor_seconds, &c, &cell, f);
        const int has = t != NULL && quantity < cell.solve.quantities;
        const double error =
            has ? relative_error(&p->scene.quantity[quantity], cell.solve.quantity[quantity].value, t->value) : NAN;
        laps[count++] = (lap){one->mesh[i], c.setup + c.solve, error};
        printf("  %-28s %5d %8d %10ld %11.4g ms %6.0f%%", one->formulation.key, one->mesh[i], cell.size.free,
               cell.counters.iterations, 1e3 * (c.setup + c.solve), 100 * c.spread);
        if (isfinite(error))
            printf("  %+.3e\n", error);
        else
            printf("  %s\n", cell.solve.reason[0] != '\0' ? cell.solve.reason : "-");
        fflush(stdout);
        if (csv != NULL)
            row(csv, p, one, one->mesh[i], t != NULL ? p->scene.quantity[quantity].name : "", error, &c, &cell);
        cell_result_free(&cell);
        if (outcome == STATUS_FAULT)
            return outcome;
    }
    crown(best, one->formulation.key, count, laps);
    return STATUS_OK;
}

static status bench_point(const sweep *s, const truths *t, FILE *csv, fault *f)
{
    const point *p = &s->point[0];
    champion best[LEVELS] = {{"", 0, 0}};
    int quantity = 0;
    const truth *row_of = first_truth(t, p, &quantity);
    printf("\n%s%s%s: %s\n", p->type->name, p->text[0] != '\0' ? " " : "", p->text,
           row_of != NULL ? p->scene.quantity[quantity].name : "no truth");
    printf("  %-28s %5s %8s %10s %14s %7s  %s\n", "formulation", "n", "unknowns", "iterations", "least time", "spread", "error");
    for (int i = 0; i < s->seriess; i++) {
        const status outcome =
            s->series[i].missing[0] == '\0' ? bench_series(s, &s->series[i], row_of, quantity, best, csv, f) : STATUS_OK;
        if (outcome != STATUS_OK)
            return outcome;
    }
    for (int level = 0; level < LEVELS; level++) {
        printf("  cheapest within %g %%: ", 100 * levels[level]);
        if (best[level].n > 0)
            printf("%s, n = %d, %.4g ms\n", best[level].key, best[level].n, 1e3 * best[level].seconds);
        else
            printf("none\n");
    }
    return STATUS_OK;
}

static status bench_case(const case_type *type, const cli_request *r, const double value[], const truths *t, FILE *csv, fault *f)
{
    formulation all[CLI_MAX_FORMULATIONS];
    int count = 0;
    sweep s;
    for (int i = 0; r->formulations == 0 && registry_formulations[i] != NULL && count < CLI_MAX_FORMULATIONS; i++)
        formulation_default(registry_formulations[i], &all[count++]);
    status outcome = sweep_plan_one(type, value, r->formulations > 0 ? r->formulation : all,
                                    r->formulations > 0 ? r->formulations : count, r->mesh, r->meshes, &s, f);
    if (outcome != STATUS_OK)
        return outcome;
    outcome = bench_point(&s, t, csv, f);
    sweep_free(&s);
    return outcome;
}

static status bench_all(cli_request *r, const case_type *only, const truths *t, FILE *csv, fault *f)
{
    status outcome = STATUS_OK;
    if (only != NULL)
        return bench_case(only, r, r->parameter, t, csv, f);
    for (int i = 0; registry_cases[i] != NULL && outcome == STATUS_OK; i++) {
        parameters_default(registry_cases[i], r->parameter);
        outcome = bench_case(registry_cases[i], r, r->parameter, t, csv, f);
    }
    return outcome;
}

int cli_bench(int count, char **arguments)
{
    cli_request r;
    truths t;
    output file = {0};
    fault f = {""};
    cli_parse("bench", "[CASE]",
              "Times every formulation and mesh of a case (or of all cases): least of enough repetitions, one processor, set-up "
              "and solution, with the error of the "
              "first quantity that has a truth.",
              "fnsoT", count, arguments, &r);
    const case_type *type = r.case_name != NULL ? cli_case(&r) : NULL;
    if (r.case_name != NULL && type == NULL)
        return EXIT_REFUSED;
    status outcome = truths_read(cli_truths_path(&r), &t, &f);
    if (outcome != STATUS_OK)
        return cli_fail(outcome, f.text);
    if (r.output != NULL)
        outcome = output_open(r.output, &file, &f);
    if (outcome == STATUS_OK) {
        clock_pin();
        if (file.stream != NULL)
            heading(file.stream);
        outcome = bench_all(&r, type, &t, file.stream, &f);
    }
    if (file.stream != NULL && outcome == STATUS_OK)
        outcome = output_close(&file, &f);
    else if (file.stream != NULL)
        output_discard(&file);
    truths_free(&t);
    return outcome == STATUS_OK ? EXIT_AS_EXPECTED : cli_fail(outcome, f.text);
}
