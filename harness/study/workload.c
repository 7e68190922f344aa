#include "harness/study/study_impl.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <sys/mman.h>

#include "harness/numerics/numerics.h"

static scene_edit noise_words(const formulation *, int repetition);
/* Sets series.noise to twice the larger of the differences between the repetitions and the value on
 * the finest mesh, relative to the value or to near_zero. If the formulation uses finite
 * differences with a larger error, the value is this error. NAN: a value or a repetition is
 * missing. Returns -1 if out of memory. */
static int noise_take(const sweep_point *, const cell_result again[NOISE_REPETITIONS], series *);

static int is_run(const sweep *s, int i)
{
    const series *one = &s->series[i];
    return one->missing[0] == '\0' && one->imported == NULL &&
           s->point[one->point].status == STATUS_OK && one->meshes > 0;
}

static int task_of_noise(const workload *w, int series_index, int repetition)
{
    return w->count + NOISE_REPETITIONS * series_index + repetition;
}

static void list_tasks(workload *w)
{
    for (int i = 0; i < w->s->seriess; i++) {
        const series *one = &w->s->series[i];
        w->open[i] = is_run(w->s, i) ? one->meshes : 0;
        w->state[i] = w->open[i] > 0 ? SERIES_CELLS : SERIES_WHOLE;
        for (int k = 0; k < NOISE_REPETITIONS; k++)
            w->tasks[task_of_noise(w, i, k)] = (workload_task){i, one->meshes - 1, k + 1};
    }
    for (int i = 0; i < w->all; i++)
        w->waits[i] = w->after[i] = -1;
    w->due = w->count;
    w->board->ended = w->due == 0;
}

