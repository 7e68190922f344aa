/* Every cell of the table of inputs: what is used changes the answer, and obeys a law: equilibrium,
 * superposition, a compliance that is the derivative of the path; what has no part leaves the
 * answer as it is; what is refused is refused by name, alone. */
#include "cases/scene/inputs.h"

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/test/sections.h"
#include "harness/catalogue/formulation.h"
#include "harness/test/ask.h"

enum { ROOT, MIDDLE, TIP, BESIDE, LATER };
static const double y_axis[3] = {0, 1, 0}, end = 1;

static section_spec spec_of(double size)
{
    section_spec spec = sections_of(1e-3 * size, 2e-7 * size, 1e-7 * size, 3e-7 * size);
    spec.young = 2e11;
    spec.shear_modulus = 8e10;
    spec.density = 7800;
    return spec;
}

/* A cantilever of two members, pushed along itself and across. */
static void base(scene *s)
{
    scene_init(s, "base");
    const section_spec one = spec_of(1);
    const int profile = scene_add_section(s, &one);
    for (int i = 0; i < 3; i++)
        scene_add_node(s, 0.5 * i, 0, 0);
    scene_add_member(s, 0, 1, profile, y_axis);
    scene_add_member(s, 1, 2, profile, y_axis);
    scene_hold_all(s, ROOT);
    scene_add_load(s, SCENE_FORCE, TIP, -300, 90, 60);
}

static scene_load *follow(scene *s, int load)
{
    scene_load_at(s, load)->follower = 1;
    return scene_load_at(s, load);
}

/* A section that warps, twisted by a force beside the axis, which has a potential. */
static void twist(scene *s)
{
    s->section[0].constants.Iw = 5e-9;
    scene_set_body(s, TIP, (scene_body){.inertia = {2, 1, 1, 0, 0, 0}}); /* it turns first */
    scene_add_load(s, SCENE_FORCE, scene_add_attached(s, TIP, 1, 0.2, 0), 0, 5, 40);
}

/* The base cannot turn about its axis at the tip. */
static void ended_in_a_fork(scene *s)
{
    scene_fork(s, TIP, (const double[]){1, 0, 0}, y_axis);
}

