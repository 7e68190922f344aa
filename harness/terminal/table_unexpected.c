#include "harness/terminal/table_unexpected.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/scene_file.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/terminal/paragraph.h"

enum { INDENT = 4 };

/* "--set a=1 --set b=2" for "a=1;b=2". */
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

/* Where the formulation comes from, if that is to be said. */
static void print_element(FILE *to, const element_type *type)
{
    const char *element = type != NULL ? formulations_element(type) : NULL;
    if (element == NULL)
        return;
    fputs(" --element ", to);
    words_quote(to, element);
}

/* The command that shows a series again; quantity: one of them, or NULL. */
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

/* A numbered heading. */
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

/* "case (parameters), formulation" and what else is told. */
static void print_subject(FILE *to, int number, const sweep_point *p, const series *one,
                          const char *more)
{
    const char *open = p->text[0] != '\0' ? " (" : "", *close = p->text[0] != '\0' ? ")" : "";
    print_heading(to, number, "%s%s%s%s, %s, %s", p->type->name, open, p->text, close,
                  one->formulation.key, more);
}

static void print_numbers(FILE *to, const series *one, const verdict *v)
{
    char limit[ROUNDING_TEXT], doubt[ROUNDING_TEXT], truth_text[ROUNDING_TEXT],
        error[ROUNDING_TEXT], finest[ROUNDING_TEXT], known[ROUNDING_TEXT];
    if (!isfinite(v->finest) || v->truth == NULL)
        return;
    rounding_known(v->fit.limit, v->fit.limit_uncertainty, limit);
    rounding_digits(v->fit.limit_uncertainty, 2, doubt);
    rounding_known(v->truth->value, v->truth->uncertainty, truth_text);
    rounding_digits(v->truth->uncertainty, 2, known);
    rounding_known(v->finest, v->fit.limit_uncertainty, finest);
    rounding_percent(v->error, error);
    paragraph_say(to, 0, INDENT,
                  "limit %s +- %s, off by %s; truth %s +- %s (%s, %s); finest mesh, n = %d: %s",
                  limit, doubt, error, truth_text, known, v->truth->kind, v->truth->source,
                  one->mesh[one->meshes - 1], finest);
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
    paragraph_say(to, 0, INDENT, "%s", sentence);
    print_numbers(to, one, v);
    if (v->reason[0] != '\0' && isfinite(v->finest)) /* else it is in the sentence */
        paragraph_say(to, 0, INDENT, "%s", v->reason);
    if (v->rule != NULL)
        paragraph_say(to, 0, INDENT, "finding %s: %s", v->rule->name, v->rule->cause);
    print_command(to, p, one, q->name);
}

static void print_disagreement(FILE *to, const sweep *s, const agreement *a, int number)
{
    const series *one = &s->series[a->series];
    const sweep_point *p = &s->point[one->point];
    print_subject(to, number, p, one, p->scene.quantity[a->quantity].name);
    paragraph_say(to, 0, INDENT, "n = %d: %.12g differs from the stored %.12g (%s)",
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
    paragraph_say(to, 0, INDENT, "inconsistent run record: %s", c->why);
    print_command(to, p, one, NULL);
}

static void print_rules(FILE *to, const truths *t, int *number)
{
    for (int i = 0; i < t->rules; i++) {
        const rule *r = &t->rule[i];
        if (!r->missed)
            continue;
        print_heading(to, ++*number, "finding %s%s%s%s %s", r->name, r->from != NULL ? " (" : "",
                      r->from != NULL ? r->from : "", r->from != NULL ? ")" : "",
                      r->observed == 0 ? "was not observed"
                                       : "names a prediction that no verdict met");
        paragraph_say(to, 0, INDENT, "formulations: %s", r->formulations);
        paragraph_say(to, 0, INDENT, "cases: %s", r->cases);
        paragraph_say(to, 0, INDENT, "quantities: %s", r->quantities);
        paragraph_say(to, 0, INDENT, "cause: %s", r->cause);
    }
}

/* Truths that no case, point or quantity answers to. */
static void print_unmet(FILE *to, const truths *t, int *number)
{
    for (int i = 0; i < t->rows; i++) {
        const truth *row = &t->row[i];
        char text[PARAMETERS_TEXT];
        if (row->met || (row->formulation[0] != '\0' && formulation_find(row->formulation) == NULL))
            continue;
        parameters_text(row->type, row->parameter, text, sizeof text);
        print_heading(to, ++*number, "truth of nothing that exists: %s%s%s, %s%s%s (%s)",
                      row->type->name, text[0] != '\0' ? ": " : "", text, row->quantity,
                      row->formulation[0] != '\0' ? ", " : "", row->formulation, row->source);
    }
    if (t->strangers > 0) {
        print_heading(to, ++*number, "truths of %d unknown cases, the first: %s", t->strangers,
                      t->stranger);
    }
}

void table_breaches(FILE *to, screen look, const judgement *j)
{
    for (int i = 0; i < j->breaches; i++) {
        screen_put(to, look, SCREEN_BAD, "BROKEN CONTRACT");
        fputs(" of ", to);
        const char *key = j->breach[i].formulation;
        paragraph words;
        paragraph_say(to, 19, INDENT, "%s: %s; all of it:", key, j->breach[i].why);
        FILE *line = paragraph_begin(&words, to);
        fprintf(line, "beamwork element-test -f %s", key);
        print_element(line, formulations_named(key, strcspn(key, ":")));
        paragraph_end_command(&words, 0, INDENT);
    }
    if (j->breaches > 0)
        fputc('\n', to);
}

void table_unexpected(FILE *to, screen look, const sweep *s, const judgement *j, const truths *t)
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
        print_heading(to, ++number, "worse than in the former run: %s: %s", j->regression[i].of,
                      j->regression[i].why);
    if (j->unobserved > 0)
        print_rules(to, t, &number);
    if (j->unmet > 0)
        print_unmet(to, t, &number);
    if (number > 0)
        fputc('\n', to);
}
