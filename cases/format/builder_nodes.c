#include "cases/format/format_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "elements/shared/choice.h"

/* Smaller deviations from a unit vector are round-off. */
static const double round_off = 1e-12;

/* Returns the component in the axes of the scene that is parallel to component c of the instance,
 * or SCENE_NONE if no axis is parallel. *same is 1 if the two directions are equal and 0 if they
 * are opposite. */
static int component_of(const fields *f, int c, int *same)
{
    double axis[3] = {0};
    int along = SCENE_NONE, others = 0;
    axis[c % 3] = 1;
    placement_turn(f->placed, axis);
    for (int k = 0; k < 3; k++)
        if (fabs(axis[k]) > round_off) {
            others += along != SCENE_NONE;
            along = k;
        }
    *same = along != SCENE_NONE && axis[along] > 0;
    return others > 0 || along == SCENE_NONE ? SCENE_NONE : c - c % 3 + along;
}

static const char held_choices[] = "all|ux|uy|uz|rx|ry|rz";

/* Returns 1 if the axes of the node are given in the file, or if the node belongs to a rotated
 * instance and its fixed or prescribed translations are not along the axes of the scene. In the
 * latter case, sets the axes to those of the instance. */
static int has_axes(const fields *f, scene_node *n)
{
    const unsigned held = fields_words(f, "hold", held_choices);
    int same = 1;
    if (fields_have(f, "axes"))
        return 1;
    if (f->placed == NULL || !f->placed->turned || fields_have(f, "rotation"))
        return 0;
    for (int c = SCENE_UX; c <= SCENE_UZ && same; c++)
        if (component_of(f, c, &same) == SCENE_NONE)
            same = 0;
        else
            same |= !fields_have(f, "drive");
    if (same || (!(held & ~1u) && !fields_have(f, "drive")))
        return 0;
    n->axes[0][0] = n->axes[1][1] = 1;
    placement_turn(f->placed, n->axes[0]);
    placement_turn(f->placed, n->axes[1]);
    return 1;
}

static void read_hold(const fields *f, int node, int own)
{
    const unsigned held = fields_words(f, "hold", held_choices);
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        int same;
        const int ours = held & 1u || own ? c : component_of(f, c, &same);
        if (held & 1u || held >> (c + 1) & 1u)
            scene_hold(f->b->scene, node, ours, ours);
    }
}

static void read_directions(const fields *axes, scene_node *n)
{
    double z[3] = {0};
    const int x = fields_have(axes, "x"), y = fields_have(axes, "y");
    if (fields_vector(axes, "z", 3, z))
        placement_turn(axes->placed, z);
    if (x + y + fields_have(axes, "z") != 2) {
        document_mistake(axes->b->mistakes, axes->place, 0,
                         "axes: give two of x, y and z, or a member");
        return;
    }
    if (!x)
        vec3_cross(n->axes[1], z, n->axes[0]);
    if (!y)
        vec3_cross(z, n->axes[0], n->axes[1]);
    const double *a = x ? n->axes[0] : n->axes[1], *b = x && y ? n->axes[1] : z,
                 lengths = vec3_norm(a) * vec3_norm(b);
    if (!(lengths > 0 && fabs(vec3_dot(a, b)) <= 1e-9 * lengths))
        mistake_axes(axes->b->mistakes, axes->place);
}

static void read_member_axes(const fields *axes, int node, scene_node *n)
{
    const document_node *name = document_find(axes->map, "member");
    const int member = fields_entry_of(axes, name, SCENE_MEMBERS);
    if (member < 0)
        return;
    const scene *s = axes->b->scene;
    const scene_member *m = &s->member[member];
    double R[9], chord[3];
    if (m->p != node && m->q != node) {
        document_mistake(axes->b->mistakes, name, 0,
                         "axes: neither end of member '%.40s' is at this node; name a member with "
                         "an end at this node",
                         name->text);
        return;
    }
    if (vec3_norm(m->curvature) > 0) {
        document_mistake(axes->b->mistakes, name, 0,
                         "axes: member '%.40s' is curved; give directions, as {x: [...], y: "
                         "[...]}",
                         name->text);
        return;
    }
    scene_chord(s, member, chord);
    if (rotation_triad(chord, m->y_axis, R) != 0)
        return;
    for (int i = 0; i < 3; i++) {
        n->axes[0][i] = R[3 * i];
        n->axes[1][i] = R[3 * i + 1];
    }
}

