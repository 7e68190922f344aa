#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Four functions return, for an outcome: the cell on the first mesh, the quantity in the scene, the
 * result of the quantity in a cell, and the value (NAN: none). refinement 0: first mesh; k:
 * neighbouring mesh k - 1. */
static const cell_result *extreme_sweep_cell(const extreme_sweep *s, const extreme_outcome *o)
{
    return &s->first.series[o->series].cell[0];
}

static const scene_quantity *extreme_sweep_quantity(const extreme_sweep *s,
                                                    const extreme_outcome *o)
{
    const scene *all = &s->first.point[o->point].scene;
    for (int i = 0; i < all->quantities; i++)
        if (strcmp(all->quantity[i].name, extremes[o->extreme].quantity[o->quantity].name) == 0)
            return &all->quantity[i];
    return NULL;
}

static const quantity_result *extreme_sweep_result(const extreme_sweep *s, const extreme_outcome *o,
                                                   const cell_result *cell)
{
    const ptrdiff_t index = extreme_sweep_quantity(s, o) - s->first.point[o->point].scene.quantity;
    return index < cell->solve.quantities ? &cell->solve.quantity[index] : NULL;
}

static double extreme_sweep_value(const extreme_sweep *s, const extreme_outcome *o, int refinement)
{
    if (refinement > 0 && o->neighbours < 0)
        return NAN;
    const cell_result *cell = refinement == 0
                                  ? extreme_sweep_cell(s, o)
                                  : &s->neighbours.series[o->neighbours].cell[refinement - 1];
    const quantity_result *r = extreme_sweep_result(s, o, cell);
    return r != NULL && r->status == STATUS_OK ? r->value : NAN;
}

extreme_outcome *extreme_sweep_base(const extreme_sweep *s, const extreme_outcome *o)
{
    for (int i = 0; i < s->outcomes; i++) {
        extreme_outcome *b = &s->outcome[i];
        if (b->extreme == o->extreme && b->formulation == o->formulation &&
            b->quantity == o->quantity && b->x == extremes[o->extreme].same_as)
            return b;
    }
    return NULL;
}

int extreme_sweep_exit(const extreme_sweep *s)
{
    int tried = 0;
    for (int i = 0; i < s->formulations; i++)
        tried += s->count[i].tried;
    if (tried == 0)
        return 3;
    return s->unexpected > 0 || s->unobserved > 0;
}

void extreme_sweep_free(extreme_sweep *s)
{
    for (int i = 0; i < s->deviations; i++) {
        extreme_deviation *r = &s->deviation[i];
        char *const all[] = {r->extreme, r->formulation, r->quantity, r->outcome, r->proof};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            free(all[k]);
    }
    truths_free(&s->truths);
    sweep_free(&s->first);
    sweep_free(&s->neighbours);
    free(s->deviation);
    free(s->formulation);
    free(s->outcome);
    free(s->count);
    memset(s, 0, sizeof *s);
}

static int quantity_index(const extreme_outcome *o, const sweep_point *p)
{
    const char *name = extremes[o->extreme].quantity[o->quantity].name;
    int q = 0;
    while (q < p->scene.quantities && strcmp(p->scene.quantity[q].name, name) != 0)
        q++;
    return q;
}

/* Returns the exact value for the shear theory of the formulation; NULL: none. */
static const truth *exact_value(const extreme_sweep *s, const truths *t, const extreme_outcome *o)
{
    const sweep_point *p = &s->first.point[o->point];
    const int q = quantity_index(o, p);
    return q < p->scene.quantities ? verdict_truth(t, p, &s->formulation[o->formulation], q) : NULL;
}

/* Returns 1 if exact values exist only for another shear theory than that of the formulation. */
static int has_other_theory(const extreme_sweep *s, const truths *t, const extreme_outcome *o)
{
    const sweep_point *p = &s->first.point[o->point];
    const char *name = extremes[o->extreme].quantity[o->quantity].name;
    return exact_value(s, t, o) == NULL && truth_of(t, p->type, p->parameter, name, "same") != NULL;
}

/* Returns the reference value and the relative uncertainty. The reference value is an exact value
 * or, for EXTREME_SAME, the value at the base x multiplied by a power of x/same_as. */
