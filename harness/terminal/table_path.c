#include "harness/terminal/terminal_impl.h"

#include <math.h>

#include "cases/scene/scene.h"
#include "elements/shared/choice.h"
#include "harness/time/time.h"

enum { MOST_STEPS = 40 };

static void corrections(FILE *to, int column, const solve_result *r, const step_record *k)
{
    paragraph words;
    FILE *list = paragraph_begin(&words, to);
    for (int j = 0; j < k->iterations; j++)
        fprintf(list, " %.0e", r->iteration[k->first + j].correction);
    paragraph_end(&words, column, column);
}

/* Returns the number of load steps. Steps of motions do not count, because their summary is printed
 * separately. */
static int steps_reported(const solve_result *r)
{
    int steps = r->steps;
    for (int i = 0; i < r->motions; i++)
        steps -= r->motion[i].at.step > 0;
    return steps;
}

void table_path_steps(FILE *to, const solve_result *r)
{
    const int steps = steps_reported(r);
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
        fprintf(to, "%4s further steps: %d; --format json contains all steps\n", "",
                steps - MOST_STEPS);
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
                fprintf(to, " %14.7g", value[6 * i + j] + 0.0);
            else
                fprintf(to, " %14s", "-");
        fputc('\n', to);
    }
}

static int has_gaps(const double value[36])
{
    for (int i = 0; i < 36; i++)
        if (!isfinite(value[i]))
            return 1;
    return 0;
}

void table_path_matrices(FILE *to, const scene *s, const solve_result *r)
{
    static const char *const motion[] = {"ux", "uy", "uz", "thx", "thy", "thz"};
    static const char *const load[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
    for (int i = 0; i < r->matrix_sets; i++) {
        const nodal_matrices *m = &r->matrices[i];
        if (m->stations == 0)
            continue;
        const size_t last = 36 * (size_t)(m->stations - 1);
        fprintf(to, "compliance of %s at path %g, %s moments, in SI units\n%s",
                scene_called(s, SCENE_NODES, m->node).text, m->path[m->stations - 1],
                scene_moments_name(m->moments),
                has_gaps(m->compliance + last)
                    ? "    -: no quantity uses this column, so it is not computed\n"
                    : "");
        matrix(to, m->compliance + last, motion, load);
        if (!isfinite(m->stiffness[last]))
            continue;
        fprintf(to, "stiffness\n");
        matrix(to, m->stiffness + last, load, motion);
    }
}

static void row_of_event(FILE *to, const path_event *e)
{
    const double least = 5e-10;
    char control[ROUNDING_TEXT], factor[ROUNDING_TEXT];
    rounding_known(e->control, fmax(e->control_error, least * fabs(e->control)), control);
    rounding_known(e->factor, fmax(e->factor_error, least * fabs(e->factor)), factor);
    fprintf(to, "%s at %s m, load factor %s", result_event_name(e->kind), control, factor);
    if (e->kind == EVENT_BRANCH_JUMP)
        fprintf(to, ": a step led to another branch, with load factor %.9g\n", e->other_factor);
    else if (e->negative_before >= 0)
        fprintf(to, ": negative pivots %d -> %d\n", e->negative_before, e->negative_after);
    else
        fputc('\n', to);
}

void table_path_events(FILE *to, const solve_result *r)
{
    for (int i = 0; i < r->events; i++)
        row_of_event(to, &r->event[i]);
}

enum { MOTION_INDENT = 2 };

/* Records [first, end) of a motion, which start with the initial state. */
typedef struct motion_extent {
    const motion_record *record;
    int first, end;
} motion_extent;

static double length_at(const motion_record *r, int of)
{
    const double *v = r->at.balance + of;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void method(FILE *to, const scene_motion *how)
{
    char name[SCENE_NAME];
    choice_name(SCENE_SCHEME_CHOICES, how->scheme, name, sizeof name);
    fprintf(to, " by %s", name);
    if (how->tolerance <= 0)
        fputs(", without a bound on the time-integration error", to);
    else if (how->scheme == SCENE_RADAU)
        fprintf(to, ", tolerance %g of the largest displacement in each step", how->tolerance);
    else
        fprintf(to, ", tolerance %g of the largest displacement", how->tolerance);
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
        fprintf(text, "; %.1f iterations per step, at most %d", (double)iterations / steps, most);
    if (last->time < end * (1 - 1e-9))
        fprintf(
            text,
            "; the motion stopped before %g s; give a smaller step, a tolerance or more elements",
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
    if (isnan(last->balance[SCENE_ENERGY])) {
        fprintf(text,
                "not computed, because the forces of elements with a history need not derive from "
                "an energy, so a gain of energy is not detected; kinetic energy at the end %.6g J, "
                "work since 0 s %.6g J",
                last->balance[SCENE_KINETIC], last->balance[SCENE_WORK]);
        paragraph_end(&words, at, MOTION_INDENT);
        return;
    }
    fprintf(text,
            "%.6g J at the end, of which %.6g J is kinetic; work since 0 s %.6g J, dissipated "
            "%.3g J; energy-balance error at most %.2g J",
            last->balance[SCENE_ENERGY], last->balance[SCENE_KINETIC], last->balance[SCENE_WORK],
            last->balance[SCENE_DISSIPATED], fabs(drift));
    if (size > 0 && drift != 0)
        fprintf(text, ", %.1e of the largest energy, at %.4g s", fabs(drift) / size, when);
    paragraph_end(&words, at, MOTION_INDENT);
}

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
        paragraph_printf(to, fprintf(to, "numerical damping: "), MOTION_INDENT,
                         "until %.4g s the integrator has dissipated %.3g J, %.2g %% of the energy "
                         "(%.3g J); use a smaller step or tolerance",
                         when, lost, 100 * part, of);
}

/* Returns the largest deviation of a vector from its initial value. */
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
    paragraph_printf(to, at, MOTION_INDENT,
                     "at the end %.6g kg m/s, and %.6g kg m^2/s about the origin; largest changes "
                     "%.2g kg m/s and %.2g kg m^2/s since %g s",
                     length_at(last, SCENE_PX), length_at(last, SCENE_LX), change_of(e, SCENE_PX),
                     change_of(e, SCENE_LX), e->record[e->first].at.time);
}

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
            paragraph_printf(to, fprintf(to, "load: "), MOTION_INDENT,
                             "the factor of %s is %g at the end of the path, but %g at the start "
                             "of the motion, so the load jumps; if it acts only in the motion, "
                             "give path: [0, 1], factor: [0, 0] in addition to its function",
                             scene_name(s, SCENE_LOADS, i).text, held, value[0]);
    }
}

void table_motion(FILE *to, const scene *s, const solve_result *r)
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
        fputs("  --format json contains every step; 'beamwork motion' measures the "
              "time-integration error\n",
              to);
}