static void turn_about_axes(const fields *f, scene_node *n)
{
    double R[9];
    int moving = 0, which = 0, driven = 0;
    if (n->rotation != SCENE_ROTATION_SPATIAL || !scene_node_axes(n, R))
        return;
    for (int k = 0; k < 3; k++) {
        driven += n->angle[k] >= 0;
        if (n->angle[k] == SCENE_HELD)
            continue;
        moving++;
        which = k;
    }
    if (moving == 0 || (moving == 3 && driven == 0))
        return;
    if (moving > 1) {
        document_mistake(
            f->b->mistakes, f->place, 0,
            "in rotated axes, at most one rotation may be free or prescribed, or all three free; "
            "for other "
            "combinations, write rotation: {sequence: [{axis: [...], angle: free}, ...]}");
        return;
    }
    n->rotation = SCENE_ROTATION_SEQUENCE;
    for (int i = 0; i < 3; i++)
        n->axis[0][i] = R[3 * i + which];
    n->angle[0] = n->angle[which];
    n->angle[1] = n->angle[2] = SCENE_FREE;
}

void builder_axes(builder *b)
{
    for (int i = 0; i < b->list[SCENE_NODES].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_NODES].entry[i]),
                     axes = fields_below(&f, "axes");
        scene_node *n = scene_node_at(b->scene, i);
        if (b->mistakes->count > 0)
            return;
        if (fields_have(&axes, "member"))
            read_member_axes(&axes, i, n);
        else if (axes.map != NULL)
            read_directions(&axes, n);
        turn_about_axes(&f, n);
    }
}

static void read_drive(const fields *f, int node, int own)
{
    static const char *const component[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
    const fields drive = fields_below(f, "drive");
    const scene_node *n = scene_node_at(f->b->scene, node);
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        const int motion = fields_entry(&drive, component[c], SCENE_DRIVERS);
        int same;
        const int ours = own ? c : component_of(f, c, &same);
        if (motion < 0)
            continue;
        if ((ours < SCENE_RX ? n->translation[ours] : n->angle[ours - SCENE_RX]) == SCENE_HELD)
            document_mistake(f->b->mistakes, document_find(drive.map, component[c]), 0,
                             "'hold' and 'drive' both contain %s; remove it from one of them",
                             component[c]);
        scene_drive(f->b->scene, node, ours, motion);
    }
}

static int angle_of(const fields *f, const document_node *n)
{
    if (n->kind == DOCUMENT_TEXT && strcmp(n->text, "free") == 0)
        return SCENE_FREE;
    if (n->kind == DOCUMENT_TEXT && strcmp(n->text, "held") == 0)
        return SCENE_HELD;
    return fields_entry_of(f, n, SCENE_DRIVERS);
}

static void read_axis(const fields *f, double axis[3])
{
    const document_node *n = document_find(f->map, "axis");
    if (n->kind == DOCUMENT_LIST)
        expression_vector(n, 3, f->names, f->b->mistakes, axis);
    else
        axis[fields_word_of(f, n, "axis", "x|y|z", 0)] = 1;
    placement_turn(f->placed, axis);
    if (axis[0] == 0 && axis[1] == 0 && axis[2] == 0)
        document_mistake(
            f->b->mistakes, n, 0,
            "the axis is the zero vector; give x, y or z, or a vector that is not zero");
}

static void read_sequence(const fields *f, const document_node *list, scene_node *n)
{
    unrolled *turns;
    const int count = unroll_entries(list, f->names, f->b->arena, f->b->mistakes, &turns);
    if (count < 1 || count > 3) {
        document_mistake(f->b->mistakes, list, 0,
                         "the sequence has %d rotations; give one to three", count);
        return;
    }
    n->rotation = SCENE_ROTATION_SEQUENCE;
    for (int i = 0; i < count; i++) {
        const fields turn = fields_of(f->b, &turns[i]);
        read_axis(&turn, n->axis[i]);
        n->angle[i] = angle_of(&turn, document_find(turn.map, "angle"));
    }
}

static void read_rotation(const fields *f, scene_node *n)
{
    const fields rotation = fields_below(f, "rotation");
    const document_node *sequence = document_find(rotation.map, "sequence"),
                        *vector = document_find(rotation.map, "vector");
    if (sequence != NULL)
        read_sequence(&rotation, sequence, n);
    if (vector == NULL)
        return;
    if (vector->kind != DOCUMENT_LIST || vector->count != 3) {
        document_mistake(f->b->mistakes, vector, 0, "vector: three motions are expected");
        return;
    }
    n->rotation = SCENE_ROTATION_VECTOR;
    for (int i = 0; i < 3; i++)
        n->angle[i] = fields_entry_of(&rotation, vector->item[i], SCENE_DRIVERS);
}

