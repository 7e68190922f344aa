#include "harness/library/call.h"

#include <gsl/gsl_errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "harness/library/known.h"

_Static_assert((int)BW_FAULT == (int)STATUS_FAULT && (int)BW_NO_VALUE == (int)STATUS_NO_VALUE,
               "a bw_status is a status");

/* GSL has one handler for all threads: the first call puts it off, the last one back. `nested`:
 * calls of this thread alone. */
static _Thread_local int nested;
static struct {
    pthread_mutex_t lock;
    int inside;
    gsl_error_handler_t *before;
    locale_t plain;
} state = {.lock = PTHREAD_MUTEX_INITIALIZER};

/* A process that is forked has none of the other threads: it must not wait for them, and calls that
 * they are inside do not count there. */
static void before_fork(void)
{
    known_hold();
    pthread_mutex_lock(&state.lock);
}

static void after_fork(void)
{
    pthread_mutex_unlock(&state.lock);
    known_let_go();
}

static void in_child(void)
{
    state.inside = nested;
    after_fork();
}

static void mind_forks(void)
{
    pthread_atfork(before_fork, after_fork, in_child);
}

static locale_t go_in(void)
{
    static pthread_once_t forks = PTHREAD_ONCE_INIT;
    pthread_once(&forks, mind_forks);
    nested++;
    pthread_mutex_lock(&state.lock);
    if (state.plain == (locale_t)0)
        state.plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (state.inside++ == 0)
        state.before = gsl_set_error_handler_off();
    const locale_t plain = state.plain;
    pthread_mutex_unlock(&state.lock);
    return plain;
}

static void go_out(void)
{
    nested--;
    pthread_mutex_lock(&state.lock);
    if (--state.inside == 0)
        gsl_set_error_handler(state.before);
    pthread_mutex_unlock(&state.lock);
}

void call_begin(call *c, char **why)
{
    c->fault.text[0] = '\0';
    c->text = NULL;
    c->why = why;
    if (why != NULL)
        *why = NULL;
    c->locale = uselocale(go_in());
    fegetenv(&c->arithmetic);
    fesetenv(FE_DFL_ENV);
}

/* Bytes of the UTF-8 character that begins here; 0: none does. */
static int character(const unsigned char *at)
{
    const int more = (at[0] >= 0xc2) + (at[0] >= 0xe0) + (at[0] >= 0xf0);
    if (at[0] < ' ' || at[0] == 0x7f || (at[0] >= 0x80 && at[0] < 0xc2) || at[0] > 0xf4)
        return 0;
    for (int i = 1; i <= more; i++)
        if ((at[i] & 0xc0) != 0x80)
            return 0;
    return 1 + more;
}

/* One line of UTF-8, whatever names were given: what is none becomes '?'. */
static char *line_of(const fault *f)
{
    char *out = strdup(f->text);
    if (out == NULL)
        return NULL;
    for (unsigned char *at = (unsigned char *)out; *at != '\0';) {
        const int bytes = character(at);
        if (bytes == 0)
            *at = '?';
        at += bytes > 0 ? bytes : 1;
    }
    return out;
}

bw_status call_end(call *c, status outcome)
{
    fesetenv(&c->arithmetic);
    uselocale(c->locale);
    go_out();
    if (outcome != STATUS_OK && c->why != NULL)
        *c->why = c->text != NULL ? c->text : line_of(&c->fault);
    else
        free(c->text);
    return (bw_status)outcome;
}
