/* Loads along one element in linear theory: as exact as forces and moments at its ends are, with
 * the stiffness that it has under these (Przemieniecki, Theory of Matrix Structural Analysis, 1968,
 * sec. 5 and 10: Timoshenko's beam). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/contract/checks.h"
#include "harness/model/model.h"

enum { SIX = 6, END = 1 };

static const double L = 0.7, force = 3, moment = 2; /* [m, N/m, N m/m] */
static const double rounding = 1e-8;                /* in parts of what a cantilever has */

typedef enum support { CANTILEVER, CLAMPED, PROPPED, HINGED, SUPPORTS } support;
static const char *const support_name[SUPPORTS] = {
    "held at its first node", "clamped at both nodes",
    "clamped at one node and propped at the other", "hinged at both nodes"};
/* Components of its two nodes that are held, a bit each. */
static const unsigned held[SUPPORTS][2] = {{63, 0}, {63, 63}, {63, 15}, {15, 7}};

/* Displacement and turn of a plane, and the sign of the turn in it. */
static const struct {
    int shift, turn, sign;
} planes[2] = {{1, 5, 1}, {2, 4, -1}};

/* What forces and moments at its end find: 1/EA, 1/GIt, and of each plane 1/EI and what shears. */
typedef struct softness {
    double axial, twist, bend[2], shear[2];
} softness;

/* Of both nodes: displacements, or reactions where they are held. */
typedef struct ends {
    double of[2][SIX];
} ends;

static void make_scene(support of, scene *s)
{
    const double y[3] = {0, 1, 0};
    section_spec spec = section_spec_rectangle(70e3, 27e3, 0.3, 0.2);
    spec.given.Iw = 0;
    scene_init(s, "along");
    const int profile = scene_add_section(s, &spec), from = scene_add_node(s, 0, 0, 0),
              to = scene_add_node(s, L, 0, 0);
    scene_add_member(s, from, to, profile, y);
    for (int node = 0; node < 2; node++)
        for (int c = 0; c < SIX; c++)
            if (held[of][node] >> c & 1)
                scene_hold(s, node, c, c);
    scene_omit(s, SCENE_OMITTABLE & ~(unsigned)(FEATURE_WARPING | FEATURE_SHEAR));
}

static void ask(scene *s, int analysis, int number, scene_extract what)
{
    char name[SCENE_NAME];
    snprintf(name, sizeof name, "v%d", number);
    scene_add_quantity(s, name, "1", analysis, what);
}

/* The values of its quantities. */
static status solve(const formulation *chosen, const scene *s, double value[], fault *f)
{
    const model_request what = {s, chosen->type, chosen->option, 1, 0, 0};
    const solve_options options = {.newton = formulation_newton(chosen)};
    solve_result found = {0};
    model *m = NULL;
    status outcome = scene_validate(s, f);
    if (outcome == STATUS_OK)
        outcome = model_alloc(&what, &m, f);
    if (outcome == STATUS_OK) {
        outcome = solve_scene(s, m, &options, &found, f);
        for (int i = 0; i < found.quantities && outcome == STATUS_OK; i++)
            value[i] = found.quantity[i].value;
        result_free(&found);
    }
    model_free(m);
    return outcome;
}

/* As the displacements between nodes have it: elements/field. */
static double shear_of(const formulation *chosen, const section *c, int plane)
{
    const int rigid = !(chosen->type->offers & FEATURE_SHEAR) ||
                      (plane == 0 && (chosen->type->lacks & LACKS_SHEAR_Y));
    return rigid ? 0 : c->F[4 * plane] / c->shear_modulus;
}

/* REFUSED: one element does not take forces and moments at its end as the exact beam does, which no
 * rule for loads along it can mend. */
static status measure(const formulation *chosen, softness *out, fault *f)
{
    double C[SIX * SIX];
    section c = {0};
    scene s;
    make_scene(CANTILEVER, &s);
    const int analysis = scene_add_compliance(&s, SCENE_NONE, (scene_compliance){.node = END});
    for (int i = 0; i < SIX * SIX; i++)
        ask(&s, analysis, i, scene_compliance_entry(i / SIX, i % SIX));
    status outcome = solve(chosen, &s, C, f);
    if (outcome == STATUS_OK)
        outcome = scene_constants(&s, 0, &c, f);
    scene_free(&s);
    TRY(outcome);
    out->axial = C[0] / L;
    out->twist = C[3 * SIX + 3] / L;
    for (int k = 0; k < 2; k++) {
        const int v = planes[k].shift, t = planes[k].turn;
        const double tip = C[t * SIX + t] * L * L / 3, cross = planes[k].sign * C[v * SIX + t];
        out->bend[k] = C[t * SIX + t] / L;
        out->shear[k] = shear_of(chosen, &c, k);
        if (!(fabs(C[v * SIX + v] / (tip + out->shear[k] * L) - 1) < rounding &&
              fabs(cross / (out->bend[k] * L * L / 2) - 1) < rounding))
            return fault_set(f, STATUS_REFUSED,
                             "one element is not exact under a force at its end (along %c by "
                             "%.2g)",
                             "yz"[k], C[v * SIX + v] / (tip + out->shear[k] * L) - 1);
    }
    return STATUS_OK;
}