static void check_masters(const fields *f, const scene_node *n)
{
    const int held =
        n->angle[0] != SCENE_FREE || n->angle[1] != SCENE_FREE || n->angle[2] != SCENE_FREE;
    const document_node *rotation = document_find(f->map, "rotation");
    if (document_find(rotation, "vector") != NULL && f->placed != NULL && f->placed->turned)
        document_mistake(f->b->mistakes, rotation, 0,
                         "rotation: a rotation vector is given along the axes of the scene, but "
                         "this part is rotated; use a node of the scene, and connect it to the "
                         "part");
    if (rotation != NULL && (held || fields_have(f, "fork")))
        document_mistake(f->b->mistakes, rotation, 0,
                         "'rotation' defines all three rotations; remove rx, ry and rz from 'hold' "
                         "and 'drive', and remove 'fork'");
}

/* Rotates the inertia tensor of a body with its instance, I <- A I A^T. */
static void turn_inertia(const placement *placed, double I[6])
{
    double row[3][3] = {{I[0], I[3], I[5]}, {I[3], I[1], I[4]}, {I[5], I[4], I[2]}};
    if (placed == NULL)
        return;
    for (int pass = 0; pass < 2; pass++) {
        double column[3][3];
        for (int i = 0; i < 3; i++)
            placement_turn(placed, row[i]);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                column[i][j] = row[j][i];
        memcpy(row, column, sizeof row);
    }
    const double turned[6] = {row[0][0], row[1][1], row[2][2], row[0][1], row[1][2], row[2][0]};
    memcpy(I, turned, sizeof turned);
}

void builder_nodes(builder *b)
{
    for (int i = 0; i < b->list[SCENE_NODES].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_NODES].entry[i]);
        const int node = scene_add_node(b->scene, 0, 0, 0);
        scene_node *n = scene_node_at(b->scene, node);
        builder_call(b, SCENE_NODES, node, i);
        fields_read(&f, entry_node, n);
        turn_inertia(f.placed, n->body.inertia);
        const int own = has_axes(&f, n);
        read_hold(&f, node, own);
        read_drive(&f, node, own);
        check_masters(&f, n);
        read_rotation(&f, n);
    }
}

static int point_of(const fields *wall, const char *key, const document_node *points)
{
    const document_node *name = document_find(wall->map, key);
    if (points != NULL)
        for (int i = 0; i < points->count; i++)
            if (strcmp(points->key[i]->text, name->text) == 0)
                return i;
    char known[FAULT_TEXT] = "";
    if (points != NULL)
        for (int i = 0, used = 0; i < points->count && used < 100; i++)
            used += snprintf(known + used, sizeof known - (size_t)used, "%s%.20s",
                             i > 0 ? ", " : "", points->key[i]->text);
    document_mistake(wall->b->mistakes, name, 0,
                     "the section has no point '%.40s'; its points are: %s", name->text,
                     known[0] != '\0' ? known : "none; add points: {NAME: [y, z]}");
    return -1;
}

static void read_walls(const fields *f, section_spec *spec)
{
    const document_node *points = document_find(f->map, "points");
    unrolled *walls;
    const int count = unroll_entries(document_find(f->map, "walls"), f->names, f->b->arena,
                                     f->b->mistakes, &walls);
    spec->kind = SECTION_WALLS;
    spec->points = points != NULL ? points->count : 0;
    spec->walls = count;
    if (spec->points > SECTION_MAX_POINTS || count > SECTION_MAX_WALLS || count == 0) {
        document_mistake(f->b->mistakes, f->place, 0,
                         "number of walls: %d, number of points: %d; give 1 to %d walls and 2 to "
                         "%d points",
                         count, spec->points, SECTION_MAX_WALLS, SECTION_MAX_POINTS);
        spec->points = spec->walls = 0;
        return;
    }
    for (int i = 0; i < spec->points; i++)
        expression_vector(points->item[i], 2, f->names, f->b->mistakes, spec->point[i]);
    for (int i = 0; i < count; i++) {
        const fields wall = fields_of(f->b, &walls[i]);
        spec->wall[i].from = point_of(&wall, "from", points);
        spec->wall[i].to = point_of(&wall, "to", points);
        spec->wall[i].thickness = fields_number(&wall, "thickness", 1);
    }
}

