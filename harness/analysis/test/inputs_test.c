/* Every entry of the table of inputs (scene_inputs). An input that has an effect must change the
 * answer and obey a law, such as equilibrium or superposition. An input without effect must not
 * change the answer. If an input is rejected, the message must name it. */
#include "cases/scene/scene.h"

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/analysis/test/posed.h"
#include "harness/formulations/formulations.h"

static double apart(const answer *a, const answer *b)
{
    double largest = 0;
    for (int i = 0; i < a->count && i < b->count; i++)
        if (isnan(a->value[i]) != isnan(b->value[i]))
            return INFINITY;
        else if (!isnan(a->value[i]) && fabs(a->value[i] - b->value[i]) > 1e-12)
            largest = fmax(largest, fabs(a->value[i] - b->value[i]) /
                                        fmax(fabs(a->value[i]), fabs(b->value[i])));
    return largest;
}

static void superposition(const scene_input *in, const element_type *e, const answer *without,
                          const answer *with)
{
    static answer twice;
    posed p = pose(in->name, SCENE_OF_LINEAR, 1);
    p.times = 2;
    solve(&p, e, &twice);
    for (int i = 0; i < twice.count; i++)
        gsl_test_abs(twice.value[i] - with->value[i], with->value[i] - without->value[i],
                     1e-8 * (fabs(with->value[i]) + fabs(without->value[i])) + 1e-9,
                     "%s: linear, %s: superposition of %s", e->name, in->name, with->name[i]);
}

static void resultants(const scene_load *load, double place, double x, double out[6])
{
    static const double weight[] = {1 / 6.0, 4 / 6.0, 1 / 6.0};
    const double begin = fmax(load->range[0], place), part = load->range[1] - begin,
                 all = load->range[1] - load->range[0];
    memset(out, 0, 6 * sizeof *out);
    for (int k = 0; k < 3 && part >= 0; k++) {
        const double at = begin + part * k / 2, last = all > 0 ? (at - load->range[0]) / all : 0,
                     arm[3] = {0.5 + 0.5 * at - x, 0, 0};
        double v[3], moment[3];
        for (int i = 0; i < 3; i++)
            v[i] =
                (scene_load_within(load) ? 1 : 0.5 * part) * weight[k] *
                (load->vector[i] + (load->varies ? last : 0) * (load->last[i] - load->vector[i]));
        vec3_cross(arm, v, moment);
        for (int i = 0; i < 3; i++) {
            out[scene_load_turns(load) ? 3 + i : i] += v[i];
            out[3 + i] += scene_load_turns(load) ? 0 : moment[i];
        }
    }
}

/* Builds the scene of a row of the table with this input as the only load. Returns 1 if the load
 * acts on a member. */
static int load_alone(const scene_input *in, posed *p, scene *s, scene_load *load)
{
    *p = pose(in->name, SCENE_OF_LINEAR, 1);
    structure(p, s);
    scene_load *own = scene_load_at(s, s->loads - 1);
    memset(s->load[0].vector, 0, sizeof s->load[0].vector);
    *load = *own;
    return scene_load_along(own) && own->kind != SCENE_GRAVITY && own->kind != SCENE_TEMPERATURE;
}

static void reactions(const scene_input *in, const element_type *e)
{
    static answer a;
    double expected[6];
    posed p;
    scene s;
    scene_load load;
    if (!load_alone(in, &p, &s, &load)) {
        scene_free(&s);
        return;
    }
    const int linear = scene_add_linear(&s);
    for (int k = 0; k < 6; k++) {
        const char name[] = {'R', (char)('0' + k), '\0'};
        scene_add_quantity(&s, name, "N", linear, scene_reaction(ROOT, k));
    }
    answer_to(&s, &p, e, &a);
    resultants(&load, 0, 0, expected);
    for (int k = 0; k < 6; k++) {
        const char name[] = {'R', (char)('0' + k), '\0'};
        gsl_test_abs(-answer_of(&a, name), expected[k], 1e-7,
                     "%s: linear, %s: component %d at the root is what acts", e->name, in->name, k);
    }
}

