#include "harness/experiments/timing.h"

#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"
#include "harness/study/study.h"

void rounds_run(const cell_request *request, double floor, rounds_reading *out)
{
    double least = INFINITY, spent = 0;
    for (int i = 0; out->rounds < ROUNDS_COUNT && (i == 0 || spent < floor); i++) {
        cell_result cell;
        fault f = {""};
        cell_run(request, &cell, &f);
        const double total = cell.solve.seconds_setup + cell.solve.seconds_solve;
        if (total < fmin(least, rounds_least(out))) {
            out->setup = cell.solve.seconds_setup;
            out->solve = cell.solve.seconds_solve;
        }
        least = fmin(least, total);
        spent += fmax(total, 1e-6);
        out->repeats++;
        cell_result_free(&cell);
    }
    if (out->rounds < ROUNDS_COUNT)
        out->round[out->rounds++] = least;
}

/* [s] of a whole run; longer ones are counted from one iteration */
static const double longest_dense = 1;
enum { MOST_UNKNOWNS = 3000 }; /* 72 MB; a few seconds per iteration */

/* Coordinates, strains and stresses. */
static int unknowns_of(const cell_result *cell)
{
    return cell->size.free + 2 * cell->size.strains * cell->size.elements;
}

static void sample(const cell_request *dense, dense_reference *out)
{
    cell_request one = *dense;
    cell_result cell;
    fault f = {""};
    double seconds = 0;
    one.solve.sample = one.solve.phases = 1;
    if (cell_run(&one, &cell, &f) == STATUS_OK)
        for (int k = 0; k < PHASE_REST; k++)
            seconds += cell.solve.phase[k];
    if (seconds > 0) { /* a path that is continued has no dense form: nothing was sampled */
        out->iteration = out->unknowns > 0 ? fmin(out->iteration, seconds) : seconds;
        out->unknowns = unknowns_of(&cell);
    }
    cell_result_free(&cell);
}

void dense_reference_round(const cell_request *own, const cell_result *cell, double floor,
                           dense_reference *out)
{
    const long iterations = cell->counters.iterations;
    cell_request dense = *own;
    dense.solve.newton = NEWTON_DENSE;
    if (iterations == 0 || unknowns_of(cell) > MOST_UNKNOWNS)
        return; /* a linear problem, or one too large */
    if (out->unknowns == 0 || out->iteration < longest_dense)
        sample(&dense, out);
    if (out->unknowns > 0 && out->iteration * (double)iterations <= longest_dense)
        rounds_run(&dense, floor, &out->whole);
}

static const double longest_elsewhere = 0.05; /* [s] of one run */

static int at_defaults(const sweep *s, const series *one)
{
    return strcmp(s->point[one->point].name, "default") == 0;
}

/* Beside the defaults a long cell keeps the time of its one run, and rounds are short. */
static int can_run(const sweep *s, const series *one, int mesh)
{
    const solve_result *r = &one->cell[mesh].solve;
    return one->missing[0] == '\0' && s->point[one->point].status == STATUS_OK &&
           r->status != STATUS_FAULT &&
           (s->points == 1 || at_defaults(s, one) ||
            r->seconds_setup + r->seconds_solve < longest_elsewhere);
}

/* The middle mesh that has a solution, or -1. */
static int mesh_kept_whole(const sweep *s, const series *one)
{
    if (!at_defaults(s, one))
        return -1;
    int mesh = one->meshes / 2;
    while (mesh > 0 && one->cell[mesh].solve.status != STATUS_OK)
        mesh--;
    return one->meshes > 0 && one->cell[mesh].solve.status == STATUS_OK ? mesh : -1;
}

/* Both in turn: the difference of their times is what leaving out saves. */
static void round_kept_whole(const cell_request *as_is, double floor, cell_timing *out)
{
    cell_request whole = *as_is;
    whole.keep_all = 1;
    if (out->free_keep_all == 0) {
        cell_result cell;
        fault f = {""};
        const status outcome = cell_run(&whole, &cell, &f);
        out->free_keep_all = outcome == STATUS_OK ? cell.size.free : -1;
        cell_result_free(&cell);
    }
    if (out->free_keep_all > 0)
        rounds_run(&whole, floor, &out->keep_all);
}

static double sum_of(const double part[PHASES])
{
    double sum = 0;
    for (int k = 0; k < PHASES; k++)
        sum += part[k];
    return sum;
}

/* One run with readings between the parts of the iterations; the fastest of all rounds stays. Long
 * cells have one in the last round. */
static void read_phases(const cell_request *as_is, cell_timing *out)
{
    const double longest = 0.3; /* [s] */
    cell_request request = *as_is;
    cell_result cell;
    fault f = {""};
    if (out->as_is.rounds < ROUNDS_COUNT && rounds_least(&out->as_is) > longest)
        return;
    request.solve.phases = 1;
    cell_run(&request, &cell, &f);
    if (sum_of(out->phase) == 0 || sum_of(cell.solve.phase) < sum_of(out->phase))
        memcpy(out->phase, cell.solve.phase, sizeof out->phase);
    cell_result_free(&cell);
}

static void round_of_series(sweep *s, int index, double floor, int dense)
{
    series *one = &s->series[index];
    const int whole = mesh_kept_whole(s, one);
    const double here = s->points == 1 || at_defaults(s, one) ? floor : 0;
    for (int i = 0; i < one->meshes; i++) {
        if (!can_run(s, one, i))
            continue;
        const cell_request request = sweep_cell(s, index, i);
        rounds_run(&request, here, &one->timing[i].as_is);
        if (i == whole)
            round_kept_whole(&request, floor, &one->timing[i]);
        if (one->cell[i].counters.iterations > 0 && here > 0)
            read_phases(&request, &one->timing[i]);
        if (dense)
            dense_reference_round(&request, &one->cell[i], floor, &one->timing[i].dense);
    }
}

status timing_run(sweep *s, double floor, int dense, FILE *to, fault *f)
{
    progress line = progress_begin(to, "times of points", s->points, clock_wall_seconds());
    char what[PARAMETERS_TEXT + SCENE_NAME];
    for (int i = 0; i < s->seriess; i++) {
        s->series[i].timing = calloc((size_t)s->series[i].meshes + 1, sizeof *s->series[i].timing);
        if (s->series[i].timing == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for times");
    }
    for (int p = 0; p < s->points; p++) {
        snprintf(what, sizeof what, "%s %s", s->point[p].type->name, s->point[p].text);
        progress_show(&line, clock_wall_seconds(), p, (double)p / s->points, what);
        for (int round = 0; round < ROUNDS_COUNT; round++)
            for (int i = 0; i < s->seriess; i++)
                if (s->series[i].point == p)
                    round_of_series(s, i, floor, dense);
    }
    progress_end(&line);
    return STATUS_OK;
}

void rounds_pin(void)
{
    const int here = sched_getcpu();
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(here >= 0 ? here : 0, &only);
    sched_setaffinity(0, sizeof only, &only); /* without it the readings are only noisier */
}

void rounds_single_thread(char **arguments)
{
    static const char *const threads[] = {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS",
                                          "MKL_NUM_THREADS", "BLIS_NUM_THREADS"};
    enum { LIBRARIES = sizeof threads / sizeof threads[0] };
    int single = 1;
    for (int i = 0; i < LIBRARIES; i++) {
        single &= getenv(threads[i]) != NULL && strcmp(getenv(threads[i]), "1") == 0;
        setenv(threads[i], "1", 1);
    }
    if (!single)
        /* returns only where there is no /proc: then libraries decide */
        execv("/proc/self/exe", arguments);
}
