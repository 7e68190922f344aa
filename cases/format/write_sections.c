/* Sections of a scene file: by their constants, walls or sizes. */
#include "cases/format/write_impl.h"

/* Which of the two is taken: see section_compute. */
static void write_shear(writer *w, const void *entry)
{
    const section_spec *spec = entry;
    const section *c = &spec->constants;
    const int by_D = c->F[0] == 0 && c->D[0] != 0;
    if (!write_values_any(9, by_D ? c->D : c->F) && !(spec->zeros & SECTION_ZERO_SHEAR))
        return;
    write_values_key(w, by_D ? "D" : "F");
    write_values_numbers(w, 9, by_D ? c->D : c->F);
}

static void write_walls(writer *w, const void *entry)
{
    const section_spec *spec = entry;
    if (spec->kind != SECTION_WALLS)
        return;
    write_values_key(w, "points");
    for (int i = 0; i < spec->points; i++) {
        fprintf(w->to, "%sp%d: ", i > 0 ? ", " : "{", i);
        write_values_numbers(w, 2, spec->point[i]);
    }
    fputs("}, walls: [", w->to);
    for (int i = 0; i < spec->walls; i++) {
        fprintf(w->to, "%s{from: p%d, to: p%d, thickness: ", i > 0 ? ", " : "", spec->wall[i].from,
                spec->wall[i].to);
        write_values_number(w, spec->wall[i].thickness);
        fputc('}', w->to);
    }
    fputc(']', w->to);
}

static void write_shear_factor(writer *w, const void *entry)
{
    const section_spec *spec = entry;
    if (spec->kind != SECTION_RECTANGLE || !write_values_any(2, spec->shear_factor))
        return;
    write_values_key(w, "shear_factor");
    write_values_numbers(w, 2, spec->shear_factor);
}

static void write_matrices(writer *w, const section *c)
{
    fputs("{stiffness: ", w->to);
    write_values_matrix(w, c->stiffness);
    if (write_values_any(36, c->mass)) {
        fputs(", mass: ", w->to);
        write_values_matrix(w, c->mass);
    }
    fputc('}', w->to);
}

void write_sections(writer *w)
{
    static const write_own own[] = {{"D", write_shear},
                                    {"points", write_walls},
                                    {"shear_factor", write_shear_factor},
                                    {NULL, NULL}};
    fputs("sections:\n", w->to);
    for (int i = 0; i < w->scene->sections; i++) {
        const section_spec *spec = &w->scene->section[i];
        write_values_named(w, "  ", SCENE_SECTIONS, i);
        fputs(": ", w->to);
        if (spec->kind == SECTION_MATRICES)
            write_matrices(w, &spec->constants);
        else
            write_entry(w, entry_section, spec, own);
        fputc('\n', w->to);
    }
}
