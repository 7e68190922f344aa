#include "harness/extremes/extreme_table.h"

#include <math.h>
#include <string.h>

#include "harness/extremes/extreme_record.h"
#include "harness/record/csv_record.h"

enum { NAME_WIDTH = 26, CELL_WIDTH = 15 };

/* "1.2e-06", with a sign of what it is: ~ coarse, ! wrong, ? not expected. */
static void cell_text(const extreme_outcome *o, char *text, size_t size)
{
    static const char *const mark[OUTCOME_KINDS] = {[OUTCOME_COARSE] = "~", [OUTCOME_WRONG] = "!"};
    const char *unexpected = o->as_expected ? "" : "?";
    if (o->kind == OUTCOME_SKIP)
        snprintf(text, size, "-");
    else if (o->kind == OUTCOME_VALUE || o->kind == OUTCOME_COARSE || o->kind == OUTCOME_WRONG)
        snprintf(text, size, "%.1e%s%s", fabs(o->error), mark[o->kind] != NULL ? mark[o->kind] : "",
                 unexpected);
    else
        snprintf(text, size, "%s%s", outcome_name(o->kind), unexpected);
}

static int is_same_line(const extreme_outcome *a, const extreme_outcome *b)
{
    return a->extreme == b->extreme && a->formulation == b->formulation &&
           a->quantity == b->quantity;
}

static int runs_anywhere(const extreme_sweep *s, int extreme_index, int formulation_index)
{
    for (int i = 0; i < s->outcomes; i++)
        if (s->outcome[i].extreme == extreme_index &&
            s->outcome[i].formulation == formulation_index && s->outcome[i].kind != OUTCOME_SKIP)
            return 1;
    return 0;
}

static void print_head(FILE *to, const extreme *e)
{
    char fixed[PARAMETERS_TEXT] = "";
    if (e->fixed[0] != '\0')
        snprintf(fixed, sizeof fixed, " (%s)", e->fixed);
    fprintf(to, "\n%s: %s\n  %s%s, %s\n  %-*s", e->name, e->summary, e->base, fixed,
            e->judge == EXTREME_EXACT ? "against exact values" : "against its own value",
            NAME_WIDTH + 14, e->x_name);
    for (int k = 0; k < e->values; k++)
        fprintf(to, " %*g", CELL_WIDTH, e->value[k]);
    fprintf(to, "  condition\n");
}

/* Errors of a formulation and quantity at all values of x, and the worst condition. */
static void print_line(FILE *to, const extreme_sweep *s, const extreme_outcome *o)
{
    double condition = 0;
    fprintf(to, "  %-*s%-14s", NAME_WIDTH, s->formulation[o->formulation].key,
            extremes[o->extreme].quantity[o->quantity].name);
    for (int k = 0; k < s->outcomes; k++)
        if (is_same_line(o, &s->outcome[k])) {
            char text[64];
            cell_text(&s->outcome[k], text, sizeof text);
            fprintf(to, " %*s", CELL_WIDTH, text);
            condition = fmax(condition, extreme_sweep_cell(s, &s->outcome[k])->counters.condition);
        }
    fprintf(to, "  %.0e\n", condition);
}

/* A line for every formulation that runs and every quantity. */
static void print_extreme(FILE *to, const extreme_sweep *s, int index)
{
    const extreme_outcome *first = NULL;
    for (int i = 0; i < s->outcomes; i++) {
        const extreme_outcome *o = &s->outcome[i];
        if (o->extreme != index)
            continue;
        if (first == NULL) {
            first = o;
            print_head(to, &extremes[index]);
        }
        if (o->value == first->value && runs_anywhere(s, index, o->formulation))
            print_line(to, s, o);
    }
}

static void print_count(FILE *to, const extreme_count *c)
{
    fprintf(to, "%-*s%10d%10d%10d%16d%10d%10d\n", NAME_WIDTH, c->formulation, c->tried, c->survived,
            c->coarse, c->named, c->wrong, c->faults);
}

static void print_counts(FILE *to, const extreme_sweep *s)
{
    extreme_count sum = {.formulation = "all"};
    fprintf(to, "%-*s%10s%10s%10s%16s%10s%10s\n", NAME_WIDTH, "extremes", "tried", "survived",
            "(coarse)", "named failures", "wrong", "faults");
    for (int i = 0; i < s->formulations; i++) {
        const extreme_count *c = &s->count[i];
        print_count(to, c);
        sum.tried += c->tried;
        sum.survived += c->survived;
        sum.coarse += c->coarse;
        sum.named += c->named;
        sum.wrong += c->wrong;
        sum.faults += c->faults;
    }
    print_count(to, &sum);
}

static void print_unexpected(FILE *to, const extreme_sweep *s)
{
    for (int i = 0; i < s->outcomes; i++) {
        const extreme_outcome *o = &s->outcome[i];
        const extreme *e = &extremes[o->extreme];
        if (!o->as_expected)
            fprintf(to, "unexpected: %s %s=%g %s %s: %s (error %.3g), expected %s; %s\n", e->name,
                    e->x_name, o->x, s->formulation[o->formulation].key,
                    e->quantity[o->quantity].name, outcome_name(o->kind), o->error,
                    o->finding != NULL ? o->finding->outcome : "a value", o->reason);
    }
    if (s->unobserved > 0)
        for (int i = 0; i < s->findings; i++)
            if (s->finding[i].observed == 0)
                fprintf(to, "not observed: %s from %g to %g %s %s: %s\n", s->finding[i].extreme,
                        s->finding[i].from, s->finding[i].to, s->finding[i].formulation,
                        s->finding[i].quantity, s->finding[i].outcome);
}

void extreme_table(FILE *to, const extreme_sweep *s)
{
    for (int i = 0; extremes[i].name != NULL; i++)
        print_extreme(to, s, i);
    fprintf(to, "\nrelative errors; ~ coarse: falls with more elements; ! wrong; ? not expected; "
                "- skip\n\n");
    print_unexpected(to, s);
    print_counts(to, s);
    fprintf(to, "%d outcomes differ from the expected ones, %d findings not observed\n",
            s->unexpected, s->unobserved);
}

void extreme_table_csv(FILE *to, const extreme_sweep *s)
{
    csv_part row = {.type = &record_outcome};
    csv_record_head(to, 1, &row);
    for (int i = 0; i < s->outcomes; i++) {
        row.s = extreme_record_subject(s, &s->outcome[i]);
        csv_record_line(to, 1, &row);
    }
}
