#include "harness/model/model_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"

/* Largest share of shear in a deflection that may be neglected. A length l whose ends do not rotate
 * deflects by F l^3/(12 EI) in bending and by F l/(kGA) in shear. Their ratio is Phi = 12 EI/(kGA
 * l^2). The ratio is a quarter of Phi for a cantilever, and about n^2 Phi for bending in n
 * half-waves. */
static const double largest_phi = 0.01;

typedef struct box {
    double low[3], high[3];
} box;

static void include(const scene *s, int member, char *reached, box *b)
{
    reached[s->member[member].p] = reached[s->member[member].q] = 1;
    for (int end = 0; end < 2; end++) {
        double at[3];
        scene_end(s, member, end, at);
        for (int k = 0; k < 3; k++) {
            b->low[k] = fmin(b->low[k], at[k]);
            b->high[k] = fmax(b->high[k], at[k]);
        }
    }
}

static int shares_section(const scene_member *a, const scene_member *b)
{
    return a->section == b->section || a->section == b->section_q || a->section_q == b->section ||
           a->section_q == b->section_q;
}

/* Returns the diagonal [m] of the box around a member and the connected members with the same
 * section, because several short members may describe one beam. reached[nodes] must be zero on
 * entry. */
static double extent_of(const scene *s, int member, char *reached)
{
    const scene_member *first = &s->member[member];
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    include(s, member, reached, &b);
    for (int grows = 1; grows;) {
        grows = 0;
        for (int i = 0; i < s->members; i++) {
            const scene_member *m = &s->member[i];
            if (!shares_section(m, first) || reached[m->p] == reached[m->q])
                continue;
            include(s, i, reached, &b);
            grows = 1;
        }
    }
    const double size[3] = {b.high[0] - b.low[0], b.high[1] - b.low[1], b.high[2] - b.low[2]};
    return vec3_norm(size);
}

static double phi_along_y(const scene *s)
{
    double largest = 0;
    for (int i = 0; i < s->members; i++) {
        const int end[2] = {s->member[i].section, s->member[i].section_q};
        char *reached = calloc((size_t)s->nodes + 1, 1);
        const double l = reached != NULL ? extent_of(s, i, reached) : INFINITY;
        for (int k = 0; k < 2; k++) {
            section c;
            if (scene_constants(s, end[k], &c, NULL) == STATUS_OK)
                largest = fmax(largest, 12 * c.young * c.Iz * c.F[0] / (c.shear_modulus * l * l));
        }
        free(reached);
    }
    return largest;
}

int lacks_of(const scene *s, const element_type *type, char *words, int size)
{
    if (size > 0)
        words[0] = '\0';
    if (!(type->lacks & LACKS_SHEAR_Y) || !(features_needed(s) & FEATURE_SHEAR))
        return 0;
    const double phi = phi_along_y(s);
    snprintf(words, (size_t)size,
             "shear flexibility along y (%s; in a beam guided at both ends, %.2g of the bending "
             "deflection)",
             type->lacks_by, phi);
    return phi > largest_phi ? 2 : 1;
}

static int is_coupled(const section *c)
{
    static const int row[3] = {0, 0, 1}, column[3] = {1, 2, 2};
    int coupled = 0;
    for (int k = 0; k < 3; k++)
        coupled |= fabs(c->F[3 * row[k] + column[k]]) >
                   1e-12 * sqrt(c->F[4 * row[k]] * c->F[4 * column[k]]);
    return coupled;
}

const char *missing_in_section(const element_type *type, const section *c, int cells, int warps)
{
    if ((type->limits & LIMIT_DOUBLY_SYMMETRIC) && (features_eccentric(c) || is_coupled(c)))
        return "sections that are not doubly symmetric";
    if ((type->limits & LIMIT_WARPING_RIGID) && warps && cells > 0 && c->Iw > 0)
        return "the shear deformation of closed cells that warp";
    return NULL;
}

static int omits_shear_of_warping(const scene *s, const element_type *type)
{
    const unsigned both = FEATURE_SHEAR | FEATURE_WARPING;
    if (!(type->limits & LIMIT_WARPING_RIGID) || (features_needed(s) & both) != both)
        return 0;
    for (int i = 0; i < s->sections; i++) {
        section c;
        if (scene_constants(s, i, &c, NULL) == STATUS_OK && !c.matrices && c.Iw > 0 && c.F[8] > 0)
            return 1;
    }
    return 0;
}

