#include "harness/study/study.h"

#include <dlfcn.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static const char python[] = "/usr/bin/python3";
enum { NOT_DERIVABLE = 3, LINE = 600 }; /* as in reference/derive/at.py */

FILE *derive_text_file(fault *f)
{
    FILE *text = tmpfile();
    if (text == NULL)
        fault_set(f, STATUS_FAULT,
                  "a temporary file for the scene cannot be created (%s); make /tmp writable, and "
                  "free space there",
                  strerror(errno));
    return text;
}

status derive_script(const char *name, char out[PATH_MAX], fault *f)
{
    char folder[PATH_MAX];
    const char *given = getenv("BEAMWORK_REFERENCE");
    if (given == NULL)
        data_place("reference", folder);
    const int length =
        snprintf(out, PATH_MAX, "%s/derive/%s", given != NULL ? given : folder, name);
    return length < PATH_MAX ? STATUS_OK
                             : fault_set(f, STATUS_FAULT,
                                         "%.60s...: the path is too long; set the environment "
                                         "variable BEAMWORK_REFERENCE to a shorter path",
                                         out);
}

typedef struct script {
    pid_t process;
    FILE *output, *errors;
} script;

typedef struct derive_question {
    const char *path;
    const char *case_name, *parameters; /* NULL: none */
    FILE *input;
} derive_question;

static status start(const derive_question *q, script *s, fault *f)
{
    int out[2] = {-1, -1}, error[2] = {-1, -1};
    if (pipe(out) != 0 || pipe(error) != 0 || (s->process = fork()) < 0) {
        const int why = errno;
        for (int i = 0; i < 2; i++) {
            close(out[i]);
            close(error[i]);
        }
        fault_set(f, STATUS_FAULT,
                  "the deriving program cannot be started (%s); close other programs, and run the "
                  "command again",
                  strerror(why));
        return STATUS_FAULT;
    }
    if (s->process == 0) {
        dup2(out[1], STDOUT_FILENO);
        dup2(error[1], STDERR_FILENO);
        for (int i = 0; i < 2; i++) {
            close(out[i]);
            close(error[i]);
        }
        if (q->input != NULL && dup2(fileno(q->input), STDIN_FILENO) < 0)
            _exit(127);
        /* The full path is used, because Python finds its libraries relative to the path by which
         * it was called. The option -I makes Python ignore environment variables. */
        execl(python, python, "-I", "-B", q->path, q->case_name, q->parameters, (char *)NULL);
        _exit(127);
    }
    close(out[1]);
    close(error[1]);
    s->output = fdopen(out[0], "r");
    s->errors = fdopen(error[0], "r");
    if (s->output != NULL && s->errors != NULL)
        return STATUS_OK;
    fault_set(f, STATUS_FAULT,
              "the output of the deriving program cannot be read (%s); run the command again",
              strerror(errno));
    return STATUS_FAULT;
}

static int take_text(char **rest, char *to, size_t size)
{
    const char *field = strsep(rest, "\t");
    if (field == NULL || strlen(field) >= size)
        return 0;
    snprintf(to, size, "%s", field);
    return 1;
}

static int take_number(char **rest, double *to)
{
    const char *field = strsep(rest, "\t");
    char *end;
    if (field == NULL || *field == '\0')
        return 0;
    *to = strtod(field, &end);
    return *end == '\0' && isfinite(*to);
}

static status read_lines(FILE *from, derived_value **out, int *count, fault *f)
{
    char line[LINE];
    while (fgets(line, sizeof line, from) != NULL) {
        derived_value *more = realloc(*out, ((size_t)*count + 1) * sizeof *more);
        if (more == NULL)
            return fault_memory(f, "derived values");
        *out = more;
        derived_value *v = &more[*count];
        char *rest = line;
        line[strcspn(line, "\n")] = '\0';
        if (!take_text(&rest, v->quantity, sizeof v->quantity) || !take_number(&rest, &v->value) ||
            !take_text(&rest, v->unit, sizeof v->unit) || !take_number(&rest, &v->uncertainty) ||
            !take_text(&rest, v->convention, sizeof v->convention) ||
            !take_text(&rest, v->source, sizeof v->source))
            return fault_set(
                f, STATUS_FAULT,
                "the deriving program printed '%.80s' instead of a value; correct the program",
                line);
        ++*count;
    }
    return STATUS_OK;
}

/* Closes the streams of the script and waits until the process ends. Returns the status from
 * waitpid. */
static int stop(script *s)
{
    int how = 0;
    if (s->output != NULL)
        fclose(s->output);
    if (s->errors != NULL)
        fclose(s->errors);
    if (s->process > 0)
        waitpid(s->process, &how, 0);
    *s = (script){0};
    return how;
}

