/* Sweeps in several processes must give the same results for any number of jobs. */
#include <gsl/gsl_test.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/study/study.h"
#include "harness/study/test/ending.h"

enum { END = 900 }; /* [s] */

static void crashes(int end, int jobs, const char *reason)
{
    static const int mesh[] = {1, 2, 3};
    const formulation chosen = ending_bad(end, 0);
    const int endless = end == HANGING || end == STOPPED;
    const sweep_request request = {.jobs = jobs, .time_limit = endless ? 1 : 0};
    const status expected = endless ? STATUS_TIME_LIMIT : STATUS_FAULT;
    double value[CASE_MAX_PARAMETERS] = {0};
    sweep s;
    fault f = {""};
    parameters_default(registry_cases[0], value);
    gsl_test(plan_one(registry_cases[0], value, &chosen, 1, mesh, 3, &s, &f) != STATUS_OK,
             "planned %s", f.text);
    gsl_test(run_sweep(&request, &s, &f) != STATUS_OK, "the sweep survives %s", f.text);
    for (int i = 0; i < 3; i++)
        gsl_test(s.series[0].cell[i].solve.status != expected ||
                     strcmp(s.series[0].cell[i].solve.reason, reason) != 0,
                 "%d jobs: %s", jobs, s.series[0].cell[i].solve.reason);
    sweep_free(&s);
}

static void together(int end, int dies)
{
    static const int mesh[] = {1};
    const formulation chosen = ending_bad(end, 0);
    const sweep_request request = {.jobs = 1, .time_limit = end == HANGING, .together = 1};
    double value[CASE_MAX_PARAMETERS] = {0};
    int how = 0;
    const pid_t child = fork();
    if (child == 0) {
        sweep s;
        parameters_default(registry_cases[0], value);
        const int good =
            plan_one(registry_cases[0], value, &chosen, 1, mesh, 1, &s, NULL) == STATUS_OK &&
            run_sweep(&request, &s, NULL) == STATUS_OK;
        sweep_free(&s);
        _exit(good ? 0 : 1);
    }
    gsl_test(waitpid(child, &how, 0) != child, "a process");
    gsl_test_int(WIFSIGNALED(how) ? WTERMSIG(how) : 0, dies ? SIGKILL : 0, "end %d", end);
    gsl_test_int(dies || WEXITSTATUS(how) == 0, 1, "end %d: a result", end);
}

static int same_results(const sweep *a, const sweep *b)
{
    int same = a->seriess == b->seriess;
    for (int i = 0; i < a->seriess && same; i++)
        for (int k = 0; k < a->series[i].meshes && same; k++) {
            const solve_result *x = &a->series[i].cell[k].solve, *y = &b->series[i].cell[k].solve;
            same = x->status == y->status && x->quantities == y->quantities && x->steps == y->steps;
            for (int q = 0; q < x->quantities && same; q++)
                same = memcmp(&x->quantity[q].value, &y->quantity[q].value, sizeof(double)) == 0;
        }
    return same;
}

static void jobs(void)
{
    static const int mesh[] = {1, 2, 4};
    double value[CASE_MAX_PARAMETERS] = {0};
    formulation chosen[8];
    int count = 0;
    sweep s[2];
    fault f = {""};
    for (; registry_formulations[count] != NULL && count < 8; count++)
        formulation_default(registry_formulations[count], &chosen[count]);
    parameters_default(registry_cases[0], value);
    for (int i = 0; i < 2; i++) {
        const sweep_request request = {.jobs = 1 + 3 * i};
        gsl_test(plan_one(registry_cases[0], value, chosen, count, mesh, 3, &s[i], &f) !=
                         STATUS_OK ||
                     run_sweep(&request, &s[i], &f) != STATUS_OK,
                 "%d jobs %s", request.jobs, f.text);
    }
    gsl_test(sweep_cells(&s[0]) == 0, "%d cells", sweep_cells(&s[0]));
    gsl_test(!same_results(&s[0], &s[1]), "bit for bit the same with one and with four jobs");
    sweep_free(&s[0]);
    sweep_free(&s[1]);
}

typedef struct follower_log {
    int passed, disorder, unfinished, measured;
    int most; /* number of series that the follower accepts before it fails */
} follower_log;

static int needs_scatter(void *context, const sweep *s, int series_index)
{
    follower_log *log = context;
    (void)s;
    log->measured++;
    return series_index % 2;
}