static void read_shear_factor(const fields *f, section_spec *spec)
{
    const document_node *k = document_find(f->map, "shear_factor");
    if (k != NULL && k->kind == DOCUMENT_LIST)
        expression_vector(k, 2, f->names, f->b->mistakes, spec->shear_factor);
    else
        spec->shear_factor[0] = spec->shear_factor[1] = fields_number(f, "shear_factor", 0);
}

static int are_zero(int count, const double value[])
{
    int i = 0;
    while (i < count && value[i] == 0)
        i++;
    return i == count;
}

static void read_rest(const fields *f, section_spec *spec)
{
    const fields those = fields_below(f, "constants");
    section *c = &spec->constants;
    if (!fields_have(&those, "Ip"))
        c->Ip = c->Iy + c->Iz;
    if ((fields_vector(&those, "D", 9, c->D) && are_zero(9, c->D)) ||
        (fields_vector(&those, "F", 9, c->F) && are_zero(9, c->F)))
        spec->zeros |= SECTION_ZERO_SHEAR;
}

static void read_matrices(const fields *f, section_spec *spec)
{
    spec->kind = SECTION_MATRICES;
    fields_matrix(f, "stiffness", spec->constants.stiffness);
    fields_matrix(f, "mass", spec->constants.mass);
}

static void check_material(const fields *f)
{
    static const struct {
        const char *key, *about;
    } material[] = {{"young", "modulus of elasticity"}, {"shear_modulus", "E/(2 (1 + nu))"}},
      other[] = {{"young", ""}, {"shear_modulus", ""}, {"density", ""}, {"given", ""}};
    mistakes *m = f->b->mistakes;
    if (!fields_have(f, "stiffness")) {
        for (size_t i = 0; i < sizeof material / sizeof material[0]; i++)
            if (!fields_have(f, material[i].key))
                document_mistake(m, f->place, 0, "%.40s: '%s' is missing (%s)", f->place->text,
                                 material[i].key, material[i].about);
        if (fields_have(f, "mass"))
            document_mistake(m, document_find(f->map, "mass"), 0,
                             "mass: a mass matrix requires 'stiffness'; add it, or give 'density' "
                             "instead of 'mass'");
        return;
    }
    for (size_t i = 0; i < sizeof other / sizeof other[0]; i++)
        if (fields_have(f, other[i].key))
            document_mistake(
                m, document_find(f->map, other[i].key), 0,
                "'%s' does not apply to a section that is given by its stiffness matrix; remove it",
                other[i].key);
}

void builder_sections(builder *b)
{
    for (int i = 0; i < b->list[SCENE_SECTIONS].count; i++) {
        const unrolled *entry = &b->list[SCENE_SECTIONS].entry[i];
        const fields f = fields_of(b, entry);
        section_spec spec;
        section computed;
        int known = 0;
        fault why = {""};
        section_spec_init(&spec);
        check_material(&f);
        fields_read(&f, entry_section, &spec);
        if (fields_have(&f, "stiffness"))
            read_matrices(&f, &spec);
        else if (fields_have(&f, "walls"))
            read_walls(&f, &spec);
        else if (fields_have(&f, "constants"))
            read_rest(&f, &spec);
        else if (fields_have(&f, "rectangle"))
            read_shear_factor(&f, &spec);
        else
            build_shapes_read(&f, &spec);
        for (int k = 0; k < 2; k++) {
            static const char *const of_walls[] = {"points", "cells"};
            if (!fields_have(&f, "walls") && fields_have(&f, of_walls[k]))
                document_mistake(b->mistakes, document_find(f.map, of_walls[k]), 0,
                                 "%s require walls; add them, or remove the %s", of_walls[k],
                                 of_walls[k]);
        }
        if (spec.kind != SECTION_RECTANGLE && fields_have(&f, "shear_factor"))
            document_mistake(b->mistakes, document_find(f.map, "shear_factor"), 0,
                             "a shear factor applies only to a rectangle; remove it, or give Dy "
                             "and Dz in 'given'");
        if (b->mistakes->count == 0) {
            known = section_compute(&spec, &computed, &why) == STATUS_OK;
            if (!known)
                document_mistake(b->mistakes, f.place, 0, "%s", why.text);
        }
        if (spec.kind != SECTION_WALLS && fields_have(&f, "thickness_terms"))
            document_mistake(b->mistakes, document_find(f.map, "thickness_terms"), 0,
                             "thickness_terms: this key applies only to walls; remove it");
        builder_call(b, SCENE_SECTIONS, scene_add_section(b->scene, &spec), i);
        b->names = section_names_add(b->names, entry->name,
                                     known && !computed.matrices ? &computed : NULL, b->arena);
    }
}

