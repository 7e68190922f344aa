#include <dlfcn.h>
#include <gsl/gsl_errno.h>
#include <hdf5.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "harness/cli/cli.h"

/* not inlined, so that its stack is used only after the stack size has been checked */
static __attribute__((noinline)) int run(int count, char **arguments)
{
    return verb_table_run(count, arguments);
}

/* If the stack limit is below 1 MB, raises it to 8 MB or as far as allowed, because a stack
 * overflow would end the program without a message. Returns 0 if the limit remains below 1 MB. */
static int stack_suffices(void)
{
    enum { LEAST = 1 << 20, USUAL = 1 << 23 }; /* [bytes] */
    struct rlimit stack;
    if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= LEAST)
        return 1;
    stack.rlim_cur = stack.rlim_max < USUAL ? stack.rlim_max : USUAL;
    return setrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur >= LEAST;
}

static _Noreturn void refuse_stack(void)
{
    static const char text[] = "beamwork: the stack is limited to less than 1 MB; allow more with "
                               "'ulimit -s 8192'\n";
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) {}
    _exit(EXIT_FAULT);
}

/* Processes and threads of the program already use all processors, its matrices for BLAS are small,
 * and threads of OpenBLAS spin while they wait. */
static void use_single_blas_thread(void)
{
    void (*set)(int);
    void *const found = dlsym(RTLD_DEFAULT, "openblas_set_num_threads");
    if (found == NULL || getenv("OPENBLAS_NUM_THREADS") != NULL)
        return;
    memcpy(&set, &found, sizeof set);
    set(1);
}

int main(int count, char **arguments)
{
    if (!stack_suffices())
        refuse_stack();
    ending_begin();
    gsl_set_error_handler_off();
    use_single_blas_thread();
    /* HDF5 must not clean up at exit: beamwork closes all HDF5 objects, and the exit handler of
     * HDF5 crashes or prints many lines if memory is exhausted. */
    H5dont_atexit();
    /* If the signal is ignored, a file that exceeds the file size limit causes a write error, which
     * is reported in one line. */
    signal(SIGXFSZ, SIG_IGN);
    return message_finish(run(count, arguments));
}