static board *alloc_board(int all, size_t *size)
{
    *size = sizeof(board) + 2 * ((size_t)all + 1) * sizeof(atomic_int);
    board *out = mmap(NULL, *size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (out == MAP_FAILED)
        return NULL;
    if (sem_init(&out->changed, 1, 0) != 0) {
        munmap(out, *size);
        return NULL;
    }
    return out;
}

status workload_begin(const sweep_request *request, sweep *s, workload *out, fault *f)
{
    const int count = sweep_cells(s), all = count + NOISE_REPETITIONS * s->seriess;
    const size_t room = (size_t)all + 1, serieses = (size_t)s->seriess + 1;
    *out = (workload){.s = s,
                      .follower = request->follower,
                      .time_limit = request->time_limit,
                      .together = request->together,
                      .count = count,
                      .all = all,
                      .tasks = calloc(room, sizeof *out->tasks),
                      .done = calloc(room, 1),
                      .open = calloc(serieses, sizeof *out->open),
                      .state = calloc(serieses, 1),
                      .again = calloc(room, sizeof *out->again),
                      .known = request->share ? task_locks_alloc(all) : NULL,
                      .waits = malloc(room * sizeof *out->waits),
                      .after = malloc(room * sizeof *out->after)};
    out->board = alloc_board(all, &out->size);
    if (out->tasks == NULL || out->done == NULL || out->open == NULL || out->state == NULL ||
        out->again == NULL || out->waits == NULL || out->after == NULL || out->board == NULL ||
        run_cost_order(s, request->jobs, out->tasks) != 0)
        return fault_memory(f, "the list of runs");
    list_tasks(out);
    return STATUS_OK;
}

void workload_end(workload *w)
{
    if (w->again != NULL)
        for (int i = 0; i < w->all - w->count; i++)
            cell_result_free(&w->again[i]);
    if (w->board != NULL) {
        sem_destroy(&w->board->changed);
        munmap(w->board, w->size);
    }
    task_locks_free(w->known);
    free(w->tasks);
    free(w->done);
    free(w->open);
    free(w->state);
    free(w->again);
    free(w->waits);
    free(w->after);
}

/* Takes task i if the counter is still n, and increases the counter. Returns 0 if another worker
 * has taken the task. */
static int take(board *b, int self, atomic_int *counter, int n, int i)
{
    b->since[self] = clock_wall_seconds();
    b->at[self] = i;
    if (atomic_compare_exchange_strong(counter, &n, n + 1))
        return 1;
    b->at[self] = -1;
    return 0;
}

int workload_take(const workload *w, int self, int *alone)
{
    board *b = w->board;
    for (;;) {
        const int ended = b->ended, late = b->taken, next = b->next;
        if (late < b->later) {
            const int entry = b->added[late], i = entry < 0 ? ~entry : entry;
            *alone = entry < 0;
            if (take(b, self, &b->taken, late, i))
                return i;
        } else if (next < w->count) {
            *alone = 0;
            if (take(b, self, &b->next, next, next))
                return next;
        } else if (ended)
            return -1;
        else
            while (sem_wait(&b->changed) != 0 && errno == EINTR)
                ;
    }
}

scene_edit workload_edit(const workload *w, int i)
{
    const series *one = &w->s->series[w->tasks[i].series];
    return w->tasks[i].again > 0 ? noise_words(&one->formulation, w->tasks[i].again - 1)
                                 : w->s->point[one->point].edit;
}

cell_result *workload_cell(const workload *w, int i)
{
    return i < w->count ? &w->s->series[w->tasks[i].series].cell[w->tasks[i].mesh]
                        : &w->again[i - w->count];
}

static void add_task(workload *w, int entry)
{
    board *b = w->board;
    b->added[b->later] = entry;
    b->later++;
    sem_post(&b->changed);
}

static void begin_noise(workload *w, int i)
{
    w->state[i] = SERIES_NOISE;
    w->open[i] = NOISE_REPETITIONS;
    w->due += NOISE_REPETITIONS;
    for (int k = 0; k < NOISE_REPETITIONS; k++)
        add_task(w, task_of_noise(w, i, k));
}

/* Handles a series without unfinished tasks. If the scatter is needed, adds the repetitions of the
 * finest mesh; otherwise marks the series as complete. *last: last task of the series. */
static void all_done(workload *w, int i, const workload_task *last)
{
    series *one = &w->s->series[i];
    const sweep_follower *to = w->follower;
    if (last->again == 0 && to != NULL && to->needs_scatter != NULL &&
        to->needs_scatter(to->context, w->s, i)) {
        begin_noise(w, i);
        return;
    }
    if (last->again > 0)
        w->out_of_memory |= noise_take(&w->s->point[one->point],
                                       workload_cell(w, task_of_noise(w, i, 0)), one) != 0;
    w->state[i] = SERIES_WHOLE;
}

static void mark(workload *w, int i)
{
    const workload_task *t = &w->tasks[i];
    w->done[i] = 1;
    w->finished++;
    if (--w->open[t->series] == 0)
        all_done(w, t->series, t);
    if (w->finished < w->due)
        return;
    w->board->ended = 1;
    for (int k = 0; k < WORKERS_MOST; k++)
        sem_post(&w->board->changed);
}

static int copy(const cell_result *from, cell_result *to)
{
    char *bytes = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&bytes, &size);
    int bad = out == NULL || serialise_write(out, from) != 0;
    if (out != NULL)
        bad |= fclose(out) != 0;
    FILE *in = bad ? NULL : fmemopen(bytes, size, "rb");
    bad |= in == NULL || serialise_read(in, to) != 0;
    if (in != NULL)
        fclose(in);
    free(bytes);
    return bad;
}

static void finish(workload *w, int i, int same)
{
    if (workload_cell(w, same)->solve.status == STATUS_OK &&
        copy(workload_cell(w, same), workload_cell(w, i)) == 0)
        mark(w, i);
    else
        add_task(w, ~i);
}

void workload_done(workload *w, int i)
{
    if (w->done[i])
        return;
    mark(w, i);
    for (int k = w->waits[i]; k >= 0; k = w->after[k])
        finish(w, k, i);
    w->waits[i] = -1;
}

void workload_same(workload *w, int i, int same)
{
    if (w->done[same]) {
        finish(w, i, same);
        return;
    }
    w->after[i] = w->waits[same];
    w->waits[same] = i;
}

double workload_share(const workload *w)
{
    double done = 0, all = 0;
    for (int i = 0; i < w->all; i++) {
        const workload_task *t = &w->tasks[i];
        if (t->again > 0 && w->state[t->series] != SERIES_NOISE && !w->done[i])
            continue;
        const double cost = run_cost_of_cell(w->s, t->series, t->mesh);
        all += cost;
        done += w->done[i] ? cost : 0;
    }
    return all > 0 ? done / all : 0;
}

int workload_can_pass(const workload *w)
{
    return w->passed < w->s->seriess && w->state[w->passed] == SERIES_WHOLE;
}

status workload_pass(workload *w, fault *f)
{
    const int i = w->passed++;
    return w->follower != NULL && w->follower->whole != NULL
               ? w->follower->whole(w->follower->context, w->s, i, f)
               : STATUS_OK;
}

