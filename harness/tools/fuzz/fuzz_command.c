/* Uses the input as a command line, with one argument per line. The command line must be parsed, or
 * rejected with one line and the documented exit status. */
#include <argp.h>
#include <setjmp.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/tools/fuzz/fuzz.h"

/* Replaces exit() (linked with --wrap). If the program under test calls it, only the current
 * execution ends. */
void __wrap_exit(int code);
void __real_exit(int code);
error_t __wrap_argp_parse(const struct argp *parser, int count, char **arguments, unsigned flags,
                          int *end, void *input);
error_t __real_argp_parse(const struct argp *parser, int count, char **arguments, unsigned flags,
                          int *end, void *input);

typedef struct fuzz_request {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    truths_options truths;
    const char *output, *format, *select, *json;
    int jobs, shapes;
} fuzz_request;
static const verb_option own[] = {{"shapes", 0, "[STATES]", "",
                                   .member = offsetof(fuzz_request, shapes), .least = 1,
                                   .most = SHAPES_ALL},
                                  {0}};
static const verb_group shared[] = {{&options_case, offsetof(fuzz_request, of)},
                                    {&options_formulations, offsetof(fuzz_request, chosen)},
                                    {&options_time_limit, offsetof(fuzz_request, chosen)},
                                    {&options_meshes, offsetof(fuzz_request, meshes)},
                                    {&options_user_truths, offsetof(fuzz_request, truths)},
                                    {&options_output, offsetof(fuzz_request, output)},
                                    {&options_format, offsetof(fuzz_request, format)},
                                    {&options_select, offsetof(fuzz_request, select)},
                                    {&options_json, offsetof(fuzz_request, json)},
                                    {&options_jobs, offsetof(fuzz_request, jobs)},
                                    {NULL, 0}};
static const verb fuzzed = {.name = "solve",
                            .arguments = "OLD [NEW]",
                            .about = "",
                            .examples = "",
                            .shared = shared,
                            .own = own};
static jmp_buf end_of_run;
static int code_of_run, running;

void __wrap_exit(int code)
{
    if (!running)
        __real_exit(code); /* exit of the fuzzing program */
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
    static const verb *const verbs[] = {&fuzzed, NULL};
    static command_line line;
    static fuzz_request r;
    memset(&r, 0, sizeof r);
    char *argument[MOST + 1] = {NULL}, *rest = NULL, name[] = "verb";
    int count = 1;
    char *text = fuzz_text(data, size);
    static int quiet;
    if (!quiet && freopen("/dev/null", "w", stdout) != NULL)
        quiet = 1;
    argument[0] = name;
    for (char *one = strtok_r(text, "\n", &rest); one != NULL && count < MOST;
         one = strtok_r(NULL, "\n", &rest))
        argument[count++] = one;
    code_of_run = -1;
    running = 1;
    if (setjmp(end_of_run) == 0) {
        command_parse(&fuzzed, verbs, count, argument, &line, &r);
        if (case_input_find(&r.of) != NULL)
            fuzz_must(r.meshes.count <= SCENE_MESHES &&
                          r.chosen.formulations <= COMMAND_MAX_FORMULATIONS &&
                          r.of.set.count <= CASE_MAX_PARAMETERS,
                      "no list is longer than its array");
        options_case.close(&r.of);
    }
    running = 0;
    fuzz_must(code_of_run == -1 || code_of_run == EXIT_REFUSED || code_of_run == EXIT_AS_EXPECTED,
              "rejected input ends with status 2, help with 0");
    free(text);
    return 0;
}
