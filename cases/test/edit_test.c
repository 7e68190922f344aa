/* Tests edits of a scene, such as reversed or split members. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "cases/test/refuse.h"

static void make(scene *s)
{
    const double path[] = {0, 1, 2}, factor[] = {0, 3, 4};
    section_spec spec = section_spec_rectangle(1, 1, 2, 1);
    scene_init(s, "edited");
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, 2, 0, 0);
    const int one = scene_add_member(s, root, tip, scene_add_section(s, &spec), y_axis);
    scene_member *m = scene_member_at(s, one);
    m->warp_p = 3;
    scene_release_end(s, 0, 0, SCENE_RY);
    scene_release_end(s, 0, 0, SCENE_UX);
    scene_release_end(s, 0, 1, SCENE_RZ);
    m->warp_q = 7;
    m->divisions = 2;
    m->strain[1] = 1e-3;
    m->damping = 0.01;
    const int load = scene_add_load(s, SCENE_DISTRIBUTED, one, 5, 6, 7);
    scene_load *l = scene_load_at(s, load);
    l->axes = SCENE_AXES_MEMBER;
    l->follower = 1;
    l->at[0] = 0.1;
    l->at[1] = 0.2;
    l->at[2] = 0.3;
    scene_set_factor(s, load, 3, path, factor);
    scene_load_piece(s, load, 1, "t");
    scene_load_piece(s, load, 0, "1");
}

static void is_vector(const double v[3], double x, double y, double z, const char *what)
{
    gsl_test(v[0] != x || v[1] != y || v[2] != z, "%s: %g %g %g", what, v[0], v[1], v[2]);
}

static void reversed(void)
{
    scene s;
    fault f = {""};
    make(&s);
    scene_member_at(&s, 0)->curvature[1] = 0.25;
    scene_member_at(&s, 0)->curvature[2] = 0.5;
    gsl_test(scene_edit_apply(&s, &(scene_edit){SCENE_EDIT_REVERSE, 0}, &f) != STATUS_OK, "%s",
             f.text);
    const scene_member *m = scene_member_at(&s, 0);
    const scene_load *l = scene_load_at(&s, 0);
    gsl_test(m->p != 1 || m->q != 0, "ends %d %d", m->p, m->q);
    gsl_test(m->warp_p != 7 || m->warp_q != 3, "warping %d %d", m->warp_p, m->warp_q);
    gsl_test(m->release[0].count != 1 || m->release[0].component[0] != SCENE_RZ ||
                 m->release[1].count != 2 || m->release[1].component[1] != SCENE_UX,
             "released ends change places");
    is_vector(m->curvature, 0, 0.25, -0.5, "about z the other way");
    is_vector(m->y_axis, 0, -1, 0, "turned by half a turn about z");
    is_vector(l->vector, -5, -6, 7, "load in the member's axes");
    is_vector(l->at, -0.1, -0.2, 0.3, "its place");
    scene_free(&s);
}

static void reversed_section(void)
{
    scene s;
    fault f = {""};
    make(&s);
    section *c = &s.section[0].constants;
    for (int i = 0; i < 36; i++) {
        c->stiffness[i] = 1 + i;
        c->mass[i] = 50 + i;
    }
    for (int times = 1; times <= 2; times++) {
        gsl_test(scene_edit_apply(&s, &(scene_edit){SCENE_EDIT_REVERSE, 0}, &f) != STATUS_OK, "%s",
                 f.text);
        c = &s.section[0].constants;
        for (int i = 0; i < 36; i++) {
            const int odd = times == 1 && (i / 6 % 3 == 2) != (i % 3 == 2);
            gsl_test(c->stiffness[i] != (odd ? -(1 + i) : 1 + i), "stiffness %d: %g", i,
                     c->stiffness[i]);
            gsl_test(c->mass[i] != (odd ? -(50 + i) : 50 + i), "mass %d: %g", i, c->mass[i]);
        }
    }
    scene_free(&s);
}

/* Loads on parts of a member of length 2 along x, which is then reversed, or split at 0.25. */
static const struct {
    scene_load_kind kind;
    double from, to, last; /* range of the load, and its value at the end relative to the start (0:
                              the load does not vary) */
    double turned[3];      /* reversed member: expected range, and value at its start */
    double first[4],
        second[4]; /* parts of the split member: expected range, and values at its start and end */
} on_part[] = {
    {SCENE_DISTRIBUTED, 0, 1, 0, {0, 1, 1}, {0, 1, 1, 1}, {0, 1, 1, 1}},
    {SCENE_DISTRIBUTED, 0, 1, 5, {0, 1, 5}, {0, 1, 1, 2}, {0, 1, 2, 5}},
    {SCENE_DISTRIBUTED_MOMENT, 0.125, 0.25, 0, {0.75, 0.875, 1}, {0.5, 1, 1, 1}, {-1}},
    {SCENE_DISTRIBUTED, 0.25, 0.625, 3, {0.375, 0.75, 3}, {-1}, {0, 0.5, 1, 3}},
    {SCENE_DISTRIBUTED_MOMENT, 0.125, 0.625, 5, {0.375, 0.875, 5}, {0.5, 1, 1, 2}, {0, 0.5, 2, 5}},
    {SCENE_GRAVITY, 0, 1, 0, {0, 1, 1}, {0, 1, 1, 1}, {0, 1, 1, 1}},
    {SCENE_MEMBER_FORCE, 0.125, 0.125, 0, {0.875, 0.875, 1}, {0.5, 0.5, 1, 1}, {-1}},
    {SCENE_MEMBER_MOMENT, 0.625, 0.625, 0, {0.375, 0.375, 1}, {-1}, {0.5, 0.5, 1, 1}},
};