/* What the base is without, so that the input has something to act on; then the input. */
static void add(scene *s, const char *name)
{
    static const double from = 0, whole = 1;
#define IS(text) (strcmp(name, text) == 0)
    if (IS("force"))
        scene_add_load(s, SCENE_FORCE, MIDDLE, 20, 50, -30);
    else if (IS("force that follows"))
        follow(s, scene_add_load(s, SCENE_FORCE, MIDDLE, 20, 50, -30));
    else if (IS("force beside its node"))
        scene_load_at(s, scene_add_load(s, SCENE_FORCE, TIP, 10, 50, -30))->at[1] = 0.1;
    else if (IS("moment"))
        scene_add_load(s, SCENE_MOMENT, TIP, 20, 30, 40);
    else if (IS("moment that follows"))
        follow(s, scene_add_load(s, SCENE_MOMENT, TIP, 20, 30, 40));
    else if (IS("load along a member"))
        scene_add_load(s, SCENE_DISTRIBUTED, 1, -70, 60, 50);
    else if (IS("load along a member that follows"))
        follow(s, scene_add_load(s, SCENE_DISTRIBUTED, 1, -70, 60, 50));
    else if (IS("moments along a member"))
        scene_add_load(s, SCENE_DISTRIBUTED_MOMENT, 1, 60, 90, 120);
    else if (IS("gravity on members"))
        scene_add_load(s, SCENE_GRAVITY, 1, -30, -9.81, 20);
    else if (IS("weight of a body")) {
        scene_set_body(s, TIP, (scene_body){.mass = 8});
        scene_add_load(s, SCENE_WEIGHT, TIP, -30, -9.81, 20);
    } else if (IS("load that stays"))
        scene_set_factor(s, scene_add_load(s, SCENE_FORCE, TIP, -300, 50, 20), 1, &from, &whole);
    else if (IS("strain of a member")) {
        scene_member_at(s, 0)->strain[0] = 2e-4;
        scene_hold_all(s, TIP);
        scene_node_at(s, TIP)->translation[1] = scene_node_at(s, TIP)->angle[2] = SCENE_FREE;
    } else if (IS("initial curvature"))
        scene_member_at(s, 1)->curvature[2] = 0.3;
    else if (IS("taper")) {
        const section_spec thin = spec_of(0.7);
        scene_member_at(s, 1)->section_q = scene_add_section(s, &thin);
    } else if (IS("section by its matrices")) {
        section_spec m = {.kind = SECTION_MATRICES};
        section_spec_init(&m);
        m.kind = SECTION_MATRICES;
        const double C[6] = {1.8e8, 6e7, 6e7, 2e4, 4e4, 2e4}, M[6] = {7, 7, 7, 3e-3, 2e-3, 1e-3};
        for (int i = 0; i < 6; i++) {
            m.constants.stiffness[7 * i] = C[i];
            m.constants.mass[7 * i] = M[i];
        }
        const int profile = scene_add_section(s, &m);
        scene_member_at(s, 1)->section = scene_member_at(s, 1)->section_q = profile;
    } else if (IS("spring")) {
        double k[36] = {0};
        for (int i = 0; i < 6; i++)
            k[7 * i] = 1e4 * (i + 1);
        scene_add_spring(s, SCENE_NONE, TIP, k);
    } else if (IS("release")) {
        double k[36] = {[28] = 500, [35] = 400};
        scene_release_end(s, 1, 0, SCENE_RZ);
        scene_add_spring(s, MIDDLE, TIP, k);
    } else if (IS("fork")) {
        twist(s);
        ended_in_a_fork(s);
    } else if (IS("warping held")) {
        twist(s);
        scene_member_at(s, 0)->warp_p = SCENE_WARP_FIXED;
    } else if (IS("warping shared")) {
        twist(s);
        scene_member_at(s, 0)->warp_p = SCENE_WARP_FIXED;
        scene_member_at(s, 0)->warp_q = scene_member_at(s, 1)->warp_p = 0;
    } else if (IS("node that another carries")) {
        const int edge = scene_add_attached(s, TIP, 1, 0.2, 0);
        scene_add_member(s, MIDDLE, edge, s->member[0].section, y_axis);
    } else if (IS("mass of a node"))
        scene_set_body(s, TIP, (scene_body){.mass = 3});
    else if (IS("inertia of a node"))
        scene_set_body(s, TIP, (scene_body){.inertia = {0.2, 0.3, 0.25, 0, 0, 0}});
    else if (IS("motion of a node"))
        scene_drive(
            s, TIP, SCENE_UX,
            scene_add_driver(s, "push", 2, (const double[]){0, 1}, (const double[]){0, -1e-6}));
    else if (IS("damping"))
        for (int i = 0; i < s->members; i++)
            scene_member_at(s, i)->damping = 1e-4;
    else if (!IS("velocity at the start")) /* which is the analysis's */
        s->name[0] = '\0';
#undef IS
}

/* Without the input, but with what was only added to carry it. */
static void carry(scene *s, const char *name)
{
    if (strcmp(name, "strain of a member") == 0) {
        scene_hold_all(s, TIP);
        scene_node_at(s, TIP)->translation[1] = scene_node_at(s, TIP)->angle[2] = SCENE_FREE;
    }
    if (strcmp(name, "fork") == 0 || strncmp(name, "warping", 7) == 0)
        twist(s);
    if (strcmp(name, "warping shared") == 0)
        scene_member_at(s, 0)->warp_p = SCENE_WARP_FIXED;
    if (strcmp(name, "weight of a body") == 0)
        scene_set_body(s, TIP, (scene_body){.mass = 8});
}

