#include "harness/experiments/extreme_table.h"

#include <math.h>
#include <string.h>

#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

enum { NAME_WIDTH = 23, INDENT = 4, WIDEST_CELL = 10, CONDITION_WIDTH = 7 };

static const struct {
    char letter;
    const char *words;
} failures[OUTCOME_KINDS] = {[OUTCOME_NOT_CONVERGED] = {'N', "not converged"},
                             [OUTCOME_SINGULAR] = {'S', "singular"},
                             [OUTCOME_REFUSED] = {'R', "refused"},
                             [OUTCOME_NO_VALUE] = {'V', "no value"},
                             [OUTCOME_FAULT] = {'F', "fault"}};

/* "0.22", "2e-7" [%], with a sign of what it is: ~ coarse, ! wrong, ? not expected; a letter for a
 * failure. */
static void cell_text(const extreme_outcome *o, char *text, size_t size)
{
    static const char *const mark[OUTCOME_KINDS] = {[OUTCOME_COARSE] = "~", [OUTCOME_WRONG] = "!"};
    const char *unexpected = o->as_expected ? "" : "?";
    char number[ROUNDING_TEXT];
    const double percent = 100 * fabs(o->error);
    if (o->kind == OUTCOME_SKIP)
        snprintf(text, size, "-");
    else if (failures[o->kind].letter != '\0')
        snprintf(text, size, "%c%s", failures[o->kind].letter, unexpected);
    else {
        rounding_digits(percent, percent < 0.01 ? 1 : 2, number);
        snprintf(text, size, "%s%s%s", number, mark[o->kind] != NULL ? mark[o->kind] : "",
                 unexpected);
    }
}

/* Columns of a cell of an extreme with so many values. */
static int width_of_cells(const extreme *e)
{
    const int width = (PARAGRAPH_WIDTH - INDENT - NAME_WIDTH - CONDITION_WIDTH) / e->values;
    return width < WIDEST_CELL ? width : WIDEST_CELL;
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
    fputc('\n', to);
    paragraph_say(to, 0, 0, "%s: %s", e->name, e->summary);
    paragraph_say(to, 0, 2, "%s%s, %s", e->base, fixed,
                  e->judge == EXTREME_EXACT ? "against exact values" : "against its own value");
    if (fprintf(to, "  %-*s", INDENT - 2 + NAME_WIDTH, e->x_name) > INDENT + NAME_WIDTH)
        fprintf(to, "\n%*s", INDENT + NAME_WIDTH, "");
    for (int k = 0; k < e->values; k++)
        fprintf(to, "%*g", width_of_cells(e), e->value[k]);
    fprintf(to, "%*s\n", CONDITION_WIDTH, "cond.");
}

/* Errors of a formulation and quantity at all values of x, and the worst condition. */
static void print_line(FILE *to, const extreme_sweep *s, const extreme_outcome *o)
{
    double condition = 0;
    if (fprintf(to, "    %-*s", NAME_WIDTH, s->formulation[o->formulation].key) >
        INDENT + NAME_WIDTH)
        fprintf(to, "\n%*s", INDENT + NAME_WIDTH, "");
    for (int k = 0; k < s->outcomes; k++)
        if (is_same_line(o, &s->outcome[k])) {
            char text[64];
            cell_text(&s->outcome[k], text, sizeof text);
            fprintf(to, "%*s", width_of_cells(&extremes[o->extreme]), text);
            condition = fmax(condition, extreme_sweep_cell(s, &s->outcome[k])->counters.condition);
        }
    fprintf(to, "%*.0e\n", CONDITION_WIDTH, condition);
}

/* A line for every formulation that runs. */
static void print_quantity(FILE *to, const extreme_sweep *s, const extreme_outcome *first,
                           int quantity)
{
    int lines = 0;
    for (int i = 0; i < s->outcomes; i++) {
        const extreme_outcome *o = &s->outcome[i];
        if (o->extreme != first->extreme || o->quantity != quantity || o->value != first->value ||
            !runs_anywhere(s, o->extreme, o->formulation))
            continue;
        if (lines++ == 0)
            fprintf(to, "  %s\n", extremes[o->extreme].quantity[quantity].name);
        print_line(to, s, o);
    }
}

static void print_extreme(FILE *to, const extreme_sweep *s, int index)
{
    const extreme *e = &extremes[index];
    int i = 0;
    while (i < s->outcomes && s->outcome[i].extreme != index)
        i++;
    if (i == s->outcomes)
        return;
    print_head(to, e);
    for (int q = 0; q < EXTREME_MAX_QUANTITIES; q++)
        print_quantity(to, s, &s->outcome[i], q);
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

static void print_outcome(FILE *to, const extreme_sweep *s, const extreme_outcome *o)
{
    const extreme *e = &extremes[o->extreme];
    char error[ROUNDING_TEXT];
    rounding_percent(o->error, error);
    paragraph_say(to, fprintf(to, "unexpected: "), 2,
                  "%s %s=%g %s %s: %s (error %s), expected %s; %s", e->name, e->x_name, o->x,
                  s->formulation[o->formulation].key, e->quantity[o->quantity].name,
                  outcome_name(o->kind), error,
                  o->finding != NULL ? o->finding->outcome : "a value", o->reason);
}

static void print_unexpected(FILE *to, const extreme_sweep *s)
{
    for (int i = 0; i < s->outcomes; i++) {
        const extreme_outcome *o = &s->outcome[i];
        if (!o->as_expected)
            print_outcome(to, s, o);
    }
    if (s->unobserved > 0)
        for (int i = 0; i < s->findings; i++)
            if (s->finding[i].observed == 0)
                paragraph_say(to, 0, 0, "not observed: %s from %g to %g %s %s: %s",
                              s->finding[i].extreme, s->finding[i].from, s->finding[i].to,
                              s->finding[i].formulation, s->finding[i].quantity,
                              s->finding[i].outcome);
}

static void print_legend(FILE *to)
{
    fprintf(
        to,
        "\nerrors in %%; ~ coarse: falls with more elements; ! wrong; ? not expected; - skip\n");
    for (int k = 0, named = 0; k < OUTCOME_KINDS; k++)
        if (failures[k].letter != '\0')
            fprintf(to, "%s%c %s", named++ > 0 ? "; " : "", failures[k].letter, failures[k].words);
    fprintf(to, "\n\n");
}

void extreme_table(FILE *to, const void *found)
{
    const extreme_sweep *s = found;
    for (int i = 0; extremes[i].name != NULL; i++)
        print_extreme(to, s, i);
    print_legend(to);
    print_unexpected(to, s);
    print_counts(to, s);
    if (s->is_new > 0)
        paragraph_say(to, 0, 0,
                      "%d outcomes of new formulations, which do not affect the exit status, are "
                      "neither a value nor "
                      "coarse and would need findings",
                      s->is_new);
    fprintf(to, "%d outcomes differ from the expected ones, %d findings not observed\n",
            s->unexpected, s->unobserved);
}
