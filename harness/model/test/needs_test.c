/* The features that a scene needs must follow from the couplings of its sections and from its
 * analyses. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/model/model.h"

static void member(double Fyz, double Fyw, double Fzw, scene *s)
{
    const double y[3] = {0, 1, 0};
    section_spec spec = section_spec_constants(1, 1);
    spec.density = 1;
    spec.constants = (section){.A = 1, .Iy = 1, .Iz = 1, .It = 1, .Iw = 1, .Ip = 2};
    const double F[9] = {1, Fyz, Fyw, Fyz, 1, Fzw, Fyw, Fzw, 1};
    memcpy(spec.constants.F, F, sizeof F);
    scene_init(s, "member");
    const int p = scene_add_node(s, 0, 0, 0), q = scene_add_node(s, 1, 0, 0);
    scene_add_member(s, p, q, scene_add_section(s, &spec), y);
}

static void couplings(void)
{
    static const double F[][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {0, 0, -0.1}};
    static const element_type symmetric = {.name = "symmetric",
                                           .offers = ~0u,
                                           .limits = LIMIT_DOUBLY_SYMMETRIC},
                              any = {.name = "any", .offers = ~0u};
    for (size_t i = 0; i < sizeof F / sizeof F[0]; i++) {
        scene s;
        char words[200];
        member(F[i][0], F[i][1], F[i][2], &s);
        gsl_test_int(missing_words(&s, &symmetric, words, sizeof words), i > 0, "coupling %zu: %s",
                     i, words);
        gsl_test_int(missing_words(&s, &any, words, sizeof words), 0,
                     "coupling %zu, of any section: %s", i, words);
        scene_free(&s);
    }
}

static void frequencies(void)
{
    scene s;
    member(0, 0, 0, &s);
    const int loading = scene_add_linear(&s), modal = scene_add_modal(&s, SCENE_NONE);
    gsl_test((features_needed(&s) & FEATURE_GEOMETRIC) != 0,
             "frequencies at rest need no stiffness of loads");
    s.analysis[modal].follows = loading;
    gsl_test((features_needed(&s) & FEATURE_GEOMETRIC) == 0, "frequencies under a load do");
    scene_free(&s);
}

int main(void)
{
    couplings();
    frequencies();
    return gsl_test_summary();
}
