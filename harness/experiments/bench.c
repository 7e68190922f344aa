#include "harness/experiments/experiments_impl.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"
#include "harness/terminal/terminal.h"

/* Measures the times of a sweep. floor: minimum processor time [s] of a round for one cell. */
static status timing_run(sweep *s, double floor, int dense, FILE *to, fault *f);

enum { MOST = 64 };                        /* largest number of formulations */
static const double floor_seconds = 0.002; /* minimum processor time [s] of a round for a cell */

static int all_formulations(formulation out[MOST])
{
    int count = 0;
    while (formulations_at(count) != NULL && count < MOST) {
        formulation_default(formulations_at(count), &out[count]);
        count++;
    }
    return count;
}

static void leave_out_others(sweep *s, int point)
{
    for (int i = 0; i < s->seriess; i++) {
        series *one = &s->series[i];
        if (one->point == point && one->without.other && one->missing[0] == '\0')
            snprintf(one->missing, sizeof one->missing, "%s", one->without.words);
    }
}

static status plan_case(const bench_request *r, const case_type *type, sweep *s, fault *f)
{
    double parameter[CASE_MAX_PARAMETERS];
    formulation all[MOST];
    const int some = r->cells.formulations, count = some > 0 ? some : all_formulations(all);
    parameters_default(type, parameter);
    for (int k = 0; k < r->assignments; k++)
        TRY(parameters_set(type, r->assignment[k], parameter, f));
    TRY(plan_add(s, type, parameter, NULL, r->mesh, r->meshes, f));
    const sweep_point *here = &s->point[s->points - 1];
    if (here->status != STATUS_OK)
        return fault_set(f, here->status, "%s", here->reason);
    TRY(plan_extend(s, some > 0 ? r->cells.formulation : all, count, f));
    leave_out_others(s, s->points - 1);
    return narrow_to(s, r->cells.select, f);
}

static status plan_named(const bench_request *r, sweep *s, fault *f)
{
    if (r->scene != NULL)
        return plan_case(r, r->scene, s, f);
    for (int i = 0; i < r->count; i++) {
        const case_type *type = case_find(r->cases[i], f);
        TRY(type != NULL ? plan_case(r, type, s, f) : STATUS_REFUSED);
    }
    return STATUS_OK;
}

static status plan(const void *requested, void *found, fault *f)
{
    const bench_request *r = requested;
    bench *b = found;
    b->named = r->count > 0 || r->scene != NULL;
    TRY(b->named ? plan_named(r, &b->sweep, f) : plan_sweep(&r->cells, &b->truths, &b->sweep, f));
    b->sweep.threads = r->threads;
    b->made = environment_now(r->threads > 1 ? r->threads : 1);
    return STATUS_OK;
}

static status run(const void *requested, void *found, fault *f)
{
    const bench_request *r = requested;
    bench *b = found;
    return run_sweep(&r->cells, &b->sweep, f);
}

static status evaluate(const void *requested, void *found, fault *f)
{
    const bench_request *r = requested;
    bench *b = found;
    if (b->named)
        TRY(families_add_truths(&b->sweep, 0, &b->truths, f));
    TRY(evaluation_make(&b->sweep, &b->truths, 0, &b->evaluation, f));
    if (r->threads <= 1)
        rounds_pin();
    return timing_run(&b->sweep, floor_seconds, r->dense, r->cells.progress, f);
}

static experiment_cells cells(const void *found)
{
    const bench *b = found;
    return (experiment_cells){&b->sweep, &b->evaluation, &b->made};
}

static status write_table(FILE *to, const bench *b, fault *f)
{
    evaluation shown = {.verdicts = 0};
    shown.verdict = reach_verdicts(&b->sweep, &b->truths, &shown.verdicts);
    if (shown.verdict == NULL)
        return fault_memory(f, "verdicts");
    table_timing(to, &b->sweep, &shown, b->named);
    free(shown.verdict);
    return STATUS_OK;
}

static status write_form(FILE *to, const char *format, const void *found, fault *f)
{
    const bench *b = found;
    if (format[0] == 'j')
        return json_timing_write(to, &b->sweep, &b->evaluation, &b->made, f);
    if (format[0] != 'c')
        return write_table(to, b, f);
    csv_timing(to, &b->sweep, &b->evaluation);
    return STATUS_OK;
}

