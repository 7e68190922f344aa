#include "harness/terminal/terminal_impl.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "harness/formulations/formulations.h"

enum { INDENT = 4 };

static void print_settings(FILE *to, const char *parameters)
{
    if (*parameters != '\0')
        fprintf(to, " --set ");
    for (; *parameters != '\0'; parameters++)
        if (*parameters == ';')
            fprintf(to, " --set ");
        else
            fputc(*parameters, to);
}

static void print_element(FILE *to, const element_type *type)
{
    const char *element = type != NULL ? formulations_element(type) : NULL;
    if (element == NULL)
        return;
    fputs(" --element ", to);
    words_quote(to, element);
}

static void print_command(FILE *to, const sweep_point *p, const series *one, const char *quantity)
{
    paragraph words;
    const char *path = scene_file_path(p->type);
    if (one->imported != NULL)
        return;
    FILE *line = paragraph_begin(&words, to);
    fputs("beamwork converge ", line);
    fputs(path != NULL ? "--scene " : "", line);
    words_quote(line, path != NULL ? path : p->type->name);
    print_settings(line, p->text);
    print_element(line, one->formulation.type);
    fprintf(line, " -f %s -n ", one->formulation.key);
    for (int i = 0; i < one->meshes; i++)
        fprintf(line, "%s%d", i > 0 ? "," : "", one->mesh[i]);
    if (quantity != NULL)
        fprintf(line, " -k %s", quantity);
    paragraph_end_command(&words, 0, INDENT);
}