static int limit_hit(const scene *s, const element_type *type, char *words, int size)
{
    const int warps = (features_needed(s) & FEATURE_WARPING) != 0;
    for (int i = 0; i < s->sections; i++) {
        section c;
        if (scene_constants(s, i, &c, NULL) != STATUS_OK)
            continue;
        const char *limit = missing_in_section(type, &c, s->section[i].cells, warps);
        if (limit != NULL)
            return snprintf(words, (size_t)size, "%s", limit) > 0;
    }
    return omits_shear_of_warping(s, type) &&
           snprintf(words, (size_t)size, "shear deformation due to warping") > 0;
}

/* Names the inertia that a motion requires but the type does not have. Returns 0 if none is
 * missing. */
static int mass_lacks(const scene *s, const element_type *type, char *words, int size)
{
    for (int i = 0; i < s->analyses && !type->spreads; i++)
        if (scene_spreads(&s->analysis[i]))
            return snprintf(words, (size_t)size, "consistent mass in motions") > 0;
    return 0;
}

/* Names the stress-free strains of the scene if the type computes nodal forces, not strains.
 * Returns 0 if there are none. */
static int strains_lack(const scene *s, const element_type *type, char *words, int size)
{
    scene_words owner_name;
    if (type->force == NULL || !scene_is_free(s, &owner_name))
        return 0;
    snprintf(words, (size_t)size, "the stress-free strains of %s (it computes forces, not strains)",
             owner_name.text);
    return 1;
}

static void words_of(unsigned missing, char *words, int size)
{
    const int used = feature_words(missing & ~(unsigned)FEATURE_CURVATURE, words, size);
    if ((missing & FEATURE_CURVATURE) && used < size)
        snprintf(words + used, (size_t)(size - used), "%sinitial strain", used > 0 ? ", " : "");
}

int missing_words(const scene *s, const element_type *type, char *words, int size)
{
    const unsigned missing = features_needed_of(s, type) & ~type->offers;
    if (size > 0)
        words[0] = '\0';
    if (missing != 0) {
        words_of(missing, words, size);
        return 1;
    }
    if (mass_lacks(s, type, words, size) || strains_lack(s, type, words, size) ||
        limit_hit(s, type, words, size) || lacks_of(s, type, words, size) > 1)
        return 1;
    if (size > 0)
        words[0] = '\0';
    return 0;
}

static unsigned can_be_omitted(const scene *s)
{
    const unsigned physics = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_ECCENTRIC | FEATURE_TRAPEZE |
                             FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE |
                             FEATURE_ROTARY_INERTIA;
    return physics & ~features_of_quantities(s);
}

int missing_refused(const scene *s, const element_type *type, char *words, int size)
{
    const unsigned missing = features_needed_of(s, type) & ~type->offers & ~can_be_omitted(s);
    if (size > 0)
        words[0] = '\0';
    if (missing != 0) {
        words_of(missing, words, size);
        return 1;
    }
    return mass_lacks(s, type, words, size) || strains_lack(s, type, words, size);
}

static unsigned omits_of_sections(const scene *s, const element_type *type)
{
    const int warps = (features_needed(s) & FEATURE_WARPING) != 0;
    unsigned omits = 0;
    for (int i = 0; i < s->sections; i++) {
        section c;
        if (scene_constants(s, i, &c, NULL) != STATUS_OK ||
            missing_in_section(type, &c, s->section[i].cells, warps) == NULL)
            continue;
        if (!(type->limits & LIMIT_DOUBLY_SYMMETRIC))
            omits |= FEATURE_WARPING;
        else if (features_eccentric(&c))
            omits |= FEATURE_ECCENTRIC;
        else
            omits |= is_coupled(&c) ? OMIT_SHEAR_COUPLING : FEATURE_WARPING;
    }
    return omits & FEATURE_ECCENTRIC ? omits & ~(unsigned)OMIT_SHEAR_COUPLING : omits;
}

unsigned missing_omits(const scene *s, const element_type *type)
{
    char words[OMIT_WORDS];
    const unsigned missing = features_needed_of(s, type) & ~type->offers & can_be_omitted(s),
                   omits = missing | omits_of_sections(s, type);
    const int shear = !(omits & FEATURE_WARPING) && omits_shear_of_warping(s, type);
    return omits | (shear ? OMIT_SHEAR_WARPING : 0) |
           (lacks_of(s, type, words, sizeof words) > 1 ? OMIT_SHEAR_Y : 0);
}

