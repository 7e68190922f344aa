#include "harness/terminal/terminal_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/shared/choice.h"
#include "harness/model/model.h"
#include "harness/time/time.h"

/* Prints nothing if there is no motion. Reports loads that jump at the start of the motion. */
static void table_motion(FILE *to, const scene *, const solve_result *);
static void loop_lines(FILE *to, const scene *s);
static void table_path_steps(FILE *to, const solve_result *r);
/* Critical points and branch jumps of continued paths. */
static void table_path_events(FILE *to, const solve_result *r);
/* At the last station reached. */
static void table_path_matrices(FILE *to, const scene *s, const solve_result *r);

enum { NAME = 28, VALUE = 20, UNIT = 9, DIGITS = 10, INDENT = 2 };
static const double least_rounding = 1e-11, /* relative, of any computed value */
    noise = 1e-4; /* round-off relative to the scale of values that are zero */

/* Prints estimates of analytic models, which are not reference values. */
static void predictions(FILE *to, const sweep_point *p, const truths *t)
{
    for (int i = 0; i < p->scene.quantities; i++) {
        const scene_quantity *q = &p->scene.quantity[i];
        const truth *row = t != NULL ? truth_of(t, p->type, p->parameter, q->name, "same") : NULL;
        char name[SCENE_NAME + 16];
        if (q->prediction.source == NULL)
            continue;
        snprintf(name, sizeof name, "prediction %s", q->name);
        const int column = fprintf(to, "%-*s ", NAME, name) + VALUE + UNIT + 1 + 12 + 2;
        table_digits(to, VALUE, q->prediction.value, DIGITS);
        fprintf(to, " %-*s", UNIT, q->unit);
        table_percent(to, row != NULL ? verdict_error(q, q->prediction.value, row->value) : NAN);
        fputs("  ", to);
        paragraph_say(to, column, INDENT, "%s, analytic", q->prediction.source);
    }
}

/* Does the previous quantity have no value for the same reason? */
static int is_told(const solve_result *r, int index)
{
    return index > 0 && r->quantity[index - 1].status != STATUS_OK &&
           strcmp(r->quantity[index - 1].reason, r->quantity[index].reason) == 0;
}

/* Is it nothing but round-off? */
static int is_zero(const scene *s, int index, const solve_result *r)
{
    return fabs(r->quantity[index].value) < change_scale(s, index, r) * noise;
}

/* Bound of the change of a value by round-off and by refinement of the mesh. */
static double uncertainty_of(const scene *s, int index, const solve_result *r)
{
    const quantity_result *v = &r->quantity[index];
    const double scale = change_scale(s, index, r),
                 of_rounding =
                     fmax(fabs(v->value) * fmax(v->rounding, least_rounding), scale * noise),
                 of_mesh = fmax(fabs(v->value), scale) * v->change;
    return isfinite(of_mesh) ? fmax(of_rounding, of_mesh) : of_rounding;
}

/* Prints the digits that this bound allows. */
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
                        is_told(&one->cell[0].solve, index) ? "likewise" : v->reason);
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
                passed                           ? "between steps"
                : q->what.kind == SCENE_RESPONSE ? "omitted modes at most"
                                                 : "round-off",
                v->rounding);
    fputc('\n', to);
}

/* Number of load steps used, and of rejected longer steps. */
static void count_steps(const counters *c, char text[FAULT_TEXT])
{
    const char *plural = c->steps == 1 ? "" : "s";
    text[0] = '\0';
    if (c->rejected_steps > 0)
        snprintf(text, FAULT_TEXT, " in %ld load step%s (%ld longer rejected)", c->steps, plural,
                 c->rejected_steps);
    else if (c->steps > 0)
        snprintf(text, FAULT_TEXT, " in %ld load step%s", c->steps, plural);
}

/* Explains why curves end early. */
static void unfinished_curves(FILE *to, const sweep_point *p, const solve_result *r)
{
    for (int i = 0; i < r->quantities; i++) {
        const quantity_result *v = &r->quantity[i];
        if (p->scene.quantity[i].reduction != SCENE_CURVE || v->status == STATUS_OK)
            continue;
        const int column = fprintf(to, "%-*s %*s ", NAME, p->scene.quantity[i].name, VALUE, "-");
        paragraph_say(to, column, INDENT, "%s%s", is_told(r, i) ? "likewise" : v->reason,
                      v->curve.points > 0 ? "; the curve ends there" : "");
    }
}