static double extreme_reference_of(const extreme_sweep *s, const truths *t,
                                   const extreme_outcome *o, int refinement, double *uncertainty)
{
    const extreme *e = &extremes[o->extreme];
    *uncertainty = 0;
    if (e->criterion == EXTREME_SAME) {
        const extreme_outcome *base = extreme_sweep_base(s, o);
        const double power = e->quantity[o->quantity].power;
        return base != NULL
                   ? extreme_sweep_value(s, base, refinement) * pow(o->x / e->same_as, power)
                   : NAN;
    }
    const truth *row = exact_value(s, t, o);
    if (row != NULL && row->value != 0)
        *uncertainty = fabs(row->uncertainty / row->value);
    return row != NULL ? row->value : NAN;
}

static outcome_kind failure_of(status s)
{
    switch (s) {
    case STATUS_NOT_CONVERGED:
        return OUTCOME_NOT_CONVERGED;
    case STATUS_SINGULAR:
        return OUTCOME_SINGULAR;
    case STATUS_REFUSED:
        return OUTCOME_REFUSED;
    case STATUS_NO_VALUE:
        return OUTCOME_NO_VALUE;
    case STATUS_OK:
    case STATUS_FAULT:
    case STATUS_TIME_LIMIT:
        break;
    }
    return OUTCOME_FAULT;
}

static void set_kind(extreme_outcome *o, outcome_kind kind, const char *reason)
{
    o->kind = kind;
    o->reason = reason;
}

static void set_failure(extreme_outcome *o, status why, const char *reason)
{
    set_kind(o, failure_of(why), reason);
}

static void evaluate_value(const scene_quantity *q, double value, double uncertainty,
                           extreme_outcome *o)
{
    const extreme *e = &extremes[o->extreme];
    o->result = value;
    o->error = verdict_error(q, value, o->reference);
    if (e->criterion == EXTREME_SAME && !isfinite(o->reference))
        set_kind(o, OUTCOME_WRONG,
                 "no comparison is possible, because the base state has no value");
    else
        o->kind = fabs(o->error) <= e->tolerance + uncertainty ? OUTCOME_VALUE : OUTCOME_WRONG;
}

status extreme_evaluate_first(const extreme_sweep *s, const truths *t, extreme_outcome *o, fault *f)
{
    const extreme *e = &extremes[o->extreme];
    const series *one = &s->first.series[o->series];
    const sweep_point *p = &s->first.point[o->point];
    double uncertainty;
    o->result = o->error = NAN;
    for (int i = 0; i < OUTCOME_NEIGHBOURS; i++)
        o->neighbour_error[i] = NAN;
    o->reference = extreme_reference_of(s, t, o, 0, &uncertainty);
    const int other = e->criterion == EXTREME_EXACT && has_other_theory(s, t, o);
    if (e->criterion == EXTREME_EXACT && !isfinite(o->reference) && !other)
        return fault_set(
            f, STATUS_FAULT,
            "extreme %s: %s has no exact value at %s; derive one with reference/derive/extremes.py",
            e->name, e->quantity[o->quantity].name, p->text);
    const solve_result *solved = &one->cell[0].solve;
    const quantity_result *r = extreme_sweep_result(s, o, &one->cell[0]);
    if (one->missing[0] != '\0')
        set_kind(o, OUTCOME_SKIP, one->missing);
    else if (other)
        set_kind(o, OUTCOME_SKIP, "the exact value belongs to another shear theory");
    else if (p->status != STATUS_OK)
        set_failure(o, p->status, p->reason);
    else if (r == NULL)
        set_failure(o, solved->status, solved->reason);
    else if (r->status != STATUS_OK)
        set_failure(o, r->status, r->reason);
    else
        evaluate_value(extreme_sweep_quantity(s, o), r->value, uncertainty, o);
    return STATUS_OK;
}

typedef struct mesh_refinement {
    int count;
    double elements[OUTCOME_NEIGHBOURS + 1], size[OUTCOME_NEIGHBOURS + 1];
} mesh_refinement;

static void add_mesh(mesh_refinement *r, int elements, double error)
{
    if (!isfinite(error))
        return;
    r->elements[r->count] = elements;
    r->size[r->count++] = fabs(error);
}

static int falls(const mesh_refinement *r)
{
    const int last = r->count - 1;
    if (r->count < 2 || r->size[last] > r->size[last - 1])
        return 0;
    return r->size[last] <= r->size[0] * sqrt(r->elements[0] / r->elements[last]);
}