static void sections(const scene_input *in, const element_type *e)
{
    static const double place[] = {0, 0.05, 0.2, 0.45, 0.9};
    static answer a;
    double expected[6];
    posed p;
    scene s;
    scene_load load;
    if (!load_alone(in, &p, &s, &load) || load.lumped) {
        scene_free(&s);
        return;
    }
    const int linear = scene_add_linear(&s);
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 6; k++) {
            const char name[] = {(char)('a' + i), (char)('0' + k), '\0'};
            scene_add_quantity(&s, name, "N", linear,
                               scene_internal_at(1, place[i], (scene_resultant)(SCENE_N + k)));
        }
    answer_to(&s, &p, e, &a);
    for (int i = 0; i < 5; i++) {
        resultants(&load, place[i], 0.5 + 0.5 * place[i], expected);
        for (int k = 0; k < 6; k++) {
            const char name[] = {(char)('a' + i), (char)('0' + k), '\0'};
            gsl_test_abs(answer_of(&a, name), expected[k], 1e-7,
                         "%s: linear, %s: resultant %d at %g of the member", e->name, in->name, k,
                         place[i]);
        }
    }
}

static int is_load(const scene_input *in)
{
    return in - scene_inputs <= 21;
}

static int is_called(const scene_input *in, const char *name)
{
    return strcmp(in->name, name) == 0;
}

static int is_motion(const scene_input *in)
{
    return is_called(in, "motion of a node") || is_called(in, "motion with a load case");
}

/* Returns the largest difference of the named values, relative to the largest value; INFINITY: a
 * value exists in one answer only. */
static double largest_apart(const answer *a, const answer *b, const char *const name[])
{
    double largest = 0, size = 1e-12;
    for (int i = 0; name[i] != NULL; i++) {
        const double x = answer_of(a, name[i]), y = answer_of(b, name[i]);
        if (isnan(x) && isnan(y))
            continue;
        largest = isnan(x) != isnan(y) ? INFINITY : fmax(largest, fabs(x - y));
        size = fmax(size, fmax(fabs(x), fabs(y)));
    }
    return largest / size;
}

static const char *const places[] = {"u_0", "u_1", "u_2", "v_0", "v_1", "v_2", NULL},
                         *const modes[] = {"f0", "f1", "f2", NULL};

static void law_of_linear(const scene_input *in, const element_type *e)
{
    static answer linear, path;
    posed p = pose(in->name, SCENE_OF_LINEAR, 1);
    p.size = 1e-4;
    solve(&p, e, &linear);
    p.column = SCENE_OF_STATIC;
    p.turns = 0;
    solve(&p, e, &path);
    const double off = largest_apart(&linear, &path, places);
    gsl_test(!(off <= 1e-3), "%s: linear, %s: as a path under small loads (%g)", e->name, in->name,
             off);
}

static void law_of_continuation(const scene_input *in, const element_type *e, const answer *with)
{
    static answer path;
    posed p = pose(in->name, SCENE_OF_STATIC, 1);
    p.end = answer_of(with, "factor");
    if (!(p.end > 0))
        return;
    solve(&p, e, &path);
    gsl_test_rel(answer_of(&path, "v_1"), end_of_continuation, 1e-7,
                 "%s: continuation, %s: the path at its factor", e->name, in->name);
}

