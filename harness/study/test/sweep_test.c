/* Sweeps in several processes: the same answers whatever the number of jobs; crashes and endless
 * cells as results; no process outlives the one that started it; who asks to end keeps what is
 * finished. Nothing here depends on the machine's speed: every step waits for an event, and END and
 * WAIT only bound a test that would never end. */
#include <gsl/gsl_test.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "harness/catalogue/registry.h"
#include "harness/model/missing.h"
#include "harness/study/interrupt.h"
#include "harness/study/plan.h"
#include "harness/study/run.h"
#include "harness/study/sweep.h"

enum { END = 900, WAIT = 120 }; /* [s] */
enum { KILLED, ENDED, HANGING, STOPPED };
static void never_end(int says)
{
    const pid_t self = getpid();
    if (says > 0 && write(says, &self, sizeof self) != (ssize_t)sizeof self)
        _exit(4);
    for (;;)
        pause();
}

/* The formulation that runs on the first case. */
static formulation runner(void)
{
    formulation chosen;
    double value[CASE_MAX_PARAMETERS] = {0};
    scene s;
    char words[200];
    scene_init(&s, "test");
    parameters_default(registry_cases[0], value);
    registry_cases[0]->build(value, &s, NULL);
    int i = 0;
    while (registry_formulations[i + 1] != NULL &&
           missing_words(&s, registry_formulations[i], words, sizeof words))
        i++;
    scene_free(&s);
    formulation_default(registry_formulations[i], &chosen);
    return chosen;
}

/* The same with another end of the process that sets up its elements: that of a cell. */
static struct {
    element_type type;
    status (*prepare)(const element_request *, element_data *, fault *);
    int end, says; /* says: where a cell that never ends says its process */
} ending;

static status prepare_end(const element_request *request, element_data *data, fault *f)
{
    if (ending.end == KILLED)
        raise(SIGKILL);
    if (ending.end == ENDED)
        _exit(3);
    if (ending.end == HANGING)
        never_end(ending.says);
    if (ending.end == STOPPED) /* its own alarm has to wait */
        raise(SIGSTOP);
    return ending.prepare(request, data, f);
}

static formulation ending_runner(int end, int says)
{
    formulation out = runner();
    ending.type = *out.type;
    ending.prepare = out.type->prepare;
    ending.end = end;
    ending.says = says;
    ending.type.prepare = prepare_end;
    out.type = &ending.type;
    return out;
}

