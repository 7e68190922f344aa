#include "harness/run/text.h"

#include <math.h>
#include <string.h>

static void row_of_series(FILE *to, const sweep *s, int index)
{
    const series *one = &s->series[index];
    const point *p = &s->point[one->point];
    fprintf(to, "%s%s%s%s, %s\n", p->type->name, p->text[0] != '\0' ? " (" : "", p->text, p->text[0] != '\0' ? ")" : "",
            one->formulation.key);
}

static void percent(FILE *to, double error)
{
    if (!isfinite(error))
        fprintf(to, "%11s", "-");
    else if (fabs(error) >= 1e-4)
        fprintf(to, " %+9.4f%%", 100 * error);
    else
        fprintf(to, " %+10.1e", error);
}

void text_solution(FILE *to, const sweep *s, const truths *t)
{
    const series *one = &s->series[0];
    const point *p = &s->point[one->point];
    const cell_result *c = &one->cell[0];
    row_of_series(to, s, 0);
    fprintf(to, "%s%s%s; %d elements, %d free coordinates, %ld iterations, %ld factorisations, %.3g s set-up, %.3g s solution\n",
            status_name(c->solve.status), c->solve.reason[0] != '\0' ? ": " : "", c->solve.reason, c->size.elements, c->size.free,
            c->counters.iterations, c->counters.factorisations, c->solve.seconds_setup, c->solve.seconds_solve);
    for (int i = 0; i < c->left_out_lines; i++)
        fprintf(to, "left out: %s\n", c->left_out[i]);
    fprintf(to, "%-28s %24s %-10s %11s\n", "quantity", "value", "unit", "error");
    for (int i = 0; i < c->solve.quantities; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const quantity_result *v = &c->solve.quantity[i];
        const truth *row = t != NULL ? truth_of(t, p->type, p->parameter, q->name, "same") : NULL;
        if (q->reduction == SCENE_CURVE)
            continue;
        if (v->status != STATUS_OK || !isfinite(v->value)) {
            fprintf(to, "%-28s %24s %s\n", q->name, "-", v->reason);
            continue;
        }
        fprintf(to, "%-28s %24.15g %-10s", q->name, v->value, q->unit);
        percent(to, row != NULL ? relative_error(q, v->value, row->value) : NAN);
        fprintf(to, "%s%s\n", row != NULL ? " against " : "", row != NULL ? row->kind : "");
    }
}

/* A field that may hold commas or quotes. */
static void field(FILE *to, const char *text, const char *end)
{
    fputc('"', to);
    for (; *text != '\0'; text++) {
        if (*text == '"')
            fputc('"', to);
        fputc(*text, to);
    }
    fprintf(to, "\"%s", end);
}

void text_solution_csv(FILE *to, const sweep *s)
{
    const series *one = &s->series[0];
    const point *p = &s->point[one->point];
    const cell_result *c = &one->cell[0];
    fprintf(to, "case,parameters,formulation,elements,quantity,unit,value,status,reason\n");
    for (int i = 0; i < c->solve.quantities; i++) {
        const quantity_result *v = &c->solve.quantity[i];
        fprintf(to, "%s,", p->type->name);
        field(to, p->text, ",");
        field(to, one->formulation.key, ",");
        fprintf(to, "%d,%s,%s,", one->mesh[0], p->scene.quantity[i].name, p->scene.quantity[i].unit);
        if (isfinite(v->value))
            fprintf(to, "%.17g", v->value);
        fprintf(to, ",%s,", status_name(v->status));
        field(to, v->reason, "\n");
    }
}

/* printf's conversion 'g', 'e' or 'f' in a field of `width`. */
static void value_or_dash(FILE *to, int width, int digits, char conversion, double value)
{
    if (!isfinite(value))
        fprintf(to, "%*s", width, "-");
    else if (conversion == 'g')
        fprintf(to, "%*.*g", width, digits, value);
    else if (conversion == 'e')
        fprintf(to, "%*.*e", width, digits, value);
    else
        fprintf(to, "%*.*f", width, digits, value);
}

