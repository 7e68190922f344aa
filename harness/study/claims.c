#include "harness/study/claims.h"

#include <stdatomic.h>
#include <sys/mman.h>

/* Of one thing; key 0: free. */
typedef struct process_claim {
    _Atomic uint64_t key, check;
    atomic_int task; /* behind the first, 1 is added; 0: not yet said */
} process_claim;

struct claims {
    size_t size; /* [bytes] of the whole */
    uint64_t places;
    process_claim place[];
};

claims *claims_alloc(int count)
{
    const uint64_t places = 2 * (uint64_t)(count > 0 ? count : 0) + 1;
    const size_t size = sizeof(claims) + places * sizeof(process_claim);
    claims *out = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (out == MAP_FAILED)
        return NULL;
    out->size = size;
    out->places = places;
    return out;
}

void claims_free(claims *c)
{
    if (c != NULL)
        munmap(c, c->size);
}

/* Is it the same thing? One that is just being said is taken for another. */
static int is_same(process_claim *at, const identity *what)
{
    return atomic_load(&at->task) != 0 && atomic_load(&at->check) == what->part[1];
}

int claims_take(claims *c, const identity *what, int task)
{
    const uint64_t key = what->part[0] != 0 ? what->part[0] : 1;
    for (uint64_t i = 0; i < c->places; i++) {
        process_claim *at = &c->place[(key + i) % c->places];
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