static void print_heading(FILE *to, int number, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void print_heading(FILE *to, int number, const char *format, ...)
{
    char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    if (vasprintf(&text, format, arguments) >= 0) {
        fputc('\n', to);
        paragraph_write(to, fprintf(to, "%2d. ", number), INDENT, text);
        free(text);
    }
    va_end(arguments);
}

static void print_subject(FILE *to, int number, const sweep_point *p, const series *one,
                          const char *more)
{
    const char *open = p->text[0] != '\0' ? " (" : "", *close = p->text[0] != '\0' ? ")" : "";
    print_heading(to, number, "%s%s%s%s, %s, %s", p->type->name, open, p->text, close,
                  one->formulation.key, more);
}

static void print_numbers(FILE *to, const series *one, const verdict *v)
{
    char limit[ROUNDING_TEXT], uncertainty[ROUNDING_TEXT], truth_text[ROUNDING_TEXT],
        error[ROUNDING_TEXT], finest[ROUNDING_TEXT], known[ROUNDING_TEXT];
    if (!isfinite(v->finest) || v->truth == NULL)
        return;
    rounding_known(v->fit.limit, v->fit.limit_uncertainty, limit);
    rounding_digits(v->fit.limit_uncertainty, 2, uncertainty);
    rounding_known(v->truth->value, v->truth->uncertainty, truth_text);
    rounding_digits(v->truth->uncertainty, 2, known);
    rounding_known(v->finest, v->fit.limit_uncertainty, finest);
    rounding_percent(v->error, error);
    paragraph_printf(
        to, 0, INDENT,
        "limit %s +- %s, error %s; reference value %s +- %s (%s, %s); finest mesh, n = %d: %s",
        limit, uncertainty, error, truth_text, known, v->truth->kind, v->truth->source,
        one->mesh[verdict_meshes(one, v->quantity) - 1], finest);
}

static void print_verdict(FILE *to, screen look, const sweep *s, const verdict *v, int number)
{
    const series *one = &s->series[v->series];
    const sweep_point *p = &s->point[one->point];
    const scene_quantity *q = &p->scene.quantity[v->quantity];
    char sentence[2 * FAULT_TEXT], what[SCENE_NAME + 48];
    snprintf(what, sizeof what, "%s [%s]", q->name, q->unit);
    print_subject(to, number, p, one, what);
    sentence_of_verdict(v, q->least_order, sentence, sizeof sentence);
    fprintf(to, "%*s", INDENT, "");
    screen_put(to, look, SCREEN_BAD, verdict_name(v->kind));
    fprintf(to, ", expected %s\n",
            v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "another verdict");
    paragraph_printf(to, 0, INDENT, "%s", sentence);
    print_numbers(to, one, v);
    if (v->reason[0] != '\0' && isfinite(v->finest))
        paragraph_printf(to, 0, INDENT, "%s", v->reason);
    if (v->rule != NULL)
        paragraph_printf(to, 0, INDENT, "known deviation %s: %s", v->rule->name, v->rule->cause);
    print_command(to, p, one, q->name);
}

static void print_disagreement(FILE *to, const sweep *s, const agreement *a, int number)
{
    const series *one = &s->series[a->series];
    const sweep_point *p = &s->point[one->point];
    print_subject(to, number, p, one, p->scene.quantity[a->quantity].name);
    paragraph_printf(to, 0, INDENT, "n = %d: %.12g differs from the stored value %.12g (%s)",
                     one->mesh[a->mesh], a->value, a->truth->value, a->truth->source);
    print_command(to, p, one, p->scene.quantity[a->quantity].name);
}

static void print_flaw(FILE *to, const sweep *s, const flaw *c, int number)
{
    const series *one = &s->series[c->series];
    const sweep_point *p = &s->point[one->point];
    char what[32];
    snprintf(what, sizeof what, "n = %d", one->mesh[c->mesh]);
    print_subject(to, number, p, one, what);
    paragraph_printf(to, 0, INDENT, "inconsistent run record: %s", c->why);
    print_command(to, p, one, NULL);
}

static void print_rules(FILE *to, const truths *t, int *number)
{
    for (int i = 0; i < t->rules; i++) {
        const rule *r = &t->rule[i];
        if (!r->missed)
            continue;
        print_heading(to, ++*number, "known deviation %s%s%s%s %s", r->name,
                      r->from != NULL ? " (" : "", r->from != NULL ? r->from : "",
                      r->from != NULL ? ")" : "",
                      r->observed == 0 ? "was not observed"
                                       : "names a derived limit with which no limit agrees");
        paragraph_printf(to, 0, INDENT, "formulations: %s", r->formulations);
        paragraph_printf(to, 0, INDENT, "cases: %s", r->cases);
        paragraph_printf(to, 0, INDENT, "quantities: %s", r->quantities);
        paragraph_printf(to, 0, INDENT, "cause: %s", r->cause);
    }
}

static void print_unmet(FILE *to, const truths *t, int *number)
{
    for (int i = 0; i < t->rows; i++) {
        const truth *row = &t->row[i];
        char text[PARAMETERS_TEXT];
        if (row->met || (row->formulation[0] != '\0' && formulation_find(row->formulation) == NULL))
            continue;
        parameters_text(row->type, row->parameter, text, sizeof text);
        print_heading(to, ++*number, "reference value with an unknown name: %s%s%s, %s%s%s (%s)",
                      row->type->name, text[0] != '\0' ? ": " : "", text, row->quantity,
                      row->formulation[0] != '\0' ? ", " : "", row->formulation, row->source);
    }
    if (t->unknown_cases > 0) {
        print_heading(to, ++*number, "unknown cases in the reference values: %d; the first is %s",
                      t->unknown_cases, t->unknown_case);
    }
}

void table_breaches(FILE *to, screen look, const evaluation *j)
{
    for (int i = 0; i < j->breaches; i++) {
        screen_put(to, look, SCREEN_BAD, "INTERFACE VIOLATED");
        fputs(" by ", to);
        const char *key = j->breach[i].formulation;
        paragraph words;
        paragraph_printf(to, 22, INDENT, "%s: %s; full report:", key, j->breach[i].why);
        FILE *line = paragraph_begin(&words, to);
        fprintf(line, "beamwork element-test -f %s", key);
        print_element(line, formulations_named(key, strcspn(key, ":")));
        paragraph_end_command(&words, 0, INDENT);
    }
    if (j->breaches > 0)
        fputc('\n', to);
}

void table_unexpected(FILE *to, screen look, const sweep *s, const evaluation *j, const truths *t)
{
    int number = 0;
    for (int i = 0; i < j->verdicts; i++)
        if (!j->verdict[i].matches)
            print_verdict(to, look, s, &j->verdict[i], ++number);
    for (int i = 0; i < j->agreements; i++)
        if (!j->agreement[i].good)
            print_disagreement(to, s, &j->agreement[i], ++number);
    for (int i = 0; i < j->flaws; i++)
        print_flaw(to, s, &j->flaw[i], ++number);
    for (int i = 0; i < j->regressions; i++)
        print_heading(to, ++number, "worse than in the previous run: %s: %s", j->regression[i].of,
                      j->regression[i].why);
    if (j->unobserved > 0)
        print_rules(to, t, &number);
    if (j->unmet > 0)
        print_unmet(to, t, &number);
    if (number > 0)
        fputc('\n', to);
}

enum { COLUMN = 18, COLUMNS = (PARAGRAPH_WIDTH - COLUMN - 8) / COLUMN, ROWS = 20, NAME = 24 };
enum { MESH = 12, MESHES = 5, DIGITS = 8, X_DIGITS = 7 };

static const curve *curve_of(const scene *s, const solve_result *r, int quantity)
{
    if (quantity >= r->quantities || s->quantity[quantity].reduction != SCENE_CURVE)
        return NULL;
    const curve *c = &r->quantity[quantity].curve;
    return c->points > 0 ? c : NULL;
}

/* Returns the analysis whose stations are the points of the curve, if steps end at these stations.
 * SCENE_NONE: the points are not those of a path with given stations. */
static int path_of(const scene *s, int quantity)
{
    const int analysis = s->quantity[quantity].analysis;
    const scene_analysis *a = &s->analysis[analysis];
    const int path =
        a->kind == SCENE_COMPLIANCE && a->follows != SCENE_NONE ? a->follows : analysis;
    const scene_analysis_kind kind = s->analysis[path].kind;
    return kind == SCENE_STATIC || kind == SCENE_ROTATION ? path : SCENE_NONE;
}

static int beside(const scene *s, const solve_result *r, int a, int b)
{
    const curve *p = curve_of(s, r, a), *q = curve_of(s, r, b);
    return p != NULL && q != NULL && p->points == q->points && path_of(s, a) == path_of(s, b) &&
           strcmp(s->quantity[a].x.name, s->quantity[b].x.name) == 0 &&
           memcmp(p->x, q->x, (size_t)p->points * sizeof *p->x) == 0;
}

static void write_name(FILE *to, const char *name, const char *unit)
{
    char text[SCENE_NAME + SCENE_UNIT + 4];
    snprintf(text, sizeof text, "%s [%s]", name, unit);
    fprintf(to, "%*s", COLUMN, text);
    if (strlen(text) >= COLUMN)
        fputc(' ', to);
}

static double largest_of(int points, const double value[])
{
    double largest = 0;
    for (int i = 0; i < points; i++)
        largest = isfinite(value[i]) ? fmax(largest, fabs(value[i])) : largest;
    return largest;
}

/* Returns the value, or 0 if its size is within the rounding error of the largest value. */
static double without_noise(int points, const double value[], int at)
{
    const double noise = 1e-13;
    return fabs(value[at]) < noise * largest_of(points, value) ? 0 : value[at];
}

static void write_value(FILE *to, const quantity_result *r, int at)
{
    const curve *c = &r->curve;
    const double value = without_noise(c->points, c->value, at),
                 apart = r->change * largest_of(c->points, c->value);
    char text[ROUNDING_TEXT];
    if (apart > pow(10, 2 - DIGITS) * fabs(value)) {
        rounding_known(value, apart, text);
        fprintf(to, "%*s", COLUMN, text);
    } else
        table_digits(to, COLUMN, value, DIGITS);
}

static void write_block(FILE *to, const scene *s, const solve_result *r, int count,
                        const int list[])
{
    const curve *first = curve_of(s, r, list[0]);
    const scene_abscissa *x = &s->quantity[list[0]].x;
    const int rows = first->points <= ROWS + 4 ? first->points : ROWS;
    write_name(to, x->name, x->unit);
    for (int k = 0; k < count; k++)
        write_name(to, s->quantity[list[k]].name, s->quantity[list[k]].unit);
    const int path = path_of(s, list[0]);
    fprintf(to, "%s\n", path != SCENE_NONE ? "  stable" : "");
    for (int i = 0; i < rows; i++) {
        const int at = rows > 1 ? (int)((long)i * (first->points - 1) / (rows - 1)) : 0;
        table_value(to, COLUMN, X_DIGITS, 'g', without_noise(first->points, first->x, at));
        for (int k = 0; k < count; k++)
            write_value(to, &r->quantity[list[k]], at);
        if (path != SCENE_NONE)
            fprintf(to, "%8s",
                    table_stability_word(history_stability_at(
                        r, path, scene_path_of(&s->analysis[path])->value[at])));
        fputc('\n', to);
    }
    if (rows < first->points)
        paragraph_printf(to, 0, 2, "  %d of %d points; --format csv and json contain all points",
                         rows, first->points);
}

void table_curves_values(FILE *to, const scene *s, const solve_result *r)
{
    for (int q = 0; q < s->quantities; q++) {
        int list[COLUMNS], count = 0, known = curve_of(s, r, q) == NULL;
        for (int k = 0; k < q && !known; k++)
            known = beside(s, r, k, q);
        for (int k = q; k < s->quantities && !known; k++) {
            if (beside(s, r, q, k))
                list[count++] = k;
            if (count > 0 && (count == COLUMNS || k + 1 == s->quantities)) {
                write_block(to, s, r, count, list);
                count = 0;
            }
        }
    }
}

static int is_given(const sweep *s, int quantity, int reference)
{
    const series *other = &s->series[reference];
    const solve_result *best = &other->cell[curve_error_finest(other, quantity)].solve;
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; s->series[i].missing[0] == '\0' && k < s->series[i].meshes; k++) {
            const solve_result *r = &s->series[i].cell[k].solve;
            if (!(curve_error_between(&s->point[0].scene, quantity, r, best, NULL) < 1e-14))
                return 0;
        }
    return 1;
}