/* Checks the load on a member. expected[0] = -1: no load. */
static void is_on(const scene *s, int member, const double expected[4], const char *what)
{
    int found = 0;
    for (int i = 0; i < s->loads; i++) {
        const scene_load *l = &s->load[i];
        const double *last = l->varies ? l->last : l->vector;
        if (l->where != member)
            continue;
        found++;
        gsl_test(l->range[0] != expected[0] || l->range[1] != expected[1], "%s: from %g to %g",
                 what, l->range[0], l->range[1]);
        gsl_test(l->vector[2] != expected[2] || last[2] != expected[3], "%s: %g at the begin, %g",
                 what, l->vector[2], last[2]);
        gsl_test(l->lumped != 1, "%s: lumped as before", what);
    }
    gsl_test_int(found, expected[0] >= 0, "%s: loads on member %d", what, member);
}

static void parts(void)
{
    for (size_t i = 0; i < sizeof on_part / sizeof on_part[0]; i++) {
        char what[40];
        for (int cut = 0; cut < 2; cut++) {
            scene s;
            fault f = {""};
            make(&s);
            scene_load *l = scene_load_at(&s, 0);
            const double v[3] = {0, 0, 1};
            l->kind = on_part[i].kind;
            l->axes = SCENE_AXES_FIXED;
            memcpy(l->vector, v, sizeof v);
            l->range[0] = on_part[i].from;
            l->range[1] = on_part[i].to;
            l->varies = on_part[i].last != 0;
            l->last[2] = on_part[i].last;
            l->lumped = 1;
            const scene_edit edit = {cut ? SCENE_EDIT_SPLIT : SCENE_EDIT_REVERSE, 0.25};
            gsl_test(scene_edit_apply(&s, &edit, &f) != STATUS_OK, "%s", f.text);
            snprintf(what, sizeof what, "load %d, %s", (int)i, cut ? "cut" : "turned");
            const double *t = on_part[i].turned;
            const double turned[4] = {t[0], t[1], t[2], on_part[i].last != 0 ? 1 : t[2]};
            is_on(&s, 0, cut ? on_part[i].first : turned, what);
            if (cut)
                is_on(&s, 1, on_part[i].second, what);
            scene_free(&s);
        }
    }
}