/* Stretch or twist, component c, under a load along it. */
static void exact_along(support of, double soft, double load, int c, ends *out)
{
    const int both = held[of][END] >> c & 1;
    out->of[END][c] = both ? -load * L / 2 : load * L * L / 2 * soft;
    out->of[0][c] = both ? -load * L / 2 : -load * L;
}

/* Bending in a plane under a force and a moment along it, by the force method: R and M hold the
 * end of a cantilever, which a hinge at its beginning turns. */
static void exact_across(support of, const softness *soft, int k, double along, double turning,
                         ends *out)
{
    const double bend = soft->bend[k], shear = soft->shear[k],
                 vv = L * L * L / 3 * bend + shear * L, vt = L * L / 2 * bend, tt = L * bend,
                 sign = planes[k].sign,
                 v = along * (L * L * L * L / 8 * bend + L * L / 2 * shear) +
                     turning * L * L * L / 3 * bend,
                 t = along * L * L * L / 6 * bend + turning * L * L / 2 * bend;
    double R = 0, M = 0, root = 0;
    if (of == CLAMPED) {
        const double det = vv * tt - vt * vt;
        R = -(tt * v - vt * t) / det;
        M = -(vv * t - vt * v) / det;
    } else if (of == PROPPED) {
        R = -v / vv;
    } else if (of == HINGED) {
        R = -(along * L / 2 + turning);
        root = -(v + vv * R) / L;
    }
    double *begin = out->of[0], *end = out->of[END];
    const int y = planes[k].shift, z = planes[k].turn;
    begin[y] = -(along * L + R);
    begin[z] = sign * (of == HINGED ? root : -(along * L * L / 2 + turning * L + R * L + M));
    end[y] = of == CANTILEVER ? v : R;
    end[z] = sign * (of == CLAMPED ? M : t + vt * R + root);
}

/* q: force and moment per length. */
static ends exact_ends(support of, const softness *soft, const double q[SIX])
{
    ends out;
    exact_along(of, soft->axial, q[0], 0, &out);
    exact_along(of, soft->twist, q[3], 3, &out);
    for (int k = 0; k < 2; k++)
        exact_across(of, soft, k, q[planes[k].shift], planes[k].sign * q[planes[k].turn], &out);
    return out;
}

static status found_ends(const formulation *chosen, support of, const double q[SIX], ends *out,
                         fault *f)
{
    scene s;
    make_scene(of, &s);
    scene_add_load(&s, SCENE_DISTRIBUTED, 0, q[0], q[1], q[2]);
    scene_add_load(&s, SCENE_DISTRIBUTED_MOMENT, 0, q[3], q[4], q[5]);
    const int analysis = scene_add_linear(&s);
    for (int i = 0; i < 2 * SIX; i++)
        ask(&s, analysis, i,
            held[of][i / SIX] >> i % SIX & 1 ? scene_reaction(i / SIX, i % SIX)
                                             : scene_coordinate(i / SIX, i % SIX));
    const status outcome = solve(chosen, &s, out->of[0], f);
    scene_free(&s);
    return outcome;
}

/* What it would be of a cantilever. */
static double size_of(const softness *soft, int component, int reaction)
{
    const ends of =
        exact_ends(CANTILEVER, soft, (const double[]){force, force, force, moment, moment, moment});
    const int turns = component >= 3;
    if (reaction)
        return turns ? force * L * L / 2 + moment * L : force * L + moment;
    return fabs(of.of[END][component]);
}

static void compare(const formulation *chosen, support of, const softness *soft,
                    const double q[SIX], claim *one)
{
    ends found;
    fault f = {""};
    const ends right = exact_ends(of, soft, q);
    if (found_ends(chosen, of, q, &found, &f) != STATUS_OK) {
        claims_asks(one, 0, "%s under loads along it: %s", support_name[of], f.text);
        return;
    }
    for (int i = 0; i < 2 * SIX; i++) {
        const int node = i / SIX, c = i % SIX, reaction = held[of][node] >> c & 1;
        const double a = found.of[node][c], b = right.of[node][c];
        char words[SPECIMEN_WORDS];
        claims_departs(
            one, fabs(a - b) / size_of(soft, c, reaction),
            "strain, stress: one element %s has under a load along it %.9g, not %.9g, as "
            "%s%s; what is right under forces at the nodes is so under loads between "
            "them where the strains are those of r and R of node_state, and at rest of "
            "x axes along the element",
            support_name[of], a, b, reaction ? "reaction to the " : "",
            specimen_coordinate(NODE_COORDINATES * node + c, words));
    }
}

void checks_along(const formulation *chosen, claims *out)
{
    static const struct {
        const char *name;
        double q[SIX];
    } load[] = {{"a uniform force along one element, and a torque", {force, force, force, moment}},
                {"a uniform moment along one element", {0, 0, 0, 0, moment, moment}}};
    softness soft;
    fault f = {""};
    claims_doing(out, "one element as a cantilever");
    const status outcome = measure(chosen, &soft, &f);
    for (size_t i = 0; i < sizeof load / sizeof load[0]; i++) {
        if (outcome != STATUS_OK) {
            claims_not_made(out, load[i].name, f.text);
            continue;
        }
        for (support of = 0; of < SUPPORTS; of++) {
            claims_doing(out, "one element %s under loads along it", support_name[of]);
            compare(chosen, of, &soft, load[i].q, claims_open(out, load[i].name, rounding));
        }
    }
}
