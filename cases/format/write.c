#include "cases/format/format_impl.h"

#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"

static void write_physics(writer *w)
{
    char words[SCENE_OMISSION_WORDS];
    scene_omission_words(w->scene->omits, words);
    if (w->scene->omits == SCENE_OMITTABLE)
        fputs("omit: all\n", w->to);
    else if (w->scene->omits != 0)
        fprintf(w->to, "omit: [%s]\n", words);
    if (w->scene->shear_theory != SCENE_SHEAR_HARINGX)
        fprintf(w->to, "shear_theory: %s\n", scene_shear_word(w->scene->shear_theory));
    if (w->scene->lumped)
        fputs("mass: lumped\n", w->to);
}

static void write_meshes(writer *w)
{
    fputs("meshes: [", w->to);
    for (int i = 0; i < w->scene->meshes; i++)
        fprintf(w->to, "%s%d", i > 0 ? ", " : "", w->scene->mesh[i]);
    fputs("]\n", w->to);
}

static void write_line(writer *w, const char *key, const char *text)
{
    if (text == NULL || text[0] == '\0')
        return;
    fprintf(w->to, "%s: ", key);
    write_values_quoted(w, text);
    fputc('\n', w->to);
}

status write_scene_refused(const char *name, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "scene %s contains a number that is not finite; give finite numbers, because "
                     "scene files cannot express others",
                     name);
}

status write_scene(FILE *to, const scene *s, const write_head *head, fault *f)
{
    writer w = {.to = to, .scene = s, .begun = 1};
    fprintf(to, "beamwork: 1\nname: %s\n", head->name);
    write_line(&w, "summary", head->summary);
    write_line(&w, "source", head->source);
    write_sections(&w);
    write_structure(&w);
    write_analyses(&w);
    write_quantities(&w);
    if (s->plane != SCENE_SPACE)
        fprintf(to, "plane: %s\n", scene_plane_name(s));
    write_physics(&w);
    write_meshes(&w);
    return w.unwritable ? write_scene_refused(head->name, f) : STATUS_OK;
}

char *write_scene_text(const scene *s, const write_head *head)
{
    char *text = NULL;
    size_t size = 0;
    fault f;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL)
        return NULL;
    const status written = s != NULL ? write_scene(to, s, head, &f) : STATUS_REFUSED;
    if (fclose(to) != 0) {
        free(text);
        return NULL;
    }
    if (written != STATUS_OK)
        text[0] = '\0';
    return text;
}

/* Returns the number of components for `hold` and `drive`: the translations and, if they are
 * spatial, the rotations. */
static int components_of(const scene_node *n)
{
    return n->rotation == SCENE_ROTATION_SPATIAL ? 6 : 3;
}

static int how_of(const scene_node *n, int c)
{
    return c < SCENE_RX ? n->translation[c] : n->angle[c - SCENE_RX];
}

static void write_hold(writer *w, const void *entry)
{
    const scene_node *n = entry;
    unsigned held = 0;
    for (int c = 0; c < components_of(n); c++)
        held |= how_of(n, c) == SCENE_HELD ? 1u << c : 0;
    if (held == 0)
        return;
    write_values_key(w, "hold");
    write_values_bits(w, ENTRY_COMPONENTS, held);
}

static void write_drive(writer *w, const void *entry)
{
    const scene_node *n = entry;
    int driven = 0;
    for (int c = 0; c < components_of(n); c++)
        if (how_of(n, c) >= 0) {
            if (driven == 0)
                write_values_key(w, "drive");
            fprintf(w->to, "%s%s: ", driven++ == 0 ? "{" : ", ", write_values_component[c]);
            write_values_motion(w, how_of(n, c));
        }
    fputs(driven > 0 ? "}" : "", w->to);
}

static void write_angle(writer *w, int how)
{
    if (how >= 0)
        write_values_motion(w, how);
    else
        fputs(how == SCENE_HELD ? "held" : "free", w->to);
}

static void write_rotation(writer *w, const void *entry)
{
    const scene_node *n = entry;
    const int vector = n->rotation == SCENE_ROTATION_VECTOR;
    if (!vector && n->rotation != SCENE_ROTATION_SEQUENCE)
        return;
    write_values_key(w, "rotation");
    fputs(vector ? "{vector: [" : "{sequence: [", w->to);
    for (int i = 0; i < 3 && (vector || write_values_any(3, n->axis[i])); i++) {
        fputs(i > 0 ? ", " : "", w->to);
        if (!vector) {
            fputs("{axis: ", w->to);
            write_values_numbers(w, 3, n->axis[i]);
            fputs(", angle: ", w->to);
        }
        write_angle(w, n->angle[i]);
        fputs(vector ? "" : "}", w->to);
    }
    fputs("]}", w->to);
}