static void verdict_line(FILE *to, const sweep *s, const verdict *v)
{
    const series *one = &s->series[v->series];
    const scene_quantity *q = &s->point[one->point].scene.quantity[v->quantity];
    fprintf(to, "  %-24s %-24s", one->formulation.key, q->name);
    value_or_dash(to, 19, 10, 'g', v->fit.limit);
    value_or_dash(to, 6, 2, 'f', v->fit.order);
    percent(to, v->error);
    fprintf(to, "  %s", verdict_name(v->kind));
    if (v->kind == VERDICT_WRONG_LIMIT)
        fprintf(to, " (%+.3g %%)", 100 * v->error);
    if (!v->matches)
        fprintf(to, "  << expected %s", v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "another verdict");
    else if (v->finding != NULL)
        fprintf(to, "  (known finding)");
    if (v->reason[0] != '\0' && v->kind != VERDICT_SKIP)
        fprintf(to, ": %.150s", v->reason);
    fputc('\n', to);
}

/* Formulations that a point leaves out, in one line each. */
static void skip_line(FILE *to, const series *one)
{
    fprintf(to, "  %-24s skip: does not offer %s\n", one->formulation.key, one->missing);
}

void text_verdicts(FILE *to, const sweep *s, const judgement *j, const truths *t)
{
    int last_point = -1, last_series = -1;
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        const series *one = &s->series[v->series];
        const point *p = &s->point[one->point];
        if (one->point != last_point) {
            fprintf(to, "\n%s%s%s\n", p->type->name, p->text[0] != '\0' ? ": " : "", p->text);
            fprintf(to, "  %-24s %-24s %18s %5s %11s  %s\n", "formulation", "quantity", "limit", "order", "error", "verdict");
        }
        if (v->kind == VERDICT_SKIP) {
            if (v->series != last_series)
                skip_line(to, one);
        } else {
            verdict_line(to, s, v);
        }
        last_point = one->point;
        last_series = v->series;
    }
    for (int i = 0; i < j->agreements; i++) {
        const agreement *a = &j->agreement[i];
        if (a->good)
            continue;
        const series *one = &s->series[a->series];
        fprintf(to, "\n%s, %s, n = %d, %s: %.12g differs from the stored %.12g\n", s->point[one->point].type->name,
                one->formulation.key, one->mesh[a->mesh], s->point[one->point].scene.quantity[a->quantity].name, a->value,
                a->truth->value);
    }
    for (int i = 0; i < t->findings && j->unobserved > 0; i++)
        if (t->finding[i].observed == 0)
            fprintf(to, "\nfinding not observed: %s, %s, %s: %s\n",
                    t->finding[i].type != NULL ? t->finding[i].type->name : "unknown case", t->finding[i].formulation,
                    t->finding[i].quantity, t->finding[i].verdict);
    fprintf(to, "\n%d cells; %d verdicts against truths:", sweep_cells(s), j->judged);
    for (int k = 0; k < VERDICT_KINDS; k++)
        fprintf(to, "%s %d %s", k > 0 ? "," : "", j->by_kind[k], verdict_name((verdict_kind)k));
    fprintf(to, "\n%d of %d stored discrete values agree; %d verdicts differ from the expected one; %d findings not observed\n",
            j->agreements - j->disagreements, j->agreements, j->unexpected, j->unobserved);
}

void text_convergence(FILE *to, const sweep *s, const truths *t)
{
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const point *p = &s->point[one->point];
        row_of_series(to, s, i);
        if (one->missing[0] != '\0') {
            fprintf(to, "  skip: does not offer %s\n", one->missing);
            continue;
        }
        for (int q = 0; q < p->scene.quantities; q++) {
            const truth *row = truth_of(t, p->type, p->parameter, p->scene.quantity[q].name, "same");
            double value[SERIES_MAX_MESHES];
            int n[SERIES_MAX_MESHES], count = 0;
            if (p->scene.quantity[q].reduction == SCENE_CURVE)
                continue;
            fprintf(to, "  %s [%s]\n", p->scene.quantity[q].name, p->scene.quantity[q].unit);
            for (int k = 0; k < one->meshes; k++) {
                const solve_result *r = &one->cell[k].solve;
                const double x = q < r->quantities ? r->quantity[q].value : NAN;
                fprintf(to, "  %6d", one->mesh[k]);
                value_or_dash(to, 23, 14, 'g', x);
                percent(to, row != NULL ? relative_error(&p->scene.quantity[q], x, row->value) : NAN);
                fprintf(to, " %10.3g s%s%s\n", r->seconds_setup + r->seconds_solve, isfinite(x) ? "" : "  ",
                        isfinite(x)         ? ""
                        : q < r->quantities ? r->quantity[q].reason
                                            : r->reason);
                if (isfinite(x)) {
                    n[count] = one->mesh[k];
                    value[count++] = x;
                }
            }
            const convergence c = convergence_of(count, n, value,
                                                 fabs(row != NULL ? row->value
                                                      : count > 0 ? value[count - 1]
                                                                  : 1));
            fprintf(to, "  limit ");
            value_or_dash(to, 22, 14, 'g', c.limit);
            fprintf(to, " +- ");
            value_or_dash(to, 1, 1, 'e', c.limit_uncertainty);
            fprintf(to, ", order ");
            value_or_dash(to, 1, 3, 'f', c.order);
            if (row != NULL)
                fprintf(to, ", %s %.14g", row->kind, row->value);
            fputc('\n', to);
        }
    }
}

