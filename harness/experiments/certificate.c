#include "harness/experiments/experiments_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

enum {
    MOST_CHILDREN = 64,
    LOOK = 100 /* MOST_CHILDREN: largest number of processes; LOOK: interval at which time limits
                  are checked [ms] */
};

typedef struct tester {
    pid_t process;
    int end;
    int late;
    double since; /* [s] time when the part started */
    certificate *of;
    int part;
} tester;

const char *certificate_part_name(int part)
{
    return part < CHECKS_FAMILIES ? checks_families[part].name
                                  : measured_groups[part - CHECKS_FAMILIES].name;
}

const char *certificate_part_words(int part)
{
    return part < CHECKS_FAMILIES ? checks_families[part].what
                                  : measured_groups[part - CHECKS_FAMILIES].what;
}

int certificate_counted(const certificate *c, check_outcome outcome)
{
    int count = 0;
    for (int i = 0; i < CERTIFICATE_PARTS; i++)
        count += checks_counted(&c->part[i].check_results, outcome);
    return count;
}

int certificate_compared(const certificate *c)
{
    int count = 0;
    for (int i = 0; i < CERTIFICATE_PARTS; i++)
        count += checks_compared(&c->part[i].check_results);
    return count;
}

int certificate_holds(const certificate *c)
{
    return certificate_counted(c, CHECK_FAILED) == 0;
}

const check_result *certificate_broken(const certificate *c)
{
    for (int i = 0; i < CERTIFICATE_PARTS; i++)
        for (int k = 0; k < c->part[i].check_results.count; k++)
            if (c->part[i].check_results.check_result[k].outcome == CHECK_FAILED)
                return &c->part[i].check_results.check_result[k];
    return NULL;
}

void certificate_violated_parts(const certificate *c, char *text, int size)
{
    int used = 0;
    text[0] = '\0';
    for (int i = 0; i < CERTIFICATE_PARTS && used < size; i++) {
        const int broken = checks_counted(&c->part[i].check_results, CHECK_FAILED);
        if (broken > 0)
            used += snprintf(text + used, (size_t)(size - used), "%s%d in '%s'",
                             used > 0 ? ", " : "", broken, certificate_part_name(i));
    }
}

static void run_part(certificate *of, int part)
{
    certificate_part *p = &of->part[part];
    if (part < CHECKS_FAMILIES)
        checks_families[part].run(&of->chosen, &p->check_results);
    else
        measured_groups[part - CHECKS_FAMILIES].run(&of->chosen, &p->check_results, &p->measures);
    p->check_results.complete = 1;
}

static status start(tester *t, certificate *of, int part, int time_limit, fault *f)
{
    int ends[2];
    const pid_t parent = getpid();
    if (pipe2(ends, O_CLOEXEC) != 0)
        return child_not_started(f);
    *t = (tester){.end = ends[0], .since = clock_wall_seconds(), .of = of, .part = part};
    fflush(NULL);
    t->process = fork();
    if (t->process == 0) {
        child_begin(parent);
        child_alarm(time_limit);
        run_part(of, part);
        _exit(0);
    }
    close(ends[1]);
    if (t->process < 0) {
        close(ends[0]);
        t->end = -1;
        return child_not_started(f);
    }
    return STATUS_OK;
}

static void handle_end(tester *t, int time_limit)
{
    char words[100];
    check_results *c = &t->of->part[t->part].check_results;
    close(t->end);
    t->end = -1;
    const int how = child_reap(t->process);
    c->count = c->count < 0 || c->count >= CHECKS_MOST ? 0 : c->count; /* may be corrupted */
    c->doing[sizeof c->doing - 1] = '\0';
    if (c->complete && WIFEXITED(how) && WEXITSTATUS(how) == 0)
        return;
    const int late = child_ended(how, t->late, time_limit, words, sizeof words);
    if (late)
        t->of->late = certificate_part_name(t->part);
    checks_require(checks_open(c, "every call returns", 0), 0, "%s: %.250s%s", words,
                   c->doing[0] != '\0' ? c->doing : "before the first call",
                   late ? "; if the element is slow, set a longer --time-limit" : "");
}