static status derive(const derive_question *q, script *s, derived_value **out, int *count, fault *f)
{
    char error_text[LINE] = "", more[LINE];
    TRY(start(q, s, f));
    TRY(read_lines(s->output, out, count, f));
    while (fgets(more, sizeof more, s->errors) != NULL) {
        memcpy(error_text, more, sizeof error_text);
        if (*count > 0)
            fputs(error_text, stderr);
    }
    error_text[strcspn(error_text, "\n")] = '\0';
    const int how = stop(s);
    if (how == 0)
        return STATUS_OK;
    return WIFEXITED(how) && WEXITSTATUS(how) == NOT_DERIVABLE
               ? fault_set(f, STATUS_REFUSED, "%.300s", error_text)
               : fault_set(f, STATUS_FAULT, "the deriving program failed: %.250s", error_text);
}

static status derive_requested(const derive_question *q, derived_value **out, int *count, fault *f)
{
    script s = {0};
    *out = NULL;
    *count = 0;
    if (access(q->path, R_OK) != 0)
        return fault_set(f, STATUS_FAULT,
                         "%.200s: the programs that derive reference values are missing; run "
                         "beamwork from a clone, or set the environment variable "
                         "BEAMWORK_REFERENCE to the folder 'reference' of a clone",
                         q->path);
    const status outcome = derive(q, &s, out, count, f);
    stop(&s);
    if (outcome != STATUS_OK) {
        free(*out);
        *out = NULL;
        *count = 0;
    }
    return outcome;
}

status derive_values(const char *path, const char *case_name, const char *parameters,
                     derived_value **out, int *count, fault *f)
{
    const derive_question q = {path, case_name, parameters, NULL};
    return derive_requested(&q, out, count, f);
}

status derive_scene(const char *path, FILE *scene_text, derived_value **out, int *count, fault *f)
{
    const derive_question q = {path, NULL, NULL, scene_text};
    rewind(scene_text);
    return derive_requested(&q, out, count, f);
}

#ifndef BEAMWORK_DATA
#define BEAMWORK_DATA "/usr/local/share/beamwork"
#endif

/* Writes the path that consists of `folder`, `below` and `name`. Returns 1 if the file can be
 * read. */
static int is_in(const char *folder, const char *below, const char *name, char path[PATH_MAX])
{
    const int length = snprintf(path, PATH_MAX, "%s/%s%s", folder, below, name);
    return length < PATH_MAX && access(path, R_OK) == 0;
}

/* Searches for `name` in the folder of the program or library, in the two folders above it, and in
 * share/beamwork/ of these two. A folder such as lib/x86_64-linux-gnu is one level deeper than bin/
 * and lib/. */
static int is_near(const char *folder, const char *name, char path[PATH_MAX])
{
    static const char *const below[] = {"", "../", "../../", "../share/beamwork/",
                                        "../../share/beamwork/"};
    for (size_t i = 0; i < sizeof below / sizeof below[0]; i++)
        if (is_in(folder, below[i], name, path))
            return 1;
    return 0;
}

static void program_folder(char out[PATH_MAX])
{
    const ssize_t length = readlink("/proc/self/exe", out, PATH_MAX - 1);
    out[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(out, '/');
    if (slash != NULL)
        *slash = '\0';
    else
        snprintf(out, PATH_MAX, ".");
}

static int library_folder(char out[PATH_MAX])
{
    static const char here = 0;
    Dl_info about;
    if (dladdr(&here, &about) == 0 || about.dli_fname == NULL ||
        strstr(about.dli_fname, ".so") == NULL || realpath(about.dli_fname, out) == NULL)
        return 0;
    *strrchr(out, '/') = '\0';
    return 1;
}

int data_place(const char *name, char path[PATH_MAX])
{
    char folder[PATH_MAX];
    if (library_folder(folder) && is_near(folder, name, path))
        return 1;
    program_folder(folder);
    if (is_near(folder, name, path) || is_in(BEAMWORK_DATA, "", name, path))
        return 1;
    is_in(folder, "", name, path);
    return 0;
}

void data_place_truths(char path[PATH_MAX])
{
    const char *given = getenv("BEAMWORK_TRUTHS");
    if (given != NULL)
        snprintf(path, PATH_MAX, "%s", given);
    else
        data_place("truths.h5", path);
}

void data_place_modules(void)
{
    char path[PATH_MAX];
    const char *given = getenv("PYTHONPATH");
    if (!data_place("elements/examples/beamwork_element.py", path) &&
        !data_place("examples/elements/beamwork_element.py", path))
        return;
    *strrchr(path, '/') = '\0';
    if (given != NULL && strstr(given, path) != NULL)
        return;
    const size_t room = (given != NULL ? strlen(given) : 0) + strlen(path) + 2;
    char *both = malloc(room);
    if (both == NULL)
        return;
    snprintf(both, room, "%s%s%s", given != NULL ? given : "",
             given != NULL && given[0] != '\0' ? ":" : "", path);
    setenv("PYTHONPATH", both, 1);
    setenv("PYTHONDONTWRITEBYTECODE", "1", 0);
    free(both);
}
