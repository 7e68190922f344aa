#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const double integrators_growth = 0.01, integrators_energy = 1e-11, integrators_momentum = 1e-12,
             integrators_reference[1 + INTEGRATORS_CHECKS] = {1e-10, 1e-8, 1e-6};

void integrators_free(integrators *p)
{
    for (int i = 0; i < p->runs; i++)
        free(p->run[i].values);
    sweep_free(&p->sweep);
    free(p->group);
    free(p->run);
    memset(p, 0, sizeof *p);
}

const char *integrators_class_name(integrators_class motion_class)
{
    static const char *const name[INTEGRATORS_CLASSES] = {"", "grows", "stops", "bounded", "exact"};
    return name[motion_class];
}

const sweep_point *integrators_point_of(const integrators *p, const integrators_run *r)
{
    return &p->sweep.point[p->sweep.series[r->series].point];
}

const cell_result *integrators_cell_of(const integrators *p, int index)
{
    return &p->sweep.series[index].cell[0];
}

typedef struct track {
    int count;
    const motion_record *record;
} track;

static track track_of(const solve_result *r, int analysis)
{
    track t = {0, r->motion};
    while (t.record != NULL && t.record < r->motion + r->motions && t.record->analysis != analysis)
        t.record++;
    while (t.record + t.count < r->motion + r->motions && t.record[t.count].analysis == analysis)
        t.count++;
    return t;
}

static double balance_at(const track *t, int i, scene_balance what)
{
    return t->record[i].at.balance[what];
}

static int first_alone(const track *t, double from)
{
    int i = 0;
    while (from > 0 && i < t->count && t->record[i].at.time <= from * (1 + 1e-12))
        i++;
    return i;
}

static void take_energy(const track *t, int first, integrators_run *r)
{
    const double before = balance_at(t, first, SCENE_ENERGY);
    r->largest = r->last = 1;
    r->energy = 0;
    for (int i = first; i < t->count; i++) {
        r->last = balance_at(t, i, SCENE_ENERGY) / before;
        r->largest = fmax(r->largest, r->last);
        r->energy = fmax(r->energy, fabs(r->last - 1));
    }
}

/* Returns the magnitude of a momentum at step `first` (i = first), or the magnitude of the change
 * from step `first` to another step i. */
static double vector_at(const track *t, scene_balance x, int i, int first)
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        const scene_balance which = (scene_balance)(x + k);
        const double d = balance_at(t, i, which) - (first != i ? balance_at(t, first, which) : 0);
        square += d * d;
    }
    return sqrt(square);
}

/* Returns the larger of the largest relative changes of momentum and angular momentum since step
 * `first`. A momentum that is zero at step `first` is ignored. */
static double momentum_drift(const track *t, int first)
{
    static const scene_balance both[] = {SCENE_PX, SCENE_LX};
    double largest = 0;
    for (int b = 0; b < 2; b++) {
        const double size = vector_at(t, both[b], first, first);
        for (int i = first + 1; i < t->count && size > 0; i++)
            largest = fmax(largest, vector_at(t, both[b], i, first) / size);
    }
    return largest;
}

/* Returns the largest difference between energy and work, relative to the largest energy. NAN: a
 * difference is not known, or all energies are zero. */
static double unexplained(const track *t)
{
    double most = 0, size = 0;
    for (int i = 0; i < t->count; i++) {
        const double drift = fabs(balance_at(t, i, SCENE_DRIFT));
        if (isnan(drift))
            return NAN;
        most = fmax(most, drift);
        size = fmax(size, fabs(balance_at(t, i, SCENE_ENERGY)));
    }
    return size > 0 ? most / size : NAN;
}

static integrators_class class_of(const integrators_run *r)
{
    if (r->status != STATUS_OK)
        return INTEGRATORS_STOPS;
    if (isnan(r->largest))
        return INTEGRATORS_UNCLASSIFIED;
    if (!(r->largest <= 1 + integrators_growth))
        return INTEGRATORS_GROWS;
    return r->energy <= integrators_energy && r->momentum <= integrators_momentum
               ? INTEGRATORS_EXACT
               : INTEGRATORS_BOUNDED;
}

void integrators_drift(const integrators *p, integrators_run *r)
{
    const integrators_group *g = &p->group[r->group];
    const track t = track_of(&integrators_cell_of(p, r->series)->solve, g->analysis);
    const int first = first_alone(&t, g->from);
    r->momentum = r->largest = r->last = NAN;
    r->energy = unexplained(&t);
    if (first < t.count && balance_at(&t, first, SCENE_ENERGY) > 0) {
        take_energy(&t, first, r);
        r->momentum = momentum_drift(&t, first);
    }
    r->motion_class =
        isfinite(g->from) || r->status != STATUS_OK ? class_of(r) : INTEGRATORS_UNCLASSIFIED;
}

