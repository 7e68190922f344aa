#include "cases/scene/scene.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *scene_moments_name(scene_moments moments)
{
    static const char *const name[] = {"spatial", "semitangential", "symmetrised"};
    return name[moments];
}

static int add(scene *s, scene_analysis analysis)
{
    const int i = scene_grow(s, &s->analysis, &s->analyses, sizeof *s->analysis);
    analysis.acting = (scene_acting){SCENE_NONE, SCENE_NONE};
    if (i >= 0)
        s->analysis[i] = analysis;
    return i;
}

static scene_path path_of(scene *s, int stations, const double path[])
{
    return (scene_path){stations, scene_copy(s, stations, path)};
}

int scene_add_linear(scene *s)
{
    return add(s, (scene_analysis){.kind = SCENE_LINEAR, .follows = SCENE_NONE});
}

static int add_walk(scene *s, scene_analysis_kind kind, scene_walk walk)
{
    const int i =
        add(s, (scene_analysis){.kind = kind, .follows = SCENE_NONE, .of = {.walk = walk}});
    if (i < 0)
        free(walk.path.value);
    return i;
}

int scene_add_static(scene *s, int stations, const double path[], int steps_between)
{
    const scene_walk walk = {.path = path_of(s, stations, path), .steps_between = steps_between};
    return add_walk(s, SCENE_STATIC, walk);
}

int scene_add_rotation(scene *s, int stations, const double path[], int steps_between, int modes,
                       scene_rotating_frame frame)
{
    const scene_walk walk = {path_of(s, stations, path), steps_between, modes, frame};
    return add_walk(s, SCENE_ROTATION, walk);
}

int scene_add_buckling(scene *s, int follows)
{
    return add(s, (scene_analysis){.kind = SCENE_BUCKLING, .follows = follows});
}

int scene_add_modal(scene *s, int follows)
{
    return add(s, (scene_analysis){
                      .kind = SCENE_MODAL, .follows = follows, .time = NAN, .axes_of = SCENE_NONE});
}

int scene_add_compliance(scene *s, int follows, scene_compliance what)
{
    return add(s, (scene_analysis){
                      .kind = SCENE_COMPLIANCE, .follows = follows, .of = {.compliance = what}});
}

int scene_add_harmonic(scene *s, int follows, int frequencies, const double hertz[])
{
    const scene_path path = path_of(s, frequencies, hertz);
    const int i = add(s, (scene_analysis){.kind = SCENE_HARMONIC,
                                          .follows = follows,
                                          .time = NAN,
                                          .axes_of = SCENE_NONE,
                                          .of = {.harmonic = path}});
    if (i < 0)
        free(path.value);
    return i;
}

int scene_add_continuation(scene *s, int stations, const double path[], scene_control control)
{
    const scene_continuation what = {.path = path_of(s, stations, path), .control = control};
    const int i = add(s, (scene_analysis){.kind = SCENE_CONTINUATION,
                                          .follows = SCENE_NONE,
                                          .of = {.continuation = what}});
    if (i < 0)
        free(what.path.value);
    return i;
}

int scene_add_motion(scene *s, int follows, int stations, const double path[], scene_motion how)
{
    how.path = path_of(s, stations, path);
    const int i =
        add(s, (scene_analysis){.kind = SCENE_MOTION, .follows = follows, .of = {.motion = how}});
    if (i < 0)
        free(how.path.value);
    return i;
}

double scene_instant_of(const scene *s, int analysis)
{
    const scene_analysis *a = &s->analysis[analysis];
    if ((a->kind != SCENE_MODAL && a->kind != SCENE_HARMONIC) || a->follows == SCENE_NONE ||
        s->analysis[a->follows].kind != SCENE_MOTION)
        return NAN;
    const scene_path *path = scene_path_of(&s->analysis[a->follows]);
    return isnan(a->time) ? path->value[path->stations - 1] : a->time;
}

double scene_motion_begin(const scene *s, int analysis)
{
    const int before = s->analysis[analysis].follows;
    if (before == SCENE_NONE || s->analysis[before].kind != SCENE_MOTION)
        return 0;
    const scene_path *path = scene_path_of(&s->analysis[before]);
    return path->value[path->stations - 1];
}

scene_alpha scene_alpha_of_radius(double rho)
{
    return (scene_alpha){(2 * rho - 1) / (rho + 1), rho / (rho + 1)};
}

void scene_set_rotating_frame(scene *s, int analysis, scene_rotating_frame frame)
{
    if (analysis < 0)
        return;
    scene_analysis *a = &s->analysis[analysis];
    assert(scene_rotating_frame_of(a) != NULL);
    *(a->kind == SCENE_CONTINUATION ? &a->of.continuation.frame : &a->of.walk.frame) = frame;
}

const char *scene_analysis_name(scene_analysis_kind kind)
{
    static const char *const name[] = {"linear",   "static",     "buckling",
                                       "modal",    "compliance", "continuation",
                                       "rotation", "motion",     "harmonic"};
    return name[kind];
}

const scene_walk *scene_walk_of(const scene_analysis *a)
{
    assert(a->kind == SCENE_STATIC || a->kind == SCENE_ROTATION);
    return &a->of.walk;
}

const scene_compliance *scene_compliance_of(const scene_analysis *a)
{
    assert(a->kind == SCENE_COMPLIANCE);
    return &a->of.compliance;
}

const scene_continuation *scene_continuation_of(const scene_analysis *a)
{
    assert(a->kind == SCENE_CONTINUATION);
    return &a->of.continuation;
}

const scene_motion *scene_motion_of(const scene_analysis *a)
{
    assert(a->kind == SCENE_MOTION);
    return &a->of.motion;
}

