#include "harness/experiments/pace_table.h"

#include <math.h>
#include <string.h>

#include "harness/experiments/pace_order.h"
#include "harness/experiments/pace_reach.h"
#include "harness/records/records.h"
#include "harness/terminal/terminal.h"

enum { NAME = 16, NUMBER = 9 };

/* What the reference is, and how far it can be trusted. */
static void print_reference(FILE *to, const pace *p, const pace_group *g)
{
    char stopped[160] = "";
    if (pace_order_is_stopped(g))
        snprintf(stopped, sizeof stopped,
                 "; between these two its order is %.1f of %d: motions faster than its steps take "
                 "part",
                 g->order, PACE_REFERENCE_ORDER);
    paragraph_say(to, 0, 2,
                  "errors of time: against radau at %g on the same mesh (%d steps), which is off "
                  "by %.1e at most, by radau at %g and %g%s",
                  pace_reference[0], pace_cell_of(p, g->reference)->solve.steps, g->uncertainty,
                  pace_reference[1], pace_reference[2], stopped);
}

static void print_head(FILE *to, const pace *p, const pace_group *g)
{
    char text[PARAMETERS_TEXT];
    parameters_text(g->type, g->parameter, text, sizeof text);
    fputc('\n', to);
    paragraph_say(to, 0, 2, "%s%s%s%s, %s, n = %d, to %g s", g->type->name,
                  text[0] != '\0' ? " (" : "", text, text[0] != '\0' ? ")" : "", g->formulation.key,
                  g->elements, g->end);
    if (g->reference >= 0 && isfinite(g->uncertainty))
        print_reference(to, p, g);
    else if (g->reference >= 0)
        paragraph_say(to, 0, 2, "no errors: the reference has none to be measured by: %s",
                      g->reason);
    if (isfinite(g->from) && g->from < g->end)
        paragraph_say(to, 0, 2, "energy and momenta: their largest change since %g s", g->from);
    fprintf(to, "  %-*s%*s%*s%*s%6s%*s%*s%6s%5s%*s%*s  %s\n", NAME, "integrator", NUMBER, "step",
            NUMBER, "tol.", NUMBER, "error", "order", NUMBER, "energy", NUMBER, "momentum", "iter.",
            "rej.", NUMBER, "cost ms", NUMBER, "time ms", "fate");
}

static void print_run(FILE *to, const pace_run *r)
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
    fprintf(to, "  %s", pace_fate_name(r->fate));
    if (r->status != STATUS_OK)
        fprintf(to, " at %.4g s", r->stopped);
    else if (r->fate == PACE_GROWS)
        fprintf(to, " to %.3g E0", r->largest);
    fputc('\n', to);
}

/* Why runs ended too early: each reason once. */
static void print_reasons(FILE *to, const pace *p, const pace_group *g)
{
    const char *last = "";
    for (int i = g->first; i < g->first + g->runs; i++) {
        const pace_run *r = &p->run[i];
        if (r->status == STATUS_OK || strcmp(r->reason, last) == 0)
            continue;
        last = r->reason;
        paragraph_say(to, 0, 4, "  %s, step %g s: %s", r->method.name, r->step, r->reason);
    }
}

static void print_orders(FILE *to, const pace *p, const pace_group *g)
{
    for (int i = g->first; i < g->first + g->runs;) {
        const pace_ladder l = pace_order_of(p, i);
        if (l.count > 2 && isfinite(l.before) && isfinite(l.order))
            paragraph_say(to, 0, 2, "order of %s: %.2f, %.2f (nominal %d): %s", l.method->name,
                          l.before, l.order, l.method->order, pace_order_name(l.kind));
        else if (l.count > 2)
            paragraph_say(to, 0, 2, "order of %s: %s, no errors that show it (nominal %d)",
                          l.method->name, pace_order_name(l.kind), l.method->order);
        i += l.count;
    }
}

/* Integrators by which the error of a quantity does not fall with the step; returns how many. */
static int write_standing(FILE *text, const pace *p, const pace_group *g, int quantity)
{
    int count = 0;
    for (int i = g->first; i < g->first + g->runs;) {
        const pace_ladder l = pace_order_of(p, i);
        const pace_run *last = &p->run[i + l.count - 1];
        i += l.count;
        if (!pace_order_stands(p, &l, quantity))
            continue;
        if (text != NULL)
            fprintf(text, "%s %s (off by %.1e at a step of %g s)", count > 0 ? "," : "",
                    l.method->name, last->values[quantity], last->step);
        count++;
    }
    return count;
}

static void print_standing(FILE *to, const pace *p, const pace_group *g)
{
    const scene *s = &pace_point_of(p, &p->run[g->first])->scene;
    for (int q = 0; q < s->quantities; q++) {
        paragraph words;
        if (write_standing(NULL, p, g, q) == 0)
            continue;
        FILE *text = paragraph_begin(&words, to);
        fprintf(text, "%s does not converge with the step by", s->quantity[q].name);
        write_standing(text, p, g, q);
        paragraph_end(&words, 0, 2);
    }
}

/* Who reaches an error soonest: the first three. */
static void print_level(FILE *to, const pace *p, int group, double level)
{
    const char *name[PACE_METHODS_MOST];
    const int count = pace_reach_methods(p, name);
    double behind = 0;
    paragraph words;
    FILE *text = paragraph_begin(&words, to);
    fprintf(text, "lowest cost to an error of %g, the first three:", level);
    for (int place = 0; place < 3; place++) {
        pace_reach best = {NULL, INFINITY};
        for (int i = 0; i < count; i++) {
            const pace_reach one = pace_reach_of(p, group, name[i], level);
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

static void print_group(FILE *to, const pace *p, int index)
{
    const pace_group *g = &p->group[index];
    print_head(to, p, g);
    for (int i = g->first; i < g->first + g->runs; i++)
        print_run(to, &p->run[i]);
    print_reasons(to, p, g);
    if (g->reference < 0)
        return;
    print_orders(to, p, g);
    print_standing(to, p, g);
    for (int l = 0; l < PACE_LEVELS; l++)
        print_level(to, p, index, pace_levels[l]);
}

static void print_verdict(FILE *to, const pace_verdict *v)
{
    paragraph words;
    FILE *text = paragraph_begin(&words, to);
    fprintf(text, "%s%s of %s, %s%s%s%s, %s, n = %d, steps %s: %s",
            v->as_expected ? "" : "unexpected: ", v->judged, v->integrator, v->case_name,
            v->parameters[0] != '\0' ? " (" : "", v->parameters,
            v->parameters[0] != '\0' ? ")" : "", v->formulation, v->elements, v->steps, v->found);
    if (!v->as_expected)
        fprintf(text, ", expected %s", v->expected);
    paragraph_end(&words, 0, 2);
}

void pace_table(FILE *to, const pace *p, const pace_verdicts *all, int runs)
{
    for (int i = 0; i < p->groups && runs; i++)
        print_group(to, p, i);
    if (all->count == 0)
        return;
    fputc('\n', to);
    for (int i = 0; i < all->count; i++)
        print_verdict(to, &all->verdict[i]);
    fprintf(to, "%d verdicts, %d differ from the expected ones\n", all->count, all->unexpected);
}
