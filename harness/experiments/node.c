#include "harness/experiments/node.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/formulations/formulations.h"

/* A function without arguments that returns a text, of a library that may be another one. */
static const char *answer_of(const char *name)
{
    char *(*function)(void);
    void *const found = dlsym(RTLD_DEFAULT, name);
    if (found == NULL)
        return NULL;
    memcpy(&function, &found, sizeof function);
    return function();
}

/* OpenBLAS names itself; of another library the name of its file. */
static void name_blas(char *out, size_t size)
{
    const char *config = answer_of("openblas_get_config"),
               *core = answer_of("openblas_get_corename");
    char path[PATH_MAX];
    Dl_info where;
    void *const product = dlsym(RTLD_DEFAULT, "dgemm_");
    if (config != NULL)
        snprintf(out, size, "%.150s%s%.80s", config, core != NULL ? ", kernels of " : "",
                 core != NULL ? core : "");
    else if (product != NULL && dladdr(product, &where) != 0 &&
             realpath(where.dli_fname, path) != NULL)
        snprintf(out, size, "%.200s", strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path);
    else
        snprintf(out, size, "unknown");
}

machine node_here(void)
{
    machine out = {.host = "unknown"};
    const environment e = environment_now(1);
    gethostname(out.host, sizeof out.host - 1);
    snprintf(out.processor, sizeof out.processor, "%s", e.processor);
    name_blas(out.blas, sizeof out.blas);
    return out;
}

int node_same_kind(const machine *a, const machine *b)
{
    return strcmp(a->processor, b->processor) == 0 && strcmp(a->blas, b->blas) == 0;
}