static void stop_late(tester *t, int time_limit)
{
    if (time_limit <= 0 || t->late || clock_wall_seconds() - t->since <= time_limit + 1)
        return;
    t->late = 1;
    kill(t->process, SIGKILL);
}

static void pass_over(certificate *of, int part)
{
    char why[CHECK_TEXT];
    snprintf(why, sizeof why, "not checked, because '%s' exceeded the time limit", of->late);
    checks_not_made(&of->part[part].check_results, certificate_part_name(part), why);
}

/* Waits at most LOOK for the end of a process, and stops processes that exceed the time limit.
 * Returns the number of processes that have ended. */
static int handle_process(tester all[], int jobs, int time_limit)
{
    struct pollfd ends[MOST_CHILDREN];
    int ended = 0;
    for (int i = 0; i < jobs; i++)
        ends[i] = (struct pollfd){.fd = all[i].end, .events = POLLIN};
    while (poll(ends, (nfds_t)jobs, LOOK) < 0 && errno == EINTR)
        ;
    for (int i = 0; i < jobs; i++) {
        if (all[i].end < 0)
            continue;
        if (ends[i].revents != 0 || child_has_ended(all[i].process)) {
            handle_end(&all[i], time_limit);
            ended++;
        } else {
            stop_late(&all[i], time_limit);
        }
    }
    return ended;
}

static int idle(const tester all[], int jobs)
{
    for (int i = 0; i < jobs; i++)
        if (all[i].end < 0)
            return i;
    return -1;
}

static status run_all(const certificate_request *r, certificate *all, tester testers[], int jobs,
                      fault *f)
{
    const int parts = r->checks_only ? CHECKS_FAMILIES : CERTIFICATE_PARTS,
              tasks = r->count * parts;
    int next = 0, running = 0;
    while (next < tasks || running > 0) {
        const int free_one = idle(testers, jobs);
        certificate *of = next < tasks ? &all[next / parts] : NULL;
        if (of != NULL && of->late != NULL) {
            pass_over(of, next % parts);
            next++;
        } else if (of != NULL && free_one >= 0) {
            TRY(start(&testers[free_one], of, next % parts, r->time_limit, f));
            next++;
            running++;
        } else {
            running -= handle_process(testers, jobs, r->time_limit);
        }
    }
    return STATUS_OK;
}