void extreme_evaluate_neighbours(const extreme_sweep *s, const truths *t, extreme_outcome *o)
{
    const int *mesh = s->neighbours.series[o->neighbours].mesh;
    const int own = s->first.series[o->series].mesh[0];
    mesh_refinement r = {.count = 0};
    int placed = 0;
    for (int i = 0; i < OUTCOME_NEIGHBOURS; i++) {
        double uncertainty;
        const double reference = extreme_reference_of(s, t, o, i + 1, &uncertainty);
        const double value = extreme_sweep_value(s, o, i + 1);
        o->neighbour_error[i] = verdict_error(extreme_sweep_quantity(s, o), value, reference);
        if (!placed && own < mesh[i]) {
            add_mesh(&r, own, o->error);
            placed = 1;
        }
        add_mesh(&r, mesh[i], o->neighbour_error[i]);
    }
    if (!placed)
        add_mesh(&r, own, o->error);
    if (falls(&r))
        o->kind = OUTCOME_COARSE;
    else
        set_kind(o, OUTCOME_WRONG, "the error does not decrease with more elements");
}

enum { NAME_WIDTH = 23, INDENT = 4, WIDEST_CELL = 10, CONDITION_WIDTH = 7 };

static const struct {
    char letter;
    const char *words;
} failures[OUTCOME_KINDS] = {[OUTCOME_NOT_CONVERGED] = {'N', "not converged"},
                             [OUTCOME_SINGULAR] = {'S', "singular"},
                             [OUTCOME_REFUSED] = {'R', "refused"},
                             [OUTCOME_NO_VALUE] = {'V', "no value"},
                             [OUTCOME_FAULT] = {'F', "fault"}};

/* Writes an error [%] as "0.22" or "2e-7", or a letter for a failure. A final sign means: ~
 * under-resolved, ! wrong, ? unexpected. */
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
    paragraph_printf(to, 0, 0, "%s: %s", e->name, e->summary);
    paragraph_printf(to, 0, 2, "%s%s, %s", e->base, fixed,
                     e->criterion == EXTREME_EXACT
                         ? "against exact values"
                         : "compared with the value of the same formulation without the extreme");
    if (fprintf(to, "  %-*s", INDENT - 2 + NAME_WIDTH, e->x_name) > INDENT + NAME_WIDTH)
        fprintf(to, "\n%*s", INDENT + NAME_WIDTH, "");
    for (int k = 0; k < e->values; k++)
        fprintf(to, "%*g", width_of_cells(e), e->value[k]);
    fprintf(to, "%*s\n", CONDITION_WIDTH, "cond.");
}

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
    paragraph_printf(to, fprintf(to, "unexpected: "), 2,
                     "%s %s=%g %s %s: %s (error %s), expected %s; %s", e->name, e->x_name, o->x,
                     s->formulation[o->formulation].key, e->quantity[o->quantity].name,
                     outcome_name(o->kind), error,
                     o->deviation != NULL ? o->deviation->outcome : "a value", o->reason);
}

static void print_unexpected(FILE *to, const extreme_sweep *s)
{
    for (int i = 0; i < s->outcomes; i++) {
        const extreme_outcome *o = &s->outcome[i];
        if (!o->as_expected)
            print_outcome(to, s, o);
    }
    if (s->unobserved > 0)
        for (int i = 0; i < s->deviations; i++)
            if (s->deviation[i].observed == 0)
                paragraph_printf(to, 0, 0, "not observed: %s from %g to %g, %s, %s: %s",
                                 s->deviation[i].extreme, s->deviation[i].from, s->deviation[i].to,
                                 s->deviation[i].formulation, s->deviation[i].quantity,
                                 s->deviation[i].outcome);
}

static void print_legend(FILE *to)
{
    fprintf(to, "\nerrors in %%; ~ under-resolved: decreases with more elements; ! wrong; ? "
                "unexpected; - not supported\n");
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
        paragraph_printf(
            to, 0, 0,
            "outcomes of new formulations that are neither accurate nor under-resolved, "
            "and would require known deviations: %d; these do not affect the exit status",
            s->is_new);
    fprintf(to,
            "outcomes that differ from the expected ones: %d; known deviations that were not "
            "observed: %d\n",
            s->unexpected, s->unobserved);
}