static void write_percent(FILE *to, double error)
{
    char text[ROUNDING_TEXT];
    rounding_percent(error, text);
    fprintf(to, "%*s", MESH, text[0] == '+' ? text + 1 : text);
}

static void errors_of(FILE *to, const sweep *s, int quantity, int index, int reference)
{
    const series *one = &s->series[index];
    const scene *what = &s->point[0].scene;
    const int finest = curve_error_finest(one, quantity);
    const series *other = &s->series[reference];
    const solve_result *best = &other->cell[curve_error_finest(other, quantity)].solve;
    const int first = one->meshes > MESHES ? one->meshes - MESHES : 0;
    const int at = fprintf(to, "  %-*s", NAME - 2, one->formulation.key);
    if (at > NAME)
        fprintf(to, "\n%*s", NAME, "");
    for (int k = first; k < one->meshes; k++)
        if (k == finest)
            fprintf(to, "%*s", MESH, "finest");
        else
            write_percent(to, finest >= 0 ? curve_error_between(what, quantity, &one->cell[k].solve,
                                                                &one->cell[finest].solve, NULL)
                                          : NAN);
    if (index != reference)
        write_percent(to, finest >= 0 ? curve_error_between(what, quantity,
                                                            &one->cell[finest].solve, best, NULL)
                                      : NAN);
    fputc('\n', to);
}