const double integrators_order_slack = 0.3;

/* Errors are reliable only above floor_of_reference times the uncertainty of the reference, and
 * above floor_of_rounding. */
static const double floor_of_reference = 10, floor_of_rounding = 1e-11;

const char *integrators_order_name(integrators_order_kind kind)
{
    static const char *const name[INTEGRATORS_ORDER_KINDS] = {"pass", "low order", "undecided"};
    return name[kind];
}

static int follows(const integrators_run *a, const integrators_run *b)
{
    return b->group == a->group && strcmp(b->method.name, a->method.name) == 0 &&
           a->tolerance == 0 && b->tolerance == 0 && b->step < a->step;
}

static double order_of(const integrators_run *coarse, const integrators_run *fine)
{
    return log(coarse->error / fine->error) / log(coarse->step / fine->step);
}

void integrators_order_fill(integrators *p)
{
    for (int i = 0; i < p->runs; i++)
        p->run[i].order = i > 0 && follows(&p->run[i - 1], &p->run[i])
                              ? order_of(&p->run[i - 1], &p->run[i])
                              : NAN;
}

/* Returns LOW if two consecutive orders are both below the nominal order by more than
 * integrators_order_slack, PASS if neither is, and UNDECIDED otherwise. */
static integrators_order_kind evaluate(const integrators_ladder *l)
{
    const double least = l->method->order - integrators_order_slack;
    if (isnan(l->order) || isnan(l->before))
        return INTEGRATORS_ORDER_UNDECIDED;
    if (l->order >= least && l->before >= least)
        return INTEGRATORS_ORDER_PASS;
    return l->order < least && l->before < least ? INTEGRATORS_ORDER_LOW
                                                 : INTEGRATORS_ORDER_UNDECIDED;
}

integrators_ladder integrators_order_of(const integrators *p, int first)
{
    const integrators_run *r = &p->run[first];
    integrators_ladder out = {
        .group = r->group,
        .method = &r->method,
        .first = first,
        .count = 1,
        .order = NAN,
        .before = NAN,
        .floor = fmax(floor_of_reference * p->group[r->group].uncertainty, floor_of_rounding)};
    while (first + out.count < p->runs && follows(&r[out.count - 1], &r[out.count]))
        out.count++;
    for (int i = 1; i < out.count && r[i].error > out.floor; i++) {
        out.before = out.order;
        out.order = order_of(&r[i - 1], &r[i]);
    }
    out.kind = evaluate(&out);
    return out;
}

int integrators_order_stagnates(const integrators *p, const integrators_ladder *l, int quantity)
{
    static const double least = 1e-3, fall = 2, steps = 3.9;
    const integrators_run *first = &p->run[l->first], *last = first + l->count - 1;
    if (first->values == NULL || last->values == NULL || first->step < steps * last->step)
        return 0;
    const double from = first->values[quantity], to = last->values[quantity];
    return to > least && to > l->floor && from < fall * to;
}

int integrators_order_is_stopped(const integrators_group *g)
{
    return g->order < INTEGRATORS_REFERENCE_ORDER - 1;
}

const double integrators_levels[INTEGRATORS_LEVELS] = {1e-2, 1e-4, 1e-6};

static int is_coarser(const integrators_run *a, const integrators_run *b)
{
    return a->group == b->group && strcmp(a->method.name, b->method.name) == 0 &&
           (a->tolerance > 0) == (b->tolerance > 0) &&
           (a->tolerance > 0 ? a->tolerance > b->tolerance : a->step > b->step);
}

static int is_reached_from(const integrators *p, const integrators_run *r, double level)
{
    for (int i = 0; i < p->runs; i++)
        if ((&p->run[i] == r || is_coarser(r, &p->run[i])) && !(p->run[i].error <= level))
            return 0;
    return 1;
}

/* Returns the cost at an error level. Between two runs, error and cost are interpolated as powers
 * of the step size. */
static double cost_at(const integrators *p, const integrators_run *r, double level)
{
    const integrators_run *before = r > p->run ? r - 1 : NULL;
    if (before == NULL || !is_coarser(before, r) || !(before->error > level) || r->error <= 0)
        return r->cost;
    const double share = log(before->error / level) / log(before->error / r->error);
    return before->cost * pow(r->cost / before->cost, share);
}

