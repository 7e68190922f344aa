#include "harness/terminal/terminal_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/model/model.h"
#include "harness/time/time.h"

static void loop_lines(FILE *to, const scene *s);

enum { NAME = 28, VALUE = 20, UNIT = 9, DIGITS = 10, INDENT = 2 };
/* smallest relative rounding error of a computed value */
static const double
    least_rounding = 1e-11,
    noise = 1e-4; /* relative to change_scale: rounding of a value; smaller values count as zero */

static void predictions(FILE *to, const sweep_point *p, const truths *t)
{
    for (int i = 0; i < p->scene.quantities; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const truth *row = t != NULL ? truth_of(t, p->type, p->parameter, q->name, "same") : NULL;
        char name[SCENE_NAME + 16];
        if (q->prediction.source == NULL)
            continue;
        snprintf(name, sizeof name, "estimate %s", q->name);
        const int column = fprintf(to, "%-*s ", NAME, name) + VALUE + UNIT + 1 + 12 + 2;
        table_digits(to, VALUE, q->prediction.value, DIGITS);
        fprintf(to, " %-*s", UNIT, q->unit);
        table_percent(to, row != NULL ? verdict_error(q, q->prediction.value, row->value) : NAN);
        fputs("  ", to);
        paragraph_printf(to, column, INDENT, "%s, analytic", q->prediction.source);
    }
}

static int is_reported(const solve_result *r, int index)
{
    return index > 0 && r->quantity[index - 1].status != STATUS_OK &&
           strcmp(r->quantity[index - 1].reason, r->quantity[index].reason) == 0;
}

/* Returns 1 if the value is only a rounding error. */
static int is_zero(const scene *s, int index, const solve_result *r)
{
    return fabs(r->quantity[index].value) < change_scale(s, index, r) * noise;
}

/* Returns a bound of the change of a value due to rounding and mesh refinement. */
static double uncertainty_of(const scene *s, int index, const solve_result *r)
{
    const quantity_result *v = &r->quantity[index];
    const double scale = change_scale(s, index, r),
                 of_rounding =
                     fmax(fabs(v->value) * fmax(v->rounding, least_rounding), scale * noise),
                 of_mesh = fmax(fabs(v->value), scale) * v->change;
    return isfinite(of_mesh) ? fmax(of_rounding, of_mesh) : of_rounding;
}

static void quantity_line(FILE *to, const sweep *s, const truths *t, int index)
{
    const series *one = &s->series[0];
    const sweep_point *p = &s->point[one->point];
    const scene_quantity *q = &p->scene.quantity[index];
    const quantity_result *v = &one->cell[0].solve.quantity[index];
    const truth *row = t != NULL ? verdict_truth(t, p, &one->formulation, index) : NULL;
    const int column = fprintf(to, "%-*s ", NAME, q->name) + VALUE + 1;
    if (v->status != STATUS_OK) {
        fprintf(to, "%*s ", VALUE, "-");
        paragraph_write(to, column, INDENT,
                        is_reported(&one->cell[0].solve, index) ? "likewise" : v->reason);
        return;
    }
    const int zero = is_zero(&p->scene, index, &one->cell[0].solve);
    table_known(to, VALUE, zero ? 0 : v->value,
                uncertainty_of(&p->scene, index, &one->cell[0].solve));
    fprintf(to, " %-*s", UNIT, q->unit);
    table_percent(to, row != NULL ? verdict_error(q, v->value, row->value) : NAN);
    fprintf(to, "%s%s", row != NULL ? " against " : "", row != NULL ? row->kind : "");
    fprintf(to, "%s%s", v->meaning[0] != '\0' ? ", " : "", v->meaning);
    const int passed = scene_is_passed(q, p->scene.analysis[q->analysis].kind);
    if (passed && (q->reduction == SCENE_MAX || q->reduction == SCENE_MIN))
        fprintf(to, ", at %.6g s", v->x);
    if (q->what.kind == SCENE_RESPONSE && (q->reduction == SCENE_MAX || q->reduction == SCENE_MIN))
        fprintf(to, ", at %.6g Hz", v->x);
    if (v->rounding > 1e-9)
        fprintf(to, ", %s %.1e",
                passed && !reading_is_slope(q)   ? "between steps"
                : q->what.kind == SCENE_RESPONSE ? "omitted modes at most"
                                                 : "round-off",
                v->rounding);
    fputc('\n', to);
}

