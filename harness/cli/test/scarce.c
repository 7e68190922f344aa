/* A library for LD_PRELOAD. In the process that was started, but not in its children, allocation
 * number $SCARCE_AT after the start of main fails. If $SCARCE_ONLY names a function, only its
 * calls are counted. The number of counted calls is written to the file $SCARCE_COUNT. */
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef int main_function(int, char **, char **);

static struct {
    void *(*malloc)(size_t);
    void *(*calloc)(size_t, size_t);
    void *(*realloc)(void *, size_t);
    void (*free)(void *);
    FILE *(*fmemopen)(void *, size_t, const char *);
    FILE *(*open_memstream)(char **, size_t *);
    FILE *(*fopen)(const char *, const char *);
    FILE *(*fdopen)(int, const char *);
} real;
static main_function *real_main;
static long at, count;
static int counts;
static const char *only;
/* memory for dlsym, before the functions are known */
static _Alignas(16) char pool[1 << 14];
static size_t used;

static void find(const char *name, void *to)
{
    void *found = dlsym(RTLD_NEXT, name);
    memcpy(to, &found, sizeof found);
}

static __attribute__((constructor)) void begin(void)
{
    find("malloc", &real.malloc);
    find("calloc", &real.calloc);
    find("realloc", &real.realloc);
    find("free", &real.free);
    find("fmemopen", &real.fmemopen);
    find("open_memstream", &real.open_memstream);
    find("fopen", &real.fopen);
    find("fdopen", &real.fdopen);
}

static void end(void)
{
    const char *path = getenv("SCARCE_COUNT");
    FILE *to = counts && path != NULL ? real.fopen(path, "w") : NULL;
    counts = 0;
    if (to != NULL) {
        fprintf(to, "%ld", count);
        fclose(to);
    }
}

static void in_child(void)
{
    counts = 0;
}

static int counted_main(int words, char **word, char **variables)
{
    const char *text = getenv("SCARCE_AT");
    at = text != NULL ? strtol(text, NULL, 10) : 0;
    only = getenv("SCARCE_ONLY");
    pthread_atfork(NULL, NULL, in_child);
    atexit(end);
    counts = 1;
    return real_main(words, word, variables);
}

int __libc_start_main(main_function *run, int words, char **word, main_function *init,
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end)
{
    int (*start)(main_function *, int, char **, main_function *, void (*)(void), void (*)(void),
                 void *);
    find("__libc_start_main", &start);
    real_main = run;
    return start(counted_main, words, word, init, fini, rtld_fini, stack_end);
}

static int refuses(const char *name)
{
    if (!counts || (only != NULL && strcmp(only, name) != 0))
        return 0;
    if (__atomic_add_fetch(&count, 1, __ATOMIC_RELAXED) != at)
        return 0;
    errno = ENOMEM;
    return 1;
}

static int is_pooled(const void *p)
{
    return (const char *)p >= pool && (const char *)p < pool + sizeof pool;
}

static void *from_pool(size_t size)
{
    used = (used + 15) & ~(size_t)15;
    void *out = pool + used;
    used += size;
    return used <= sizeof pool ? out : NULL;
}

void *malloc(size_t size)
{
    if (real.malloc == NULL)
        return from_pool(size);
    return refuses("malloc") ? NULL : real.malloc(size);
}

void *calloc(size_t elements, size_t size)
{
    if (real.calloc == NULL)
        return from_pool(elements * size);
    return refuses("calloc") ? NULL : real.calloc(elements, size);
}

void *realloc(void *old, size_t size)
{
    if (is_pooled(old))
        return NULL;
    return refuses("realloc") ? NULL : real.realloc(old, size);
}

void free(void *old)
{
    if (!is_pooled(old))
        real.free(old);
}

FILE *fmemopen(void *bytes, size_t size, const char *mode)
{
    return refuses("fmemopen") ? NULL : real.fmemopen(bytes, size, mode);
}

FILE *open_memstream(char **text, size_t *size)
{
    return refuses("open_memstream") ? NULL : real.open_memstream(text, size);
}

FILE *fopen(const char *path, const char *mode)
{
    return refuses("fopen") ? NULL : real.fopen(path, mode);
}

FILE *fdopen(int descriptor, const char *mode)
{
    return refuses("fdopen") ? NULL : real.fdopen(descriptor, mode);
}
