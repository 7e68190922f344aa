#include "harness/cli/cli.h"

#include <argp.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "elements/shared/choice.h"
#include "harness/records/records.h"
#include "harness/terminal/terminal.h"

int message_finish(int code)
{
    const int reported = code == EXIT_REFUSED || code == EXIT_FAULT;
    fault f = {""};
    if (output_all_written(&f) == STATUS_OK || reported)
        return code;
    return message_exit(STATUS_FAULT, &f);
}

int message_exit(status s, const fault *f)
{
    return s == STATUS_OK ? EXIT_AS_EXPECTED : message_fail(s, f->text);
}

int message_fail(status s, const char *text)
{
    fprintf(stderr, "beamwork: %s\n", text);
    switch (s) {
    case STATUS_OK:
        return EXIT_AS_EXPECTED;
    case STATUS_NOT_CONVERGED:
    case STATUS_SINGULAR:
    case STATUS_TIME_LIMIT:
    case STATUS_NO_VALUE:
        return EXIT_DIFFERS;
    case STATUS_REFUSED:
        return EXIT_REFUSED;
    case STATUS_FAULT:
        break;
    }
    return EXIT_FAULT;
}

void message_refuse(const char *text)
{
    exit(message_fail(STATUS_REFUSED, text));
}

/* process to which the handlers apply; child processes end without them */
static pid_t program;

static void write_error(const char *text)
{
    if (write(STDERR_FILENO, text, strlen(text)) < 0) {
        /* the exit status still reports the error */
    }
}

static void end_by(int number)
{
    signal(number, SIG_DFL);
    raise(number);
}

static void stop_requested(int number)
{
    if (getpid() == program)
        output_abandon();
    end_by(number);
}

static void crashed(int number)
{
    if (getpid() == program) {
        write_error(
            "beamwork: the program crashed; check your own element with 'beamwork element-test'; "
            "in the source tree, run valgrind on a program built with 'make DEBUG=1'; libraries "
            "can also crash if memory runs out\n");
        output_abandon();
    }
    end_by(number);
}

static void ended(int code, void *unused)
{
    (void)unused;
    if (getpid() != program || (code >= EXIT_AS_EXPECTED && code <= EXIT_INTERRUPTED))
        return;
    write_error("beamwork: a library or an element ended the program, perhaps because memory ran "
                "out; free memory, and check your own element with 'beamwork element-test'\n");
    output_abandon();
    _exit(EXIT_FAULT);
}