/* What omitted modes may add to curves. */
static void bounded_curves(FILE *to, const scene *s, const solve_result *r)
{
    for (int i = 0; i < r->quantities; i++)
        if (r->quantity[i].curve.points > 0 && r->quantity[i].rounding > 1e-9)
            fprintf(to, "%-*s omitted modes at most %.1e of its largest\n", NAME,
                    s->quantity[i].name, r->quantity[i].rounding);
}

/* "ULS = 1.35 dead + 1.5 wind; ...": what acts where loads have cases. */
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

/* Initial shapes, and the analyses that do not have them. */
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

/* Does an analysis that is linear about a state hold what drives prescribe? Names these kinds. */
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

/* Is this motion the input of a response? */
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

/* "held: stage ux, driven (modal)": where a drive does not move. */
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
        paragraph_say(to, fprintf(to, "held by drives (%s): ", kinds), INDENT, "%s", words);
    free(words);
}

static int has_no_inertia(const scene_body *b)
{
    int none = b->mass > 0;
    for (int i = 0; i < 6; i++)
        none &= b->inertia[i] == 0;
    return none;
}

/* Can it turn, and has nothing that moves with it a mass away from it? */
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

/* "mass: bodies 500 kg, members 0.0125 kg": a wrong unit shows here. members [kg] */
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
    paragraph_say(to, at, INDENT,
                  "%s%s; %d elements, %d free coordinates, %ld iterations%s, "
                  "%ld factorisations, %.3g s set-up, %.3g s solution",
                  c->solve.reason[0] != '\0' ? ": " : "", c->solve.reason, c->size.elements,
                  c->size.free, c->counters.iterations, steps, c->counters.factorisations,
                  c->solve.seconds_setup, c->solve.seconds_solve);
    table_stability_paths(to, &p->scene, &c->solve);
    for (int i = 0; i < c->left_out_lines; i++)
        paragraph_write(to, fprintf(to, "eliminated: "), INDENT, c->left_out[i]);
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
    table_path_matrices(to, &p->scene, &c->solve);
    table_motion(to, &p->scene, &c->solve);
    loop_lines(to, &p->scene);
    table_path_steps(to, &c->solve);
}

enum { MOST_STEPS = 40 };

/* Writes the corrections of the iterations of a step, on several lines if there are many. */
static void corrections(FILE *to, int column, const solve_result *r, const step_record *k)
{
    paragraph words;
    FILE *list = paragraph_begin(&words, to);
    for (int j = 0; j < k->iterations; j++)
        fprintf(list, " %.0e", r->iteration[k->first + j].correction);
    paragraph_end(&words, column, column);
}

/* Number of steps to report; those of motions have a short form. */
static int steps_told(const solve_result *r)
{
    int steps = r->steps;
    for (int i = 0; i < r->motions; i++)
        steps -= r->motion[i].at.step > 0;
    return steps;
}

static void table_path_steps(FILE *to, const solve_result *r)
{
    const int steps = steps_told(r);
    if (steps <= 0)
        return;
    fprintf(to, "%4s %12s %12s %8s %6s %10s  %s\n", "step", "path", "increment", "rejected",
            "stable", "iterations", "their corrections");
    for (int i = 0; i < steps && i < MOST_STEPS; i++) {
        const step_record *k = &r->step[i];
        const int column =
            fprintf(to, "%4d %12.6g %12.4g %8d %6s %10d  ", i + 1, k->path, k->increment,
                    k->rejected, table_stability_word(k->stability), k->iterations);
        corrections(to, column, r, k);
    }
    if (steps > MOST_STEPS)
        fprintf(to, "%4s %d more steps: --format json has them all\n", "", steps - MOST_STEPS);
}

static void matrix(FILE *to, const double value[36], const char *const row[6],
                   const char *const column[6])
{
    fprintf(to, "%7s", "");
    for (int j = 0; j < 6; j++)
        fprintf(to, " %14s", column[j]);
    fputc('\n', to);
    for (int i = 0; i < 6; i++) {
        fprintf(to, "%7s", row[i]);
        for (int j = 0; j < 6; j++)
            if (isfinite(value[6 * i + j]))
                fprintf(to, " %14.7g", value[6 * i + j] + 0.0); /* no "-0" */
            else
                fprintf(to, " %14s", "-");
        fputc('\n', to);
    }
}