static void is_split(void)
{
    scene s;
    fault f = {""};
    make(&s);
    gsl_test(scene_edit_apply(&s, &(scene_edit){SCENE_EDIT_SPLIT, 0.25}, &f) != STATUS_OK, "%s",
             f.text);
    gsl_test(s.members != 2 || s.loads != 2, "%d members, %d loads", s.members, s.loads);
    const scene_member *first = scene_member_at(&s, 0), *second = scene_member_at(&s, 1);
    is_vector(s.node[first->q].position, 0.5, 0, 0, "the node between");
    gsl_test(first->q != second->p || second->q != 1, "in a row");
    gsl_test(first->warp_p != 3 || second->warp_q != 7 || first->warp_q != second->warp_p ||
                 first->warp_q <= 7,
             "warping %d %d, %d %d", first->warp_p, first->warp_q, second->warp_p, second->warp_q);
    gsl_test(first->release[0].count != 2 || first->release[1].count != 0 ||
                 second->release[0].count != 0 || second->release[1].count != 1,
             "ends stay released, the cut is not");
    gsl_test_int(second->divisions, 2, "divisions");
    gsl_test(second->strain[1] != 1e-3, "initial strain");
    gsl_test_abs(second->damping, 0.01, 0, "damping");
    const scene_load *l = scene_load_at(&s, 1);
    gsl_test(l->where != 1 || l->axes != SCENE_AXES_MEMBER || !l->follower, "its load");
    is_vector(l->vector, 5, 6, 7, "of that size");
    is_vector(l->at, 0.1, 0.2, 0.3, "at that place");
    gsl_test(l->stations != 3 || l->factor[1] != 3 || l->path[2] != 2, "along that path");
    gsl_test(l->function.pieces != 2 || strcmp(l->function.piece[0].text, "t") != 0 ||
                 l->function.piece[0].until != 1,
             "over that time");
    scene_free(&s);
}

static void twisted(scene *s)
{
    s->member[0].curvature[0] = 0.1;
}

static void curved(scene *s)
{
    s->member[0].curvature[2] = 0.1;
}

static void unchanged(scene *s)
{
    (void)s;
}