static const char *plural(long count)
{
    return count == 1 ? "" : "s";
}

/* Writes the number of load steps or time steps, and the number of rejected longer steps. */
static void count_steps(const counters *c, char text[FAULT_TEXT])
{
    text[0] = '\0';
    if (c->rejected_steps > 0)
        snprintf(text, FAULT_TEXT, " in %ld step%s (%ld longer rejected)", c->steps,
                 plural(c->steps), c->rejected_steps);
    else if (c->steps > 0)
        snprintf(text, FAULT_TEXT, " in %ld step%s", c->steps, plural(c->steps));
}

static void unfinished_curves(FILE *to, const sweep_point *p, const solve_result *r)
{
    for (int i = 0; i < r->quantities; i++) {
        const quantity_result *v = &r->quantity[i];
        if (p->scene.quantity[i].reduction != SCENE_CURVE || v->status == STATUS_OK)
            continue;
        const int column = fprintf(to, "%-*s %*s ", NAME, p->scene.quantity[i].name, VALUE, "-");
        paragraph_printf(to, column, INDENT, "%s%s", is_reported(r, i) ? "likewise" : v->reason,
                         v->curve.points > 0 ? "; the curve ends there" : "");
    }
}

static void bounded_curves(FILE *to, const scene *s, const solve_result *r)
{
    for (int i = 0; i < r->quantities; i++)
        if (r->quantity[i].curve.points > 0 && r->quantity[i].rounding > 1e-9)
            fprintf(to, "%-*s %s %.1e of its largest value\n", NAME, s->quantity[i].name,
                    s->quantity[i].what.kind == SCENE_RESPONSE ? "omitted modes at most"
                                                               : "round-off",
                    r->quantity[i].rounding);
}

static void continued_curves(FILE *to, const scene *s, const solve_result *r)
{
    for (int i = 0; i < r->quantities; i++)
        if (r->quantity[i].curve.points > 0 &&
            s->analysis[s->quantity[i].analysis].kind == SCENE_MOTION &&
            r->quantity[i].meaning[0] != '\0')
            fprintf(to, "%-*s %s\n", NAME, s->quantity[i].name, r->quantity[i].meaning);
}

/* Prints the combinations if loads have load cases, for example "ULS = 1.35 dead + 1.5 wind;
 * ...". */
static void combinations(FILE *to, const scene *s)
{
    if (s->combinations == 0)
        return;
    const int at = fprintf(to, "combinations: ");
    paragraph words;
    FILE *text = paragraph_begin(&words, to);
    for (int i = 0; i < s->combinations; i++) {
        const scene_combination *c = &s->combination[i];
        fprintf(text, "%s%s =", i > 0 ? "; " : "", c->name);
        for (int k = 0; k < c->terms; k++)
            fprintf(text, " %s%.6g %s",
                    c->term[k].factor < 0 ? (k > 0 ? "- " : "-")
                    : k > 0               ? "+ "
                                          : "",
                    fabs(c->term[k].factor), s->load_case[c->term[k].load_case].name);
    }
    paragraph_end(&words, at, INDENT);
}

static void imperfections(FILE *to, const scene *s)
{
    if (s->imperfections == 0)
        return;
    const int at = fprintf(to, "imperfections: ");
    paragraph words;
    FILE *text = paragraph_begin(&words, to);
    for (int i = 0; i < s->imperfections; i++) {
        const scene_imperfection *p = &s->imperfection[i];
        fprintf(text, "%s%s, ", i > 0 ? "; " : "", scene_name(s, SCENE_IMPERFECTIONS, i).text);
        if (p->analysis != SCENE_NONE)
            fprintf(text, "mode %d of %s, at most %.4g m", p->order,
                    scene_name(s, SCENE_ANALYSES, p->analysis).text, fabs(p->amplitude));
        else
            fprintf(text, "shifts of %d nodes", p->nodes);
    }
    for (int i = 0, named = 0; i < s->analyses; i++)
        if (scene_is_perfect(s, i))
            fprintf(text, "%s %s",
                    named++ ? "," : "; without them:", scene_name(s, SCENE_ANALYSES, i).text);
    paragraph_end(&words, at, INDENT);
}

/* Returns 1 if the scene has analyses in which prescribed components are fixed. words: kinds of
 * these analyses. */