static void write_list(writer *w, const char *key, scene_list list, const entry_field *table,
                       const write_own own[])
{
    const scene *s = w->scene;
    const struct {
        int count;
        size_t size;
        const void *first;
    } all[SCENE_LISTS] = {
        [SCENE_NODES] = {s->nodes, sizeof *s->node, s->node},
        [SCENE_MEMBERS] = {s->members, sizeof *s->member, s->member},
        [SCENE_SPRINGS] = {s->springs, sizeof *s->spring, s->spring},
        [SCENE_DRIVERS] = {s->drivers, sizeof *s->driver, s->driver},
        [SCENE_LOADS] = {s->loads, sizeof *s->load, s->load},
        [SCENE_COMBINATIONS] = {s->combinations, sizeof *s->combination, s->combination},
        [SCENE_CONSTRAINTS] = {s->constraints, sizeof *s->constraint, s->constraint},
        [SCENE_IMPERFECTIONS] = {s->imperfections, sizeof *s->imperfection, s->imperfection}};
    for (int i = 0; i < all[list].count; i++) {
        if (i == 0)
            fprintf(w->to, "%s:\n", key);
        write_values_named(w, "  ", list, i);
        fputs(": ", w->to);
        write_entry(w, table, (const char *)all[list].first + (size_t)i * all[list].size, own);
        fputc('\n', w->to);
    }
}

static void write_warp(writer *w, int warp)
{
    if (warp >= 0)
        fprintf(w->to, "{shared: w%d}", warp);
    else
        fputs(warp == SCENE_WARP_FREE ? "free" : "fixed", w->to);
}

static void write_warping(writer *w, const void *entry)
{
    const scene_member *m = entry;
    write_values_key(w, "warping");
    fputc('[', w->to);
    write_warp(w, m->warp_p);
    fputs(", ", w->to);
    write_warp(w, m->warp_q);
    fputc(']', w->to);
}

static void write_section(writer *w, const void *entry)
{
    const scene_member *m = entry;
    write_values_key(w, "section");
    write_values_named(w, scene_member_tapers(m) ? "[" : "", SCENE_SECTIONS, m->section);
    if (scene_member_tapers(m)) {
        write_values_named(w, ", ", SCENE_SECTIONS, m->section_q);
        fputc(']', w->to);
    }
}

static void write_release(writer *w, const void *entry)
{
    static const char *const end[] = {"from", "to"};
    const scene_release *release = ((const scene_member *)entry)->release;
    if (release[0].count + release[1].count == 0)
        return;
    write_values_key(w, "release");
    fputc('{', w->to);
    for (int i = 0; i < 2; i++) {
        if (release[i].count == 0)
            continue;
        fprintf(w->to, "%s%s: [", i == 1 && release[0].count > 0 ? ", " : "", end[i]);
        for (int k = 0; k < release[i].count; k++)
            fprintf(w->to, "%s%s", k > 0 ? ", " : "",
                    write_values_component[release[i].component[k]]);
        fputc(']', w->to);
    }
    fputc('}', w->to);
}

static void write_stiffness(writer *w, const void *entry)
{
    int tables = 0;
    for (int k = 0; k < 6; k++)
        tables |= ((const scene_spring *)entry)->table[k].at.stations > 0;
    if (tables && !write_values_any(36, ((const scene_spring *)entry)->stiffness))
        return;
    write_values_key(w, "stiffness");
    write_values_matrix(w, ((const scene_spring *)entry)->stiffness);
}

static void write_damping(writer *w, const void *entry)
{
    if (!scene_spring_damps(entry))
        return;
    write_values_key(w, "damping");
    write_values_matrix(w, ((const scene_spring *)entry)->damping);
}

static void write_scaled(writer *w, const char *text, double scale)
{
    if (scale == 0 || scale == 1) {
        write_values_quoted(w, text);
        return;
    }
    fprintf(w->to, "\"(%s)*%.17g\"", text, scale);
}

static void write_pieces(writer *w, const scene_function *f)
{
    if (f->pieces == 0)
        return;
    write_values_key(w, "pieces");
    fputc('[', w->to);
    for (int i = 0; i < f->pieces; i++) {
        fputs(i > 0 ? ", {" : "{", w->to);
        if (i < f->pieces - 1) {
            fputs("until: ", w->to);
            write_values_number(w, f->piece[i].until);
            fputs(", ", w->to);
        }
        fputs("is: ", w->to);
        write_scaled(w, f->piece[i].text, f->scale);
        fputc('}', w->to);
    }
    fputc(']', w->to);
}

static void write_stations(writer *w, int count, const double path[], const char *key,
                           const double value[])
{
    write_values_key(w, "path");
    write_values_numbers(w, count, path);
    write_values_key(w, key);
    write_values_numbers(w, count, value);
}

static void write_known(writer *w, const void *entry)
{
    const scene_driver *d = entry;
    if (d->value != NULL && (d->function.pieces == 0 || d->stations > 1 || d->value[0] != 0))
        write_stations(w, d->stations, d->path, "value", d->value);
    write_pieces(w, &d->function);
}

static void write_vector(writer *w, const void *entry)
{
    const scene_load *load = entry;
    if (load->kind == SCENE_TEMPERATURE || load->towards != SCENE_NONE)
        return;
    write_values_key(w, entry_of_load(load->kind)->name);
    write_values_numbers(w, 3, load->vector);
}