/* Defaults of a transient analysis. The tolerances are relative to the size of the motion, and the
 * step is relative to the time of the last station. */
static const double usual_tolerance = 1e-3, usual_of_radau = 1e-5, usual_step = 1e-3;

static double between(const fields *f, const char *key, double otherwise, double least, double most,
                      const char *range)
{
    const double value = fields_number(f, key, otherwise);
    if (value >= least && value <= most)
        return value;
    document_mistake(f->b->mistakes, document_find(f->map, key), 0, "%s = %g; give %s", key, value,
                     range);
    return otherwise;
}

static scene_alpha alpha_of(const fields *f)
{
    double pair[2];
    if (fields_vector(f, "parameters", 2, pair))
        return (scene_alpha){pair[0], pair[1]};
    if (fields_have(f, "hht"))
        return (scene_alpha){0, between(f, "hht", 0, 0, 1. / 3,
                                        "the alpha of Hilber, Hughes and Taylor, from 0 to 1/3")};
    if (fields_word(f, "trapezoidal", "no|yes", 0))
        return (scene_alpha){0, 0};
    return scene_alpha_of_radius(between(f, "rho", 0.9, 0, 1, "a spectral radius from 0 to 1"));
}

static const char *const of_alpha[] = {"rho", "hht", "trapezoidal", "parameters"};

/* Returns 1 if the file selects the integrator alpha without naming it: by a parameter that only
 * alpha has, or by constant steps. */
static int has_alpha_keys(const fields *f)
{
    int requests = fields_have(f, "step") && !fields_have(f, "tolerance");
    for (int i = 0; i < 4; i++)
        requests |= fields_have(f, of_alpha[i]);
    return requests;
}

static void check_parameters(const fields *f, scene_scheme scheme)
{
    const int chosen = choice_index(SCENE_SCHEME_CHOICES, fields_text(f, "integrator", "")) < 0;
    for (int i = 0; i < 4 && scheme != SCENE_ALPHA && !chosen; i++)
        if (fields_have(f, of_alpha[i]))
            document_mistake(f->b->mistakes, document_find(f->map, of_alpha[i]), 0,
                             "'%s' applies only to the integrator alpha; remove it, or give "
                             "'integrator: alpha'",
                             of_alpha[i]);
}

static scene_scheme scheme_of(const fields *f)
{
    static const char *const set[][2] = {{"hht", "hht: 0.1"}, {"trapezoidal", "trapezoidal: yes"}};
    const char *given = fields_text(f, "integrator", "");
    for (int i = 0; i < 2; i++)
        if (strcmp(given, set[i][0]) == 0) {
            document_mistake(
                f->b->mistakes, document_find(f->map, "integrator"), 0,
                "integrator: %s is a form of alpha; write 'integrator: alpha' and '%s'", given,
                set[i][1]);
            return SCENE_ALPHA;
        }
    return (scene_scheme)fields_word(f, "integrator", SCENE_SCHEME_CHOICES,
                                     has_alpha_keys(f) ? SCENE_ALPHA : SCENE_RADAU);
}

static void read_steps(const fields *f, scene_motion *how)
{
    const int steps = fields_have(f, "step"), count = how->path.stations;
    const double last = count > 0 ? how->path.value[count - 1] : 0;
    if (!steps)
        how->step = usual_step * (last > 0 ? last : 1);
    if (!steps && !fields_have(f, "tolerance"))
        how->tolerance = how->scheme == SCENE_RADAU ? usual_of_radau : usual_tolerance;
    if (!steps && how->tolerance == 0)
        document_mistake(f->b->mistakes, document_find(f->map, "tolerance"), 0,
                         "tolerance: 0 means equal steps; give 'step' [s], or a positive "
                         "tolerance");
}

void builder_in_time(const fields *f, scene_motion *how)
{
    how->scheme = scheme_of(f);
    how->alpha = alpha_of(f);
    check_parameters(f, how->scheme);
    if (how->path.value != NULL)
        read_steps(f, how);
}