integrators_reach integrators_reach_of(const integrators *p, int group, const char *method,
                                       double level)
{
    integrators_reach best = {NULL, INFINITY};
    for (int i = 0; i < p->runs; i++) {
        const integrators_run *r = &p->run[i];
        if (r->group != group || strcmp(r->method.name, method) != 0 ||
            !is_reached_from(p, r, level))
            continue;
        const double cost = cost_at(p, r, level);
        if (cost < best.cost)
            best = (integrators_reach){r, cost};
    }
    return best;
}

int integrators_reach_methods(const integrators *p, const char *name[INTEGRATORS_METHODS_MOST])
{
    int count = 0;
    for (int i = 0; i < p->runs; i++) {
        int known = 0;
        for (int k = 0; k < count; k++)
            known |= strcmp(name[k], p->run[i].method.name) == 0;
        if (!known && count < INTEGRATORS_METHODS_MOST)
            name[count++] = p->run[i].method.name;
    }
    return count;
}

enum { NAME = 16, NUMBER = 9 };

static void print_reference(FILE *to, const integrators *p, const integrators_group *g)
{
    char stopped[160] = "";
    if (integrators_order_is_stopped(g))
        snprintf(stopped, sizeof stopped,
                 "; the observed order of radau is %.1f instead of %d, because its steps do not "
                 "resolve some modes",
                 g->order, INTEGRATORS_REFERENCE_ORDER);
    paragraph_printf(
        to, 0, 2,
        "time-integration errors: relative to radau with tolerance %g on the same mesh (%d steps), "
        "whose error is at most %.1e according to radau with tolerances %g and %g%s",
        integrators_reference[0], integrators_cell_of(p, g->reference)->solve.steps, g->uncertainty,
        integrators_reference[1], integrators_reference[2], stopped);
}

static void print_head(FILE *to, const integrators *p, const integrators_group *g)
{
    char text[PARAMETERS_TEXT];
    parameters_text(g->type, g->parameter, text, sizeof text);
    fputc('\n', to);
    paragraph_printf(to, 0, 2, "%s%s%s%s, %s, n = %d, to %g s", g->type->name,
                     text[0] != '\0' ? " (" : "", text, text[0] != '\0' ? ")" : "",
                     g->formulation.key, g->elements, g->end);
    if (g->reference >= 0 && isfinite(g->uncertainty))
        print_reference(to, p, g);
    else if (g->reference >= 0)
        paragraph_printf(
            to, 0, 2,
            "no errors are available, because the reference solution cannot be checked: %s",
            g->reason);
    if (isfinite(g->from) && g->from < g->end)
        paragraph_printf(to, 0, 2, "energy and momentum: largest changes since %g s", g->from);
    fprintf(to, "  %-*s%*s%*s%*s%6s%*s%*s%6s%5s%*s%*s  %s\n", NAME, "integrator", NUMBER, "step",
            NUMBER, "tol.", NUMBER, "error", "order", NUMBER, "energy", NUMBER, "momentum", "iter.",
            "rej.", NUMBER, "cost ms", NUMBER, "time ms", "fate");
}

static void print_run(FILE *to, const integrators_run *r)
{
    fprintf(to, "  %-*s%*g", NAME, r->method.name, NUMBER, r->step);
    table_value(to, NUMBER, 3, 'g', r->tolerance > 0 ? r->tolerance : NAN);
    table_value(to, NUMBER, 1, 'e', r->error);
    table_value(to, 6, 2, 'f', r->order);
    table_value(to, NUMBER, 1, 'e', r->energy);
    table_value(to, NUMBER, 1, 'e', r->momentum);
    table_value(to, 6, 1, 'f', r->iterations);
    fprintf(to, "%5ld", r->rejected);
    table_value(to, NUMBER, 3, 'g', 1e3 * r->cost);
    table_value(to, NUMBER, 3, 'g', 1e3 * r->seconds);
    fprintf(to, "  %s", integrators_class_name(r->motion_class));
    if (r->status != STATUS_OK)
        fprintf(to, " at %.4g s", r->stopped);
    else if (r->motion_class == INTEGRATORS_GROWS)
        fprintf(to, " to %.3g E0", r->largest);
    fputc('\n', to);
}

static void print_reasons(FILE *to, const integrators *p, const integrators_group *g)
{
    const char *last = "";
    for (int i = g->first; i < g->first + g->runs; i++) {
        const integrators_run *r = &p->run[i];
        if (r->status == STATUS_OK || strcmp(r->reason, last) == 0)
            continue;
        last = r->reason;
        paragraph_printf(to, 0, 4, "  %s, step %g s: %s", r->method.name, r->step, r->reason);
    }
}