/* The analysis of a column; what follows has its own before it. */
static int analyse(scene *s, scene_column column)
{
    const int about_path = column == SCENE_OF_BUCKLING_ABOUT || column == SCENE_OF_MODAL_ABOUT ||
                           column == SCENE_OF_COMPLIANCE_ABOUT,
              path = about_path                        ? scene_add_static(s, 1, &end, 2)
                     : column == SCENE_OF_MODAL_LINEAR ? scene_add_linear(s)
                                                       : SCENE_NONE;
    switch (column) {
    case SCENE_OF_LINEAR:
        return scene_add_linear(s);
    case SCENE_OF_STATIC:
        return scene_add_static(s, 1, &end, 2);
    case SCENE_OF_CONTINUATION:
        return scene_add_continuation(
            s, 1, (const double[]){0.01},
            (scene_control){.node = TIP, .component = SCENE_UY, .step = 0.003, .step_max = 0.01});
    case SCENE_OF_BUCKLING:
    case SCENE_OF_BUCKLING_ABOUT:
        return scene_add_buckling(s, path);
    case SCENE_OF_MODAL:
    case SCENE_OF_MODAL_LINEAR:
    case SCENE_OF_MODAL_ABOUT:
        return scene_add_modal(s, path);
    case SCENE_OF_COMPLIANCE:
    case SCENE_OF_COMPLIANCE_ABOUT:
        return scene_add_compliance(s, path, (scene_compliance){.node = TIP});
    case SCENE_OF_ROTATION:
        return scene_add_rotation(s, 1, &end, 2, 1, (scene_rotating_frame){.omega = {0, 3, 20}});
    default:
        return scene_add_motion(s, SCENE_NONE, 1, (const double[]){0.02},
                                (scene_motion){.scheme = SCENE_ALPHA,
                                               .alpha = scene_alpha_of_radius(0.9),
                                               .step = 1e-3});
    }
}

/* What the last analysis has of itself. */
static void begin(scene *s, const char *name, double times)
{
    if (strcmp(name, "velocity at the start") == 0 &&
        s->analysis[s->analyses - 1].kind == SCENE_MOTION)
        s->analysis[s->analyses - 1].of.motion.start.spin[2] = 0.01 * times;
}

static void want(scene *s, scene_column column, int analysis)
{
    switch (column) {
    case SCENE_OF_BUCKLING:
    case SCENE_OF_BUCKLING_ABOUT:
        scene_add_quantity(s, "factor", "1", analysis, scene_critical_factor(1, 0));
        break;
    case SCENE_OF_MODAL:
    case SCENE_OF_MODAL_LINEAR:
    case SCENE_OF_MODAL_ABOUT:
        for (int i = 0; i < 3; i++)
            scene_add_quantity(s, (const char *[]){"f0", "f1", "f2"}[i], "Hz", analysis,
                               scene_frequency(i, SCENE_ANY));
        break;
    case SCENE_OF_COMPLIANCE:
    case SCENE_OF_COMPLIANCE_ABOUT:
        for (int i = 0; i < 3; i++)
            scene_add_quantity(s, (const char *[]){"cx", "cy", "cz"}[i], "m/N", analysis,
                               scene_compliance_entry(i, SCENE_UY));
        scene_add_quantity(s, "turn", "rad/(N m)", analysis,
                           scene_compliance_entry(SCENE_RX, SCENE_RX));
        break;
    default:
        for (int i = 0; i < 6; i++) {
            char name[SCENE_NAME];
            snprintf(name, sizeof name, "u_%d", i);
            scene_add_quantity(s, name, "m", analysis, scene_coordinate(MIDDLE, i));
            snprintf(name, sizeof name, "v_%d", i);
            scene_add_quantity(s, name, "m", analysis, scene_coordinate(TIP, i));
        }
        for (int i = 0; i < 6; i++) {
            char name[SCENE_NAME];
            snprintf(name, sizeof name, "R_%d", i);
            scene_add_quantity(s, name, "N", analysis, scene_reaction(ROOT, i));
        }
        scene_add_quantity(s, "N", "N", analysis, scene_internal_at(1, 0, SCENE_N));
        scene_add_quantity(s, "M", "N m", analysis, scene_internal_at(0, 0.7, SCENE_MZ));
        if (column == SCENE_OF_CONTINUATION)
            scene_add_quantity(s, "factor", "1", analysis, scene_factor_at());
    }
}