static int holding(const scene *s, char words[40])
{
    static const struct {
        scene_analysis_kind kind;
        const char *name;
    } all[] = {{SCENE_MODAL, "modal"}, {SCENE_BUCKLING, "buckling"}, {SCENE_HARMONIC, "harmonic"}};
    int used = 0;
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        for (int i = 0; i < s->analyses; i++)
            if (s->analysis[i].kind == all[k].kind) {
                used += snprintf(words + used, 40 - (size_t)used, "%s%s", used > 0 ? ", " : "",
                                 all[k].name);
                break;
            }
    return used > 0;
}

static int is_input(const scene *s, int driver)
{
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].what.kind == SCENE_RESPONSE &&
            s->quantity[i].what.of.response.driver == driver)
            return 1;
    return 0;
}

static void put_driven(FILE *text, const scene *s, int node, const int driver[3], const char *names,
                       int *count)
{
    for (int k = 0; k < 3; k++)
        if (driver[k] >= 0 && !is_input(s, driver[k]))
            fprintf(text, "%s%s %.2s", (*count)++ > 0 ? ", " : "",
                    scene_name(s, SCENE_NODES, node).text, names + 2 * k);
}

/* Prints the prescribed components that are fixed in some analyses, for example "held by drives
 * (modal): stage ux". */
static void driven(FILE *to, const scene *s)
{
    char kinds[40], *words = NULL;
    size_t size;
    int count = 0;
    FILE *text = holding(s, kinds) ? open_memstream(&words, &size) : NULL;
    if (text == NULL)
        return;
    for (int i = 0; i < s->nodes; i++) {
        const scene_node *n = &s->node[i];
        put_driven(text, s, i, n->translation, "uxuyuz", &count);
        if (n->rotation != SCENE_ROTATION_FORK)
            put_driven(text, s, i, n->angle, "rxryrz", &count);
    }
    if (fclose(text) == 0 && count > 0)
        paragraph_printf(to, fprintf(to, "held by drives (%s): ", kinds), INDENT, "%s", words);
    free(words);
}

static int has_no_inertia(const scene_body *b)
{
    int none = b->mass > 0;
    for (int i = 0; i < 6; i++)
        none &= b->inertia[i] == 0;
    return none;
}

static int turns_alone(const scene *s, int node)
{
    const scene_node *n = &s->node[node];
    if (n->attached != SCENE_NONE ||
        (n->rotation == SCENE_ROTATION_SPATIAL && n->angle[0] == SCENE_HELD &&
         n->angle[1] == SCENE_HELD && n->angle[2] == SCENE_HELD))
        return 0;
    for (int i = 0; i < s->nodes; i++)
        if (s->node[i].attached == node && scene_has_body(&s->node[i]))
            return 0;
    return 1;
}

static int is_weighed(const scene *s)
{
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].kind == SCENE_GRAVITY || s->load[i].kind == SCENE_WEIGHT)
            return 1;
    return 0;
}

/* Prints the masses, which reveal a wrong unit, for example "mass: bodies 500 kg, members 0.0125
 * kg". members: mass [kg]. */
static void masses(FILE *to, const scene *s, double members)
{
    enum { MOST_NAMES = 8 };
    const int moves = (features_needed(s) & FEATURE_MASS) != 0;
    double bodies = 0;
    int count = 0;
    paragraph words;
    if (!moves && !is_weighed(s))
        return;
    for (int i = 0; i < s->nodes; i++)
        bodies += s->node[i].body.mass;
    const int at = fprintf(to, "mass: ");
    FILE *text = paragraph_begin(&words, to);
    if (bodies > 0)
        fprintf(text, "bodies %.6g kg, ", bodies);
    fprintf(text, "members %.6g kg", members);
    for (int i = 0; moves && i < s->nodes; i++)
        if (has_no_inertia(&s->node[i].body) && turns_alone(s, i) && ++count <= MOST_NAMES)
            fprintf(text, "%s%s", count > 1 ? ", " : "; no moment of inertia: ",
                    scene_name(s, SCENE_NODES, i).text);
    if (count > MOST_NAMES)
        fprintf(text, " and %d more", count - MOST_NAMES);
    paragraph_end(&words, at, INDENT);
}

