/* OP = K^-1 s A is symmetric in the inner product of K (ARPACK mode 2). The projection I - X X^T K
 * removes known eigenvectors X. */
#include "harness/numerics/numerics_impl.h"

#include <arpack/arpack.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MAX_RESTARTS = 300, EXTRA_VECTORS = 12, PARAMETERS = 11, POINTERS = 14 };
enum {
    ENDED_EARLY = 1,
    CONVERGED = 4
}; /* value of ARPACK's info after an iteration that ended early; index of the number of converged
      values in its iparam */

/* Tolerance for the error of a vector. The error of its Rayleigh quotient is the square of this
 * value. */
static const double tolerance = 1e-10;

typedef struct lanczos_workspace {
    int n, wanted, vectors, size;
    double *numbers, *start, *basis, *vector, *work, *value;
    int *integers, *parameter, *pointer, *select;
} lanczos_workspace;

static status workspace_alloc(lanczos_workspace *w, int n, int wanted, int room, fault *f)
{
    memset(w, 0, sizeof *w);
    w->n = n;
    w->wanted = wanted;
    w->vectors = wanted + EXTRA_VECTORS < room ? wanted + EXTRA_VECTORS : room;
    w->size = w->vectors * (w->vectors + 8);
    const size_t N = (size_t)n, vectors = (size_t)w->vectors;
    w->numbers = malloc((4 * N + (size_t)w->size + vectors) * sizeof *w->numbers);
    w->basis = malloc(N * vectors * sizeof *w->basis);
    w->integers = calloc(PARAMETERS + POINTERS + vectors, sizeof *w->integers);
    if (w->numbers == NULL || w->integers == NULL || w->basis == NULL)
        return fault_memory(f, "%d vectors of %d unknowns", w->vectors, n);
    w->start = w->numbers;
    w->vector = w->start + N;
    w->work = w->vector + 3 * N;
    w->value = w->work + w->size;
    w->parameter = w->integers;
    w->pointer = w->parameter + PARAMETERS;
    w->select = w->pointer + POINTERS;
    return STATUS_OK;
}

static void workspace_free(lanczos_workspace *w)
{
    free(w->numbers);
    free(w->basis);
    free(w->integers);
}

/* Sets x to a fixed starting vector with a component along every mode. */
static void fill_start(int n, double x[])
{
    unsigned long long seed = 0x9E3779B97F4A7C15ull;
    for (int i = 0; i < n; i++) {
        seed = seed * 6364136223846793005ull + 1442695040888963407ull;
        x[i] = (double)(seed >> 11) / 9007199254740992.0 - 0.5;
    }
}

/* Computes x -= X dual^T measured for the `known` vectors. */
static void deflate(int n, int known, const double *dual, const double *measured, const double *X,
                    double x[])
{
    for (int k = 0; k < known; k++) {
        const double *d = dual + (size_t)k * (size_t)n, *v = X + (size_t)k * (size_t)n;
        double part = 0;
        for (int i = 0; i < n; i++)
            part += d[i] * measured[i];
        for (int i = 0; i < n; i++)
            x[i] -= part * v[i];
    }
}

/* Computes y = OP x, and replaces x by s A x, as ARPACK requires. Removes the known eigenvectors
 * from both. */
static void apply(const lanczos_problem *p, double x[], double y[])
{
    const int n = p->K->n;
    sparse_mul(p->A, x, y);
    for (int i = 0; i < n; i++)
        x[i] = y[i] *= p->sign;
    factor_solve(p->K_factor, y);
    deflate(n, p->known, p->KX, y, p->X, y);
    deflate(n, p->known, p->X, x, p->KX, x);
}

static int iterate(const lanczos_problem *p, lanczos_workspace *w)
{
    int ido = 0, info = 1;
    w->parameter[0] = 1;
    w->parameter[2] = MAX_RESTARTS;
    w->parameter[6] = 2;
    for (;;) {
        dsaupd_c(&ido, "G", w->n, "LA", w->wanted, tolerance, w->start, w->vectors, w->basis, w->n,
                 w->parameter, w->pointer, w->vector, w->work, w->size, &info);
        if (ido != 2 && ido != 1 && ido != -1)
            return info;
        double *x = &w->vector[w->pointer[0] - 1], *y = &w->vector[w->pointer[1] - 1];
        if (ido == 2) {
            sparse_mul(p->K, x, y);
        } else {
            apply(p, x, y);
        }
    }
}

static void reverse(size_t n, int count, double x[])
{
    for (int low = 0, high = count - 1; low < high; low++, high--)
        for (size_t k = 0; k < n; k++) {
            const double kept = x[(size_t)low * n + k];
            x[(size_t)low * n + k] = x[(size_t)high * n + k];
            x[(size_t)high * n + k] = kept;
        }
}

static status take_vectors(lanczos_workspace *w, int n, int wanted, int found, double mu[],
                           double **x, fault *f)
{
    int info = 0;
    dseupd_c(1, "A", w->select, w->value, w->basis, n, 0, "G", n, "LA", wanted, tolerance, w->start,
             w->vectors, w->basis, n, w->parameter, w->pointer, w->vector, w->work, w->size, &info);
    if (info != 0)
        return fault_set(
            f, STATUS_NOT_CONVERGED,
            "the eigenvectors were not found (ARPACK returned %d); use another number of elements",
            info);
    for (int i = 0; i < found; i++)
        mu[i] = w->value[found - 1 - i];
    reverse((size_t)n, found, w->basis);
    double *less = realloc(w->basis, (size_t)found * (size_t)n * sizeof *less);
    *x = less != NULL ? less : w->basis;
    w->basis = NULL;
    return STATUS_OK;
}

static status solve(const lanczos_problem *p, lanczos_workspace *w, int wanted, int *found,
                    double mu[], double **x, fault *f)
{
    const int n = p->K->n;
    TRY(workspace_alloc(w, n, wanted, n - p->known, f));
    fill_start(n, w->start);
    deflate(n, p->known, p->KX, w->start, p->X, w->start);
    const int info = iterate(p, w);
    *found = info == 0 ? wanted : w->parameter[CONVERGED];
    if (info != 0 && (info != ENDED_EARLY || *found == 0))
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "only %d of %d eigenvalues were found (ARPACK returned %d); use another "
                         "number of elements",
                         *found, wanted, info);
    return take_vectors(w, n, wanted, *found, mu, x, f);
}

/* ARPACK stores its state between calls in static variables, so only one thread may use it at a
 * time. A process that is forked while another thread uses ARPACK does not have this thread;
 * therefore a fork waits for the lock. */
static pthread_mutex_t arpack = PTHREAD_MUTEX_INITIALIZER;
static pthread_once_t forks = PTHREAD_ONCE_INIT;

static void lock(void)
{
    pthread_mutex_lock(&arpack);
}

static void unlock(void)
{
    pthread_mutex_unlock(&arpack);
}

static void mind_forks(void)
{
    pthread_atfork(lock, unlock, unlock);
}

status lanczos_largest(const lanczos_problem *p, int wanted, int *found, double mu[], double **x,
                       fault *f)
{
    lanczos_workspace w;
    *x = NULL;
    pthread_once(&forks, mind_forks);
    lock();
    const status outcome = solve(p, &w, wanted, found, mu, x, f);
    unlock();
    workspace_free(&w);
    return outcome;
}

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double clock_wall_seconds(void)
{
    return seconds_of(CLOCK_MONOTONIC);
}

double clock_processor_seconds(void)
{
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}