void text_convergence_csv(FILE *to, const sweep *s, const truths *t)
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
                field(to, p->text, ",");
                field(to, one->formulation.key, ",");
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

static void escaped(FILE *to, const char *text)
{
    for (; *text != '\0'; text++)
        switch (*text) {
        case '<':
            fputs("&lt;", to);
            break;
        case '>':
            fputs("&gt;", to);
            break;
        case '&':
            fputs("&amp;", to);
            break;
        case '"':
            fputs("&quot;", to);
            break;
        default:
            fputc(*text, to);
        }
}

static void property(FILE *to, const char *name, double value)
{
    if (isfinite(value))
        fprintf(to, "   <property name=\"%s\" value=\"%.17g\"/>\n", name, value);
}

static double seconds_of(const series *one)
{
    double seconds = 0;
    for (int i = 0; i < one->meshes; i++)
        seconds += one->cell[i].solve.seconds_setup + one->cell[i].solve.seconds_solve;
    return seconds;
}

void text_junit(FILE *to, const sweep *s, const judgement *j)
{
    fprintf(to,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n <testsuite name=\"beamwork\" tests=\"%d\" failures=\"%d\" "
            "skipped=\"%d\">\n",
            j->verdicts + j->agreements, j->unexpected + j->disagreements, j->by_kind[VERDICT_SKIP]);
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        const series *one = &s->series[v->series];
        const point *p = &s->point[one->point];
        fprintf(to, "  <testcase classname=\"%s.", p->type->name);
        escaped(to, p->text[0] != '\0' ? p->text : "default");
        fprintf(to, "\" name=\"%s %s\" time=\"%.6f\">\n   <properties>\n", one->formulation.key,
                p->scene.quantity[v->quantity].name, seconds_of(one));
        property(to, "value", v->finest);
        property(to, "limit", v->fit.limit);
        property(to, "order", v->fit.order);
        property(to, "truth", v->truth != NULL ? v->truth->value : NAN);
        property(to, "error", v->error);
        property(to, "tolerance", v->tolerance);
        fprintf(to, "   </properties>\n");
        if (v->kind == VERDICT_SKIP) {
            fprintf(to, "   <skipped message=\"");
            escaped(to, v->reason);
            fprintf(to, "\"/>\n");
        } else if (!v->matches) {
            fprintf(to, "   <failure message=\"%s, expected %s", verdict_name(v->kind),
                    v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "another verdict");
            escaped(to, v->reason[0] != '\0' ? ": " : "");
            escaped(to, v->reason);
            fprintf(to, "\"/>\n");
        }
        fprintf(to, "  </testcase>\n");
    }
    for (int i = 0; i < j->agreements; i++) {
        const agreement *a = &j->agreement[i];
        const series *one = &s->series[a->series];
        const point *p = &s->point[one->point];
        fprintf(to, "  <testcase classname=\"%s.", p->type->name);
        escaped(to, p->text[0] != '\0' ? p->text : "default");
        fprintf(to, "\" name=\"%s n=%d %s (discrete)\">\n", one->formulation.key, one->mesh[a->mesh],
                p->scene.quantity[a->quantity].name);
        if (!a->good)
            fprintf(to, "   <failure message=\"%.17g differs from the stored %.17g\"/>\n", a->value, a->truth->value);
        fprintf(to, "  </testcase>\n");
    }
    fprintf(to, " </testsuite>\n</testsuites>\n");
}