static void table_path_matrices(FILE *to, const scene *s, const solve_result *r)
{
    static const char *const motion[] = {"ux", "uy", "uz", "thx", "thy", "thz"};
    static const char *const load[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
    for (int i = 0; i < r->matrix_sets; i++) {
        const nodal_matrices *m = &r->matrices[i];
        if (m->stations == 0)
            continue;
        const size_t last = 36 * (size_t)(m->stations - 1);
        fprintf(to, "compliance of %s at path %g, %s moments [SI]\n",
                scene_called(s, SCENE_NODES, m->node).text, m->path[m->stations - 1],
                scene_moments_name(m->moments));
        matrix(to, m->compliance + last, motion, load);
        if (!isfinite(m->stiffness[last]))
            continue;
        fprintf(to, "stiffness\n");
        matrix(to, m->stiffness + last, load, motion);
    }
}

static void row_of_event(FILE *to, const path_event *e)
{
    fprintf(to, "%s at %.9g m, load factor %.9g", result_event_name(e->kind), e->control,
            e->factor);
    if (e->kind == EVENT_BRANCH_JUMP)
        fprintf(to, ": a step led to another branch with %.9g\n", e->other_factor);
    else if (e->negative_before >= 0)
        fprintf(to, ": negative pivots %d -> %d\n", e->negative_before, e->negative_after);
    else
        fputc('\n', to);
}

static void table_path_events(FILE *to, const solve_result *r)
{
    for (int i = 0; i < r->events; i++)
        row_of_event(to, &r->event[i]);
}

enum { MOTION_INDENT = 2 };

/* Records [first, end) of one motion, starting with the initial state. */
typedef struct motion_extent {
    const motion_record *record;
    int first, end;
} motion_extent;

static double length_at(const motion_record *r, int of)
{
    const double *v = r->at.balance + of;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Writes the integrator and its parameters. */
static void method(FILE *to, const scene_motion *how)
{
    char name[SCENE_NAME];
    choice_name(SCENE_SCHEME_CHOICES, how->scheme, name, sizeof name);
    fprintf(to, " by %s", name);
    if (how->tolerance <= 0)
        fputs(", without a bound of the time error", to);
    else if (how->scheme == SCENE_RADAU)
        fprintf(to, ", each step to %g of the largest motion", how->tolerance);
    else
        fprintf(to, " to %g of the largest motion", how->tolerance);
}

static void steps_line(FILE *to, const motion_extent *e, const scene_motion *how)
{
    const double end = how->path.value[how->path.stations - 1];
    const outcome_step *begin = &e->record[e->first].at, *last = &e->record[e->end - 1].at;
    const int steps = e->end - e->first - 1;
    double least = INFINITY, largest = 0;
    long iterations = 0, rejected = 0;
    int most = 0;
    for (int i = e->first + 1; i < e->end; i++) {
        const outcome_step *one = &e->record[i].at;
        least = fmin(least, one->step);
        largest = fmax(largest, one->step);
        iterations += one->iterations;
        rejected += one->rejected;
        most = one->iterations > most ? one->iterations : most;
    }
    const int at = fprintf(to, "motion: ");
    paragraph words;
    FILE *text = paragraph_begin(&words, to);
    fprintf(text, "%g to %g s", begin->time, last->time);
    method(text, how);
    fprintf(text, "; %d step%s", steps, steps == 1 ? "" : "s");
    if (steps > 0 && largest - least <= 1e-9 * largest)
        fprintf(text, " of %.4g s", largest);
    else if (steps > 0)
        fprintf(text, " of %.3g to %.3g s", least, largest);
    fprintf(text, ", %ld longer rejected", rejected);
    if (iterations > 0)
        fprintf(text, "; %.1f iterations a step, at most %d", (double)iterations / steps, most);
    if (last->time < end * (1 - 1e-9))
        fprintf(text, "; it ends before %g s: give a smaller step, a tolerance or more elements",
                end);
    paragraph_end(&words, at, MOTION_INDENT);
}

static void energy_line(FILE *to, const motion_extent *e)
{
    const outcome_step *last = &e->record[e->end - 1].at;
    double drift = 0, when = 0, size = 0;
    for (int i = e->first; i < e->end; i++) {
        const outcome_step *one = &e->record[i].at;
        size = fmax(size, fabs(one->balance[SCENE_ENERGY]));
        if (fabs(one->balance[SCENE_DRIFT]) > fabs(drift)) {
            drift = one->balance[SCENE_DRIFT];
            when = one->time;
        }
    }
    const int at = fprintf(to, "energy: ");
    paragraph words;
    FILE *text = paragraph_begin(&words, to);
    fprintf(text,
            "%.6g J at the end, %.6g J of it kinetic; work since the start %.6g J, dissipated "
            "%.3g J; energy-balance error at most %.2g J",
            last->balance[SCENE_ENERGY], last->balance[SCENE_KINETIC], last->balance[SCENE_WORK],
            last->balance[SCENE_DISSIPATED], fabs(drift));
    if (size > 0 && drift != 0)
        fprintf(text, ", %.1e of the largest energy, at %.4g s", fabs(drift) / size, when);
    paragraph_end(&words, at, MOTION_INDENT);
}

/* Largest energy dissipated by the integrator, relative to the largest energy. */
static void damping_line(FILE *to, const motion_extent *e)
{
    account so_far = {.largest = 0};
    double part = 0, lost = 0, of = 0, when = 0;
    for (int i = e->first; i < e->end; i++) {
        const outcome_step *one = &e->record[i].at;
        account_take(&so_far, i - e->first, one->balance);
        const double size = account_size(&so_far), missing = -one->balance[SCENE_DRIFT];
        if ((i - e->first < ACCOUNT_STEPS && i < e->end - 1) || !(missing > part * size))
            continue;
        part = missing / size;
        lost = missing;
        of = size;
        when = one->time;
    }
    if (part > account_stated)
        paragraph_say(to, fprintf(to, "numerical damping: "), MOTION_INDENT,
                      "until %.4g s the integrator has lost %.3g J of energy, %.2g %% of %.3g J; "
                      "use a smaller step or tolerance to lose less",
                      when, lost, 100 * part, of);
}

/* Largest change of a vector from its initial value. */
static double change_of(const motion_extent *e, int of)
{
    const double *begin = e->record[e->first].at.balance + of;
    double largest = 0;
    for (int i = e->first; i < e->end; i++) {
        const double *v = e->record[i].at.balance + of;
        double square = 0;
        for (int k = 0; k < 3; k++)
            square += (v[k] - begin[k]) * (v[k] - begin[k]);
        largest = fmax(largest, sqrt(square));
    }
    return largest;
}

static void momentum_line(FILE *to, const motion_extent *e)
{
    const motion_record *last = &e->record[e->end - 1];
    const int at = fprintf(to, "momenta: ");
    paragraph_say(to, at, MOTION_INDENT,
                  "%.6g kg m/s at the end, %.6g kg m^2/s about the origin; they change by at most "
                  "%.2g and %.2g from those at the start",
                  length_at(last, SCENE_PX), length_at(last, SCENE_LX), change_of(e, SCENE_PX),
                  change_of(e, SCENE_LX));
}

/* Reports a load whose factor at the end of the preceding path differs from that at the start of
 * the motion. */
static void jump_lines(FILE *to, const scene *s, int analysis, double path)
{
    for (int i = 0; i < s->loads && isfinite(path); i++) {
        const scene_load *load = &s->load[i];
        double value[3];
        if (load->function.pieces == 0 ||
            scene_acting_factor(s, scene_acting_of(s, analysis), load->load_case) == 0)
            continue;
        function_at(&load->function, 0, value);
        const double held = along_path_factor(load, path);
        if (fabs(held - value[0]) > 1e-9 * fmax(fabs(held), fabs(value[0])))
            paragraph_say(to, fprintf(to, "load: "), MOTION_INDENT,
                          "%s has factor %g where the path ends but %g where the motion begins, so "
                          "it jumps; for a load of the motion only, give path: [0, 1], factor: [0, "
                          "0] in addition to its function",
                          scene_name(s, SCENE_LOADS, i).text, held, value[0]);
    }
}

static void table_motion(FILE *to, const scene *s, const solve_result *r)
{
    motion_extent e = {.record = r->motion};
    for (e.first = 0; e.first < r->motions; e.first = e.end) {
        e.end = e.first + 1;
        while (e.end < r->motions && r->motion[e.end].analysis == r->motion[e.first].analysis)
            e.end++;
        const int analysis = r->motion[e.first].analysis;
        steps_line(to, &e, scene_motion_of(&s->analysis[analysis]));
        jump_lines(to, s, analysis, r->motion[e.first].path);
        energy_line(to, &e);
        damping_line(to, &e);
        momentum_line(to, &e);
    }
    if (r->motions > 0)
        fputs("  --format json has every step; 'beamwork motion' measures the time error\n", to);
}

/* The loops of feedback that small vibrations close. */
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
        between += !c->sample[k].asked;
        if (!c->sample[k].asked)
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
        fprintf(to, "%d intermediate values where shapes change fast\n", between);
}