static void refused(void)
{
    static const struct {
        corrupt *how;
        scene_edit edit;
        const char *words;
    } row[] = {
        {twisted, {SCENE_EDIT_REVERSE, 0}, "member 0: cannot exchange its two nodes"},
        {curved, {SCENE_EDIT_SPLIT, 0.5}, "member 0 is curved"},
        {unchanged, {SCENE_EDIT_SPLIT, 1}, "split at the fraction 1 of its length"},
        {unchanged, {SCENE_EDIT_SPLIT, NAN}, "split at the fraction nan of its length"},
        {unchanged, {SCENE_EDIT_UNIT, 0}, "length units per metre are not possible"},
        {unchanged, {SCENE_EDIT_UNIT, INFINITY}, "length units per metre are not possible"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        scene s;
        fault f = {""};
        refuse_unchanged(&s);
        row[i].how(&s);
        gsl_test_int((int)scene_edit_apply(&s, &row[i].edit, &f), STATUS_REFUSED, "refused: %s",
                     row[i].words);
        gsl_test(strstr(f.text, row[i].words) == NULL, "%s: %s", row[i].words, f.text);
        refuse_one_line(row[i].words, &f);
        scene_free(&s);
    }
}

static void unchanged_scenes(void)
{
    static const scene_edit edit[] = {
        {SCENE_EDIT_REVERSE, 0}, {SCENE_EDIT_SPLIT, 0.3}, {SCENE_EDIT_UNIT, 1000}};
    for (size_t i = 0; i < sizeof edit / sizeof edit[0]; i++) {
        scene s;
        fault f = {""};
        refuse_unchanged(&s);
        gsl_test(scene_edit_apply(&s, &edit[i], &f) != STATUS_OK, "edit %d: %s", (int)i, f.text);
        gsl_test(scene_validate(&s, &f) != STATUS_OK, "edit %d gives a scene: %s", (int)i, f.text);
        scene_free(&s);
    }
}

static void in_millimetres(void)
{
    static const struct {
        scene_balance what;
        double factor; /* conversion from the unit of the scene to SI */
    } balance[] = {{SCENE_KINETIC, 1e-3}, {SCENE_WORK, 1e-3}, {SCENE_DRIFT, 1e-3}, {SCENE_PX, 1},
                   {SCENE_PZ, 1},         {SCENE_LX, 1e-3},   {SCENE_LZ, 1e-3}};
    const double instant = 1;
    scene s;
    fault f = {""};
    double at[3];
    refuse_unchanged(&s);
    scene_drive_piece(&s, 0, 0, "t^2");
    const scene_motion how = {
        .step = 0.1, .start = {.velocity = {1, 0, 0}, .spin = {0, 2, 0}, .centre = {0, 0, 3}}};
    const int motion = scene_add_motion(&s, 0, 1, &instant, how), first = s.quantities;
    for (size_t i = 0; i < sizeof balance / sizeof balance[0]; i++)
        scene_add_quantity(&s, "balance", "", motion, scene_balance_of(balance[i].what));
    scene_add_quantity(&s, "rate", "", motion, scene_rate(TIP, SCENE_UX));
    scene_add_quantity(&s, "turn", "", motion, scene_rate(TIP, SCENE_RX));
    gsl_test(scene_edit_apply(&s, &(scene_edit){SCENE_EDIT_UNIT, 1000}, &f) != STATUS_OK, "%s",
             f.text);
    function_at(&s.driver[0].function, 2, at);
    is_vector(at, 4000, 4000, 2000, "a driven length, its velocity and acceleration");
    const scene_motion *m = scene_motion_of(&s.analysis[motion]);
    is_vector(m->start.velocity, 1000, 0, 0, "a velocity");
    is_vector(m->start.spin, 0, 2, 0, "an angular velocity");
    is_vector(m->start.centre, 0, 0, 3000, "its centre");
    gsl_test_abs(m->step, 0.1, 0, "a step");
    const int count = sizeof balance / sizeof balance[0];
    for (int i = 0; i < count; i++)
        gsl_test_rel(s.quantity[first + i].factor, balance[i].factor, 1e-15, "balance %d",
                     (int)balance[i].what);
    gsl_test_rel(s.quantity[first + count].factor, 1e-3, 1e-15, "a velocity that is asked for");
    gsl_test_rel(s.quantity[first + count + 1].factor, 1, 1e-15, "an angular velocity");
    scene_free(&s);
}

static void sides(void)
{
    static const struct {
        int before, member;
        double place;
    } half[] = {{0, 1, 0}, {1, 0, 1}};
    for (int i = 0; i < 2; i++) {
        scene s;
        fault f = {""};
        make(&s);
        const int linear = scene_add_linear(&s), before = half[i].before;
        scene_add_quantity(&s, "Q", "N", linear,
                           scene_beside(scene_internal_at(0, 0.25, SCENE_QY), before));
        scene_add_quantity(&s, "stress", "Pa", linear,
                           scene_beside(scene_stress_at(0, 0.25, SCENE_VON_MISES), before));
        scene_edit_apply(&s, &(scene_edit){SCENE_EDIT_REVERSE, 0}, &f);
        gsl_test_int(scene_internal_of(&s.quantity[0])->before, !before, "side of a resultant");
        gsl_test_int(scene_stress_of(&s.quantity[1])->before, !before, "side of a stress");
        scene_edit_apply(&s, &(scene_edit){SCENE_EDIT_REVERSE, 0}, &f);
        gsl_test(scene_edit_apply(&s, &(scene_edit){SCENE_EDIT_SPLIT, 0.25}, &f) != STATUS_OK, "%s",
                 f.text);
        const scene_internal *Q = scene_internal_of(&s.quantity[0]);
        const scene_stress *of = scene_stress_of(&s.quantity[1]);
        gsl_test(Q->member != half[i].member || Q->place != half[i].place || Q->before != before,
                 "half of a resultant's side: member %d at %g", Q->member, Q->place);
        gsl_test(of->member != half[i].member || of->place != half[i].place || of->before != before,
                 "half of a stress' side: member %d at %g", of->member, of->place);
        scene_free(&s);
    }
}

static void edit_tests(void)
{
    sides();
    in_millimetres();
    reversed();
    reversed_section();
    is_split();
    parts();
    refused();
    unchanged_scenes();
}

static void has_powers(void)
{
    static const struct {
        const char *unit;
        int length, force;
    } all[] = {{"m^4", 4, 0},         {"1/m", -1, 0},     {"kg", -1, 1},     {"kg/m^3", -4, 1},
               {"kg m^2", 1, 1},      {"Pa", -2, 1},      {"N/m", -1, 1},    {"m/s^2", 1, 0},
               {"rad/(N m)", -1, -1}, {"kg m^2/s", 1, 1}, {"N m/rad", 1, 1}, {"rad/s", 0, 0}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        gsl_test_int(entry_power(all[i].unit, ENTRY_LENGTH), all[i].length, "length in %s",
                     all[i].unit);
        gsl_test_int(entry_power(all[i].unit, ENTRY_FORCE), all[i].force, "force in %s",
                     all[i].unit);
    }
}

static scene_node some_node(void)
{
    return (scene_node){.position = {1, 2, 3},
                        .attached = SCENE_NONE,
                        .rotation = SCENE_ROTATION_FORK,
                        .axis = {{1, 0, 0}, {0, 1, 0}},
                        .body = {.mass = 7, .inertia = {5, 5, 5}}};
}

static void is_scaled(void)
{
    scene_node n = some_node();
    entry_scale(entry_node, &n, ENTRY_LENGTH, 10);
    gsl_test_rel(n.position[2], 30, 1e-15, "position");
    gsl_test_rel(n.body.mass, 0.7, 1e-15, "mass");
    gsl_test_rel(n.body.inertia[1], 50, 1e-15, "inertia");
    gsl_test_rel(n.axis[1][1], 1, 1e-15, "a direction has no length");
}

static void is_compared(void)
{
    const scene_node n = some_node();
    scene_node other = n;
    gsl_test(!entry_same(entry_node, &n, &other), "the same");
    other.axis[1][2] = 1e-300;
    gsl_test(entry_same(entry_node, &n, &other), "another web of the fork");
    other.rotation = SCENE_ROTATION_SPATIAL;
    gsl_test(entry_same(entry_node, &n, &other), "no fork");
    other = n;
    other.body.centre[0] = -0.0;
    gsl_test(entry_same(entry_node, &n, &other), "bit for bit");
}

static void is_in_range(void)
{
    const scene s = {.nodes = 2};
    scene_member m = {.p = 0, .q = 1, .damping = 1, .half_waves = 1};
    fault f = {""};
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_OK, "in range");
    m.divisions = -3;
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_REFUSED ||
                 strcmp(f.text, "divisions = -3; give a whole number from 0 to 10000000") != 0,
             "below: %s", f.text);
    m.divisions = 0;
    m.damping = INFINITY;
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_REFUSED ||
                 strcmp(f.text, "damping = inf; give at least 0") != 0,
             "endless: %s", f.text);
    m.damping = 0;
    m.curvature[1] = NAN;
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_REFUSED, "no number");
    m.curvature[1] = 0;
    m.q = 2;
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_REFUSED ||
                 strcmp(f.text, "to: node 2 does not exist; add the node first") != 0,
             "no node: %s", f.text);
}

