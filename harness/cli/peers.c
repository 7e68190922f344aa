#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/study/study.h"

static const char python[] = "/usr/bin/python3";
enum { MOST_WORDS = 2 * CASE_MAX_PARAMETERS + 16, NO_VALUES = 3 };

/* Words of a command. Texts in `made` are freed. */
typedef struct peers_command {
    int words, made_words;
    const char *word[MOST_WORDS];
    char *made[MOST_WORDS];
} peers_command;

static void add(peers_command *c, const char *text)
{
    c->word[c->words++] = text;
}

static void add_made(peers_command *c, char *text)
{
    c->made[c->made_words++] = text;
    add(c, text != NULL ? text : "");
}

static void add_meshes(peers_command *c, const mesh_list *m)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = m->count > 0 ? open_memstream(&text, &size) : NULL;
    if (to == NULL)
        return;
    for (int i = 0; i < m->count; i++)
        fprintf(to, "%s%d", i > 0 ? "," : "", m->elements[i]);
    fclose(to);
    add(c, "--elements");
    add_made(c, text);
}

static void add_case(peers_command *c, const case_options *of, const case_type *type)
{
    char text[PARAMETERS_TEXT];
    parameters_text(type, of->parameter, text, sizeof text);
    if (of->scene_path != NULL)
        add(c, "--scene");
    add(c, of->scene_path != NULL ? of->scene_path : type->name);
    for (char *rest = text, *one; (one = strsep(&rest, ";")) != NULL;)
        if (one[0] != '\0' && c->words < MOST_WORDS - 10) {
            add(c, "--set");
            add_made(c, strdup(one));
        }
}

static void set_environment(void)
{
    char path[PATH_MAX];
    if (data_place("harness/library/python/beamwork/peers/__init__.py", path)) {
        for (int i = 0; i < 3; i++)
            *strrchr(path, '/') = '\0';
        setenv("PYTHONPATH", path, 1);
        setenv("PYTHONDONTWRITEBYTECODE", "1", 0);
    }
    if (data_place("libbeamwork.so.0", path))
        setenv("BEAMWORK_LIBRARY", path, 0);
    if (realpath("/proc/self/exe", path) != NULL)
        setenv("BEAMWORK", path, 1);
}

static status run(const peers_command *c, int *found, fault *f)
{
    int how = 0;
    const pid_t child = fork();
    if (child == 0) {
        char *word[MOST_WORDS] = {NULL};
        for (int i = 0; i < c->words; i++)
            word[i] = strdup(c->word[i]);
        set_environment();
        execv(python, word);
        _exit(127);
    }
    if (child < 0 || waitpid(child, &how, 0) < 0 || !WIFEXITED(how) || WEXITSTATUS(how) == 127)
        return fault_set(f, STATUS_FAULT,
                         "--peers: %s cannot be run; install Python, on Debian and Ubuntu with "
                         "'sudo apt-get install python3'",
                         python);
    *found = WEXITSTATUS(how) == 0;
    return *found || WEXITSTATUS(how) == NO_VALUES
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "--peers: no program was run; correct the error that is printed above");
}

status peers_solve(const case_options *of, const case_type *type, const mesh_list *meshes,
                   const char *peers, const char *to, int *found, fault *f)
{
    peers_command c = {0};
    add(&c, python);
    add(&c, "-m");
    add(&c, "beamwork.peers");
    add_case(&c, of, type);
    add_meshes(&c, meshes);
    add(&c, "--peers");
    add(&c, peers);
    add(&c, "-o");
    add(&c, to);
    const status outcome = run(&c, found, f);
    for (int i = 0; i < c.made_words; i++)
        free(c.made[i]);
    return outcome;
}
