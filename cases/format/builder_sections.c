/* Sections of a scene. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/build_shapes.h"
#include "cases/format/builder.h"
#include "cases/format/expression.h"
#include "cases/format/section_names.h"

/* Index of a point that a wall names; -1 after a mistake. */
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
    spec->thickness_terms = fields_word(f, "thickness_terms", "no|yes", 0);
    spec->cells = fields_whole(f, "cells", 0, 0, SECTION_MAX_WALLS);
    spec->points = points != NULL ? points->count : 0;
    spec->walls = count;
    if (spec->points > SECTION_MAX_POINTS || count > SECTION_MAX_WALLS || count == 0) {
        document_mistake(f->b->mistakes, f->place, 0,
                         "%d points and %d walls; give 1 to %d of each", spec->points, count,
                         SECTION_MAX_WALLS);
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

static void read_rectangle(const fields *f, section_spec *spec)
{
    const fields sizes = fields_below(f, "rectangle");
    const document_node *k = document_find(f->map, "shear_factor");
    spec->kind = SECTION_RECTANGLE;
    spec->width = fields_number(&sizes, "width", 1);
    spec->height = fields_number(&sizes, "thickness", 1);
    if (k != NULL && k->kind == DOCUMENT_LIST)
        expression_vector(k, 2, f->names, f->b->mistakes, spec->shear_factor);
    else
        spec->shear_factor[0] = spec->shear_factor[1] = fields_number(f, "shear_factor", 0);
}

static void read_tube(const fields *f, section_spec *spec)
{
    const fields sizes = fields_below(f, "tube");
    spec->kind = SECTION_TUBE;
    spec->diameter = fields_number(&sizes, "diameter", 1);
    spec->wall_thickness = fields_number(&sizes, "thickness", 1);
}

static int are_zero(int count, const double value[])
{
    int i = 0;
    while (i < count && value[i] == 0)
        i++;
    return i == count;
}

static void read_constants(const fields *f, section_spec *spec)
{
    const fields those = fields_below(f, "constants");
    section *c = &spec->constants;
    spec->kind = SECTION_CONSTANTS;
    c->A = fields_number(&those, "A", 1);
    c->Iy = fields_number(&those, "Iy", 1);
    c->Iz = fields_number(&those, "Iz", 1);
    c->It = fields_number(&those, "It", 1);
    c->Iw = fields_number(&those, "Iw", 0);
    c->Ip = fields_number(&those, "Ip", c->Iy + c->Iz);
    c->ys = fields_number(&those, "ys", 0);
    c->zs = fields_number(&those, "zs", 0);
    c->wagner_y = fields_number(&those, "wagner_y", 0);
    c->wagner_z = fields_number(&those, "wagner_z", 0);
    c->wagner_torque = fields_number(&those, "wagner_torque", 0);
    fields_vector(&those, "D", 9, c->D);
    fields_vector(&those, "F", 9, c->F);
    const struct {
        const char *key;
        section_zero what;
        const double *value;
        int count;
    } all[] = {{"D", SECTION_ZERO_SHEAR, c->D, 9},
               {"F", SECTION_ZERO_SHEAR, c->F, 9},
               {"Iw", SECTION_ZERO_WARPING, &c->Iw, 1},
               {"wagner_y", SECTION_ZERO_WAGNER_Y, &c->wagner_y, 1},
               {"wagner_z", SECTION_ZERO_WAGNER_Z, &c->wagner_z, 1},
               {"wagner_torque", SECTION_ZERO_WAGNER_TORQUE, &c->wagner_torque, 1}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (fields_have(&those, all[i].key) && are_zero(all[i].count, all[i].value))
            spec->zeros |= all[i].what;
}

static void read_given(const fields *f, section_spec *spec)
{
    const fields given = fields_below(f, "given");
    const struct {
        const char *key;
        double *value;
    } all[] = {{"Iw", &spec->given.Iw},   {"ys", &spec->given.ys},
               {"zs", &spec->given.zs},   {"Dy", &spec->given.Dy},
               {"Dz", &spec->given.Dz},   {"Dw", &spec->given.Dw},
               {"Dyz", &spec->given.Dyz}, {"Dyw", &spec->given.Dyw},
               {"Dzw", &spec->given.Dzw}, {"It", &spec->given.It},
               {"Ip", &spec->given.Ip},   {"wagner_torque", &spec->given.wagner_torque}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        *all[i].value = fields_number(&given, all[i].key, NAN);
}

/* 36 numbers, or six of the diagonal. */
static void read_matrix(const fields *f, const char *key, double out[36])
{
    double *given;
    const int count = fields_values(f, key, &given);
    if (count == 36)
        memcpy(out, given, 36 * sizeof *out);
    for (int k = 0; k < 6 && count == 6; k++)
        out[7 * k] = given[k];
    if (fields_have(f, key) && count != 6 && count != 36)
        document_mistake(f->b->mistakes, document_find(f->map, key), 0,
                         "%s: %d numbers; give the 36 of a matrix, or the six of its diagonal", key,
                         count);
}

static void read_matrices(const fields *f, section_spec *spec)
{
    spec->kind = SECTION_MATRICES;
    read_matrix(f, "stiffness", spec->constants.stiffness);
    read_matrix(f, "mass", spec->constants.mass);
}

/* Material and overrides belong to all sections but those of matrices, and masses of their own to
 * these. */
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
                             "a mass matrix is of a section with a stiffness matrix; give a "
                             "density");
        return;
    }
    for (size_t i = 0; i < sizeof other / sizeof other[0]; i++)
        if (fields_have(f, other[i].key))
            document_mistake(m, document_find(f->map, other[i].key), 0,
                             "'%s' is not of a section by its stiffness matrix; leave it out",
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
        spec.young = fields_number(&f, "young", 1);
        spec.shear_modulus = fields_number(&f, "shear_modulus", 1);
        spec.density = fields_number(&f, "density", 0);
        if (fields_have(&f, "stiffness"))
            read_matrices(&f, &spec);
        else if (fields_have(&f, "walls"))
            read_walls(&f, &spec);
        else if (build_shapes_read(&f, &spec))
            spec.thickness_terms = fields_word(&f, "thickness_terms", "no|yes", 0);
        else if (fields_have(&f, "rectangle"))
            read_rectangle(&f, &spec);
        else if (fields_have(&f, "tube"))
            read_tube(&f, &spec);
        else
            read_constants(&f, &spec);
        read_given(&f, &spec);
        for (int k = 0; k < 2; k++) {
            static const char *const of_walls[] = {"points", "cells"};
            if (!fields_have(&f, "walls") && fields_have(&f, of_walls[k]))
                document_mistake(b->mistakes, document_find(f.map, of_walls[k]), 0,
                                 "%s are of walls; add them, or leave the %s out", of_walls[k],
                                 of_walls[k]);
        }
        if (spec.kind != SECTION_RECTANGLE && fields_have(&f, "shear_factor"))
            document_mistake(b->mistakes, document_find(f.map, "shear_factor"), 0,
                             "a shear factor is of a rectangle; leave it out, or use 'given'");
        if (b->mistakes->count == 0) {
            known = section_compute(&spec, &computed, &why) == STATUS_OK;
            if (!known)
                document_mistake(b->mistakes, f.place, 0, "%s", why.text);
        }
        if (spec.kind != SECTION_WALLS && fields_have(&f, "thickness_terms"))
            document_mistake(b->mistakes, document_find(f.map, "thickness_terms"), 0,
                             "thickness terms are of walls; leave them out");
        builder_call(b, SCENE_SECTIONS, scene_add_section(b->scene, &spec), i);
        b->names = section_names_add(b->names, entry->name,
                                     known && !computed.matrices ? &computed : NULL, b->arena);
    }
}
