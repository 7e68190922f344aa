/* A small frame with one row of the table of inputs and one analysis. */
#ifndef BEAMWORK_POSED_H
#define BEAMWORK_POSED_H

#include <gsl/gsl_test.h>
#include <stdio.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/test/kit.h"
#include "harness/tools/kit/ask.h"

enum { ROOT, MIDDLE, TIP, BESIDE, LATER };
static const double y_axis[3] = {0, 1, 0}, end = 1, turning[3] = {0, 3, 20};

static section_spec spec_of(double size)
{
    section_spec spec = sections_of(1e-3 * size, 2e-7 * size, 1e-7 * size, 3e-7 * size);
    spec.young = 2e11;
    spec.shear_modulus = 8e10;
    spec.density = 7800;
    spec.expansion = 1e-5;
    return spec;
}

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

static void arch(scene *s)
{
    base(s);
    for (int i = 0; i < 3; i++)
        scene_node_at(s, i)->position[1] = 0.03 * i;
    scene_node_at(s, TIP)->translation[0] = scene_node_at(s, TIP)->translation[2] = SCENE_HELD;
    scene_load_at(s, 0)->vector[0] = scene_load_at(s, 0)->vector[2] = 0;
    scene_load_at(s, 0)->vector[1] = -300;
}

static scene_load *follow(scene *s, int load)
{
    scene_load_at(s, load)->follower = 1;
    return scene_load_at(s, load);
}

static scene_load *spread(scene *s, double from, double to)
{
    scene_load *load = scene_load_at(s, scene_add_load(s, SCENE_DISTRIBUTED, 1, -70, 60, 50));
    load->range[0] = from;
    load->range[1] = to;
    return load;
}

static void twist(scene *s)
{
    s->section[0].constants.Iw = 5e-9;
    scene_set_body(s, TIP, (scene_body){.inertia = {2, 1, 1, 0, 0, 0}});
    scene_add_load(s, SCENE_FORCE, scene_add_attached(s, TIP, 1, 0.2, 0), 0, 5, 40);
}

static void ended_in_a_fork(scene *s)
{
    const double *to = s->node[TIP].position, axis[3] = {to[0], to[1], to[2]},
                 web[3] = {-to[1], to[0], 0};
    scene_fork(s, TIP, axis, web);
}

static void hold_tip(scene *s)
{
    scene_hold_all(s, TIP);
    scene_node_at(s, TIP)->translation[1] = scene_node_at(s, TIP)->angle[2] = SCENE_FREE;
}

static double length_of(const scene *s, int member)
{
    const double *p = s->node[s->member[member].p].position,
                 *q = s->node[s->member[member].q].position;
    return sqrt((q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]) +
                (q[2] - p[2]) * (q[2] - p[2]));
}

static void combine(scene *s)
{
    const int all = scene_add_combination(s, "all");
    scene_add_term(s, all, scene_add_case(s, "dead"), 1);
    scene_add_term(s, all, scene_add_case(s, "live"), -1.5);
}