int scene_has_ratios(const scene_analysis *a)
{
    int any = a->damping.ratio > 0;
    for (int i = 0; i < a->damping.ratios.stations; i++)
        any |= a->damping.ratios.value[i] > 0;
    return any;
}

int scene_spreads(const scene_analysis *a)
{
    return a->kind == SCENE_MOTION && scene_motion_of(a)->mass == SCENE_CONSISTENT;
}

/* Returns the first motion of the chain of motions that ends with this analysis. */
static int first_motion(const scene *s, int analysis)
{
    const int before = s->analysis[analysis].follows;
    return before != SCENE_NONE && s->analysis[before].kind == SCENE_MOTION
               ? first_motion(s, before)
               : analysis;
}

int scene_may_spread(const scene *s, int analysis)
{
    const scene_analysis *a = &s->analysis[analysis];
    if (a->kind != SCENE_MOTION || scene_motion_of(a)->mass != SCENE_MASS_USUAL)
        return scene_spreads(a);
    for (int i = 0; i < s->analyses; i++) {
        if (s->analysis[i].kind != SCENE_MOTION || first_motion(s, i) != first_motion(s, analysis))
            continue;
        const scene_motion *m = scene_motion_of(&s->analysis[i]);
        if (m->mass != SCENE_MASS_USUAL)
            return m->mass == SCENE_CONSISTENT;
        if (m->scheme != SCENE_ALPHA && m->scheme != SCENE_RADAU)
            return 0;
    }
    return !s->lumped;
}

/* Returns the offset of the path in an analysis; 0: the kind has no path. */
static size_t path_offset(scene_analysis_kind kind)
{
    switch (kind) {
    case SCENE_STATIC:
    case SCENE_ROTATION:
        return offsetof(scene_analysis, of.walk.path);
    case SCENE_CONTINUATION:
        return offsetof(scene_analysis, of.continuation.path);
    case SCENE_MOTION:
        return offsetof(scene_analysis, of.motion.path);
    case SCENE_HARMONIC:
        return offsetof(scene_analysis, of.harmonic);
    case SCENE_LINEAR:
    case SCENE_BUCKLING:
    case SCENE_MODAL:
    case SCENE_COMPLIANCE:
        break;
    }
    return 0;
}

const scene_path *scene_path_of(const scene_analysis *a)
{
    const size_t offset = path_offset(a->kind);
    return offset == 0 ? NULL : (const void *)((const char *)a + offset);
}

scene_path *scene_editable_path(scene_analysis *a)
{
    const size_t offset = path_offset(a->kind);
    return offset == 0 ? NULL : (void *)((char *)a + offset);
}

int scene_origin_of(const scene *s, int analysis)
{
    int i = analysis;
    while (i != SCENE_NONE && s->analysis[i].kind == SCENE_MOTION)
        i = s->analysis[i].follows;
    return i;
}

const scene_rotating_frame *scene_rotating_frame_of(const scene_analysis *a)
{
    if (a->kind == SCENE_CONTINUATION)
        return &a->of.continuation.frame;
    return a->kind == SCENE_STATIC || a->kind == SCENE_ROTATION ? &a->of.walk.frame : NULL;
}

int scene_rotates(const scene_analysis *a)
{
    const scene_rotating_frame *frame = scene_rotating_frame_of(a);
    return frame != NULL && (frame->omega[0] != 0 || frame->omega[1] != 0 || frame->omega[2] != 0);
}

/* Doubles the memory of a list if its count is a power of two. */
int scene_grow(scene *s, void *list, int *count, size_t size)
{
    void *entries;
    memcpy(&entries, list, sizeof entries);
    const int n = *count;
    if ((n & (n - 1)) == 0) {
        void *larger = realloc(entries, (n == 0 ? 1 : 2 * (size_t)n) * size);
        if (larger == NULL) {
            s->out_of_memory = 1;
            return SCENE_NONE;
        }
        entries = larger;
        memcpy(list, &entries, sizeof entries);
    }
    memset((char *)entries + (size_t)n * size, 0, size);
    return (*count)++;
}

double *scene_copy(scene *s, int n, const double from[])
{
    double *to = malloc((size_t)(n > 0 ? n : 1) * sizeof *to);
    if (to == NULL)
        s->out_of_memory = 1;
    else if (n > 0)
        memcpy(to, from, (size_t)n * sizeof *to);
    return to;
}

const scene_omission scene_omissions[] = {{FEATURE_SHEAR, "shear"},
                                          {FEATURE_TRAPEZE, "trapeze"},
                                          {FEATURE_WAGNER_MOMENTS, "wagner_moments"},
                                          {FEATURE_WAGNER_TORQUE, "wagner_torque"},
                                          {FEATURE_ROTARY_INERTIA, "rotary_inertia"},
                                          {FEATURE_WARPING, "warping"},
                                          {0, NULL}};

void scene_omission_words(unsigned omits, char words[SCENE_OMISSION_WORDS])
{
    int used = 0;
    words[0] = '\0';
    for (const scene_omission *o = scene_omissions; o->word != NULL; o++)
        if (omits & o->feature)
            used += snprintf(words + used, (size_t)(SCENE_OMISSION_WORDS - used), "%s%s",
                             used > 0 ? ", " : "", o->word);
}

const char *scene_shear_word(scene_shear theory)
{
    static const char *const word[] = {[SCENE_SHEAR_HARINGX] = "haringx",
                                       [SCENE_SHEAR_ENGESSER] = "engesser",
                                       [SCENE_SHEAR_OWN] = "own"};
    return word[theory];
}