static void write_meshes(FILE *to, const series *one, int several, const char *reference)
{
    const int first = one->meshes > MESHES ? one->meshes - MESHES : 0;
    fprintf(to, "%*s", NAME, "n");
    for (int k = first; k < one->meshes; k++)
        fprintf(to, "%*d", MESH, one->mesh[k]);
    fprintf(to, "%s%s\n", several ? "  from " : "", several ? reference : "");
}

static void write_errors(FILE *to, const sweep *s, int quantity, int reference)
{
    const scene_quantity *q = &s->point[0].scene.quantity[quantity];
    int running = 0, last = -1;
    for (int i = 0; i < s->seriess; i++)
        running += s->series[i].missing[0] == '\0';
    const int at = fprintf(to, "\n%s [%s] over %s [%s], ", q->name, q->unit, q->x.name, q->x.unit);
    paragraph_printf(
        to, at - 1, 4,
        "largest error over the curve, relative to the largest value of the curve; reference: the "
        "finest mesh%s",
        running > 1
            ? "; error of the finest mesh: relative to the finest mesh of another formulation"
            : "");
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        if (one->missing[0] != '\0')
            continue;
        const int same =
            last >= 0 && s->series[last].meshes == one->meshes &&
            memcmp(s->series[last].mesh, one->mesh, (size_t)one->meshes * sizeof *one->mesh) == 0;
        if (!same)
            write_meshes(to, one, running > 1, s->series[reference].formulation.key);
        last = i;
        errors_of(to, s, quantity, i, reference);
    }
}

void table_curves_errors(FILE *to, const sweep *s)
{
    const scene *what = &s->point[0].scene;
    int best = -1, mesh = -1;
    for (int q = 0; q < what->quantities; q++) {
        const int reference =
            what->quantity[q].reduction == SCENE_CURVE ? curve_error_reference(s, q) : -1;
        if (reference < 0)
            continue;
        if (is_given(s, q, reference))
            fprintf(to, "\n%s [%s]: the same curve on all meshes\n", what->quantity[q].name,
                    what->quantity[q].unit);
        else
            write_errors(to, s, q, reference);
        if (best < 0) {
            best = reference;
            mesh = curve_error_finest(&s->series[best], q);
        }
    }
    if (best < 0)
        return;
    fprintf(to, "\n%s, n = %d\n", s->series[best].formulation.key, s->series[best].mesh[mesh]);
    table_curves_values(to, what, &s->series[best].cell[mesh].solve);
}