static void add(scene *s, const char *name)
{
    static const double from = 0, whole = 1;
#define IS(text) (strcmp(name, text) == 0)
    if (IS("force"))
        scene_add_load(s, SCENE_FORCE, MIDDLE, 20, 50, -30);
    else if (IS("follower force"))
        follow(s, scene_add_load(s, SCENE_FORCE, MIDDLE, 20, 50, -30));
    else if (IS("force at an offset from its node"))
        scene_load_at(s, scene_add_load(s, SCENE_FORCE, TIP, 10, 50, -30))->at[1] = 0.1;
    else if (IS("moment"))
        scene_add_load(s, SCENE_MOMENT, TIP, 20, 30, 40);
    else if (IS("follower moment"))
        follow(s, scene_add_load(s, SCENE_MOMENT, TIP, 20, 30, 40));
    else if (IS("load along a member"))
        scene_add_load(s, SCENE_DISTRIBUTED, 1, -70, 60, 50);
    else if (IS("follower load along a member"))
        follow(s, scene_add_load(s, SCENE_DISTRIBUTED, 1, -70, 60, 50));
    else if (IS("load along a part of a member"))
        spread(s, 0.1, 0.7);
    else if (IS("load that varies along a member")) {
        scene_load *load = spread(s, 0, 1);
        load->varies = 1;
        load->last[1] = 150;
        load->last[2] = -80;
    } else if (IS("lumped load along a member"))
        spread(s, 0, 1)->lumped = 1;
    else if (IS("force within a member"))
        scene_add_load_within(s, SCENE_MEMBER_FORCE, 1, 0.3, -20, 50, -30);
    else if (IS("follower force within a member"))
        follow(s, scene_add_load_within(s, SCENE_MEMBER_FORCE, 1, 0.3, -20, 50, -30));
    else if (IS("moment within a member"))
        scene_add_load_within(s, SCENE_MEMBER_MOMENT, 1, 0.3, 20, 30, 40);
    else if (IS("moments along a member"))
        scene_add_load(s, SCENE_DISTRIBUTED_MOMENT, 1, 60, 90, 120);
    else if (IS("gravity on members"))
        scene_add_load(s, SCENE_GRAVITY, 1, -30, -9.81, 20);
    else if (IS("weight of a body")) {
        scene_set_body(s, TIP, (scene_body){.mass = 8});
        scene_add_load(s, SCENE_WEIGHT, TIP, -30, -9.81, 20);
    } else if (IS("constant load"))
        scene_set_factor(s, scene_add_load(s, SCENE_FORCE, TIP, -300, 50, 20), 1, &from, &whole);
    else if (IS("temperature")) {
        scene_load *load = scene_load_at(s, scene_add_load(s, SCENE_TEMPERATURE, 1, 0, 0, 0));
        load->temperature = s->node[TIP].position[1] > 0 ? -20 : 20;
        load->gradient[0] = 80;
        load->gradient[1] = -50;
        hold_tip(s);
    } else if (IS("tension between nodes")) {
        scene_load *load = scene_load_at(s, scene_add_load(s, SCENE_FORCE, TIP, 0, 0, 0));
        load->towards = ROOT;
        load->tension = 80;
    } else if (IS("elongation")) {
        scene_load_at(s, scene_add_load(s, SCENE_TEMPERATURE, 1, 0, 0, 0))->elongation =
            s->node[TIP].position[1] > 0 ? -1e-4 : 1e-4;
        hold_tip(s);
    } else if (IS("strain of a member")) {
        scene_member_at(s, 0)->strain[0] = 2e-4;
        hold_tip(s);
    } else if (IS("pretension")) {
        scene_member_at(s, 0)->pretension = 3e4;
        hold_tip(s);
    } else if (IS("unstressed length")) {
        scene_member_at(s, 1)->unstressed_length = length_of(s, 1) * (1 - 2e-4);
        hold_tip(s);
    } else if (IS("free curvature")) {
        scene_member_at(s, 1)->free_curvature[1] = 0.01;
        scene_member_at(s, 1)->free_curvature[0] = 0.02;
        hold_tip(s);
    } else if (IS("initial curvature"))
        scene_member_at(s, 1)->curvature[2] = 0.3;
    else if (IS("taper")) {
        const section_spec thin = spec_of(0.7);
        scene_member_at(s, 1)->section_q = scene_add_section(s, &thin);
    } else if (IS("section given by its matrices")) {
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
    } else if (IS("spring given by a table") || IS("spring with a kink at rest")) {
        const int kink = IS("spring with a kink at rest");
        double none[36] = {0};
        const double at[4] = {-1, kink ? 0 : -1e-4, 1e-3, 1}, soft = 2e3,
                     value[4] = {5e3 * at[1] - 0.5, soft * at[1], soft * 1e-3, 40};
        const int i = scene_add_spring(s, SCENE_NONE, TIP, none);
        scene_set_table(s, i, SCENE_UY, 4, at, value);
        scene_set_table(s, i, SCENE_UZ, 4, at, value);
    } else if (IS("foundation")) {
        for (int i = 0; i < 6; i++)
            scene_member_at(s, 1)->foundation[i] = 3e4 * (i + 1) / (1 + 9 * (i > 2));
    } else if (IS("offset of an end")) {
        scene_member_at(s, 1)->offset[0][1] = 0.003;
        scene_member_at(s, 1)->offset[1][2] = 0.02;
    } else if (IS("imperfection")) {
        scene_member_at(s, 1)->bow[0] = 0.004;
        scene_member_at(s, 1)->bow[1] = 0.002;
        scene_member_at(s, 1)->half_waves = 1;
    } else if (IS("imperfection given by a mode")) {
        const int shape = scene_add_imperfection(s);
        if (shape >= 0) {
            s->imperfection[shape].analysis = scene_add_modal(s, SCENE_NONE);
            s->imperfection[shape].amplitude = 0.01;
        }
    } else if (IS("imperfection given by shifts")) {
        const int shape = scene_add_imperfection(s);
        scene_shift_node(s, shape, MIDDLE, (const double[]){0.001, 0.004, 0.006});
        scene_shift_node(s, shape, TIP, (const double[]){0, -0.001, 0});
    } else if (IS("nodes that are shifted")) {
        const double shift[2][3] = {{0.001, 0.004, 0.006}, {0, -0.001, 0}};
        for (int i = 0; i < 3; i++) {
            scene_node_at(s, MIDDLE)->position[i] += shift[0][i];
            scene_node_at(s, TIP)->position[i] += shift[1][i];
        }
    } else if (IS("offset by bodies")) {
        scene_member_at(s, 1)->p = scene_add_attached(s, MIDDLE, s->node[MIDDLE].position[0],
                                                      s->node[MIDDLE].position[1] + 0.003, 0);
        scene_member_at(s, 1)->q =
            scene_add_attached(s, TIP, s->node[TIP].position[0], s->node[TIP].position[1], 0.02);
    } else if (IS("dashpot")) {
        const double none[36] = {0};
        double c[36] = {0};
        for (int i = 0; i < 6; i++)
            c[7 * i] = 20 * (i + 1);
        scene_damp_spring(s, scene_add_spring(s, SCENE_NONE, TIP, none), c);
    } else if (IS("unsymmetric spring") || IS("unsymmetric dashpot")) {
        const double none[36] = {0}, times = IS("unsymmetric spring") ? 1e4 : 20;
        double k[36] = {[8] = -0.4 * times, [13] = 0.3 * times};
        for (int i = 0; i < 6; i++)
            k[7 * i] = times * (i + 1);
        const int i = scene_add_spring(s, SCENE_NONE, TIP, times > 20 ? k : none);
        if (times == 20)
            scene_damp_spring(s, i, k);
    } else if (IS("feedback")) {
        const int load = scene_add_load(s, SCENE_FORCE, TIP, 0, 1, 0);
        scene_load_at(s, load)->feedback =
            (scene_feedback){TIP, SCENE_UY, SCENE_NONE, 2e3, 5, 1e4, 0};
    } else if (IS("release")) {
        double k[36] = {[28] = 500, [35] = 400};
        scene_release_end(s, 1, 0, SCENE_RZ);
        scene_add_spring(s, MIDDLE, TIP, k);
    } else if (IS("supports along rotated axes")) {
        static const double axes[2][3] = {{1, 0, 0}, {0, 0.8, 0.6}};
        memcpy(scene_node_at(s, TIP)->axes, axes, sizeof axes);
        scene_hold(s, TIP, SCENE_UZ, SCENE_UZ);
    } else if (IS("constraint")) {
        const int c = scene_add_constraint(s, 1u << SCENE_UY, 3);
        scene_constrain(s, c, MIDDLE);
        scene_constrain(s, c, TIP);
    } else if (IS("diaphragm")) {
        scene_constrain(s, scene_add_diaphragm(s, TIP, 2), MIDDLE);
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
    } else if (IS("node attached to another")) {
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
    else if (IS("motion with a load case")) {
        combine(s);
        scene_drive(
            s, TIP, SCENE_UX,
            scene_add_driver(s, "push", 2, (const double[]){0, 1}, (const double[]){0, 1e-6}));
        s->driver[0].load_case = 1;
    } else if (IS("load with a load case")) {
        combine(s);
        scene_load_at(s, scene_add_load(s, SCENE_FORCE, MIDDLE, 20, 50, -30))->load_case = 1;
    } else if (IS("damping"))
        for (int i = 0; i < s->members; i++)
            scene_member_at(s, i)->damping = 1e-4;
    else if (!IS("initial velocity") && !IS("rotating axes"))
        s->name[0] = '\0';
#undef IS
}

static void carry(scene *s, const char *name)
{
    static const char *const held[] = {"temperature",       "strain of a member", "pretension",
                                       "unstressed length", "free curvature",     "elongation"};
    for (int i = 0; i < 6; i++)
        if (strcmp(name, held[i]) == 0)
            hold_tip(s);
    if (strcmp(name, "fork") == 0 || strncmp(name, "warping", 7) == 0)
        twist(s);
    if (strcmp(name, "warping shared") == 0)
        scene_member_at(s, 0)->warp_p = SCENE_WARP_FIXED;
    if (strcmp(name, "weight of a body") == 0)
        scene_set_body(s, TIP, (scene_body){.mass = 8});
}

static const double end_of_continuation = 0.01;

typedef struct posed {
    const char *name;
    scene_column column;
    int with;
    double times;
    double size;  /* factor by which all loads, strains and motions are multiplied */
    double grown; /* additional factor of loads that are not functions of the path */
    double end;   /* end of the static path */
    double pull;
    int turns;   /* 1 if static paths are in rotating axes */
    int follows; /* 1: a follower force acts on the tip */
} posed;

/* Returns 1 if flutter is requested, because the load has no potential. */
static int flutters(const char *name, scene_column column)
{
    for (const scene_input *in = scene_inputs; in->name != NULL; in++)
        if (strcmp(in->name, name) == 0)
            return column == SCENE_OF_BUCKLING_ABOUT &&
                   (in->part[SCENE_OF_BUCKLING] == SCENE_PART_STATE ||
                    in->part[SCENE_OF_BUCKLING] == SCENE_PART_REFUSED);
    return 0;
}

/* Returns 1 if the input adds nodes to the mesh, which changes the elements of its member. */
static int divides(const char *name)
{
    return strstr(name, "within a member") != NULL || strstr(name, "part of a member") != NULL;
}

static posed pose(const char *name, scene_column column, int with)
{
    return (posed){.name = name,
                   .column = column,
                   .with = with,
                   .times = 1,
                   .size = 1,
                   .grown = 1,
                   .end = 1,
                   .turns = with && strcmp(name, "rotating axes") == 0,
                   .follows = flutters(name, column)};
}

static const double shaking = 17; /* [Hz] excitation frequency */

static void respond(scene *s, const char *name, int analysis, int node, int component, int along,
                    scene_vibration_part part, double at)
{
    const scene_response what = {.node = node,
                                 .component = component,
                                 .from = SCENE_NONE,
                                 .forced = node,
                                 .forced_along = along,
                                 .driver = SCENE_NONE,
                                 .reference = SCENE_NONE,
                                 .unbalanced = SCENE_NONE,
                                 .spinning = SCENE_RX,
                                 .part = part};
    const char *unit = along < SCENE_RX ? "m/N" : "rad/(N m)";
    scene_set_at(scene_add_quantity(s, name, unit, analysis, scene_response_to(what)), at);
}

static int is_instant(scene_column column)
{
    return column == SCENE_OF_MODAL_INSTANT || column == SCENE_OF_HARMONIC_INSTANT;
}

static int move(scene *s, int from, scene_column column)
{
    return scene_add_motion(s, from, 1, (const double[]){0.02},
                            (scene_motion){.scheme = is_instant(column) ? SCENE_RADAU : SCENE_ALPHA,
                                           .alpha = scene_alpha_of_radius(0.9),
                                           .step = 1e-3});
}

static int analyse(scene *s, const posed *p)
{
    const scene_column column = p->column;
    const int about_path = column == SCENE_OF_BUCKLING_ABOUT || column == SCENE_OF_MODAL_ABOUT ||
                           column == SCENE_OF_COMPLIANCE_ABOUT || column == SCENE_OF_HARMONIC_ABOUT,
              about_linear = column == SCENE_OF_MODAL_LINEAR || column == SCENE_OF_HARMONIC_LINEAR,
              path = about_path           ? scene_add_static(s, 1, &p->end, 2)
                     : about_linear       ? scene_add_linear(s)
                     : is_instant(column) ? move(s, SCENE_NONE, column)
                                          : SCENE_NONE;
    const int still = strcmp(p->name, "rotating axes") == 0 && !p->turns;
    switch (column) {
    case SCENE_OF_LINEAR:
        return scene_add_linear(s);
    case SCENE_OF_STATIC:
        return scene_add_static(s, 1, &p->end, 2);
    case SCENE_OF_CONTINUATION:
        return scene_add_continuation(
            s, 1, &end_of_continuation,
            (scene_control){.node = TIP, .component = SCENE_UY, .step = 0.003, .step_max = 0.01});
    case SCENE_OF_BUCKLING:
    case SCENE_OF_BUCKLING_ABOUT:
        return scene_add_buckling(s, path);
    case SCENE_OF_MODAL:
    case SCENE_OF_MODAL_LINEAR:
    case SCENE_OF_MODAL_ABOUT:
    case SCENE_OF_MODAL_INSTANT: {
        const int modal = scene_add_modal(s, path);
        s->analysis[modal].damped = column == SCENE_OF_MODAL_INSTANT;
        return modal;
    }
    case SCENE_OF_COMPLIANCE:
    case SCENE_OF_COMPLIANCE_ABOUT:
        return scene_add_compliance(s, path, (scene_compliance){.node = TIP});
    case SCENE_OF_ROTATION:
        return scene_add_rotation(
            s, 1, &end, 2, 1,
            (scene_rotating_frame){.omega = {0, still ? 0 : turning[1], still ? 0 : turning[2]}});
    case SCENE_OF_HARMONIC:
    case SCENE_OF_HARMONIC_LINEAR:
    case SCENE_OF_HARMONIC_ABOUT:
    case SCENE_OF_HARMONIC_INSTANT:
        return scene_add_harmonic(s, path, 2, (const double[]){0, shaking});
    default:
        return move(s, SCENE_NONE, column);
    }
}

static void begin(scene *s, const posed *p)
{
    for (int i = 0; i < s->analyses && strcmp(p->name, "initial velocity") == 0; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            s->analysis[i].of.motion.start.spin[2] = (is_instant(p->column) ? 5 : 0.01) * p->times;
    for (int i = 0; i < s->analyses && p->turns; i++)
        if (s->analysis[i].kind == SCENE_STATIC || s->analysis[i].kind == SCENE_CONTINUATION)
            scene_set_rotating_frame(
                s, i, (scene_rotating_frame){.omega = {turning[0], turning[1], turning[2]}});
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
    case SCENE_OF_MODAL_INSTANT:
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
    case SCENE_OF_HARMONIC:
    case SCENE_OF_HARMONIC_LINEAR:
    case SCENE_OF_HARMONIC_ABOUT:
    case SCENE_OF_HARMONIC_INSTANT:
        for (int i = 0; i < 3; i++) {
            const char *const name[] = {"cx", "cy", "cz", "rx", "ry", "rz", "ix", "iy", "iz"};
            respond(s, name[i], analysis, TIP, i, SCENE_UY, SCENE_REAL, 0);
            respond(s, name[3 + i], analysis, TIP, i, SCENE_UY, SCENE_REAL, shaking);
            respond(s, name[6 + i], analysis, TIP, i, SCENE_UY, SCENE_IMAGINARY, shaking);
        }
        respond(s, "turn", analysis, MIDDLE, SCENE_RX, SCENE_RX, SCENE_REAL, shaking);
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

static void strain(scene_member *m, double length, double times)
{
    m->strain[0] *= times;
    m->pretension *= times;
    for (int k = 0; k < 2; k++)
        m->free_curvature[k] *= times;
    if (m->unstressed_length > 0)
        m->unstressed_length = length + times * (m->unstressed_length - length);
}

static void structure(const posed *p, scene *s)
{
    static const double from = 0, whole = 1;
    if (p->column == SCENE_OF_BUCKLING_ABOUT && !p->follows)
        arch(s);
    else
        base(s);
    const int loads = s->loads;
    if (p->with)
        add(s, p->name);
    else
        carry(s, p->name);
    if (p->with && strcmp(p->name, "feedback") == 0 &&
        (p->column == SCENE_OF_HARMONIC_LINEAR || p->column == SCENE_OF_HARMONIC_ABOUT))
        scene_set_factor(s, s->loads - 1, 2, (const double[]){0, 1}, (const double[]){0, 0});
    for (int i = 0; i < s->loads && p->column == SCENE_OF_BUCKLING_ABOUT; i++)
        for (int k = 0; k < 2; k++)
            s->load[i].range[k] = round(2 * s->load[i].range[k]) / 2;
    for (int i = 0; i < s->loads; i++)
        for (int k = 0; k < 3; k++) {
            const double scale =
                p->size * (i < loads ? 1 : p->times) * (s->load[i].stations == 0 ? p->grown : 1);
            s->load[i].vector[k] *= scale;
            s->load[i].last[k] *= scale;
            *(k == 2 ? &s->load[i].temperature : &s->load[i].gradient[k]) *= scale;
            s->load[i].elongation *= k == 0 ? scale : 1;
            s->load[i].tension *= k == 0 ? scale : 1;
        }
    for (int i = 0; i < s->members; i++)
        strain(scene_member_at(s, i), length_of(s, i), p->times * p->size);
    for (int i = 0; i < s->drivers; i++)
        s->driver[i].value[1] *= p->times * p->size;
    if (p->pull != 0)
        scene_set_factor(s, scene_add_load(s, SCENE_FORCE, TIP, 0, p->pull, 0), 1, &from, &whole);
    if (p->follows)
        follow(s, scene_add_load(s, SCENE_FORCE, TIP, -3000, 0, 0));
}

static void act(scene *s)
{
    const unsigned unloaded = 1u << SCENE_MODAL | 1u << SCENE_COMPLIANCE | 1u << SCENE_HARMONIC;
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].load_case == SCENE_NONE)
            s->load[i].load_case = 0;
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].follows == SCENE_NONE && !(unloaded >> s->analysis[i].kind & 1u))
            s->analysis[i].acting.combination = 0;
}

static void answer_to(scene *s, const posed *p, const element_type *e, answer *a)
{
    fault f = {""};
    if (s->cases > 0)
        act(s);
    gsl_test(scene_validate(s, &f) != STATUS_OK, "%s: %s is a scene (%s)",
             scene_column_name[p->column], p->name, f.text);
    ask_scene(s, e, NULL, divides(p->name) ? 2 : 4, a);
    scene_free(s);
}

static void solve(const posed *p, const element_type *e, answer *a)
{
    scene s;
    structure(p, &s);
    const int requested = analyse(&s, p);
    begin(&s, p);
    want(&s, p->column, requested);
    answer_to(&s, p, e, a);
}

#endif