void table_solution(FILE *to, const sweep *s, const truths *t)
{
    const series *one = &s->series[0];
    const sweep_point *p = &s->point[one->point];
    const cell_result *c = &one->cell[0];
    char steps[FAULT_TEXT], ends[FAULT_TEXT];
    table_series(to, s, 0);
    count_steps(&c->counters, steps);
    const int at = fprintf(to, "%s", status_name(c->solve.status));
    paragraph_printf(to, at, INDENT,
                     "%s%s; %d element%s, %d free coordinate%s, %ld iteration%s%s, "
                     "%ld factorisation%s, %.3g s set-up, %.3g s solution",
                     c->solve.reason[0] != '\0' ? ": " : "", c->solve.reason, c->size.elements,
                     plural(c->size.elements), c->size.free, plural(c->size.free),
                     c->counters.iterations, plural(c->counters.iterations), steps,
                     c->counters.factorisations, plural(c->counters.factorisations),
                     c->solve.seconds_setup, c->solve.seconds_solve);
    table_stability_paths(to, &p->scene, &c->solve);
    for (int i = 0; i < c->left_out_lines; i++)
        paragraph_write(to, fprintf(to, "not included: "), INDENT, c->left_out[i]);
    warping_ends(&p->scene, ends, sizeof ends);
    if (ends[0] != '\0')
        paragraph_write(to, fprintf(to, "warping: "), INDENT, ends);
    on_nodes(&p->scene, one->formulation.type, one->formulation.option, ends, sizeof ends);
    if (ends[0] != '\0')
        paragraph_write(to, fprintf(to, "lumped: "), INDENT, ends);
    masses(to, &p->scene, c->mass);
    driven(to, &p->scene);
    combinations(to, &p->scene);
    imperfections(to, &p->scene);
    table_omitted(to, p);
    table_theory(to, &p->scene, one->formulation.type);
    table_path_events(to, &c->solve);
    fprintf(to, "%-*s %*s %-*s %11s\n", NAME, "quantity", VALUE, "value", UNIT, "unit", "error");
    for (int i = 0; i < c->solve.quantities; i++)
        if (p->scene.quantity[i].reduction != SCENE_CURVE)
            quantity_line(to, s, t, i);
    predictions(to, p, t);
    unfinished_curves(to, p, &c->solve);
    table_curves_values(to, &p->scene, &c->solve);
    bounded_curves(to, &p->scene, &c->solve);
    continued_curves(to, &p->scene, &c->solve);
    table_path_matrices(to, &p->scene, &c->solve);
    table_motion(to, &p->scene, &c->solve);
    loop_lines(to, &p->scene);
    table_path_steps(to, &c->solve);
}

static void loop_lines(FILE *to, const scene *s)
{
    for (int i = 0; i < s->loads; i++) {
        int closed = 0;
        for (int a = 0; a < s->analyses; a++) {
            if ((s->analysis[a].kind != SCENE_HARMONIC && !s->analysis[a].damped) ||
                !scene_closes_loop(s, a, i))
                continue;
            if (closed == 0)
                fprintf(to, "feedback: the loop of %s is closed in",
                        scene_called(s, SCENE_LOADS, i).text);
            fprintf(to, "%s %s", closed++ > 0 ? "," : "", scene_name(s, SCENE_ANALYSES, a).text);
        }
        if (closed > 0)
            fputc('\n', to);
    }
}

void table_follow(FILE *to, const char *parameter, const follow_curves *c)
{
    int between = 0;
    fprintf(to, "%-16s", parameter);
    for (int i = 0; i < c->modes; i++)
        fprintf(to, " %8s %-2d [Hz]", "mode", i + 1);
    fputc('\n', to);
    for (int k = 0; k < c->samples; k++) {
        between += !c->sample[k].requested;
        if (!c->sample[k].requested)
            continue;
        fprintf(to, "%-16.10g", c->sample[k].value);
        for (int i = 0; i < c->modes; i++)
            fprintf(to, " %16.10g", c->sample[k].frequency[i]);
        fputc('\n', to);
    }
    for (int i = 0; i < c->events; i++) {
        const follow_event *e = &c->event[i];
        fprintf(to, "modes %d and %d %s at %.10g, %.10g Hz", e->mode[0] + 1, e->mode[1] + 1,
                e->crossing ? "cross" : "avoid each other", e->value, e->frequency);
        if (e->crossing)
            fputc('\n', to);
        else
            fprintf(to, ", %.2g %% apart\n", 100 * e->gap);
    }
    if (between > 0)
        fprintf(to, "intermediate values, added where mode shapes change fast: %d\n", between);
}