static void law_of_compliance(const scene_input *in, scene_column column, const element_type *e,
                              const answer *with)
{
    static answer less, more;
    posed p = pose(in->name, SCENE_OF_STATIC, 1);
    if (column == SCENE_OF_COMPLIANCE) {
        if (is_called(in, "constant load"))
            return;
        p.end = 1e-9;
        p.turns = 0;
    }
    p.pull = -1;
    solve(&p, e, &less);
    p.pull = 1;
    solve(&p, e, &more);
    const char *const entry[] = {"cx", "cy", "cz"}, *const moved[] = {"v_0", "v_1", "v_2"};
    const double size = fabs(answer_of(with, "cy"));
    for (int i = 0; i < 3; i++) {
        const double c = answer_of(with, entry[i]);
        if (!isnan(c))
            gsl_test_abs((answer_of(&more, moved[i]) - answer_of(&less, moved[i])) / 2, c,
                         1e-4 * size, "%s: %s, %s: %s is the derivative of the path", e->name,
                         scene_column_name[column], in->name, entry[i]);
    }
}

static void law_of_modal(const scene_input *in, const element_type *e, const answer *with)
{
    static answer about;
    posed p = pose(in->name, SCENE_OF_MODAL_ABOUT, 1);
    p.end = 1e-9;
    p.turns = 0;
    if (is_called(in, "constant load") || is_called(in, "free curvature"))
        return;
    solve(&p, e, &about);
    const double off = largest_apart(with, &about, modes);
    const double inside = strcmp(e->name, "geometrically_exact") == 0 ? 0 : 8e-4;
    gsl_test(!(off <= 2e-5 + inside), "%s: modal, %s: as at the begin of a path (%g)", e->name,
             in->name, off);
}

static void law_of_modal_linear(const scene_input *in, const element_type *e)
{
    static answer rest, linear, path;
    double largest = 0, off = 0;
    posed p = pose(in->name, SCENE_OF_MODAL_LINEAR, 1);
    p.size = 1e-4;
    solve(&p, e, &linear);
    p.column = SCENE_OF_MODAL_ABOUT;
    p.turns = 0;
    solve(&p, e, &path);
    p.end = 1e-9;
    p.size = 1e-9;
    solve(&p, e, &rest);
    if (linear.values == 0 || path.values == 0 || is_called(in, "node attached to another") ||
        is_called(in, "imperfection given by shifts"))
        return;
    for (int i = 0; modes[i] != NULL; i++) {
        const double f = answer_of(&rest, modes[i]), by_linear = answer_of(&linear, modes[i]) - f,
                     by_path = answer_of(&path, modes[i]) - f;
        largest = fmax(largest, fabs(by_path));
        off = fmax(off, fabs(by_linear - by_path));
    }
    gsl_test(!(off <= 0.02 * largest + 1e-7),
             "%s: modal about a linear analysis, %s: %g Hz from what the path adds, %g Hz", e->name,
             in->name, off, largest);
}

static void law_of_modal_about(const scene_input *in, const element_type *e)
{
    static answer a;
    const posed p = pose(in->name, SCENE_OF_MODAL_ABOUT, 1);
    scene s;
    structure(&p, &s);
    want(&s, SCENE_OF_MODAL_ABOUT, analyse(&s, &p));
    const int still = scene_add_rotation(&s, 1, &end, 2, 6, (scene_rotating_frame){.omega = {0}});
    for (int i = 0; i < 3; i++)
        scene_add_quantity(&s, (const char *[]){"g0", "g1", "g2"}[i], "Hz", still,
                           scene_frequency(i, SCENE_ANY));
    answer_to(&s, &p, e, &a);
    for (int i = 0; i < 3; i++) {
        const double g = answer_of(&a, (const char *[]){"g0", "g1", "g2"}[i]);
        if (!isnan(g))
            gsl_test_rel(answer_of(&a, modes[i]), g, 1e-6,
                         "%s: modal about a path, %s: %s of a frame at rest", e->name, in->name,
                         modes[i]);
    }
}

