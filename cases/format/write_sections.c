/* Sections of a scene file: by their constants, walls or sizes. */
#include <math.h>

#include "cases/format/write_impl.h"

/* Zero where nothing else is said, and nothing was. */
static void write_unless_zero(writer *w, const section_spec *spec, section_zero what,
                              const char *key, double value)
{
    write_values_if(w, key, value, spec->zeros & (unsigned)what ? NAN : 0);
}

static void write_constants(writer *w, const section_spec *spec)
{
    const section *c = &spec->constants;
    fputs("constants: {A: ", w->to);
    write_values_number(w, c->A);
    const struct {
        const char *key;
        double value;
    } needed[] = {{"Iy", c->Iy}, {"Iz", c->Iz}, {"It", c->It}, {"Ip", c->Ip}};
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++)
        write_values_if(w, needed[i].key, needed[i].value, NAN);
    write_unless_zero(w, spec, SECTION_ZERO_WARPING, "Iw", c->Iw);
    write_values_if(w, "ys", c->ys, 0);
    write_values_if(w, "zs", c->zs, 0);
    write_unless_zero(w, spec, SECTION_ZERO_WAGNER_Y, "wagner_y", c->wagner_y);
    write_unless_zero(w, spec, SECTION_ZERO_WAGNER_Z, "wagner_z", c->wagner_z);
    write_unless_zero(w, spec, SECTION_ZERO_WAGNER_TORQUE, "wagner_torque", c->wagner_torque);
    /* which of the two is taken: see section_compute */
    const int by_D = c->F[0] == 0 && c->D[0] != 0;
    if (write_values_any(9, by_D ? c->D : c->F) || (spec->zeros & SECTION_ZERO_SHEAR)) {
        fputs(by_D ? ", D: " : ", F: ", w->to);
        write_values_numbers(w, 9, by_D ? c->D : c->F);
    }
    fputc('}', w->to);
}

static void write_walls(writer *w, const section_spec *spec)
{
    fputs("points: {", w->to);
    for (int i = 0; i < spec->points; i++) {
        fprintf(w->to, "%sp%d: ", i > 0 ? ", " : "", i);
        write_values_numbers(w, 2, spec->point[i]);
    }
    fputs("}, walls: [", w->to);
    for (int i = 0; i < spec->walls; i++) {
        fprintf(w->to, "%s{from: p%d, to: p%d, thickness: ", i > 0 ? ", " : "", spec->wall[i].from,
                spec->wall[i].to);
        write_values_number(w, spec->wall[i].thickness);
        fputc('}', w->to);
    }
    fputs(spec->thickness_terms ? "], thickness_terms: yes" : "]", w->to);
    write_values_if(w, "cells", spec->cells, 0);
}

static void write_rectangle(writer *w, const section_spec *spec)
{
    fputs("rectangle: {width: ", w->to);
    write_values_number(w, spec->width);
    fputs(", thickness: ", w->to);
    write_values_number(w, spec->height);
    fputc('}', w->to);
    if (write_values_any(2, spec->shear_factor)) {
        fputs(", shear_factor: ", w->to);
        write_values_numbers(w, 2, spec->shear_factor);
    }
}

static void write_tube(writer *w, const section_spec *spec)
{
    fputs("tube: {diameter: ", w->to);
    write_values_number(w, spec->diameter);
    write_values_if(w, "thickness", spec->wall_thickness, NAN);
    fputc('}', w->to);
}

static void write_given(writer *w, const section_spec *spec)
{
    const struct {
        const char *key;
        double value;
    } all[] = {{"Iw", spec->given.Iw},   {"ys", spec->given.ys},
               {"zs", spec->given.zs},   {"Dy", spec->given.Dy},
               {"Dz", spec->given.Dz},   {"Dw", spec->given.Dw},
               {"Dyz", spec->given.Dyz}, {"Dyw", spec->given.Dyw},
               {"Dzw", spec->given.Dzw}, {"It", spec->given.It},
               {"Ip", spec->given.Ip},   {"wagner_torque", spec->given.wagner_torque}};
    int count = 0;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (!isnan(all[i].value)) {
            fprintf(w->to, "%s%s: ", count++ == 0 ? ", given: {" : ", ", all[i].key);
            write_values_number(w, all[i].value);
        }
    fputs(count > 0 ? "}" : "", w->to);
}

static void write_matrices(writer *w, const section *c)
{
    fputs("stiffness: ", w->to);
    write_values_matrix(w, c->stiffness);
    if (write_values_any(36, c->mass)) {
        fputs(", mass: ", w->to);
        write_values_matrix(w, c->mass);
    }
}

void write_sections(writer *w)
{
    fputs("sections:\n", w->to);
    for (int i = 0; i < w->scene->sections; i++) {
        const section_spec *spec = &w->scene->section[i];
        write_values_named(w, "  ", SCENE_SECTIONS, i);
        fputs(": {", w->to);
        if (spec->kind == SECTION_MATRICES) {
            write_matrices(w, &spec->constants);
            fputs("}\n", w->to);
            continue;
        }
        if (spec->kind == SECTION_WALLS)
            write_walls(w, spec);
        else if (spec->kind == SECTION_RECTANGLE)
            write_rectangle(w, spec);
        else if (spec->kind == SECTION_TUBE)
            write_tube(w, spec);
        else
            write_constants(w, spec);
        write_given(w, spec);
        write_values_if(w, "young", spec->young, NAN);
        write_values_if(w, "shear_modulus", spec->shear_modulus, NAN);
        write_values_if(w, "density", spec->density, 0);
        fputs("}\n", w->to);
    }
}
