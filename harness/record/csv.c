#include "harness/record/csv.h"

#include <math.h>

void csv_field(FILE *to, const char *text, const char *end)
{
    fputc('"', to);
    for (; *text != '\0'; text++) {
        if (*text == '"')
            fputc('"', to);
        fputc(*text, to);
    }
    fprintf(to, "\"%s", end);
}

void csv_solution(FILE *to, const sweep *s)
{
    const series *one = &s->series[0];
    const point *p = &s->point[one->point];
    const cell_result *c = &one->cell[0];
    fprintf(to, "case,parameters,formulation,elements,quantity,unit,value,moments,status,reason\n");
    for (int i = 0; i < c->solve.quantities; i++) {
        const quantity_result *v = &c->solve.quantity[i];
        fprintf(to, "%s,", p->type->name);
        csv_field(to, p->text, ",");
        csv_field(to, one->formulation.key, ",");
        fprintf(to, "%d,%s,%s,", one->mesh[0], p->scene.quantity[i].name, p->scene.quantity[i].unit);
        if (isfinite(v->value))
            fprintf(to, "%.17g", v->value);
        const char *convention = scene_convention(&p->scene, &p->scene.quantity[i]);
        fprintf(to, ",%s,%s,", convention != NULL ? convention : "", status_name(v->status));
        csv_field(to, v->reason, "\n");
    }
}

void csv_convergence(FILE *to, const sweep *s, const truths *t)
{
    fprintf(to, "case,parameters,formulation,elements,quantity,unit,value,truth,error,free,seconds_setup,seconds_solve\n");
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const point *p = &s->point[one->point];
        for (int k = 0; k < one->meshes && one->missing[0] == '\0'; k++)
            for (int q = 0; q < p->scene.quantities && q < one->cell[k].solve.quantities; q++) {
                const double value = one->cell[k].solve.quantity[q].value;
                const truth *row = truth_of(t, p->type, p->parameter, p->scene.quantity[q].name, "same");
                fprintf(to, "%s,", p->type->name);
                csv_field(to, p->text, ",");
                csv_field(to, one->formulation.key, ",");
                fprintf(to, "%d,%s,%s,", one->mesh[k], p->scene.quantity[q].name, p->scene.quantity[q].unit);
                if (isfinite(value))
                    fprintf(to, "%.17g", value);
                if (row != NULL)
                    fprintf(to, ",%.17g,%.17g,", row->value, relative_error(&p->scene.quantity[q], value, row->value));
                else
                    fprintf(to, ",,,");
                fprintf(to, "%d,%.6g,%.6g\n", one->cell[k].size.free, one->cell[k].solve.seconds_setup,
                        one->cell[k].solve.seconds_solve);
            }
    }
}

static void timing_of(FILE *to, const sweep *s, const verdict *v, int mesh)
{
    const series *one = &s->series[v->series];
    const point *p = &s->point[one->point];
    const scene_quantity *q = &p->scene.quantity[v->quantity];
    const cell_result *cell = &one->cell[mesh];
    const clock_reading *c = &one->timing[mesh].as_is;
    const counters *k = &cell->counters;
    const double value = v->quantity < cell->solve.quantities ? cell->solve.quantity[v->quantity].value : NAN;
    fprintf(to, "%s,", p->type->name);
    csv_field(to, p->text, ",");
    csv_field(to, one->formulation.key, ",");
    fprintf(to, "%d,%d,%s,", one->mesh[mesh], cell->size.free, q->name);
    if (isfinite(value))
        fprintf(to, "%.6e", relative_error(q, value, v->truth->value));
    fprintf(to, ",");
    if (isfinite(value) && v->model_truth != NULL)
        fprintf(to, "%.6e", relative_error(q, value, v->model_truth->value));
    if (c->rounds > 0)
        fprintf(to, ",%.6e,%.6e,%.6e,%.6e,%d", c->setup, c->solve, clock_least(c), clock_most(c), c->repeats);
    else
        fprintf(to, ",,,,,0");
    for (int part = 0; part < PHASES; part++)
        fprintf(to, ",%.6e", one->timing[mesh].phase[part]);
    if (one->timing[mesh].dense.unknowns > 0)
        fprintf(to, ",%.6e,%d", baseline_seconds(&one->timing[mesh].dense, k->iterations),
                one->timing[mesh].dense.whole.rounds > 0);
    else
        fprintf(to, ",,");
    fprintf(to, ",%ld,%ld,%ld,%ld,%ld,%.6e,%s\n", k->iterations, k->strain_evaluations, k->stress_evaluations, k->factorisations,
            k->factor_entries, k->factor_flops, status_name(cell->solve.status));
}

void csv_timing(FILE *to, const sweep *s, const judgement *j)
{
    fprintf(to, "case,parameters,formulation,elements,free,quantity,error,model_error,seconds_setup,seconds_solve,seconds_least,"
                "seconds_most,repeats,seconds_elements,seconds_assembly,seconds_factorisation,seconds_solution,seconds_dense,dense_"
                "whole,iterations,strain_evaluations,stress_evaluations,factorisations,factor_entries,factor_flops,"
                "status\n");
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        for (int k = 0; k < s->series[v->series].meshes && v->truth != NULL && s->series[v->series].missing[0] == '\0'; k++)
            timing_of(to, s, v, k);
    }
}