void missing_omit_words(unsigned omits, char words[OMIT_WORDS])
{
    static const struct {
        unsigned bit;
        const char *words;
    } more[] = {{OMIT_SHEAR_Y, "shear along y"},
                {OMIT_SHEAR_COUPLING, "coupling of shear"},
                {OMIT_SHEAR_WARPING, "shear due to warping"}};
    words[0] = '\0';
    if ((omits & (FEATURE_END - 1)) != 0)
        feature_words(omits & (FEATURE_END - 1), words, OMIT_WORDS);
    for (int i = 0; i < 3; i++) {
        const size_t used = strlen(words);
        if (omits & more[i].bit)
            snprintf(words + used, OMIT_WORDS - used, "%s%s", used > 0 ? ", " : "", more[i].words);
    }
}

void missing_omit(section *c, unsigned omits)
{
    for (int i = 0; i < 9; i++) {
        const int off = i % 4 != 0 && (omits & (FEATURE_ECCENTRIC | OMIT_SHEAR_COUPLING)),
                  along_y = (i < 3 || i % 3 == 0) && (omits & OMIT_SHEAR_Y),
                  of_warping = (i >= 6 || i % 3 == 2) && (omits & OMIT_SHEAR_WARPING);
        if (off || along_y || of_warping)
            c->F[i] = c->D[i] = 0;
    }
    if ((omits & (FEATURE_ECCENTRIC | OMIT_SHEAR_COUPLING)) && !c->matrices)
        for (int i = 0; i < 9; i += 4)
            c->D[i] = c->F[i] > 0 ? 1 / c->F[i] : 0;
    if (omits & FEATURE_ECCENTRIC)
        c->ys = c->zs = 0;
}

enum { MOST_NAMES = 6 };

static void put_loads(model_words *w, const scene *s)
{
    int count = 0;
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].lumped && ++count <= MOST_NAMES)
            model_words_put(w, "%s%s", count > 1 ? ", " : "", scene_called(s, SCENE_LOADS, i).text);
    if (count > MOST_NAMES)
        model_words_put(w, " and %d more", count - MOST_NAMES);
}

static int is_heavy(const scene *s)
{
    section c;
    int heavy = 0;
    for (int i = 0; i < s->sections && !heavy; i++)
        heavy = scene_constants(s, i, &c, NULL) == STATUS_OK && (c.density > 0 || c.matrices);
    return heavy;
}

static const char *requirement_of(const scene *s, const scene_motion *how)
{
    int weight = 0, other = 0;
    for (int i = 0; i < s->loads; i++) {
        const int along = scene_load_along(&s->load[i]) && !s->load[i].lumped &&
                          s->load[i].kind != SCENE_TEMPERATURE;
        weight |= along && s->load[i].kind == SCENE_GRAVITY;
        other |= along && s->load[i].kind != SCENE_GRAVITY;
    }
    if (how->scheme == SCENE_CONSERVING && (weight || other))
        return " and loads along members";
    return weight ? " and weight" : "";
}

static int is_lumped(const scene *s, const scene_analysis *a)
{
    return s->lumped && (a->kind == SCENE_MODAL || a->kind == SCENE_HARMONIC ||
                         a->kind == SCENE_ROTATION || scene_rotates(a));
}

static int put_masses(model_words *w, const scene *s, const element_type *type,
                      const double options[])
{
    int count = 0;
    for (int i = 0; i < s->analyses; i++) {
        const scene_analysis *a = &s->analysis[i];
        const int motion = a->kind == SCENE_MOTION && !features_spreads(s, i, type, options);
        if (!motion && !is_lumped(s, a))
            continue;
        model_words_put(w, "%smass%s of %s",
                        count++ > 0   ? ", "
                        : w->used > 0 ? "; "
                                      : "",
                        motion ? requirement_of(s, scene_motion_of(a)) : "",
                        scene_called(s, SCENE_ANALYSES, i).text);
    }
    return count;
}

static void put_foundations(model_words *w, const scene *s)
{
    int count = 0;
    for (int i = 0; i < s->members; i++)
        if (scene_is_founded(&s->member[i]) && ++count <= MOST_NAMES)
            model_words_put(w, "%s%s",
                            count > 1     ? ", "
                            : w->used > 0 ? "; foundation of "
                                          : "foundation of ",
                            scene_called(s, SCENE_MEMBERS, i).text);
    if (count > MOST_NAMES)
        model_words_put(w, " and %d more", count - MOST_NAMES);
    if (count > 0)
        model_words_put(
            w, ": springs at the nodes, weighted along each member; order 4 in bending for 6 or "
               "more elements, order 2 for fewer; internal forces jump at the nodes");
}

