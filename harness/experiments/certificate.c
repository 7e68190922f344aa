#include "harness/experiments/certificate.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"
#include "harness/study/study.h"

enum { MOST_CHILDREN = 64, LOOK = 100 /* [ms] between looks at the clocks */ };

/* A process that is at one part; its pipe closes when it ends. */
typedef struct tester {
    pid_t process;
    int end; /* -1: it does not run */
    int late;
    double since; /* [s] */
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

int certificate_counted(const certificate *c, claim_outcome outcome)
{
    int count = 0;
    for (int i = 0; i < CERTIFICATE_PARTS; i++)
        count += claims_counted(&c->part[i].claims, outcome);
    return count;
}

int certificate_compared(const certificate *c)
{
    int count = 0;
    for (int i = 0; i < CERTIFICATE_PARTS; i++)
        count += claims_compared(&c->part[i].claims);
    return count;
}

int certificate_holds(const certificate *c)
{
    return certificate_counted(c, CLAIM_BROKEN) == 0;
}

const claim *certificate_broken(const certificate *c)
{
    for (int i = 0; i < CERTIFICATE_PARTS; i++)
        for (int k = 0; k < c->part[i].claims.count; k++)
            if (c->part[i].claims.claim[k].outcome == CLAIM_BROKEN)
                return &c->part[i].claims.claim[k];
    return NULL;
}

static void run_part(certificate *of, int part)
{
    certificate_part *p = &of->part[part];
    if (part < CHECKS_FAMILIES)
        checks_families[part].run(&of->chosen, &p->claims);
    else
        measured_groups[part - CHECKS_FAMILIES].run(&of->chosen, &p->claims, &p->measures);
    p->claims.complete = 1;
}

static status start(tester *t, certificate *of, int part, int time_limit, fault *f)
{
    int ends[2];
    const pid_t parent = getpid();
    if (pipe2(ends, O_CLOEXEC) != 0)
        return fault_set(f, STATUS_FAULT, "cannot start a process: no pipe");
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
        return fault_set(f, STATUS_FAULT, "cannot start a process");
    }
    return STATUS_OK;
}

/* It has ended; what did not come to an end is a claim that is broken. */
static void bury(tester *t, int time_limit)
{
    char words[100];
    claims *c = &t->of->part[t->part].claims;
    close(t->end);
    t->end = -1;
    const int how = child_reap(t->process);
    c->count = c->count < 0 || c->count >= CLAIMS_MOST ? 0 : c->count; /* it may be spoilt */
    c->doing[sizeof c->doing - 1] = '\0';
    if (c->complete && WIFEXITED(how) && WEXITSTATUS(how) == 0)
        return;
    if (child_ended(how, t->late, time_limit, words, sizeof words))
        t->of->late = certificate_part_name(t->part);
    claims_asks(claims_open(c, "every call comes back", 0), 0, "%s: %.250s", words,
                c->doing[0] != '\0' ? c->doing : "before the first call");
}

static void stop_late(tester *t, int time_limit)
{
    if (time_limit <= 0 || t->late || clock_wall_seconds() - t->since <= time_limit + 1)
        return;
    t->late = 1;
    kill(t->process, SIGKILL);
}

/* After one that did not come back in time the others are not waited for. */
static void pass_over(certificate *of, int part)
{
    char why[CLAIM_SENTENCE];
    snprintf(why, sizeof why, "not checked: '%s' hit the time limit", of->late);
    claims_not_made(&of->part[part].claims, certificate_part_name(part), why);
}

/* Waits until one ends, and takes what has. Returns how many ended. */
static int attend(tester all[], int jobs, int time_limit)
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
        if (ends[i].revents != 0 || child_is_gone(all[i].process)) {
            bury(&all[i], time_limit);
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

static status run_all(const certificate_request *r, certificate *all, tester team[], int jobs,
                      fault *f)
{
    const int parts = r->contract_only ? CHECKS_FAMILIES : CERTIFICATE_PARTS,
              tasks = r->count * parts;
    int next = 0, running = 0;
    while (next < tasks || running > 0) {
        const int free_one = idle(team, jobs);
        certificate *of = next < tasks ? &all[next / parts] : NULL;
        if (of != NULL && of->late != NULL) {
            pass_over(of, next % parts);
            next++;
        } else if (of != NULL && free_one >= 0) {
            TRY(start(&team[free_one], of, next % parts, r->time_limit, f));
            next++;
            running++;
        } else {
            running -= attend(team, jobs, r->time_limit);
        }
    }
    return STATUS_OK;
}

status certificate_find(const certificate_request *r, certificate **out, fault *f)
{
    tester team[MOST_CHILDREN];
    const int jobs = r->jobs < MOST_CHILDREN ? r->jobs : MOST_CHILDREN;
    certificate *all = mmap(NULL, (size_t)r->count * sizeof *all, PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    *out = NULL;
    if (all == MAP_FAILED)
        return fault_set(f, STATUS_FAULT, "out of memory for the certificates");
    *out = all;
    for (int i = 0; i < r->count; i++)
        all[i].chosen = r->chosen[i];
    for (int i = 0; i < jobs; i++)
        team[i].end = -1;
    const status outcome = run_all(r, all, team, jobs, f);
    for (int i = 0; i < jobs; i++)
        if (team[i].end >= 0) {
            kill(team[i].process, SIGKILL);
            bury(&team[i], 0);
        }
    for (int i = 0; i < r->count; i++) /* whoever spoilt it */
        all[i].chosen = r->chosen[i];
    return outcome;
}

void certificate_free(certificate *all, int count)
{
    if (all != NULL)
        munmap(all, (size_t)count * sizeof *all);
}
