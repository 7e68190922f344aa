#include "harness/experiments/beam.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/model/model.h"
#include "harness/study/study.h"

/* An I of depth 0.1 m and flanges of 0.06 m. */
static section_spec i_profile(void)
{
    static const double h = 0.05, b = 0.03;
    static const double point[][2] = {{-b, h}, {0, h}, {b, h}, {-b, -h}, {0, -h}, {b, -h}},
                        thick[] = {2e-3, 2e-3, 2e-3, 2e-3, 2e-3};
    static const int ends[][2] = {{0, 1}, {1, 2}, {1, 4}, {3, 4}, {4, 5}};
    return section_spec_walls(210e9, 81e9, 5, point, ends, thick);
}

static section_spec spec_of(const beam_request *r)
{
    section_spec spec = section_spec_rectangle(210e9, 81e9, r->width, r->thickness);
    spec.given.Iw = 0;
    if (r->profile)
        spec = i_profile();
    spec.density = 7800;
    return spec;
}

status beam_section(const beam_request *r, section *out)
{
    const section_spec spec = spec_of(r);
    return section_compute(&spec, out, NULL);
}

/* The place at s of the length. */
static void place(const beam_request *r, double s, double at[3])
{
    const double radius = 2 / PI;
    at[0] = r->quarter ? radius * cos(s * PI / 2) : s;
    at[1] = r->quarter ? radius * sin(s * PI / 2) : 0;
    at[2] = 0;
}

static void add_pieces(const beam_request *r, scene *s)
{
    const section_spec spec = spec_of(r);
    const int profile = scene_add_section(s, &spec);
    double at[3], done = 0;
    place(r, 0, at);
    int from = scene_add_node(s, at[0], at[1], at[2]);
    scene_hold_all(s, from);
    for (int i = 0; i < r->elements; i++) {
        double next[3];
        done = i == r->elements - 1  ? 1
               : r->fraction != NULL ? done + r->fraction[i]
                                     : (i + 1.0) / r->elements;
        place(r, done, next);
        const double across[3] = {-(next[1] - at[1]), next[0] - at[0], 0};
        const int to = scene_add_node(s, next[0], next[1], next[2]);
        scene_member *m = scene_member_at(s, scene_add_member(s, from, to, profile, across));
        m->warp_p = i == 0 && r->profile ? SCENE_WARP_FIXED : i;
        m->warp_q = i == r->elements - 1 ? SCENE_WARP_FREE : i + 1;
        m->divisions = 1;
        memcpy(at, next, sizeof at);
        from = to;
    }
}

static void add_question(const beam_request *r, scene *s)
{
    static const double end = 1;
    const int tip = s->nodes - 1;
    int analysis;
    if (r->analysis != BEAM_VIBRATION)
        scene_add_load(s, r->load, tip, r->vector[0], r->vector[1], r->vector[2]);
    switch (r->analysis) {
    case BEAM_LARGE:
        analysis = scene_add_static(s, 1, &end, 1);
        break;
    case BEAM_BUCKLING:
        analysis = scene_add_buckling(s, SCENE_NONE);
        scene_add_quantity(s, "value", "1", analysis, scene_critical_factor(1, 0));
        return;
    case BEAM_VIBRATION:
        analysis = scene_add_modal(s, SCENE_NONE);
        scene_add_quantity(s, "value", "Hz", analysis, scene_frequency(0, SCENE_ANY));
        return;
    default:
        analysis = scene_add_linear(s);
    }
    scene_add_quantity(s, "value", r->component < SCENE_RX ? "m" : "rad", analysis,
                       scene_coordinate(tip, r->component));
}

static double solved(const beam_request *r, const scene *s, char words[MEASURE_WORDS])
{
    cell_request request = {.scene = s, .elements = 1};
    cell_result found;
    fault f = {""};
    double value = NAN;
    cell_formulation(&request, r->chosen);
    const status outcome = cell_run(&request, &found, &f);
    if (outcome == STATUS_OK && found.solve.quantities == 1)
        value = found.solve.quantity[0].value;
    if (isnan(value))
        snprintf(words, MEASURE_WORDS, "%.180s",
                 f.text[0] != '\0'               ? f.text
                 : found.solve.reason[0] != '\0' ? found.solve.reason
                                                 : "no value");
    cell_result_free(&found);
    return value;
}

int beam_point(const beam_request *r, double at, double exact, element_measure *one)
{
    scene s;
    fault f = {""};
    char words[MEASURE_WORDS] = "", missing[MEASURE_WORDS - 20];
    int offered = 1;
    double value = NAN;
    scene_init(&s, "beam");
    add_pieces(r, &s);
    add_question(r, &s);
    scene_omit(&s, SCENE_OMITTABLE & ~(r->needs | FEATURE_WARPING));
    if (scene_validate(&s, &f) != STATUS_OK)
        snprintf(words, sizeof words, "%.180s", f.text);
    else if (missing_words(&s, r->chosen->type, missing, sizeof missing))
        offered = 0;
    else
        value = solved(r, &s, words);
    if (!offered)
        snprintf(one->words, sizeof one->words, "not offered: %s", missing);
    else if (words[0] != '\0' && one->words[0] == '\0')
        memcpy(one->words, words, sizeof words);
    if (offered)
        measures_point(one, at, value / exact - 1);
    scene_free(&s);
    return offered && !measures_hopeless(one);
}