static void print_orders(FILE *to, const integrators *p, const integrators_group *g)
{
    for (int i = g->first; i < g->first + g->runs;) {
        const integrators_ladder l = integrators_order_of(p, i);
        if (l.count > 2 && isfinite(l.before) && isfinite(l.order))
            paragraph_printf(to, 0, 2, "order of %s: %.2f, %.2f (nominal %d): %s", l.method->name,
                             l.before, l.order, l.method->order, integrators_order_name(l.kind));
        else if (l.count > 2)
            paragraph_printf(
                to, 0, 2,
                "order of %s: %s; the order cannot be measured from the errors (nominal %d)",
                l.method->name, integrators_order_name(l.kind), l.method->order);
        i += l.count;
    }
}

/* Prints the integrators for which the error of a quantity stagnates (integrators_order_stagnates),
 * and returns their number. text NULL: nothing is printed. */
static int write_standing(FILE *text, const integrators *p, const integrators_group *g,
                          int quantity)
{
    int count = 0;
    for (int i = g->first; i < g->first + g->runs;) {
        const integrators_ladder l = integrators_order_of(p, i);
        const integrators_run *last = &p->run[i + l.count - 1];
        i += l.count;
        if (!integrators_order_stagnates(p, &l, quantity))
            continue;
        if (text != NULL)
            fprintf(text, "%s %s (error %.1e at a step of %g s)", count > 0 ? "," : "",
                    l.method->name, last->values[quantity], last->step);
        count++;
    }
    return count;
}

static void print_standing(FILE *to, const integrators *p, const integrators_group *g)
{
    const scene *s = &integrators_point_of(p, &p->run[g->first])->scene;
    for (int q = 0; q < s->quantities; q++) {
        paragraph words;
        if (write_standing(NULL, p, g, q) == 0)
            continue;
        FILE *text = paragraph_begin(&words, to);
        fprintf(text, "%s does not converge as the step decreases, with", s->quantity[q].name);
        write_standing(text, p, g, q);
        paragraph_end(&words, 0, 2);
    }
}

static void print_level(FILE *to, const integrators *p, int group, double level)
{
    const char *name[INTEGRATORS_METHODS_MOST];
    const int count = integrators_reach_methods(p, name);
    double behind = 0;
    paragraph words;
    FILE *text = paragraph_begin(&words, to);
    fprintf(text, "integrators with the lowest cost for an error of %g (at most three):", level);
    for (int place = 0; place < 3; place++) {
        integrators_reach best = {NULL, INFINITY};
        for (int i = 0; i < count; i++) {
            const integrators_reach one = integrators_reach_of(p, group, name[i], level);
            if (one.run != NULL && one.cost > behind && one.cost < best.cost)
                best = one;
        }
        if (best.run == NULL && place == 0)
            fprintf(text, " none");
        if (best.run == NULL)
            break;
        fprintf(text, "%s %s (%.3g ms)", place > 0 ? "," : "", best.run->method.name,
                1e3 * best.cost);
        behind = best.cost;
    }
    paragraph_end(&words, 0, 2);
}

static void print_group(FILE *to, const integrators *p, int index)
{
    const integrators_group *g = &p->group[index];
    print_head(to, p, g);
    for (int i = g->first; i < g->first + g->runs; i++)
        print_run(to, &p->run[i]);
    print_reasons(to, p, g);
    if (g->reference < 0)
        return;
    print_orders(to, p, g);
    print_standing(to, p, g);
    for (int l = 0; l < INTEGRATORS_LEVELS; l++)
        print_level(to, p, index, integrators_levels[l]);
}

static void print_verdict(FILE *to, const integrators_verdict *v)
{
    paragraph words;
    FILE *text = paragraph_begin(&words, to);
    fprintf(text, "%s%s of %s, %s%s%s%s, %s, n = %d, steps %s: %s",
            v->as_expected ? "" : "unexpected: ", v->criterion, v->integrator, v->case_name,
            v->parameters[0] != '\0' ? " (" : "", v->parameters,
            v->parameters[0] != '\0' ? ")" : "", v->formulation, v->elements, v->steps, v->found);
    if (!v->as_expected)
        fprintf(text, ", expected %s", v->expected);
    paragraph_end(&words, 0, 2);
}

void integrators_table(FILE *to, const integrators *p, const integrators_verdicts *all, int runs)
{
    for (int i = 0; i < p->groups && runs; i++)
        print_group(to, p, i);
    if (all->count == 0)
        return;
    fputc('\n', to);
    for (int i = 0; i < all->count; i++)
        print_verdict(to, &all->verdict[i]);
    fprintf(to, "%d verdict%s; %d %s from the expected verdict%s\n", all->count,
            all->count == 1 ? "" : "s", all->unexpected,
            all->unexpected == 1 ? "differs" : "differ", all->unexpected == 1 ? "" : "s");
}