static void is_mirrored(void)
{
    scene_member m = {.y_axis = {1, 2, 3}, .curvature = {0, 5, 7}};
    entry_mirror(entry_member, &m);
    gsl_test_rel(m.y_axis[1], -2, 0, "y");
    gsl_test_rel(m.curvature[1], 5, 0, "curvature about y");
    gsl_test_rel(m.curvature[2], -7, 0, "curvature about z");
}

static void entry_tests(void)
{
    has_powers();
    is_scaled();
    is_compared();
    is_in_range();
    is_mirrored();
}

static scene_function pieces(int count, const double until[], const char *const text[])
{
    scene_function f = {0, NULL, 0};
    for (int i = 0; i < count; i++)
        gsl_test_int(function_add(&f, until[i], text[i]), 0, "piece %d", i);
    return f;
}

static void check_ends(void)
{
    const double until[] = {1, 3, 0};
    const char *const text[] = {"t", "2*t", "5"};
    static const double instant[] = {0, 0.5, 1, 2, 3, 100}, value[] = {0, 0.5, 2, 4, 5, 5},
                        rate[] = {1, 1, 2, 2, 0, 0};
    scene_function f = pieces(3, until, text), copy = {0, NULL, 0};
    fault why;
    double at[3];
    gsl_test_int((int)function_check(&f, &why), STATUS_OK, "three pieces");
    for (int i = 0; i < 6; i++) {
        function_at(&f, instant[i], at);
        gsl_test_abs(at[0], value[i], 0, "value at %g", instant[i]);
        gsl_test_abs(at[1], rate[i], 0, "rate at %g: of the piece behind", instant[i]);
    }
    function_at(&f, nextafter(1, 0), at);
    gsl_test_abs(at[0], 1, 1e-15, "just before the end of a piece");
    f.scale = 3;
    gsl_test_int(function_copy(&copy, &f), 0, "copied");
    function_free(&f);
    function_at(&copy, 2, at);
    gsl_test_abs(at[0], 12, 0, "a copy has the scale");
    gsl_test_abs(at[1], 6, 0, "of the rate too");
    function_free(&copy);
}