static void write_on(writer *w, const void *entry)
{
    const scene_load *load = entry;
    write_values_key(w, "on");
    write_values_name(w, scene_load_along(load) ? SCENE_MEMBERS : SCENE_NODES, load->where);
}

static void write_temperature(writer *w, const void *entry)
{
    const scene_load *load = entry;
    if (load->kind != SCENE_TEMPERATURE || load->elongation != 0)
        return;
    write_values_key(w, "temperature");
    write_values_number(w, load->temperature);
}

static void write_range(writer *w, const void *entry)
{
    const scene_load *load = entry;
    if (scene_load_within(load)) {
        write_values_key(w, "where");
        write_values_number(w, load->range[0]);
    } else if (scene_load_along(load)) {
        write_values_if(w, "from", load->range[0], 0);
        write_values_if(w, "to", load->range[1], 1);
    }
    if (load->varies) {
        write_values_key(w, "to_value");
        write_values_numbers(w, 3, load->last);
    }
}

static void write_factor(writer *w, const void *entry)
{
    const scene_load *load = entry;
    if (load->stations > 0)
        write_stations(w, load->stations, load->path, "factor", load->factor);
    write_pieces(w, &load->function);
}

static void write_terms(writer *w, const void *entry)
{
    const scene_combination *c = entry;
    for (int i = 0; i < c->terms; i++) {
        write_values_named(w, i > 0 ? ", " : "", SCENE_CASES, c->term[i].load_case);
        fputs(": ", w->to);
        write_values_number(w, c->term[i].factor);
    }
}

static void write_constraint(writer *w, const void *entry)
{
    const scene_constraint *c = entry;
    const int equal = c->ratio == 1, across = c->master != SCENE_NONE;
    write_values_key(w, across ? "diaphragm" : equal ? "equal" : "node");
    for (int i = 0; i < c->nodes && equal; i++)
        write_values_named(w, i > 0 ? ", " : "[", SCENE_NODES, c->node[i]);
    if (equal)
        fputc(']', w->to);
    else
        write_values_named(w, "", SCENE_NODES, c->node[1]);
    if (across) {
        write_values_key(w, "master");
        write_values_named(w, "", SCENE_NODES, c->master);
        write_values_key(w, "normal");
        fputc("xyz"[c->normal], w -> to);
        return;
    }
    write_values_key(w, equal ? "components" : "component");
    const char *before = equal ? "[" : "";
    for (int k = SCENE_UX; k <= SCENE_RZ; k++)
        if (c->components >> k & 1u) {
            fprintf(w->to, "%s%s", before, write_values_component[k]);
            before = ", ";
        }
    if (equal) {
        fputc(']', w->to);
        return;
    }
    write_values_key(w, "ratio");
    write_values_number(w, c->ratio);
    write_values_key(w, "of");
    write_values_named(w, "", SCENE_NODES, c->node[0]);
}

static void write_shifts(writer *w, const void *entry)
{
    const scene_imperfection *p = entry;
    if (p->nodes == 0)
        return;
    write_values_key(w, "shifts");
    for (int i = 0; i < p->nodes; i++) {
        write_values_named(w, i > 0 ? ", " : "{", SCENE_NODES, p->node[i]);
        fputs(": ", w->to);
        write_values_numbers(w, 3, p->shift[i]);
    }
    fputc('}', w->to);
}

void write_structure(writer *w)
{
    static const write_own node[] = {
        {"hold", write_hold}, {"drive", write_drive}, {"rotation", write_rotation}, {NULL, NULL}};
    static const write_own member[] = {{"section", write_section},
                                       {"warping", write_warping},
                                       {"release", write_release},
                                       {NULL, NULL}};
    static const write_own spring[] = {
        {"stiffness", write_stiffness}, {"damping", write_damping}, {NULL, NULL}};
    static const write_own driver[] = {{"path", write_known}, {NULL, NULL}};
    static const write_own load[] = {{"force", write_vector}, {"temperature", write_temperature},
                                     {"on", write_on},        {"where", write_range},
                                     {"path", write_factor},  {NULL, NULL}};
    static const write_own constraint[] = {{"equal", write_constraint}, {NULL, NULL}};
    static const write_own imperfection[] = {{"shifts", write_shifts}, {NULL, NULL}};
    static const write_own combination[] = {{"", write_terms}, {NULL, NULL}};
    write_list(w, "nodes", SCENE_NODES, entry_node, node);
    write_list(w, "members", SCENE_MEMBERS, entry_member, member);
    write_list(w, "springs", SCENE_SPRINGS, entry_spring, spring);
    write_list(w, "constraints", SCENE_CONSTRAINTS, entry_constraint, constraint);
    write_list(w, "imperfections", SCENE_IMPERFECTIONS, entry_imperfection, imperfection);
    write_list(w, "motions", SCENE_DRIVERS, entry_driver, driver);
    write_list(w, "loads", SCENE_LOADS, entry_load, load);
    write_list(w, "combinations", SCENE_COMBINATIONS, entry_combination, combination);
}
