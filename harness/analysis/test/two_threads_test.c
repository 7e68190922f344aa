/* Two simultaneous solutions with one model in two threads must be bitwise equal to a single
 * solution. */
#include <gsl/gsl_test.h>
#include <pthread.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/tools/kit/scenes.h"

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

static void compare_scene(const char *name, const scene *s, const char *with, int elements)
{
    formulation chosen;
    fault f = {""};
    model *m = NULL;
    gsl_test(formulation_parse(with, &chosen, &f) != STATUS_OK, "%s: %s", name, f.text);
    const model_request request = {
        .scene = s, .type = chosen.type, .options = chosen.option, .elements = elements};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s: %s", name, f.text);
    at_once(name, s, m);
    model_free(m);
}

static void compare_case(const char *name, const char *with, int elements)
{
    const case_type *type = case_find(name, NULL);
    double value[CASE_MAX_PARAMETERS];
    fault f = {""};
    scene s;
    parameters_default(type, value);
    scene_init(&s, name);
    gsl_test(case_build(type, value, &s, &f) != STATUS_OK, "%s: %s", name, f.text);
    compare_scene(name, &s, with, elements);
    scene_free(&s);
}

static void compare_file(const char *path, const char *values, const char *with, int elements)
{
    scene s;
    scenes_read(&s, path, "%s", values);
    compare_scene(values, &s, with, elements);
    scene_free(&s);
}

static void compare_motions(void)
{
    static const char *const values[] = {
        "of=linked;joint=hinge;damping=0.01;end=0.1;step=0.005;integrator=alpha",
        "of=linked;joint=hinge;damping=0.01;end=0.1;step=0.005;integrator=radau",
        "of=linked;joint=hinge;damping=0.01;end=0.1;step=0.005;integrator=conserving",
        "of=free;end=0.01;step=0.0005;integrator=explicit"};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
        compare_file("harness/time/test/rods.yaml", values[i], "geometrically_exact", 2);
    compare_file("cases/examples/servo.yaml", "place=0.02", "beamw", 1);
}

int main(void)
{
    compare_case("sheet_cantilever", "beamw", 4);
    compare_case("c_column", "beamw_consistent", 8);
    compare_case("rotating_cantilever", "beamw", 4);
    compare_case("lee_frame", "geometrically_exact", 4);
    compare_case("elbow", "collocation", 2);
    compare_case("tip_body", "beamw_consistent", 4);
    compare_file("cases/examples/sunlit_deck.yaml", "", "geometrically_exact", 2);
    compare_motions();
    return gsl_test_summary();
}
