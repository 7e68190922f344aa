#include "harness/numerics/numerics.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { SPINS = 2000 };

typedef struct thread_pool_member {
    thread_pool *pool;
    int index; /* 1 .. threads - 1; the calling thread is thread 0 */
    pthread_t thread;
} thread_pool_member;

struct thread_pool {
    int threads, started;
    thread_pool_member member[THREAD_POOL_MOST];
    pthread_mutex_t lock;
    pthread_cond_t wake;
    atomic_int round,
        /* round: changes when there is work; left: number of threads that are still working */
        left;
    int end;
    int count;
    thread_pool_work *work;
    void *context;
};

static void do_part(const thread_pool *t, int index)
{
    const int first = (int)((long)t->count * index / t->threads),
              end = (int)((long)t->count * (index + 1) / t->threads);
    if (first < end)
        t->work(t->context, first, end);
}

static void wait_for_round(thread_pool *t, int seen)
{
    for (int i = 0; i < SPINS; i++)
        if (atomic_load_explicit(&t->round, memory_order_acquire) != seen)
            return;
    pthread_mutex_lock(&t->lock);
    while (atomic_load(&t->round) == seen)
        pthread_cond_wait(&t->wake, &t->lock);
    pthread_mutex_unlock(&t->lock);
}

static void *live(void *argument)
{
    const thread_pool_member *self = argument;
    thread_pool *t = self->pool;
    for (int seen = 0;; seen++) {
        wait_for_round(t, seen);
        if (t->end)
            return NULL;
        do_part(t, self->index);
        atomic_fetch_sub_explicit(&t->left, 1, memory_order_release);
    }
}

static void announce(thread_pool *t)
{
    pthread_mutex_lock(&t->lock);
    atomic_fetch_add(&t->round, 1);
    pthread_cond_broadcast(&t->wake);
    pthread_mutex_unlock(&t->lock);
}

status thread_pool_alloc(int threads, thread_pool **out, fault *f)
{
    *out = NULL;
    if (threads <= 1)
        return STATUS_OK;
    thread_pool *t = calloc(1, sizeof *t);
    if (t == NULL)
        return fault_memory(f, "threads");
    t->threads = threads < THREAD_POOL_MOST ? threads : THREAD_POOL_MOST;
    pthread_mutex_init(&t->lock, NULL);
    pthread_cond_init(&t->wake, NULL);
    for (int i = 1; i < t->threads; i++) {
        t->member[i] = (thread_pool_member){.pool = t, .index = i};
        if (pthread_create(&t->member[i].thread, NULL, live, &t->member[i]) != 0)
            break;
        t->started++;
    }
    if (t->started + 1 < t->threads) {
        thread_pool_free(t);
        return fault_set(f, STATUS_FAULT, "cannot start %d threads", threads);
    }
    *out = t;
    return STATUS_OK;
}

void thread_pool_free(thread_pool *t)
{
    if (t == NULL)
        return;
    t->end = 1;
    announce(t);
    for (int i = 1; i <= t->started; i++)
        pthread_join(t->member[i].thread, NULL);
    pthread_cond_destroy(&t->wake);
    pthread_mutex_destroy(&t->lock);
    free(t);
}

void thread_pool_run(thread_pool *t, int count, thread_pool_work *work, void *context)
{
    if (t == NULL) {
        work(context, 0, count);
        return;
    }
    t->count = count;
    t->work = work;
    t->context = context;
    atomic_store(&t->left, t->threads - 1);
    announce(t);
    do_part(t, 0);
    int spins = 0;
    while (atomic_load_explicit(&t->left, memory_order_acquire) > 0)
        if (++spins > SPINS)
            sched_yield();
}

typedef struct relay {
    thread_pool_fill *fill;
    thread_pool_take *take;
    void *context;
    int pieces;
    atomic_int claimed, taken;
    atomic_int filled[THREAD_POOL_SLOTS]; /* index of the piece in the slot, plus one */
} relay;

static int fill_next(relay *r)
{
    int piece = atomic_load(&r->claimed);
    if (piece >= r->pieces ||
        piece - atomic_load_explicit(&r->taken, memory_order_acquire) >= THREAD_POOL_SLOTS ||
        !atomic_compare_exchange_strong(&r->claimed, &piece, piece + 1))
        return 0;
    r->fill(r->context, piece, piece % THREAD_POOL_SLOTS);
    atomic_store_explicit(&r->filled[piece % THREAD_POOL_SLOTS], piece + 1, memory_order_release);
    return 1;
}

static void wait_a_moment(int *spins)
{
    if (++*spins > SPINS)
        sched_yield();
}

static void follow(relay *r)
{
    int spins = 0;
    while (atomic_load(&r->claimed) < r->pieces)
        if (fill_next(r))
            spins = 0;
        else
            wait_a_moment(&spins);
}

static void lead(relay *r)
{
    int spins = 0, wanted = 1;
    for (int piece = 0; piece < r->pieces && wanted;) {
        const int slot = piece % THREAD_POOL_SLOTS;
        if (atomic_load_explicit(&r->filled[slot], memory_order_acquire) == piece + 1) {
            wanted = r->take(r->context, piece, slot);
            atomic_store_explicit(&r->taken, ++piece, memory_order_release);
            spins = 0;
        } else if (!fill_next(r))
            wait_a_moment(&spins);
    }
    atomic_store(&r->claimed, r->pieces);
}

static void relay_member(void *context, int first, int end)
{
    (void)end;
    if (first == 0)
        lead(context);
    else
        follow(context);
}

void thread_pool_relay(thread_pool *t, int pieces, thread_pool_fill *fill, thread_pool_take *take,
                       void *context)
{
    if (t == NULL) {
        int wanted = 1;
        for (int piece = 0; piece < pieces && wanted; piece++) {
            fill(context, piece, 0);
            wanted = take(context, piece, 0);
        }
        return;
    }
    relay r = {.fill = fill, .take = take, .context = context, .pieces = pieces};
    thread_pool_run(t, t->threads, relay_member, &r);
}