static void crashes(int end, int jobs, const char *reason)
{
    static const int mesh[] = {1, 2, 3};
    const formulation chosen = ending_runner(end, 0);
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

/* A process that runs a sweep of cells that never end, and what they say of themselves. */
typedef struct family {
    pid_t parent;
    int says;
} family;

/* Child: its exit code is 0 when `sound` cells, then endless ones, gave what the request asks for.
 */
static int run_endless(const sweep_request *request, int sound, int says)
{
    static const int mesh[] = {1, 2, 3};
    const formulation good = runner(), endless = ending_runner(HANGING, says);
    double value[CASE_MAX_PARAMETERS] = {0};
    sweep s = {0};
    fault f = {""};
    parameters_default(registry_cases[0], value);
    status outcome = plan_add(&s, registry_cases[0], value, NULL, mesh, 3, &f);
    if (outcome == STATUS_OK && sound)
        outcome = plan_extend(&s, &good, 1, &f);
    if (outcome == STATUS_OK)
        outcome = plan_extend(&s, &endless, 1, &f);
    if (outcome != STATUS_OK || run_sweep(request, &s, &f) != STATUS_OK)
        return 1;
    int right = request->interruptible ? s.seriess == sound && s.unfinished == 3
                                       : s.seriess == 1 + sound && s.unfinished == 0;
    for (int i = 0; i < s.seriess; i++)
        for (int k = 0; k < 3; k++)
            right = right &&
                    (s.series[i].cell[k].solve.status == STATUS_TIME_LIMIT) == (i >= sound) &&
                    (s.series[i].cell[k].solve.quantities > 0) == (i < sound);
    sweep_free(&s);
    return right ? 0 : 2;
}

static family begin_family(const sweep_request *request, int sound)
{
    int ends[2];
    family out = {-1, -1};
    if (pipe(ends) != 0 || (out.parent = fork()) < 0)
        return out;
    if (out.parent == 0) {
        close(ends[0]);
        _exit(run_endless(request, sound, ends[1]));
    }
    close(ends[1]);
    out.says = ends[0];
    return out;
}

/* The process of a cell that has begun; 0: all who could say so are gone; -1: nothing happens. */
static pid_t next_cell(const family *of)
{
    struct pollfd end = {.fd = of->says, .events = POLLIN};
    pid_t process = 0;
    if (poll(&end, 1, 1000 * WAIT) <= 0)
        return -1;
    return read(of->says, &process, sizeof process) == (ssize_t)sizeof process ? process : 0;
}

static int exit_code(pid_t process)
{
    int how = 0;
    return waitpid(process, &how, 0) == process && WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

/* Whoever is killed takes his workers along. */
static void orphans(void)
{
    const sweep_request request = {.jobs = 2};
    const family of = begin_family(&request, 0);
    const pid_t first = next_cell(&of), second = next_cell(&of);
    gsl_test(first <= 0 || second <= 0 || first == second, "two workers are at their cells");
    kill(of.parent, SIGKILL);
    exit_code(of.parent);
    const int gone = next_cell(&of) == 0;
    gsl_test(!gone, "nobody holds the pipe any more: the workers went with their parent");
    if (!gone && first > 0 && second > 0) {
        kill(first, SIGKILL);
        kill(second, SIGKILL);
    }
    close(of.says);
}

static char state_of(pid_t process)
{
    char path[64], state = 'X';
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
    FILE *file = fopen(path, "r");
    if (file == NULL || fscanf(file, "%*d (%*[^)]) %c", &state) != 1)
        state = 'X';
    if (file != NULL)
        fclose(file);
    return state;
}

/* A worker keeps the limit when nobody looks at it. */
static void own_limit(void)
{
    const sweep_request request = {.jobs = 1, .time_limit = 1};
    const family of = begin_family(&request, 0);
    const pid_t cell = next_cell(&of);
    gsl_test(cell <= 0, "a worker is at its cell");
    kill(of.parent, SIGSTOP);
    char state = 'R';
    for (int i = 0; i < 100 * WAIT && cell > 0 && state != 'X' && state != 'Z'; i++) {
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
        state = state_of(cell);
    }
    gsl_test(state != 'X' && state != 'Z', "it has ended while its parent is stopped (%c)", state);
    if (state != 'X' && state != 'Z' && cell > 0)
        kill(cell, SIGKILL);
    kill(of.parent, SIGCONT);
    gsl_test_int(exit_code(of.parent), 0, "and its parent says that the limit was reached");
    close(of.says);
}

/* Asked to end, a run keeps the series that are finished, and only those. */
static void interrupted(int number)
{
    const sweep_request request = {.jobs = 1, .interruptible = 1};
    const family of = begin_family(&request, 1);
    gsl_test(next_cell(&of) <= 0, "three cells are done, the fourth has begun");
    kill(of.parent, number);
    gsl_test_int(exit_code(of.parent), 0,
                 "signal %d: one series of two is left, three cells are not done", number);
    gsl_test_int(next_cell(&of), 0, "signal %d: no worker is left", number);
    close(of.says);
}

static int is_asked(const interrupt *i)
{
    struct pollfd end = {.fd = i->descriptor, .events = POLLIN};
    return poll(&end, 1, 0) > 0;
}

/* What is ignored (nohup) is no request; afterwards everything is as before. */
static void requests(void)
{
    interrupt i;
    sigset_t after;
    interrupt_begin(&i);
    gsl_test(i.descriptor < 0 || is_asked(&i), "nobody asks");
    raise(SIGTERM);
    gsl_test(!is_asked(&i), "somebody does, and is not obeyed at once");
    interrupt_end(&i);
    signal(SIGHUP, SIG_IGN);
    interrupt_begin(&i);
    raise(SIGHUP);
    gsl_test(is_asked(&i), "an ignored signal is no request");
    interrupt_end(&i);
    signal(SIGHUP, SIG_DFL);
    sigprocmask(SIG_SETMASK, NULL, &after);
    gsl_test(sigismember(&after, SIGINT) || sigismember(&after, SIGTERM),
             "the mask is the one of before");
}

/* The first case of the registry, in the planning process only. */
static status build_in_plan(const double value[], scene *s, fault *f)
{
    double defaults[CASE_MAX_PARAMETERS] = {0};
    if (getpid() != (pid_t)value[0])
        return fault_set(f, STATUS_REFUSED, "the scene is built once more");
    parameters_default(registry_cases[0], defaults);
    return registry_cases[0]->build(defaults, s, f);
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
    const formulation chosen = runner();
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
    signal(SIGINT, SIG_DFL); /* a shell's background job ignores it, and what is ignored stays so */
    alarm(END);
    crashes(KILLED, 1, "crashed with signal 9");
    crashes(KILLED, 2, "crashed with signal 9");
    crashes(ENDED, 2, "its process ended with status 3");
    crashes(HANGING, 3, "time limit: no result after 1 s");
    crashes(STOPPED, 2, "time limit: no result after 1 s");
    orphans();
    own_limit();
    interrupted(SIGINT);
    interrupted(SIGTERM);
    requests();
    jobs();
    cells_share_a_scene();
    return gsl_test_summary();
}