static void law_of_buckling(const scene_input *in, const element_type *e, const answer *with)
{
    static answer near, nearer;
    const double load = answer_of(with, "factor");
    posed p = pose(in->name, SCENE_OF_MODAL_LINEAR, 1);
    p.turns = 0;
    if (is_motion(in) || isnan(load))
        return;
    p.grown = 0.9995 * load;
    solve(&p, e, &near);
    p.grown = 0.99975 * load;
    solve(&p, e, &nearer);
    if (near.outcome == ASK_NOT_OFFERED)
        return;
    const double f = answer_of(&near, "f0"), g = answer_of(&nearer, "f0");
    gsl_test_rel(f * f / (g * g), 2, 0.02,
                 "%s: buckling, %s: the frequency vanishes there (%g, %g)", e->name, in->name, f,
                 g);
}

static void law_of_buckling_about(const scene_input *in, const element_type *e, const answer *with)
{
    static answer a;
    static const double down = -0.05;
    const posed p = pose(in->name, SCENE_OF_BUCKLING_ABOUT, 1);
    scene s;
    if (in->part[SCENE_OF_CONTINUATION] == SCENE_PART_REFUSED)
        return;
    structure(&p, &s);
    const int along = scene_add_continuation(
        &s, 1, &down,
        (scene_control){.node = TIP, .component = SCENE_UY, .step = 5e-4, .step_max = 2e-3});
    begin(&s, &p);
    scene_add_quantity(&s, "limit", "1", along,
                       scene_critical_point(SCENE_LIMIT_POINT, 0, SCENE_LOAD_FACTOR));
    scene_add_quantity(&s, "branch", "1", along,
                       scene_critical_point(SCENE_BIFURCATION, 0, SCENE_LOAD_FACTOR));
    answer_to(&s, &p, e, &a);
    const double limit = answer_of(&a, "limit"), branch = answer_of(&a, "branch"),
                 first = isnan(branch) || limit < branch ? limit : branch;
    gsl_test_rel(answer_of(with, "factor"), first, 1e-5,
                 "%s: buckling about a path, %s: the first critical point", e->name, in->name);
}

static void law_of_harmonic(const scene_input *in, scene_column column, const element_type *e,
                            const answer *with)
{
    static answer a, by_modes;
    static const char *const at_rest[] = {"cx", "cy", "cz", NULL}, *const all[] = {"cx", "cy", "cz",
                                                                                   "rx", "ry", "rz",
                                                                                   "ix", "iy", "iz",
                                                                                   NULL};
    posed p = pose(
        in->name,
        column == SCENE_OF_HARMONIC_ABOUT ? SCENE_OF_COMPLIANCE_ABOUT : SCENE_OF_COMPLIANCE, 1);
    scene s;
    if (column != SCENE_OF_HARMONIC_LINEAR && !is_called(in, "feedback")) {
        solve(&p, e, &a);
        const double off = largest_apart(with, &a, at_rest);
        gsl_test(!(off <= 1e-7), "%s: %s, %s: at 0 Hz the compliance (%g)", e->name,
                 scene_column_name[column], in->name, off);
    }
    if (is_called(in, "rotating axes"))
        return;
    p.column = column;
    structure(&p, &s);
    const int analysis = analyse(&s, &p);
    begin(&s, &p);
    want(&s, column, analysis);
    s.analysis[analysis].by_modes = 1;
    answer_to(&s, &p, e, &by_modes);
    if (by_modes.status == STATUS_REFUSED && strstr(by_modes.reason, "unsymmetric") != NULL)
        return;
    const double off = largest_apart(with, &by_modes, all);
    gsl_test(!(off <= 1e-8), "%s: %s, %s: by all modes (%g; %s)", e->name,
             scene_column_name[column], in->name, off, by_modes.reason);
}