void on_nodes(const scene *s, const element_type *type, const double options[], char *text,
              size_t room)
{
    model_words w = {text, room, 0};
    text[0] = '\0';
    put_loads(&w, s);
    if (w.used > 0)
        model_words_put(&w, ": half of an element's load at each of its nodes; order 2 in the "
                            "length of the element (more than two nodes: weights that integrate "
                            "the polynomial through them; order 4 or more)");
    if (is_heavy(s) && put_masses(&w, s, type, options) > 0)
        model_words_put(&w, ": at the nodes, weighted along each member; order 4 in slender "
                            "bending for 6 or more elements, order 2 with shear, stretch and twist "
                            "(more than two nodes: weights that integrate the polynomial through "
                            "them; order 4 or more)");
    put_foundations(&w, s);
}

enum { HELD, SHARED, FREE, STATES };
enum { ENDS_MOST_NAMES = 8 };

typedef struct ends_tally {
    int of[STATES], all;
} ends_tally;

typedef struct held_ends {
    const scene *scene;
    ends_tally *node;
} held_ends;

static int warp_of(const scene *s, int member, int end)
{
    return end == 0 ? s->member[member].warp_p : s->member[member].warp_q;
}

static int warps(const scene *s, int member, int end)
{
    const scene_member *m = &s->member[member];
    section c;
    return scene_constants(s, end == 0 ? m->section : m->section_q, &c, NULL) == STATUS_OK &&
           c.Iw > 0;
}

/* Returns HELD, SHARED or FREE; STATES: the section at this end does not warp. */
static int state_of(const held_ends *e, int member, int end)
{
    const int warp = warp_of(e->scene, member, end);
    if (!warps(e->scene, member, end))
        return STATES;
    return warp == SCENE_WARP_FIXED ? HELD : warp >= 0 ? SHARED : FREE;
}

typedef struct ends_words {
    char *text;
    size_t room, used;
    int names;
} ends_words;

static void ends_put(ends_words *w, const char *before, const char *text)
{
    if (w->used < w->room)
        w->used += (size_t)snprintf(w->text + w->used, w->room - w->used, "%s%s", before, text);
}

static void add(ends_words *w, const char *text)
{
    if (w->names > 0 && w->names < ENDS_MOST_NAMES)
        ends_put(w, ", ", text);
    else if (w->names == 0)
        ends_put(w, "", text);
    w->names++;
}

static void add_node(const held_ends *e, int node, int state, ends_words *out)
{
    const scene *s = e->scene;
    const scene_words where = scene_name(s, SCENE_NODES, node);
    if (e->node[node].of[state] == e->node[node].all) {
        add(out, where.text);
        return;
    }
    for (int i = 0; i < 2 * s->members; i++) {
        char text[2 * sizeof where.text + 8];
        const scene_member *m = &s->member[i / 2];
        if ((i % 2 == 0 ? m->p : m->q) != node || state_of(e, i / 2, i % 2) != state)
            continue;
        snprintf(text, sizeof text, "%s at %s", scene_name(s, SCENE_MEMBERS, i / 2).text,
                 where.text);
        add(out, text);
    }
}

static void write_ends(const held_ends *e, ends_words *out)
{
    static const char *const word[STATES] = {"held at ", "shared at ", "free at "};
    for (int state = 0; state < STATES; state++) {
        char more[40];
        int any = 0;
        for (int i = 0; i < e->scene->nodes; i++)
            any |= e->node[i].of[state] > 0;
        if (!any)
            continue;
        ends_put(out, out->used > 0 ? "; " : "", word[state]);
        out->names = 0;
        for (int i = 0; i < e->scene->nodes; i++)
            if (e->node[i].of[state] > 0)
                add_node(e, i, state, out);
        snprintf(more, sizeof more, " and %d more", out->names - ENDS_MOST_NAMES);
        if (out->names > ENDS_MOST_NAMES)
            ends_put(out, "", more);
    }
}

void warping_ends(const scene *s, char *text, size_t room)
{
    held_ends e = {s, NULL};
    ends_words out = {text, room, 0, 0};
    text[0] = '\0';
    if (!(features_needed(s) & FEATURE_WARPING))
        return;
    e.node = calloc((size_t)s->nodes + 1, sizeof *e.node);
    if (e.node == NULL)
        return;
    for (int i = 0; i < 2 * s->members; i++) {
        const scene_member *m = &s->member[i / 2];
        const int node = i % 2 == 0 ? m->p : m->q, state = state_of(&e, i / 2, i % 2);
        if (node < 0 || node >= s->nodes)
            continue; /* scene_validate reports it */
        e.node[node].all += warps(s, i / 2, i % 2);
        if (state < STATES)
            e.node[node].of[state]++;
    }
    write_ends(&e, &out);
    free(e.node);
}
