/* Any bytes as a command line, one argument per line: parsed, or refused with one line and the
 * documented exit code. */
#include <setjmp.h>

#include "harness/cli/case_input.h"
#include "harness/tools/fuzz/fuzz.h"

/* Linked with --wrap: the end of the program is the end of one execution. */
void __wrap_exit(int code);
void __real_exit(int code);
error_t __wrap_argp_parse(const struct argp *parser, int count, char **arguments, unsigned flags,
                          int *end, void *input);
error_t __real_argp_parse(const struct argp *parser, int count, char **arguments, unsigned flags,
                          int *end, void *input);

static jmp_buf end_of_run;
static int code_of_run, running;

void __wrap_exit(int code)
{
    if (!running)
        __real_exit(code); /* of the fuzzing program itself */
    code_of_run = code;
    longjmp(end_of_run, 1);
}

error_t __wrap_argp_parse(const struct argp *parser, int count, char **arguments, unsigned flags,
                          int *end, void *input)
{
    return __real_argp_parse(parser, count, arguments,
                             flags | ARGP_NO_EXIT | ARGP_NO_ERRS | ARGP_NO_HELP, end, input);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    enum { MOST = 32 };
    static command_request r;
    char *argument[MOST + 1] = {NULL}, *rest = NULL, verb[] = "verb";
    int count = 1;
    char *text = fuzz_text(data, size);
    static int quiet;
    if (!quiet && freopen("/dev/null", "w", stdout) != NULL)
        quiet = 1;
    argument[0] = verb;
    for (char *one = strtok_r(text, "\n", &rest); one != NULL && count < MOST;
         one = strtok_r(NULL, "\n", &rest))
        argument[count++] = one;
    code_of_run = -1;
    running = 1;
    if (setjmp(end_of_run) == 0) {
        command_parse("solve", "CASE", "", "fnsFoKSkjJUT2c", count, argument, &r);
        if (case_input_find(&r) != NULL)
            fuzz_must(r.meshes <= COMMAND_MAX_MESHES &&
                          r.formulations <= COMMAND_MAX_FORMULATIONS &&
                          r.assignments <= CASE_MAX_PARAMETERS,
                      "no list is longer than its array");
    }
    running = 0;
    fuzz_must(code_of_run == -1 || code_of_run == EXIT_REFUSED || code_of_run == EXIT_AS_EXPECTED,
              "what is refused ends with 2, help with 0");
    free(text);
    return 0;
}
