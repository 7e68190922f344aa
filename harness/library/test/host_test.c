/* Settings of the host must not change the results, not even one bit, and must be restored
 * afterwards. */
#include <fenv.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_gamma.h>
#include <hdf5.h>
#include <locale.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "harness/library/test/leaf.h"

enum { THREADS = 4, ROUNDS = 6 };

/* Returns the document of a solution without its times. The caller frees it. */
static char *solved(const char *name, const char *formulation, int elements)
{
    char *why = NULL, *json = NULL;
    bw_scene *s = NULL;
    bw_result *r = NULL;
    if (bw_scene_case(name, &s, &why) == BW_OK &&
        bw_solve(s, formulation, elements, NULL, &r, &why) == BW_OK)
        bw_result_json(r, &json, &why);
    bw_result_free(r);
    bw_scene_free(s);
    bw_free_text(why);
    for (char *at = json; at != NULL && (at = strstr(at, "\"seconds_")) != NULL;)
        memmove(at, strchr(at, '\n'), strlen(strchr(at, '\n')) + 1);
    return json;
}

static void same(char *got, const char *expected, const char *what)
{
    gsl_test(got == NULL || expected == NULL || strcmp(got, expected) != 0, "same bits: %s", what);
    free(got);
}

static void rounding(const char *expected)
{
    fesetround(FE_UPWARD);
    same(solved("c_column", "beamw", 2), expected, "rounding upwards");
    gsl_test(fegetround() != FE_UPWARD, "the host rounds upwards still");
    fesetround(FE_TONEAREST);
#ifdef __GLIBC__
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    same(solved("c_column", "beamw", 2), expected, "traps");
    gsl_test(fegetexcept() != (FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW), "the traps are set still");
    fedisableexcept(FE_ALL_EXCEPT);
#endif
}

/* Sets a locale with a decimal comma. Returns 0 if the machine has none and none can be made. */
static int set_comma(char folder[])
{
    char command[200];
    if (setlocale(LC_ALL, "de_DE.UTF-8") != NULL)
        return 1;
    snprintf(command, sizeof command, "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8 >/dev/null 2>&1",
             folder);
    setenv("LOCPATH", folder, 1);
    return system(command) == 0 && setlocale(LC_ALL, "de_DE.UTF-8") != NULL;
}

static void words(const char *expected)
{
    char folder[] = "/tmp/beamwork.XXXXXX", command[100];
    if (mkdtemp(folder) == NULL || !set_comma(folder))
        printf("SKIP a comma in numbers: needs the locale de_DE.UTF-8\n");
    else {
        same(solved("c_column", "beamw", 2), expected, "a comma in numbers of the host");
        gsl_test(localeconv()->decimal_point[0] != ',', "the host has its comma still");
    }
    setlocale(LC_ALL, "C");
    snprintf(command, sizeof command, "rm -r %s", folder);
    gsl_test(system(command) != 0, "%s", command);
}

static int reported;

static void report_error(const char *reason, const char *file, int line, int number)
{
    (void)reason, (void)file, (void)line, (void)number;
    reported++;
}

static void catch (int number)
{
    (void)number;
}

static void handlers(const char *expected)
{
    static const int signals[] = {SIGSEGV, SIGALRM, SIGINT, SIGPIPE, SIGCHLD, SIGFPE, SIGABRT};
    H5E_auto2_t print = NULL;
    void *context = NULL;
    char *json = NULL;
    bw_scene *s = NULL;
    gsl_set_error_handler(report_error);
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++)
        signal(signals[i], catch);
    H5Eset_auto2(H5E_DEFAULT, (H5E_auto2_t)H5Eprint2, stderr);
    same(solved("c_column", "beamw", 2), expected, "handlers of the host");
    bw_scene_case("elastica", &s, NULL);
    gsl_test(bw_converge(s, "collocation", "1,2", NULL, &json, NULL) != BW_OK, "with processes");
    bw_free_text(json);
    bw_scene_free(s);
    gsl_sf_gamma(-1);
    gsl_test(reported < 1, "GSL tells the host, %d times", reported);
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++)
        gsl_test(signal(signals[i], SIG_DFL) != catch, "signal %d is the host's", signals[i]);
    H5Eget_auto2(H5E_DEFAULT, &print, &context);
    gsl_test(print != (H5E_auto2_t)H5Eprint2 || context != stderr, "HDF5 prints as before");
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