static void law_of_harmonic_instant(const scene_input *in, const element_type *e)
{
    static answer state, instant;
    static const char *const all[] = {"cx", "cy", "cz", "rx", "ry", "rz", "ix", "iy", "iz", NULL};
    posed p = pose(in->name, SCENE_OF_HARMONIC_ABOUT, 1);
    for (int about = 0; about < 2; about++) {
        scene s;
        structure(&p, &s);
        s.lumped = 1;
        int of = scene_add_static(&s, 1, &p.end, 2);
        of = about ? move(&s, of, p.column) : of;
        const int harmonic = scene_add_harmonic(&s, of, 2, (const double[]){0, shaking});
        s.analysis[harmonic].time = about ? 0 : NAN;
        want(&s, p.column, harmonic);
        answer_to(&s, &p, e, about ? &instant : &state);
        if (state.status == STATUS_REFUSED)
            return;
    }
    const double off = largest_apart(&state, &instant, all);
    gsl_test(!(off <= 1e-7), "%s: harmonic about an instant, %s: as the state there (%g; %s)",
             e->name, in->name, off, instant.reason);
}

static void law_of_rotation(const scene_input *in, const element_type *e, const answer *with)
{
    static answer path;
    posed p = pose(in->name, SCENE_OF_STATIC, 1);
    p.turns = 1;
    solve(&p, e, &path);
    const double off = largest_apart(with, &path, places);
    gsl_test(!(off <= 1e-6), "%s: rotation, %s: as the path in rotating axes (%g)", e->name,
             in->name, off);
}

static void law_of_motion(const scene_input *in, const element_type *e, int continued)
{
    static answer path, motion;
    static const double first = 0.004, second = 0.008;
    const scene_motion how = {
        .scheme = SCENE_ALPHA, .alpha = scene_alpha_of_radius(0.9), .step = 1e-3};
    posed p = pose(in->name, continued ? SCENE_OF_CONTINUATION : SCENE_OF_STATIC, 1);
    p.end = 0.7;
    if (in->part[SCENE_OF_MOTION] == SCENE_PART_REFUSED)
        return;
    for (int last = 0; last < 2; last++) {
        scene s;
        structure(&p, &s);
        const int state = analyse(&s, &p), before = scene_add_motion(&s, state, 1, &first, how),
                  behind = scene_add_motion(&s, before, 1, &second, how);
        want(&s, SCENE_OF_MOTION, last ? behind : state);
        answer_to(&s, &p, e, last ? &motion : &path);
        if (path.status == STATUS_REFUSED)
            return;
    }
    const double off = largest_apart(&path, &motion, places);
    gsl_test(!(off <= 1e-6), "%s: motion after a motion after a %s, %s: stays (%g; %s)", e->name,
             scene_column_name[p.column], in->name, off, motion.reason);
}

static void obey(const scene_input *in, scene_column column, const element_type *e,
                 const answer *with)
{
    const int turns = is_called(in, "rotating axes");
    switch (column) {
    case SCENE_OF_LINEAR:
        law_of_linear(in, e);
        break;
    case SCENE_OF_STATIC:
        if (!turns)
            law_of_motion(in, e, 0);
        break;
    case SCENE_OF_CONTINUATION:
        law_of_continuation(in, e, with);
        if (!turns)
            law_of_motion(in, e, 1);
        break;
    case SCENE_OF_BUCKLING:
        law_of_buckling(in, e, with);
        break;
    case SCENE_OF_BUCKLING_ABOUT:
        if (!flutters(in->name, column))
            law_of_buckling_about(in, e, with);
        break;
    case SCENE_OF_MODAL:
        law_of_modal(in, e, with);
        break;
    case SCENE_OF_MODAL_LINEAR:
        law_of_modal_linear(in, e);
        break;
    case SCENE_OF_MODAL_ABOUT:
        law_of_modal_about(in, e);
        break;
    case SCENE_OF_COMPLIANCE:
    case SCENE_OF_COMPLIANCE_ABOUT:
        law_of_compliance(in, column, e, with);
        break;
    case SCENE_OF_HARMONIC:
    case SCENE_OF_HARMONIC_LINEAR:
    case SCENE_OF_HARMONIC_ABOUT:
        law_of_harmonic(in, column, e, with);
        break;
    case SCENE_OF_HARMONIC_INSTANT:
        law_of_harmonic_instant(in, e);
        break;
    case SCENE_OF_ROTATION:
        law_of_rotation(in, e, with);
        break;
    default:
        break;
    }
}