void workload_keep_whole(workload *w)
{
    int kept = 0;
    w->s->unfinished = w->due - w->finished;
    for (int i = 0; i < w->s->seriess; i++)
        if (w->state[i] != SERIES_WHOLE)
            sweep_series_free(&w->s->series[i]);
        else {
            w->state[kept] = SERIES_WHOLE;
            w->s->series[kept++] = w->s->series[i];
        }
    w->s->seriess = kept;
}

/* Factor for the larger of two differences, because both may be small by accident. */
static const double cover = 2;

static scene_edit noise_words(const formulation *chosen, int repetition)
{
    if (repetition == 0)
        return (scene_edit){SCENE_EDIT_UNIT, 1000};
    if (chosen->type->limits & LIMIT_ORDER_DEPENDENT)
        return (scene_edit){SCENE_EDIT_UNIT, 0.3};
    return (scene_edit){SCENE_EDIT_REVERSE, 0};
}

static double value_of(const cell_result *cell, int quantity)
{
    const solve_result *r = &cell->solve;
    return quantity < r->quantities && r->quantity[quantity].status == STATUS_OK
               ? r->quantity[quantity].value
               : NAN;
}

/* Returns twice the larger relative difference; NAN: one of the values is unknown. */
static double noise_of(const scene_quantity *q, double value, const double again[NOISE_REPETITIONS])
{
    double largest = 0;
    for (int k = 0; k < NOISE_REPETITIONS; k++) {
        const double scale = fmax(fabs(value), q->near_zero), apart = fabs(again[k] - value);
        if (!isfinite(apart))
            return NAN;
        largest = fmax(largest, apart > 0 ? apart / scale : 0);
    }
    return cover * largest;
}

static int noise_take(const sweep_point *p, const cell_result again[NOISE_REPETITIONS], series *one)
{
    const int quantities = p->scene.quantities;
    free(one->noise);
    one->noise = calloc((size_t)quantities + 1, sizeof *one->noise);
    if (one->noise == NULL)
        return -1;
    for (int q = 0; q < quantities; q++) {
        double value[NOISE_REPETITIONS];
        for (int k = 0; k < NOISE_REPETITIONS; k++)
            value[k] = value_of(&again[k], q);
        const double measured =
            noise_of(&p->scene.quantity[q], value_of(&one->cell[one->meshes - 1], q), value);
        /* Errors of finite differences are the same on all meshes and in equivalent scenes, so they
         * do not appear as scatter. */
        one->noise[q] =
            isnan(measured) ? measured : fmax(measured, adapters_error(one->formulation.type));
    }
    return 0;
}

int noise_cells(const sweep *s)
{
    int cells = 0;
    for (int i = 0; i < s->seriess; i++)
        cells += s->series[i].noise != NULL ? NOISE_REPETITIONS : 0;
    return cells;
}

typedef struct task_lock {
    _Atomic uint64_t key, check;
    atomic_int task;
} task_lock;

struct task_locks {
    size_t size;
    uint64_t places;
    task_lock place[];
};

task_locks *task_locks_alloc(int count)
{
    const uint64_t places = 2 * (uint64_t)(count > 0 ? count : 0) + 1;
    const size_t size = sizeof(task_locks) + places * sizeof(task_lock);
    task_locks *out = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (out == MAP_FAILED)
        return NULL;
    out->size = size;
    out->places = places;
    return out;
}

void task_locks_free(task_locks *c)
{
    if (c != NULL)
        munmap(c, c->size);
}

/* Returns 1 if the lock is for this problem, 0 also while the lock is being written. */
static int is_same(task_lock *at, const identity *what)
{
    return atomic_load(&at->task) != 0 && atomic_load(&at->check) == what->part[1];
}

int task_locks_acquire(task_locks *c, const identity *what, int task)
{
    const uint64_t key = what->part[0] != 0 ? what->part[0] : 1;
    for (uint64_t i = 0; i < c->places; i++) {
        task_lock *at = &c->place[(key + i) % c->places];
        uint64_t there = 0;
        if (atomic_compare_exchange_strong(&at->key, &there, key)) {
            atomic_store(&at->check, what->part[1]);
            atomic_store(&at->task, task + 1);
            return task;
        }
        if (there == key && is_same(at, what))
            return atomic_load(&at->task) - 1;
    }
    return task;
}