status certificate_find(const certificate_request *r, certificate **out, fault *f)
{
    tester testers[MOST_CHILDREN];
    const int jobs = r->jobs < MOST_CHILDREN ? r->jobs : MOST_CHILDREN;
    certificate *all = mmap(NULL, (size_t)r->count * sizeof *all, PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    *out = NULL;
    if (all == MAP_FAILED)
        return fault_memory(f, "the element reports");
    *out = all;
    for (int i = 0; i < r->count; i++)
        all[i].chosen = r->chosen[i];
    for (int i = 0; i < jobs; i++)
        testers[i].end = -1;
    const status outcome = run_all(r, all, testers, jobs, f);
    for (int i = 0; i < jobs; i++)
        if (testers[i].end >= 0) {
            kill(testers[i].process, SIGKILL);
            handle_end(&testers[i], 0);
        }
    for (int i = 0; i < r->count; i++) {
        all[i].chosen = r->chosen[i];
        if (r->hash != NULL)
            r->hash(r->chosen[i].type, all[i].hash);
    }
    return outcome;
}

void certificate_free(certificate *all, int count)
{
    if (all != NULL)
        munmap(all, (size_t)count * sizeof *all);
}

enum { NAME = 14, INDENT = 18, MEASURE = 36, COLUMN = 8 };

static void put_mark(FILE *to, screen look, check_outcome outcome)
{
    static const char *const utf8[] = {"✔", "✘", "·"}, *const ascii[] = {"+", "X", "."};
    static const screen_ink ink[] = {SCREEN_GOOD, SCREEN_BAD, SCREEN_FAINT};
    fputs("  ", to);
    screen_put(to, look, ink[outcome], (look.utf8 ? utf8 : ascii)[outcome]);
    fputc(' ', to);
}

check_outcome checks_outcome(const check_results *c)
{
    int held = 0;
    if (checks_counted(c, CHECK_FAILED) > 0)
        return CHECK_FAILED;
    for (int i = 0; i < c->count; i++)
        held |= c->check_result[i].outcome == CHECK_PASSED &&
                strcmp(c->check_result[i].name, "prepare") != 0;
    return held ? CHECK_PASSED : CHECK_NOT_MADE;
}

static void write_checks(FILE *to, screen look, const check_results *c, int verbose)
{
    for (int i = 0; i < c->count; i++) {
        const check_result *one = &c->check_result[i];
        if (!verbose && one->outcome != CHECK_FAILED)
            continue;
        fputs("    ", to);
        put_mark(to, look, one->outcome);
        if (one->outcome == CHECK_PASSED)
            paragraph_printf(to, 8, 8, "%s: %d compared, at most %.1e (allowed %.1e)", one->name,
                             one->compared, one->worst, one->allowed);
        else if (one->outcome == CHECK_FAILED && isfinite(one->worst) && one->allowed > 0)
            paragraph_printf(to, 8, 8, "%s (difference %.1e, allowed %.1e)", one->sentence,
                             one->worst, one->allowed);
        else if (one->outcome == CHECK_FAILED)
            paragraph_write(to, 8, 8, one->sentence);
        else
            paragraph_printf(to, 8, 8, "%s: not applicable; %s", one->name, one->sentence);
    }
}

static void write_family(FILE *to, screen look, const certificate *c, int part, int verbose)
{
    const check_results *own = &c->part[part].check_results;
    const check_outcome outcome = checks_outcome(own);
    put_mark(to, look, outcome);
    fprintf(to, "%-*s", NAME, certificate_part_name(part));
    if (outcome == CHECK_NOT_MADE && c->late != NULL && own->count == 1 &&
        strncmp(own->check_result[0].sentence, "not checked", 11) == 0)
        paragraph_write(to, INDENT, INDENT, own->check_result[0].sentence);
    else if (outcome == CHECK_NOT_MADE)
        paragraph_printf(to, INDENT, INDENT, "not applicable: %s",
                         own->count > 0 ? own->check_result[own->count - 1].sentence
                                        : "nothing to check");
    else
        paragraph_printf(to, INDENT, INDENT, "%s (%d compared)", certificate_part_words(part),
                         checks_compared(own));
    write_checks(to, look, own, verbose);
}

static void error_text(double error, char text[COLUMN + 8])
{
    const double percent = 100 * fabs(error);
    if (isnan(error))
        snprintf(text, COLUMN + 8, "-");
    else if (fabs(error) < CERTIFICATE_EXACT)
        snprintf(text, COLUMN + 8, "exact");
    else if (percent >= 999)
        snprintf(text, COLUMN + 8, "%.0e %%", percent);
    else
        snprintf(text, COLUMN + 8,
                 percent < 1e-2   ? "%.0e %%"
                 : percent < 99.5 ? "%.2g %%"
                                  : "%.0f %%",
                 percent);
}

static int nothing(const element_measure *one)
{
    for (int i = 0; i < one->points; i++)
        if (!isnan(one->error[i]))
            return 0;
    return 1;
}

static void write_measure(FILE *to, const element_measure *one, int path, int verbose)
{
    const int at = fprintf(to, "    %-*s ", MEASURE - 5, one->name);
    if (nothing(one)) {
        paragraph_write(to, at, at, one->words);
        return;
    }
    for (int i = 0; i < one->points; i++) {
        char text[COLUMN + 8];
        error_text(one->error[i], text);
        fprintf(to, "%*s", i == 0 ? COLUMN - (at - MEASURE) : COLUMN, text);
    }
    if (!isnan(one->order))
        fprintf(to, "  %.1f (%d-%d)", one->order, one->least, one->highest);
    if (path && one->words[0] != '\0')
        fprintf(to, "  %s", one->words);
    fputs(one->locks ? "  locks\n" : "\n", to);
    if (verbose && !path && !one->wrong_limit && one->words[0] != '\0')
        paragraph_write(to, fprintf(to, "      "), 6, one->words);
}

static void write_measures(FILE *to, screen look, const certificate *c, int part, int verbose)
{
    const certificate_part *own = &c->part[part];
    const element_measure *first = &own->measures.measure[0];
    fprintf(to, "  %-*s", MEASURE - 2, certificate_part_name(part));
    for (int i = 1; i < own->measures.count; i++)
        first = own->measures.measure[i].points > first->points ? &own->measures.measure[i] : first;
    for (int i = 0; i < first->points; i++)
        fprintf(to, part == CHECKS_FAMILIES + 1 ? " %*.0e" : " %*.0f", COLUMN - 1, first->at[i]);
    fputs(part == CHECKS_FAMILIES + 2 ? "  order (decl.)" : "", to);
    if (checks_counted(&own->check_results, CHECK_FAILED) > 0) {
        fputs("  ", to);
        screen_put(to, look, SCREEN_BAD, "violated");
    }
    fputc('\n', to);
    if (own->measures.count == 0 && own->check_results.count == 1 && c->late != NULL)
        paragraph_write(to, fprintf(to, "    "), 4, own->check_results.check_result[0].sentence);
    for (int i = 0; i < own->measures.count; i++)
        write_measure(to, &own->measures.measure[i], part == CHECKS_FAMILIES + 3, verbose);
    if (part == CHECKS_FAMILIES + 2 && c->chosen.type->inertia == NULL)
        fputs("    vibration: with the mass computed by beamwork, because the element has no "
              "'inertia'\n",
              to);
    write_checks(to, look, &own->check_results, verbose);
}

static void write_verdict(FILE *to, screen look, const certificate *c)
{
    const int broken = certificate_counted(c, CHECK_FAILED),
              kept = certificate_counted(c, CHECK_PASSED);
    fputs("interface requirements: ", to);
    screen_put(to, look, broken == 0 ? SCREEN_GOOD : SCREEN_BAD,
               broken == 0 ? "SATISFIED" : "VIOLATED");
    if (broken > 0)
        fprintf(to, ", %d of %d checks", broken, broken + kept);
    else
        fprintf(to, ", %d checks", kept);
    fprintf(to, " on %d numbers; %d not applicable\n", certificate_compared(c),
            certificate_counted(c, CHECK_NOT_MADE));
    if (broken > 0) {
        char parts[CERTIFICATE_PARTS_TEXT];
        certificate_violated_parts(c, parts, sizeof parts);
        paragraph_printf(to, 0, 2, "violated: %s", parts);
    }
    const int wrong_limit = measures_wrong_limits(&c->part[CHECKS_FAMILIES].measures);
    if (wrong_limit > 0)
        fprintf(to, "measured: %d state%s with a wrong limit\n", wrong_limit,
                wrong_limit > 1 ? "s" : "");
}

static void write_one(FILE *to, screen look, const certificate *c, int verbose, int quiet)
{
    const char *left = adapters_words(c->chosen.type);
    paragraph_write(to, fprintf(to, "%s: ", c->chosen.key), 2, c->chosen.type->summary);
    if (left[0] != '\0')
        paragraph_printf(to, 0, 2, "computed by beamwork: %s", left);
    write_verdict(to, look, c);
    for (int i = 0; i < CHECKS_FAMILIES; i++)
        if (!quiet || checks_outcome(&c->part[i].check_results) == CHECK_FAILED)
            write_family(to, look, c, i, verbose);
    if (!quiet)
        fputs("measured: errors over numbers of elements (states: 1, and 4 of unequal length) and "
              "over thicknesses\n",
              to);
    for (int i = CHECKS_FAMILIES; i < CERTIFICATE_PARTS; i++)
        if (!quiet)
            write_measures(to, look, c, i, verbose);
        else
            write_checks(to, look, &c->part[i].check_results, verbose);
}

void certificate_text(FILE *to, screen look, const certificate *all, int count, int verbose,
                      int quiet)
{
    int broken = 0, numbers = 0;
    for (int i = 0; i < count; i++) {
        if (i > 0 && !quiet)
            fputc('\n', to);
        if (!quiet || !certificate_holds(&all[i]))
            write_one(to, look, &all[i], verbose, quiet);
        else if (count == 1)
            fprintf(to, "%s: SATISFIED\n", all[i].chosen.key);
        broken += !certificate_holds(&all[i]);
        numbers += certificate_compared(&all[i]);
    }
    if (count > 1)
        fprintf(
            to,
            "%s%d of %d formulations satisfy the interface requirements (%d numbers compared)\n",
            quiet ? "" : "\n", count - broken, count, numbers);
}