static void check_order(void)
{
    const double falls[] = {2, 1, 0}, last[] = {2, 0};
    const char *const text[] = {"1", "2", "3"};
    fault why;
    scene_function f = pieces(3, falls, text);
    gsl_test_int((int)function_check(&f, &why), STATUS_REFUSED, "pieces out of order");
    gsl_test(strstr(why.text, "piece 2") == NULL, "names the piece: %s", why.text);
    function_free(&f);
    f = pieces(2, last, text);
    gsl_test_int((int)function_check(&f, &why), STATUS_OK, "the last piece has no end");
    function_free(&f);
}

/* Checks the smoothness of two pieces that meet at 1 s. `derivative` is the first derivative that
 * must be discontinuous, or -1. */
static void check_joint(const char *before, const char *behind, double end, int derivative)
{
    const double until[] = {1, 0};
    const char *const text[] = {before, behind};
    scene_function f = pieces(2, until, text);
    double time = NAN;
    int which = -1;
    const int smooth = function_smooth(&f, end, &time, &which);
    gsl_test_int(smooth, derivative < 0, "%s, then %s, to %g s", before, behind, end);
    if (!smooth) {
        gsl_test_int(which, derivative, "%s, then %s: what jumps", before, behind);
        gsl_test_abs(time, 1, 0, "where");
    }
    function_free(&f);
}

static void check_joints(void)
{
    check_joint("t^2", "2*t - 1", 2, -1);
    check_joint("t^2", "2*t - 1.1", 2, 0);
    check_joint("t^2", "t", 2, 1);
    check_joint("t^2", "t", 1, -1);
    check_joint("t^2", "7", 0.5, -1);
}

static void check_finite(const char *before, const char *behind, int derivatives, double end,
                         double where)
{
    const double until[] = {1, 0};
    const char *const text[] = {before, behind};
    scene_function f = pieces(2, until, text);
    double time = NAN;
    const int finite = function_finite(&f, end, derivatives, &time);
    gsl_test_int(finite, isnan(where), "%s, then %s: finite to %g s", before, behind, end);
    if (!finite)
        gsl_test_abs(time, where, 1e-12, "%s, then %s: where not", before, behind);
    function_free(&f);
}

static void check_poles(void)
{
    check_finite("t", "1", 2, 4, NAN);
    check_finite("sqrt(t)", "1", 0, 4, NAN);
    check_finite("sqrt(t)", "1", 1, 4, 0);
    check_finite("t^1.5", "1", 2, 4, 0);
    check_finite("1/(t - 1)", "0", 0, 4, 1);
    check_finite("1", "1/(t - 2.5)", 0, 4, 2.5);
    check_finite("1", "1/(t - 2.5)", 0, 2, NAN);
    check_finite("1", "log(2 - t)", 0, 4, 1 + 22 * 3. / 64);
    check_finite("exp(1e4*t)", "1", 0, 0.5, 5. / 64);
}

static void function_tests(void)
{
    check_ends();
    check_order();
    check_joints();
    check_poles();
}

int main(void)
{
    edit_tests();
    entry_tests();
    function_tests();
    return gsl_test_summary();
}