static status is_passed(void *context, const sweep *s, int series_index, fault *f)
{
    follower_log *log = context;
    const series *one = &s->series[series_index];
    log->disorder += series_index != log->passed++;
    for (int k = 0; k < one->meshes && one->missing[0] == '\0'; k++)
        log->unfinished += one->cell[k].solve.quantities == 0;
    log->unfinished += one->missing[0] == '\0' && (one->noise != NULL) != (series_index % 2);
    return log->passed <= log->most ? STATUS_OK : fault_set(f, STATUS_REFUSED, "enough");
}

static void followed(int jobs, int most)
{
    static const int mesh[] = {1, 2, 4};
    double value[CASE_MAX_PARAMETERS] = {0};
    formulation chosen[64];
    int count = 0, runs = 0;
    sweep s;
    fault f = {""};
    for (; registry_formulations[count] != NULL; count++)
        formulation_default(registry_formulations[count], &chosen[count]);
    parameters_default(registry_cases[0], value);
    follower_log log = {.most = most < count ? most : count};
    const sweep_follower follower = {&log, needs_scatter, is_passed};
    const sweep_request request = {.jobs = jobs, .share = 1, .follower = &follower};
    gsl_test(plan_one(registry_cases[0], value, chosen, count, mesh, 3, &s, &f) != STATUS_OK,
             "planned %s", f.text);
    const status outcome = run_sweep(&request, &s, &f);
    for (int i = 0; i < count; i++)
        runs += s.series[i].missing[0] == '\0';
    gsl_test(outcome != (most < count ? STATUS_REFUSED : STATUS_OK), "%d jobs: %s", jobs, f.text);
    gsl_test_int(log.passed, most < count ? most + 1 : count, "%d jobs: told of all", jobs);
    gsl_test_int(log.disorder, 0, "%d jobs: in their order", jobs);
    gsl_test_int(log.unfinished, 0, "%d jobs: with cells and noise", jobs);
    gsl_test(most >= count && log.measured != runs, "%d jobs: asked of %d series, not %d", jobs,
             runs, log.measured);
    sweep_free(&s);
}

static status build_in_plan(const double value[], scene *s, fault *f)
{
    double defaults[CASE_MAX_PARAMETERS] = {0};
    if (getpid() != (pid_t)value[0])
        return fault_set(f, STATUS_REFUSED, "the scene is built once more");
    parameters_default(registry_cases[0], defaults);
    return case_build(registry_cases[0], defaults, s, f);
}

static void cells_share_a_scene(void)
{
    static const parameter_type planner[] = {
        {"planner", "1", 0, 0, 1e12, NULL, "the process that may build the scene"}, {0}};
    static const case_type once = {.name = "once",
                                   .summary = "a case of the test",
                                   .source = "none",
                                   .parameters = {planner},
                                   .build = build_in_plan};
    static const int mesh[] = {1, 2, 3};
    const double value[CASE_MAX_PARAMETERS] = {(double)getpid()};
    const formulation chosen = ending_good();
    const sweep_request request = {.jobs = 1};
    sweep s;
    fault f = {""};
    gsl_test(plan_one(&once, value, &chosen, 1, mesh, 3, &s, &f) != STATUS_OK, "%s", f.text);
    gsl_test(run_sweep(&request, &s, &f) != STATUS_OK, "%s", f.text);
    for (int i = 0; i < 3; i++)
        gsl_test(s.series[0].cell[i].solve.status != STATUS_OK, "cell %d %s", i,
                 s.series[0].cell[i].solve.reason);
    sweep_free(&s);
}

int main(void)
{
    signal(SIGINT, SIG_DFL);
    alarm(END);
    crashes(KILLED, 1, "crashed with signal 9");
    crashes(KILLED, 2, "crashed with signal 9");
    crashes(ENDED, 2, "the worker process ended with status 3");
    crashes(HANGING, 3, "time limit: there was no result within 1 s");
    crashes(STOPPED, 2, "time limit: there was no result within 1 s");
    together(KILLED, 1);
    together(ENDED, 0);
    together(HANGING, 0);
    jobs();
    for (int i = 1; i < 6; i += 2) {
        followed(i, 64);
        followed(i, 2);
    }
    cells_share_a_scene();
    return gsl_test_summary();
}