static void mute(void)
{
    char *text = NULL, *why = NULL;
    bw_scene *s = NULL;
    long written;
    FILE *to = tmpfile();
    const int out = dup(STDOUT_FILENO), error = dup(STDERR_FILENO);
    fflush(stdout);
    dup2(fileno(to), STDOUT_FILENO);
    dup2(fileno(to), STDERR_FILENO);
    bw_scene_case("nothing", &s, NULL);
    bw_scene_read("a: [", 4, NULL, &s, &why);
    bw_free_text(why);
    bw_truths("/dev/null", NULL);
    bw_truths(NULL, NULL);
    bw_formulation_load("/dev/null", NULL, NULL);
    bw_list(NULL, &text, NULL);
    bw_free_text(text);
    bw_scene_case("elastica", &s, NULL);
    bw_converge(s, "collocation sheet_third", "1,2", NULL, &text, NULL);
    bw_free_text(text);
    bw_verify(s, "collocation", NULL, NULL, "/dev/full", &text, NULL);
    bw_free_text(text);
    bw_scene_free(s);
    fflush(stdout);
    fflush(stderr);
    dup2(out, STDOUT_FILENO);
    dup2(error, STDERR_FILENO);
    written = lseek(fileno(to), 0, SEEK_END);
    gsl_test_int((int)written, 0, "bytes written to standard output and error");
    fclose(to);
    close(out);
    close(error);
}

static const char *const several[] = {"c_column", "c_column", "lateral_buckling", "tip_body"};
enum { SEVERAL = sizeof several / sizeof several[0], MANY = 150 };
static char *alone[SEVERAL];
static int differs[THREADS];

static void *work(void *argument)
{
    const int self = (int)((int *)argument - differs);
    for (int i = 0; i < ROUNDS * SEVERAL; i++) {
        const int which = (i + self) % SEVERAL;
        char *got = solved(several[which], "beamw", MANY);
        differs[self] += got == NULL || strcmp(got, alone[which]) != 0;
        free(got);
    }
    return NULL;
}

static void *converge(void *argument)
{
    char *json = NULL;
    bw_scene *s = NULL;
    for (int i = 0; i < ROUNDS; i++) {
        bw_scene_case("c_column", &s, NULL);
        *(int *)argument += bw_converge(s, "beamw", "2,4", "{\"jobs\": 2}", &json, NULL) != BW_OK;
        bw_free_text(json);
        bw_scene_free(s);
    }
    return NULL;
}

/* The allocator of the address sanitizer of gcc 12 deadlocks in a process that was forked while
 * another thread held its lock. The allocator of glibc does not. */
#ifdef __SANITIZE_ADDRESS__
enum { BESIDE = 0 };
#else
enum { BESIDE = 1 };
#endif

static void threads(void)
{
    pthread_t thread[THREADS], other;
    int failed = 0;
    for (int i = 0; i < SEVERAL; i++) {
        alone[i] = solved(several[i], "beamw", MANY);
        gsl_test(alone[i] == NULL, "%s is solved", several[i]);
    }
    for (int i = 0; i < THREADS; i++)
        pthread_create(&thread[i], NULL, work, &differs[i]);
    if (BESIDE)
        pthread_create(&other, NULL, converge, &failed);
    for (int i = 0; i < THREADS; i++) {
        pthread_join(thread[i], NULL);
        gsl_test_int(differs[i], 0, "answers of thread %d that differ", i);
    }
    if (BESIDE)
        pthread_join(other, NULL);
    else
        converge(&failed);
    gsl_test_int(failed, 0, "processes started beside them");
    for (int i = 0; i < SEVERAL; i++)
        free(alone[i]);
}

static void *solve_shared(void *scene)
{
    double *value = calloc(1, sizeof *value);
    bw_result *r = NULL;
    if (bw_solve(scene, NULL, 2, NULL, &r, NULL) == BW_OK)
        *value = bw_result_value(r, "buckling_load");
    bw_result_free(r);
    return value;
}

static void shared_scene(void)
{
    pthread_t thread[THREADS];
    double *value[THREADS];
    bw_scene *s = NULL;
    bw_scene_case("c_column", &s, NULL);
    for (int i = 0; i < THREADS; i++)
        pthread_create(&thread[i], NULL, solve_shared, s);
    for (int i = 0; i < THREADS; i++) {
        void *got;
        pthread_join(thread[i], &got);
        value[i] = got;
    }
    for (int i = 0; i < THREADS; i++)
        gsl_test(!(*value[i] > 0) || *value[i] < *value[0] || *value[i] > *value[0],
                 "a shared scene in thread %d", i);
    for (int i = 0; i < THREADS; i++)
        free(value[i]);
    bw_scene_free(s);
}

/* 1 after all tests. A numerical library may end the program early with status 0, as LAPACK does
 * for a wrong argument. */
static int ended;

static void mind_the_end(void)
{
    if (!ended)
        _exit(1);
}

/* If OpenBLAS 0.3.21 uses threads, one of several host threads occasionally obtains different last
 * digits. The test sets the number of threads of OpenBLAS, which is read during loading, to one. */
static void begin_again(char **arguments)
{
    if (getenv("OPENBLAS_NUM_THREADS") != NULL)
        return;
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    execv("/proc/self/exe", arguments);
}

int main(int count, char **arguments)
{
    begin_again(arguments);
    (void)count;
    atexit(mind_the_end);
    char *expected = solved("c_column", "beamw", 2);
    gsl_test(expected == NULL, "c_column is solved");
    rounding(expected);
    words(expected);
    handlers(expected);
    mute();
    threads();
    shared_scene();
    free(expected);
    ended = 1;
    return gsl_test_summary();
}