/* times: of all loads, strains and motions that are the input's. 0: without them. */
static void solve(const char *name, scene_column column, int with, double times,
                  const element_type *e, answer *a)
{
    scene s;
    base(&s);
    const int loads = s.loads;
    if (with)
        add(&s, name);
    else
        carry(&s, name);
    for (int i = loads; i < s.loads; i++)
        for (int k = 0; k < 3; k++)
            s.load[i].vector[k] *= times;
    for (int i = 0; i < s.members; i++)
        s.member[i].strain[0] *= times;
    for (int i = 0; i < s.drivers; i++)
        s.driver[i].value[1] *= times;
    const int asked = analyse(&s, column);
    if (with)
        begin(&s, name, times);
    want(&s, column, asked);
    fault f = {""};
    gsl_test(scene_validate(&s, &f) != STATUS_OK, "%s: %s is a scene (%s)",
             scene_column_name[column], name, f.text);
    ask_scene(&s, e, NULL, 4, a);
    scene_free(&s);
}

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

/* Twice the input is twice its part of the answer. */
static void superposition(const scene_input *in, const element_type *e, const answer *without,
                          const answer *with)
{
    static answer twice;
    solve(in->name, SCENE_OF_LINEAR, 1, 2, e, &twice);
    for (int i = 0; i < twice.count; i++)
        gsl_test_abs(twice.value[i] - with->value[i], with->value[i] - without->value[i],
                     1e-8 * (fabs(with->value[i]) + fabs(without->value[i])) + 1e-9,
                     "%s: linear, %s: superposition of %s", e->name, in->name, with->name[i]);
}

static int is_load(const scene_input *in)
{
    return in - scene_inputs <= 11; /* and strain */
}

static void cell(const scene_input *in, scene_column column, const element_type *e, int counts[])
{
    static answer with, without;
    const char part = in->part[column], *where = scene_column_name[column];
    /* a beam bent from the first load on loses its stiffness nowhere; a motion needs loads over
     * time */
    if (column == SCENE_OF_BUCKLING_ABOUT ||
        (column == SCENE_OF_MOTION &&
         (strcmp(in->name, "load that stays") == 0 || strcmp(in->name, "motion of a node") == 0)))
        return;
    const int moved = strcmp(in->name, "motion of a node") == 0; /* or held there */
    solve(in->name, column, moved, 0, e, &without);
    solve(in->name, column, 1, 1, e, &with);
    if (with.outcome == ASK_NOT_OFFERED || without.outcome == ASK_NOT_OFFERED)
        return;
    counts[part == 'x' ? 1 : part == '-' ? 2 : 0]++;
    const int refused = with.status == STATUS_REFUSED;
    if (part == SCENE_PART_REFUSED) {
        gsl_test(!refused || strstr(with.reason, in->name) == NULL ||
                     strstr(with.reason, where) == NULL,
                 "%s: %s, %s: is refused by name (%s)", e->name, where, in->name, with.reason);
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
    if (part == SCENE_PART_NONE)
        gsl_test(change > 1e-9, "%s: %s, %s: has no part (%g)", e->name, where, in->name, change);
    else
        gsl_test(!(change > 1e-6), "%s: %s, %s: changes the answer (%g)", e->name, where, in->name,
                 change);
    if (column == SCENE_OF_LINEAR && is_load(in))
        superposition(in, e, &without, &with);
}

int main(void)
{
    static const char *const chosen[] = {"collocation", "geometrically_exact", "beamw_consistent"};
    int walked[3] = {0};
    for (int k = 0; k < 3; k++) {
        const element_type *e = formulation_find(chosen[k]);
        for (const scene_input *in = scene_inputs; in->name != NULL; in++) {
            scene s;
            base(&s);
            add(&s, in->name);
            analyse(&s, SCENE_OF_MOTION);
            begin(&s, in->name, 1);
            const int posed = s.name[0] != '\0';
            gsl_test(posed && !in->stands(&s, NULL, 0), "%s stands in its scene", in->name);
            scene_free(&s);
            for (int c = 0; c < SCENE_COLUMNS && posed; c++)
                cell(in, (scene_column)c, e, walked);
        }
    }
    gsl_test(walked[0] < 500 || walked[1] < 12 || walked[2] < 60, "%d used, %d refused, %d no part",
             walked[0], walked[1], walked[2]);
    return gsl_test_summary();
}