void bench_free(bench *b)
{
    evaluation_free(&b->evaluation);
    sweep_free(&b->sweep);
    truths_free(&b->truths);
}

const experiment_type experiment_bench = {.name = "bench",
                                          .plan = plan,
                                          .run = run,
                                          .evaluate = evaluate,
                                          .cells = cells,
                                          .write = write_form};

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

/* [s] longest complete run; the time of a longer run is extrapolated from the time of one
 * iteration */
static const double longest_dense = 1;
enum {
    MOST_UNKNOWNS = 3000
}; /* largest number of unknowns; the matrix takes 72 MB, and an iteration takes a few seconds */

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
    if (seconds > 0) {
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
        return;
    if (out->unknowns == 0 || out->iteration < longest_dense)
        sample(&dense, out);
    if (out->unknowns > 0 && out->iteration * (double)iterations <= longest_dense)
        rounds_run(&dense, floor, &out->whole);
}

/* [s] longest run that is repeated at points other than the default point */
static const double longest_elsewhere = 0.05;

static int at_defaults(const sweep *s, const series *one)
{
    return strcmp(s->point[one->point].name, "default") == 0;
}

static int can_run(const sweep *s, const series *one, int mesh)
{
    const solve_result *r = &one->cell[mesh].solve;
    return one->missing[0] == '\0' && s->point[one->point].status == STATUS_OK &&
           r->status != STATUS_FAULT &&
           (s->points == 1 || at_defaults(s, one) ||
            r->seconds_setup + r->seconds_solve < longest_elsewhere);
}

/* Returns the index of the middle mesh or, if it has no solution, of the next coarser mesh with a
 * solution. -1: there is none, or the point is not the default point. */
static int mesh_kept_whole(const sweep *s, const series *one)
{
    if (!at_defaults(s, one))
        return -1;
    int mesh = one->meshes / 2;
    while (mesh > 0 && one->cell[mesh].solve.status != STATUS_OK)
        mesh--;
    return one->meshes > 0 && one->cell[mesh].solve.status == STATUS_OK ? mesh : -1;
}

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