static void part_of_inertia(const scene_input *in, scene_column column, const element_type *e)
{
    static answer with, without;
    posed p = pose(in->name, column, 1);
    p.follows = column == SCENE_OF_BUCKLING_ABOUT || column == SCENE_OF_MODAL_ABOUT;
    p.turns = !p.follows;
    solve(&p, e, &with);
    p.with = divides(in->name);
    p.times = 0;
    solve(&p, e, &without);
    const double change = apart(&with, &without);
    if (column == SCENE_OF_MODAL_ABOUT &&
        (is_called(in, "damping") || strstr(in->name, "dashpot") != NULL))
        return;
    gsl_test(with.values == 0 || !(change > 1e-6), "%s: %s, %s: changes the answer there (%g; %s)",
             e->name, scene_column_name[column], in->name, change, with.reason);
}

static void cell(const scene_input *in, scene_column column, const element_type *e, int counts[])
{
    static answer with, without;
    const char part = in->part[column];
    const char *where = scene_column_name[column];
    if ((column == SCENE_OF_MOTION || is_instant(column)) &&
        (is_called(in, "constant load") || is_motion(in) || is_called(in, "rotating axes")))
        return;
    posed p = pose(in->name, column, is_motion(in) || divides(in->name));
    p.times = 0;
    solve(&p, e, &without);
    p = pose(in->name, column, 1);
    solve(&p, e, &with);
    if (with.outcome == ASK_NOT_OFFERED || without.outcome == ASK_NOT_OFFERED)
        return;
    counts[part == 'x' ? 1 : part == '-' ? 2 : 0]++;
    const int refused = with.status == STATUS_REFUSED;
    if ((column == SCENE_OF_MODAL_LINEAR || column == SCENE_OF_HARMONIC_LINEAR) &&
        in->part[SCENE_OF_LINEAR] == SCENE_PART_REFUSED)
        where = scene_column_name[SCENE_OF_LINEAR];
    if ((column == SCENE_OF_BUCKLING_ABOUT || column == SCENE_OF_MODAL_ABOUT ||
         column == SCENE_OF_COMPLIANCE_ABOUT || column == SCENE_OF_HARMONIC_ABOUT) &&
        in->part[SCENE_OF_STATIC] == SCENE_PART_REFUSED)
        where = scene_column_name[SCENE_OF_STATIC];
    if (is_instant(column) && in->part[SCENE_OF_MOTION] == SCENE_PART_REFUSED)
        where = scene_column_name[SCENE_OF_MOTION];
    if (part == SCENE_PART_REFUSED) {
        gsl_test(!refused || strstr(with.reason, in->name) == NULL ||
                     strstr(with.reason, where) == NULL,
                 "%s: %s, %s: the rejection names the input (%s)", e->name, where, in->name,
                 with.reason);
        return;
    }
    if (part == SCENE_PART_STATE && with.values == 0) {
        gsl_test(strstr(with.reason, "symmetric") == NULL &&
                     strstr(with.reason, "potential") == NULL &&
                     strstr(with.reason, "pivots") == NULL,
                 "%s: %s, %s: says why (%s)", e->name, where, in->name, with.reason);
        return;
    }
    gsl_test(with.values == 0, "%s: %s, %s: has an answer (%s; %s)", e->name, where, in->name,
             with.reason, with.count > 0 ? with.why[0] : "");
    const double change = apart(&with, &without);
    if (part == SCENE_PART_NONE || part == SCENE_PART_INERTIA)
        gsl_test(change > 1e-9, "%s: %s, %s: has no part (%g)", e->name, where, in->name, change);
    else
        gsl_test(!(change > 1e-6), "%s: %s, %s: changes the answer (%g)", e->name, where, in->name,
                 change);
    if (part == SCENE_PART_INERTIA)
        part_of_inertia(in, column, e);
    if (column == SCENE_OF_LINEAR && is_load(in))
        superposition(in, e, &without, &with);
    if (column == SCENE_OF_LINEAR && is_load(in)) {
        reactions(in, e);
        sections(in, e);
    }
    if (with.values == with.count)
        obey(in, column, e, &with);
}

