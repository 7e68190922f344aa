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

/* What the table does not say of constants. */
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
            document_mistake(
                m, document_find(f->map, other[i].key), 0,
                "'%s' does not apply to a section given by its stiffness matrix; remove it",
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
                                 "%s are of walls; add them, or leave the %s out", of_walls[k],
                                 of_walls[k]);
        }
        if (spec.kind != SECTION_RECTANGLE && fields_have(&f, "shear_factor"))
            document_mistake(
                b->mistakes, document_find(f.map, "shear_factor"), 0,
                "a shear factor applies to a rectangle only; remove it, or use 'given'");
        if (b->mistakes->count == 0) {
            known = section_compute(&spec, &computed, &why) == STATUS_OK;
            if (!known)
                document_mistake(b->mistakes, f.place, 0, "%s", why.text);
        }
        if (spec.kind != SECTION_WALLS && fields_have(&f, "thickness_terms"))
            document_mistake(b->mistakes, document_find(f.map, "thickness_terms"), 0,
                             "thickness terms apply to walls only; remove them");
        builder_call(b, SCENE_SECTIONS, scene_add_section(b->scene, &spec), i);
        b->names = section_names_add(b->names, entry->name,
                                     known && !computed.matrices ? &computed : NULL, b->arena);
    }
}
