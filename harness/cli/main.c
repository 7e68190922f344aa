/* beamwork VERB ...: see --help. */
#include <gsl/gsl_errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "harness/catalogue/choice.h"
#include "harness/catalogue/environment.h"
#include "harness/cli/cli.h"

static const struct {
    const char *name;
    cli_verb *run;
    const char *summary;
} verbs[] = {
    {"list", cli_list, "cases, formulations, parameters, quantities"},
    {"solve", cli_solve, "one case, one formulation, one mesh"},
    {"converge", cli_converge, "one case on several meshes: errors, order, limit"},
    {"bench", cli_bench, "error against run time: the cheapest way to an error"},
    {"stress", cli_stress,
     "every formulation driven to extremes: a value with its error, or a named failure"},
    {"verify", cli_verify, "every formulation on every case, judged against stored truths"},
    {"truth", cli_truth, "what is known of a case at a parameter point; derived on demand"},
    {"scene", cli_scene,
     "a case, or a scene of your own, as a scene file with all loops written out"},
    {"export", cli_export, "a structure as solids, as an input deck of another program"},
    {"import", cli_import, "what other programs found, for 'verify --beside'"},
    {"schema", cli_schema, "what the result file consists of: tables, columns, units"},
    {"compare", cli_compare,
     "two stored runs: errors and work, worse and better; exit status like diff"},
};
enum { VERBS = sizeof verbs / sizeof verbs[0] };

static const char *verb_name(const void *context, int i)
{
    (void)context;
    return i < VERBS ? verbs[i].name : NULL;
}

static int help(void)
{
    printf("beamwork: verification and benchmark of three-dimensional beam finite "
           "elements\n\nusage: beamwork VERB [OPTION...]; "
           "'beamwork VERB --help' shows its options\n\n");
    for (int i = 0; i < VERBS; i++)
        printf("  %-10s %s\n", verbs[i].name, verbs[i].summary);
    printf("\n  --version  versions of the program and its libraries\n\n"
           "exit status: 0 as expected; 1 a verdict differs (solve: not converged or singular); 2 "
           "refused input;\n"
           "             3 nothing was checked; 4 file, disk or memory; 5 interrupted: what was "
           "judged is in *.partial.*\n"
           "             (compare, as diff: 0 the same, 1 different, 2 trouble)\n\n"
           "example: beamwork converge c_column -f beamw -f beamw_consistent -n 2,4,8,16,32\n");
    return EXIT_AS_EXPECTED;
}

static int version(void)
{
    const environment e = environment_now(1);
    printf("beamwork %s (%s)\n%s, flags %s\n%s\n", e.version, e.commit, e.compiler, e.flags,
           e.libraries);
    return EXIT_AS_EXPECTED;
}

/* Not inlined: what it needs of the stack is taken once the stack is known to suffice. */
static __attribute__((noinline)) int run(int count, char **arguments)
{
    if (count < 2 || strcmp(arguments[1], "--help") == 0 || strcmp(arguments[1], "help") == 0)
        return help();
    if (strcmp(arguments[1], "--version") == 0)
        return version();
    for (int i = 0; i < VERBS; i++)
        if (strcmp(verbs[i].name, arguments[1]) == 0)
            return verbs[i].run(count - 1, arguments + 1);
    char text[200];
    const char *near = choice_nearest(arguments[1], verb_name, NULL);
    snprintf(text, sizeof text, "unknown verb '%.60s'%s%s%s; 'beamwork --help' shows them all",
             arguments[1], near != NULL ? ", did you mean '" : "", near != NULL ? near : "",
             near != NULL ? "'?" : "");
    return message_fail(STATUS_REFUSED, text);
}

/* A stack that is too small ends a program without a word: it is raised as far as we may. 1: it is
 * large enough. */
static int stack_suffices(void)
{
    enum { LEAST = 1 << 20, USUAL = 1 << 23 }; /* [bytes] */
    struct rlimit stack;
    if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= LEAST)
        return 1;
    stack.rlim_cur = stack.rlim_max < USUAL ? stack.rlim_max : USUAL;
    return setrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur >= LEAST;
}

/* Without stdio, whose buffer for standard error lies on the stack: what starts at all says it. */
static _Noreturn void refuse_stack(void)
{
    static const char text[] = "beamwork: the stack is limited to less than 1 MB; allow more with "
                               "'ulimit -s 8192'\n";
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) {
        /* the exit status says it still */
    }
    _exit(EXIT_FAULT);
}

int main(int count, char **arguments)
{
    if (!stack_suffices())
        refuse_stack();
    gsl_set_error_handler_off();
    /* a file that may not grow is an error of writing, told in one line */
    signal(SIGXFSZ, SIG_IGN);
    return message_finish(run(count, arguments));
}