static void alike(const char *name, const char *other, scene_column column, const element_type *e)
{
    static answer one, two;
    const posed p = pose(name, column, 1), q = pose(other, column, 1);
    solve(&p, e, &one);
    solve(&q, e, &two);
    const double off = apart(&one, &two);
    const double most = is_instant(column) ? 1e-4 : 1e-7;
    gsl_test(one.outcome != two.outcome || !(off <= most), "%s: %s, %s: as %s (%g; %s; %s)",
             e->name, scene_column_name[column], name, other, off, one.reason, two.reason);
}

static void start_turning(const element_type *e)
{
    static answer a;
    const posed p = pose("rotating axes", SCENE_OF_STATIC, 1);
    const scene_motion how = {
        .scheme = SCENE_ALPHA, .alpha = scene_alpha_of_radius(0.9), .step = 2e-4};
    scene s;
    base(&s);
    scene_load_at(&s, 0)->follower = 1;
    const int turn =
        scene_add_driver(&s, "turn", 2, (const double[]){0, 1}, (const double[]){0, 0});
    scene_drive_piece(&s, turn, 0, "20*t");
    scene_node_at(&s, ROOT)->angle[2] = turn;
    const int path = scene_add_static(&s, 1, &end, 2),
              motion = scene_add_motion(&s, path, 1, (const double[]){0.02}, how);
    scene_set_rotating_frame(&s, path, (scene_rotating_frame){.omega = {0, 0, 20}});
    for (int i = 0; i < 3; i++) {
        scene_add_quantity(&s, (const char *[]){"x", "y", "z"}[i], "m", path,
                           scene_coordinate(TIP, i));
        scene_add_quantity(&s, (const char *[]){"X", "Y", "Z"}[i], "m", motion,
                           scene_relative_to(TIP, i, ROOT));
    }
    answer_to(&s, &p, e, &a);
    for (int i = 0; i < 3; i++)
        gsl_test_rel(answer_of(&a, (const char *[]){"X", "Y", "Z"}[i]),
                     answer_of(&a, (const char *[]){"x", "y", "z"}[i]), 0.05,
                     "%s: motion after a path in rotating axes: %d", e->name, i);
}

int main(void)
{
    static const char *const chosen[] = {"collocation", "geometrically_exact", "beamw_consistent"};
    int walked[3] = {0};
    for (int k = 0; k < 3; k++) {
        const element_type *e = formulation_find(chosen[k]);
        for (const scene_input *in = scene_inputs; in->name != NULL; in++) {
            scene s;
            const posed p = pose(in->name, SCENE_OF_MOTION, 1);
            structure(&p, &s);
            scene_add_static(&s, 1, &end, 2);
            const int last = analyse(&s, &p);
            begin(&s, &p);
            const int known = s.name[0] != '\0', of = p.turns ? 0 : last;
            gsl_test(known && !in->stands(&s, of, NULL, 0), "%s stands in its scene", in->name);
            scene_free(&s);
            for (int c = 0; c < SCENE_COLUMNS && known; c++)
                cell(in, (scene_column)c, e, walked);
        }
        for (int c = 0; c < SCENE_COLUMNS; c++)
            alike("offset of an end", "offset by bodies", (scene_column)c, e);
        for (int c = 0; c < SCENE_COLUMNS; c++)
            alike("imperfection given by shifts", "nodes that are shifted", (scene_column)c, e);
        start_turning(e);
    }
    gsl_test(walked[0] < 500 || walked[1] < 12 || walked[2] < 60, "%d used, %d refused, %d no part",
             walked[0], walked[1], walked[2]);
    return gsl_test_summary();
}
