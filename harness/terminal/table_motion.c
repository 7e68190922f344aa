#include "harness/terminal/table_motion.h"

#include <math.h>

#include "cases/scene/along_path.h"
#include "cases/scene/names.h"
#include "elements/shared/choice.h"
#include "harness/terminal/paragraph.h"
#include "harness/time/time.h"

enum { MOTION_INDENT = 2 };

/* Records [first, end) of one motion, the begin first. */
typedef struct motion_extent {
    const motion_record *record;
    int first, end;
} motion_extent;

static double length_at(const motion_record *r, int of)
{
    const double *v = r->at.balance + of;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* By what, and how well. */
static void method(FILE *to, const scene_motion *how)
{
    char name[SCENE_NAME];
    choice_name(SCENE_SCHEME_CHOICES, how->scheme, name, sizeof name);
    fprintf(to, " by %s", name);
    if (how->tolerance <= 0)
        fputs(", whose error of time nothing bounds", to);
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

/* Energy that the integrator has lost, the largest part of what there was. */
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
                      "less with a smaller step or tolerance",
                      when, lost, 100 * part, of);
}

/* How far a vector moves from what it is at the begin. */
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
                  "%.6g kg m/s at the end, %.6g kg m^2/s about the origin; they move by at most "
                  "%.2g and %.2g from those at the start",
                  length_at(last, SCENE_PX), length_at(last, SCENE_LX), change_of(e, SCENE_PX),
                  change_of(e, SCENE_LX));
}

/* A load that the path before the motion ends with at one factor, and the motion begins with at
 * another one. */
static void jump_lines(FILE *to, const scene *s, double path)
{
    for (int i = 0; i < s->loads && isfinite(path); i++) {
        const scene_load *load = &s->load[i];
        double value[3];
        if (load->function.pieces == 0)
            continue;
        function_at(&load->function, 0, value);
        const double held = along_path_factor(load, path);
        if (fabs(held - value[0]) > 1e-9 * fmax(fabs(held), fabs(value[0])))
            paragraph_say(to, fprintf(to, "load: "), MOTION_INDENT,
                          "%s is at factor %g where the path ends, at %g where the motion begins: "
                          "it jumps; one that acts in the motion only has path: [0, 1], factor: "
                          "[0, 0] beside its function",
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
        jump_lines(to, s, r->motion[e.first].path);
        energy_line(to, &e);
        damping_line(to, &e);
        momentum_line(to, &e);
    }
    if (r->motions > 0)
        fputs("  --format json has every step; 'beamwork motion' measures the error of "
              "time\n",
              to);
}