static void read_phases(const cell_request *as_is, cell_timing *out)
{
    const double longest = 0.3;
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

static status timing_run(sweep *s, double floor, int dense, FILE *to, fault *f)
{
    progress line = progress_begin(to, "times of points", s->points, clock_wall_seconds());
    char what[PARAMETERS_TEXT + SCENE_NAME];
    for (int i = 0; i < s->seriess; i++) {
        s->series[i].timing = calloc((size_t)s->series[i].meshes + 1, sizeof *s->series[i].timing);
        if (s->series[i].timing == NULL)
            return fault_memory(f, "times");
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
    sched_setaffinity(0, sizeof only, &only);
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
        execv("/proc/self/exe", arguments);
}

enum { LEAST_PAIRS = 51, MOST_PAIRS = 1001, WARM_UP = 3 };
static const double tail = 0.0005, least_difference = 0.02;

const char *against_name(against_outcome o)
{
    switch (o) {
    case AGAINST_FASTER:
        return "faster";
    case AGAINST_SLOWER:
        return "slower";
    case AGAINST_UNDECIDED:
        break;
    }
    return "undecided";
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Returns k such that the median lies between the k-th smallest and the k-th largest of n draws,
 * except with probability 2 P(Binomial(n, 1/2) < k). */
static int rank_of_interval(int pairs)
{
    int k = 0;
    while (k < pairs / 2 && gsl_cdf_binomial_P((unsigned)k, 0.5, (unsigned)pairs) <= tail)
        k++;
    return k;
}

against_times against_evaluate(int pairs, const double a[], const double b[])
{
    against_times out = {
        .pairs = pairs, .a = INFINITY, .b = INFINITY, .ratio = NAN, .low = 0, .high = INFINITY};
    double *ratio = malloc(((size_t)pairs + 1) * sizeof *ratio);
    for (int i = 0; i < pairs; i++) {
        out.a = fmin(out.a, a[i]);
        out.b = fmin(out.b, b[i]);
        if (ratio != NULL)
            ratio[i] = b[i] / a[i];
    }
    if (ratio == NULL || pairs < 1) {
        free(ratio);
        return out; /* undecided */
    }
    qsort(ratio, (size_t)pairs, sizeof *ratio, ascending);
    const int k = rank_of_interval(pairs);
    out.ratio = (ratio[(pairs - 1) / 2] + ratio[pairs / 2]) / 2;
    if (k > 0) {
        out.low = ratio[k - 1];
        out.high = ratio[pairs - k];
    }
    if (out.low > 1 + least_difference)
        out.outcome = AGAINST_SLOWER;
    else if (out.high < 1 / (1 + least_difference))
        out.outcome = AGAINST_FASTER;
    free(ratio);
    return out;
}

static status lap_pair(against_lap *lap, void *a, void *b, int b_first, double *seconds_a,
                       double *seconds_b, fault *f)
{
    TRY(b_first ? lap(b, seconds_b, f) : lap(a, seconds_a, f));
    return b_first ? lap(a, seconds_a, f) : lap(b, seconds_b, f);
}

status against_run(against_lap *lap, void *a, void *b, double budget, against_times *out, fault *f)
{
    double seconds_a[MOST_PAIRS], seconds_b[MOST_PAIRS], least = INFINITY;
    for (int i = 0; i < WARM_UP; i++) {
        const double start = clock_wall_seconds();
        TRY(lap_pair(lap, a, b, i % 2, &seconds_a[0], &seconds_b[0], f));
        least = fmin(least, clock_wall_seconds() - start);
    }
    const int pairs = (int)fmax(LEAST_PAIRS, fmin(MOST_PAIRS, budget / least));
    for (int i = 0; i < pairs; i++)
        TRY(lap_pair(lap, a, b, i % 2, &seconds_a[i], &seconds_b[i], f));
    *out = against_evaluate(pairs, seconds_a, seconds_b);
    return STATUS_OK;
}

static section_spec profiles_matrices(double unit)
{
    static const double stiff[6] = {5e6, 2e6, 1.7e6, 90, 130, 480},
                        part[15] = {0.2,  -0.1, 0.3, 0.15, -0.2, 0.1,  -0.15, 0.2,
                                    -0.3, 0.25, 0.1, -0.1, 0.4,  -0.2, 0.1};
    const double m = 0.7 * unit, y = 0.011 / unit, z = -0.007 / unit, r = 1e-4 / (unit * unit);
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    double *C = spec.constants.stiffness, *M = spec.constants.mass;
    for (int i = 0, k = 0; i < 6; i++) {
        C[7 * i] = stiff[i] / (i < 3 ? 1 : unit * unit);
        for (int j = 0; j < i; j++, k++)
            C[6 * i + j] = C[6 * j + i] = part[k] * sqrt(C[7 * i] * C[7 * j]);
    }
    M[0] = M[7] = M[14] = m;
    M[4] = M[24] = m * z;
    M[9] = M[19] = -M[4];
    M[15] = M[20] = m * y;
    M[5] = M[30] = -M[15];
    M[21] = m * (y * y + z * z) + 3 * m * r;
    M[28] = m * z * z + 2 * m * r;
    M[35] = m * y * y + m * r;
    M[29] = M[34] = -m * y * z + 0.3 * m * r;
    return spec;
}

static section_spec rectangle(double unit)
{
    section_spec spec = section_spec_rectangle(210e9 * unit * unit, 80.7e9 * unit * unit,
                                               0.0371 / unit, 0.0123 / unit);
    spec.shear_factor[0] = spec.shear_factor[1] = 0.847;
    return spec;
}

static section_spec open_walls(double unit)
{
    static const double at[4][2] = {{0, 0}, {0.031, 0}, {0.031, 0.057}, {0.012, 0.057}},
                        thick[3] = {0.0013, 0.002, 0.0027};
    double point[4][2], thickness[3];
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            point[i][k] = at[i][k] / unit;
    for (int i = 0; i < 3; i++)
        thickness[i] = thick[i] / unit;
    return section_spec_walls(210e9 * unit * unit, 80.7e9 * unit * unit, 3,
                              (const double(*)[2])point, NULL, thickness);
}

status profiles_section(profiles_form form, double unit, section *out, fault *f)
{
    section_spec spec = form == PROFILES_MATRICES      ? profiles_matrices(unit)
                        : form == PROFILES_UNSYMMETRIC ? open_walls(unit)
                                                       : rectangle(unit);
    if (form != PROFILES_MATRICES)
        spec.density = 7850 * unit * unit * unit;
    TRY(section_compute(&spec, out, f));
    if (form == PROFILES_UNSYMMETRIC)
        out->Iw = out->A * pow(0.2 / unit, 4);
    return STATUS_OK;
}