static void handle_signal(int number, void (*handler)(int))
{
    struct sigaction action, before;
    if (sigaction(number, NULL, &before) != 0 || before.sa_handler != SIG_DFL)
        return;
    memset(&action, 0, sizeof action);
    action.sa_handler = handler;
    action.sa_flags = SA_ONSTACK | SA_NODEFER;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

static void fill_streams(void)
{
    for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++)
        if (fcntl(i, F_GETFD) < 0 && open("/dev/null", i == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
}

void ending_begin(void)
{
    static const int asking[] = {SIGTERM, SIGHUP, SIGINT},
                     crashing[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
    static char stack[1 << 16];
    const stack_t other = {.ss_sp = stack, .ss_size = sizeof stack};
    program = getpid();
    fill_streams();
    sigaltstack(&other, NULL);
    for (size_t i = 0; i < sizeof asking / sizeof asking[0]; i++)
        handle_signal(asking[i], stop_requested);
    for (size_t i = 0; i < sizeof crashing / sizeof crashing[0]; i++)
        handle_signal(crashing[i], crashed);
    on_exit(ended, NULL);
}

static struct {
    int signal;
    const char *what;
    char line[200];
} mishap[] = {
    {SIGSEGV, "accessed memory that it does not own", ""},
    {SIGBUS, "accessed an unaligned address, or memory beyond the end of a mapped file", ""},
    {SIGFPE, "divided an integer by zero", ""},
    {SIGILL, "executed an invalid instruction", ""},
    {SIGABRT, "aborts", ""},
    {SIGALRM, "did not finish within the time limit (--time-limit)", ""}};

enum { MISHAPS = sizeof mishap / sizeof mishap[0] };

static void report(int which)
{
    for (int i = 0; i < MISHAPS; i++)
        if (mishap[i].signal == which &&
            write(STDERR_FILENO, mishap[i].line, strlen(mishap[i].line)) > 0)
            break;
    output_abandon();
    _exit(EXIT_DIFFERS);
}

static void stand_on_another_stack(void)
{
    static char stack[1 << 16];
    const stack_t other = {.ss_sp = stack, .ss_size = sizeof stack};
    sigaltstack(&other, NULL);
}

void formulation_start_guard(const formulation *chosen, int seconds)
{
    if (!formulations_is_loaded(chosen->type))
        return;
    struct sigaction action = {.sa_handler = report, .sa_flags = SA_ONSTACK | SA_RESETHAND};
    stand_on_another_stack();
    for (int i = 0; i < MISHAPS; i++) {
        snprintf(mishap[i].line, sizeof mishap[i].line, "beamwork: formulation %.60s %s\n",
                 chosen->type->name, mishap[i].what);
        sigaction(mishap[i].signal, &action, NULL);
    }
    alarm((unsigned)seconds);
}

enum { INDENT = 2, COLUMN = 30 };

static void write_option(FILE *to, const verb_option *o)
{
    int at = o->letter != 0 ? fprintf(to, "  -%c, ", o->letter) : fprintf(to, "      ");
    at += fprintf(to, "--%s", o->name);
    if (o->argument != NULL)
        at += verb_optional(o) ? fprintf(to, "[=%s", o->argument + 1)
                               : fprintf(to, "=%s", o->argument);
    if (at + 1 >= COLUMN) {
        fputc('\n', to);
        at = 0;
    }
    paragraph_write(to, at, COLUMN, o->help);
}

static void write_examples(FILE *to, const char *lines)
{
    fprintf(to, strchr(lines, '\n') != NULL ? "\nexamples\n" : "\nexample\n");
    while (*lines != '\0') {
        const size_t length = strcspn(lines, "\n");
        fprintf(to, "  %.*s\n", (int)length, lines);
        lines += length + (lines[length] == '\n');
    }
}

void help_write(FILE *to, const verb *v)
{
    const verb_option *o;
    fprintf(to, "usage: beamwork %s %s%s[OPTION...]\n", v->name, v->arguments,
            v->arguments[0] != '\0' ? " " : "");
    paragraph_write(to, 0, INDENT, v->about);
    fprintf(to, "\noptions\n");
    for (int i = 0; (o = verb_option_at(v, i, NULL)) != NULL; i++)
        write_option(to, o);
    write_examples(to, v->examples);
}

enum { FIRST_KEY = 256, MOST_ROWS = 256 };

static const char *name_of(const void *context, int i)
{
    const verb_option *o = verb_option_at(context, i, NULL);
    return o != NULL ? o->name : NULL;
}

static int others_take(const verb *const *verbs, const char *word)
{
    const verb_option *o = NULL;
    for (; *verbs != NULL; verbs++)
        for (int i = 0; (*verbs)->answer != NULL && (o = verb_option_at(*verbs, i, NULL)) != NULL;
             i++)
            if (strcmp(o->name, word) == 0 ||
                (verb_former_name(o) != NULL && strcmp(verb_former_name(o), word) == 0))
                return 1;
    return 0;
}

/* Returns REFUSED: the verb has no such option; another verb may have it. begun: number of options
 * that match the abbreviation. */
static status refuse_word(const verb *v, const verb *const *verbs, const char *text, int begun,
                          fault *f)
{
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)strcspn(text, "="), text);
    if (begun > 1)
        return fault_set(
            f, STATUS_REFUSED,
            "%s is an abbreviation of several options; 'beamwork %s -h' lists the options", word,
            v->name);
    if (others_take(verbs, word + 2))
        return fault_set(f, STATUS_REFUSED, "%s has no %s; 'beamwork %s -h' lists its options",
                         v->name, word, v->name);
    const char *near = choice_nearest(word + 2, name_of, v);
    return fault_set(f, STATUS_REFUSED, "unknown option %s%s%s%s'beamwork %s -h' lists the options",
                     word, near != NULL ? "; did you mean --" : "", near != NULL ? near : "",
                     near != NULL ? "? " : "; ", v->name);
}

static void report_former(const verb_option *o, const char *word)
{
    const char *was = verb_former_name(o);
    const size_t length = strcspn(word, "=");
    if (was != NULL && length == strlen(was) + 2 && strncmp(word + 2, was, length - 2) == 0)
        fprintf(stderr,
                "beamwork: --%s has been renamed to --%s; the old name will be removed in the next "
                "version\n",
                was, o->name);
}

/* Checks an option on the command line. last 1: no argument follows. *more: 1 if the next argument
 * is the value of the option. */
static status check_word(const verb *v, const verb *const *verbs, const char *word, int last,
                         int *more, fault *f)
{
    const char *value;
    int begun;
    const verb_option *o = verb_word(v, word, &value, &begun);
    if (o == NULL && word[1] != '-')
        return *value == '?' ? STATUS_OK
                             : fault_set(f, STATUS_REFUSED,
                                         "unknown option -%c; 'beamwork %s -h' lists the options",
                                         *value, v->name);
    if (o == NULL)
        return refuse_word(v, verbs, word, begun, f);
    if (value != NULL && o->argument == NULL)
        return fault_set(f, STATUS_REFUSED, "--%s does not accept a value; remove the value",
                         o->name);
    report_former(o, word);
    *more = value == NULL && o->argument != NULL && !verb_optional(o);
    return *more && last
               ? fault_set(f, STATUS_REFUSED, "--%s requires a value: %s", o->name, o->argument)
               : STATUS_OK;
}

static status check_options(const verb *v, const verb *const *verbs, int count,
                            char *const argument[], fault *f)
{
    for (int i = 1; i < count && strcmp(argument[i], "--") != 0; i++) {
        int more = 0;
        if (argument[i][0] == '-' && argument[i][1] != '\0')
            TRY(check_word(v, verbs, argument[i], i + 1 == count, &more, f));
        i += more;
    }
    return STATUS_OK;
}

static void show_usage(const struct argp_state *state)
{
    argp_state_help(state, stdout, ARGP_HELP_USAGE & ~(unsigned)ARGP_HELP_EXIT_ERR);
    exit(message_finish(EXIT_AS_EXPECTED));
}

static void add_argument(command_line *l, const char *text)
{
    if (l->arguments == verb_most_arguments(l->verb->arguments)) {
        char words[200];
        snprintf(words, sizeof words,
                 "there are too many arguments, from '%.60s' on; remove them ('beamwork %.40s -h' "
                 "shows the usage)",
                 text, l->verb->name);
        message_refuse(words);
    }
    l->argument[l->arguments++] = text;
}

static void add_given(command_line *l, const verb_option *o, const char *value)
{
    char text[160];
    const int once = o->argument != NULL && (o->traits & OPTION_REPEATS) == 0;
    if (once && given_value(l, o->name) != NULL) {
        snprintf(text, sizeof text,
                 "--%s is given twice, but accepts only one value; remove one of them", o->name);
        message_refuse(text);
    }
    if (l->givens == COMMAND_MOST_GIVEN)
        message_refuse(
            "too many options are given; remove some, or run the command for fewer files");
    l->given[l->givens++] = (given_option){o, value};
}

typedef struct command_reading {
    command_line *line;
    char *request;
} command_reading;

static void take_option(command_reading *r, const verb_option *o, size_t at, const char *value)
{
    fault f;
    add_given(r->line, o, value);
    if (option_take(o, r->request + at + o->member, value, &f) != STATUS_OK)
        message_refuse(f.text);
}

static error_t take(int key, char *value, struct argp_state *state)
{
    command_reading *r = state->input;
    const verb *v = r->line->verb;
    size_t at;
    if (key == ARGP_KEY_ARG)
        return add_argument(r->line, value), 0;
    if (key < 0 || key >= FIRST_KEY + MOST_ROWS)
        return ARGP_ERR_UNKNOWN;
    const verb_option *o =
        key >= FIRST_KEY ? verb_option_at(v, key - FIRST_KEY, &at) : verb_letter(v, (char)key, &at);
    if (o != NULL && key < FIRST_KEY && key != o->letter)
        fprintf(stderr,
                "beamwork: -%c has been renamed to --%s; the letter will be removed in the next "
                "version\n",
                key, o->name);
    if (o == NULL || o == verb_help) {
        help_write(stdout, v);
        exit(message_finish(EXIT_AS_EXPECTED));
    } else if (o == verb_help + 1)
        show_usage(state);
    else
        take_option(r, o, at, value);
    return 0;
}

/* Adds the rows of an option for argp, from row n on. Letters and former names are aliases of the
 * option. Returns the number of rows so far. */
static int add_row(struct argp_option row[], int n, const verb_option *o, int index)
{
    const char *was = verb_former_name(o);
    row[n++] = (struct argp_option){o->name,     FIRST_KEY + index,
                                    o->argument, verb_optional(o) ? OPTION_ARG_OPTIONAL : 0,
                                    o->help,     0};
    if (was != NULL)
        row[n++] = (struct argp_option){.name = was, .flags = OPTION_ALIAS | OPTION_HIDDEN};
    if (o->letter != 0)
        row[n++] = (struct argp_option){.key = o->letter, .flags = OPTION_ALIAS};
    for (int i = 0; verb_former_letter(o, i) != 0; i++)
        row[n++] = (struct argp_option){.key = verb_former_letter(o, i),
                                        .flags = OPTION_ALIAS | OPTION_HIDDEN};
    return n;
}

static void end_groups(command_line *l, char *request)
{
    fault f;
    for (const verb_group *g = l->verb->shared; g->group != NULL; g++)
        if (g->group->end != NULL && g->group->end(request + g->member, l, &f) != STATUS_OK)
            message_refuse(f.text);
}

void command_parse(const verb *v, const verb *const *verbs, int count, char **arguments,
                   command_line *line, void *request)
{
    struct argp_option row[MOST_ROWS] = {{0}};
    command_reading r = {line, request};
    const verb_option *o;
    char name[64];
    fault f;
    int n = 0;
    *line = (command_line){.verb = v, .verbs = verbs};
    if (check_options(v, verbs, count, arguments, &f) != STATUS_OK)
        message_refuse(f.text);
    for (int i = 0; (o = verb_option_at(v, i, NULL)) != NULL; i++)
        n = add_row(row, n, o, i);
    row[n] = (struct argp_option){.key = '?', .flags = OPTION_HIDDEN | OPTION_ALIAS};
    for (const verb_group *g = v->shared; g->group != NULL; g++)
        if (g->group->begin != NULL)
            g->group->begin(r.request + g->member, line);
    const struct argp parser = {.options = row, .parser = take, .args_doc = v->arguments};
    snprintf(name, sizeof name, "beamwork %s", v->name);
    arguments[0] = name;
    argp_err_exit_status = EXIT_REFUSED;
    argp_parse(&parser, count, arguments, ARGP_NO_HELP, NULL, &r);
    end_groups(line, request);
}

int command_run(const verb *v, const verb *const *verbs, int count, char **arguments)
{
    command_line line;
    if (v->before != NULL)
        v->before(arguments);
    char *request = calloc(1, v->request + 1);
    if (request == NULL)
        return message_fail(STATUS_FAULT, "out of memory for the command line");
    command_parse(v, verbs, count, arguments, &line, request);
    const int code = v->answer(&line, request);
    for (const verb_group *g = v->shared; g->group != NULL; g++)
        if (g->group->close != NULL)
            g->group->close(request + g->member);
    free(request);
    return code;
}
