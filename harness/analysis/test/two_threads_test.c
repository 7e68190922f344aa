/* Two simultaneous solutions with one model in two threads must be bitwise equal to a single
 * solution. */
#include <gsl/gsl_test.h>
#include <pthread.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"

enum { THREADS = 2, ROUNDS = 3 };

typedef struct one_thread {
    const scene *s;
    const model *m;
    solve_result result;
} one_thread;

static void *solved(void *of)
{
    one_thread *t = of;
    fault f = {""};
    const solve_options options = {.systems = 1, .condition = 1};
    solve_scene(t->s, t->m, &options, &t->result, &f);
    return NULL;
}

static int same_bits(const solve_result *a, const solve_result *b)
{
    int same = a->status == b->status && a->quantities == b->quantities &&
               memcmp(&a->counters, &b->counters, sizeof a->counters) == 0;
    for (int i = 0; same && i < a->quantities; i++)
        same = memcmp(&a->quantity[i].value, &b->quantity[i].value, sizeof(double)) == 0;
    return same;
}

static void at_once(const char *name, const scene *s, const model *m)
{
    one_thread alone = {.s = s, .m = m};
    solved(&alone);
    gsl_test(alone.result.status != STATUS_OK, "%s alone: %s", name, alone.result.reason);
    for (int round = 0; round < ROUNDS; round++) {
        pthread_t thread[THREADS];
        one_thread one[THREADS];
        int same = 1;
        for (int i = 0; i < THREADS; i++) {
            one[i] = (one_thread){.s = s, .m = m};
            pthread_create(&thread[i], NULL, solved, &one[i]);
        }
        for (int i = 0; i < THREADS; i++) {
            pthread_join(thread[i], NULL);
            same &= same_bits(&alone.result, &one[i].result);
            result_free(&one[i].result);
        }
        gsl_test(!same, "%s: two at once as one alone", name);
    }
    result_free(&alone.result);
}

static void compare_threads(const char *name, const char *with, int elements)
{
    const case_type *type = case_find(name, NULL);
    double value[CASE_MAX_PARAMETERS];
    formulation chosen;
    fault f = {""};
    scene s;
    model *m = NULL;
    parameters_default(type, value);
    scene_init(&s, name);
    gsl_test(case_build(type, value, &s, &f) != STATUS_OK ||
                 formulation_parse(with, &chosen, &f) != STATUS_OK,
             "%s: %s", name, f.text);
    const model_request request = {
        .scene = &s, .type = chosen.type, .options = chosen.option, .elements = elements};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s: %s", name, f.text);
    at_once(name, &s, m);
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    compare_threads("sheet_cantilever", "beamw", 4);
    compare_threads("c_column", "beamw_consistent", 8);
    compare_threads("rotating_cantilever", "beamw", 4);
    compare_threads("lee_frame", "geometrically_exact", 4);
    compare_threads("elbow", "collocation", 2);
    compare_threads("tip_body", "beamw_consistent", 4);
    return gsl_test_summary();
}
