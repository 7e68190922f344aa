#include "harness/import_export/import_export.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "elements/feature.h"
#include "harness/model/model.h"

/* Converts a node of a scene file. A plain text that is a number becomes a number. */
static json_t *json_of(const document_node *n)
{
    double value;
    if (n->kind == DOCUMENT_TEXT)
        return n->inset == 0 && line_number(n->text, &value) ? json_real(value)
                                                             : json_string(n->text);
    json_t *all = n->kind == DOCUMENT_MAP ? json_object() : json_array();
    for (int i = 0; i < n->count; i++)
        if (n->kind == DOCUMENT_MAP)
            json_object_set_new(all, n->key[i]->text, json_of(n->item[i]));
        else
            json_array_append_new(all, json_of(n->item[i]));
    return all;
}

static json_t *numbers(int count, const double value[])
{
    json_t *all = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(all, json_real(value[i]));
    return all;
}

static json_t *matrix(int rows, int columns, const double value[])
{
    json_t *all = json_array();
    for (int i = 0; i < rows; i++)
        json_array_append_new(all, numbers(columns, value + (size_t)i * (size_t)columns));
    return all;
}

static status read_file(const scene_data_request *r, json_t *root, fault *f)
{
    arena memory = {0};
    mistakes m = {.file = r->head->name};
    char *text = write_scene_text(r->scene, r->head);
    if (text == NULL)
        return fault_memory(f, "a scene");
    const document_node *read = document_read(text, strlen(text), &memory, &m);
    if (read != NULL && text[0] != '\0')
        json_object_set_new(root, "scene", json_of(read));
    const status outcome =
        text[0] == '\0' ? write_scene_refused(r->head->name, f) : mistakes_status(&m, f);
    arena_free(&memory);
    free(text);
    return outcome;
}

static void add_physics(const scene *s, json_t *root)
{
    const unsigned needs = features_needed(s);
    json_t *words = json_array();
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        if (needs & bit)
            json_array_append_new(words, json_string(feature_name(bit)));
    json_object_set_new(root, "physics", words);
}

static json_t *constants_of(const section *c)
{
    const struct {
        const char *name;
        double value;
    } constant[] = {{"E", c->young},
                    {"G", c->shear_modulus},
                    {"density", c->density},
                    {"A", c->A},
                    {"Iy", c->Iy},
                    {"Iz", c->Iz},
                    {"It", c->It},
                    {"Iw", c->Iw},
                    {"ys", c->ys},
                    {"zs", c->zs},
                    {"Ip", c->Ip},
                    {"wagner_y", c->wagner_y},
                    {"wagner_z", c->wagner_z},
                    {"wagner_torque", c->wagner_torque}};
    json_t *one = json_object();
    for (size_t k = 0; k < sizeof constant / sizeof *constant; k++)
        json_object_set_new(one, constant[k].name, json_real(constant[k].value));
    json_object_set_new(one, "F", matrix(3, 3, c->F));
    if (c->matrices) {
        json_object_set_new(one, "stiffness", matrix(6, 6, c->stiffness));
        json_object_set_new(one, "mass", matrix(6, 6, c->mass));
    }
    return one;
}

enum { STATIONS = 128 }; /* intervals between the sections of a tapered member in the data */

/* Adds the sections of a tapered member at equal distances, and the angles of their principal axes.
 */
static status add_taper(const scene *s, const scene_member *m, json_t *line, fault *f)
{
    json_t *sections = json_array(), *angles = json_array();
    json_object_set_new(line, "sections", sections);
    json_object_set_new(line, "angles", angles);
    for (int i = 0; i <= STATIONS; i++) {
        section_spec spec;
        section c;
        section_taper_at(&s->section[m->section], &s->section[m->section_q], (double)i / STATIONS,
                         &spec);
        TRY(section_compute(&spec, &c, f));
        json_array_append_new(sections, constants_of(&c));
        json_array_append_new(angles, json_real(c.axes_angle));
    }
    return STATUS_OK;
}

/* Adds the axis of each member, in the order of the file: the position and the triad of the
 * principal axes at its start, and its length and curvatures. */
static status add_lines(const scene *s, json_t *root, fault *f)
{
    json_t *lines = json_array();
    json_object_set_new(root, "lines", lines);
    for (int i = 0; i < s->members; i++) {
        section constants;
        member_arc a;
        TRY(scene_constants(s, s->member[i].section, &constants, f));
        TRY(member_arc_of(s, i, constants.axes_angle, &a, f));
        json_t *line =
            json_pack("{s:o, s:o, s:f, s:o}", "start", numbers(3, a.start), "axes",
                      matrix(3, 3, a.R), "length", a.length, "curvature", numbers(3, a.k));
        json_array_append_new(lines, line);
        if (scene_member_tapers(&s->member[i]))
            TRY(add_taper(s, &s->member[i], line, f));
    }
    return STATUS_OK;
}

static status add_sections(const scene *s, json_t *root, fault *f)
{
    json_t *sections = json_array();
    json_object_set_new(root, "sections", sections);
    for (int i = 0; i < s->sections; i++) {
        section c;
        TRY(scene_constants(s, i, &c, f));
        json_array_append_new(sections, constants_of(&c));
    }
    return STATUS_OK;
}

static void add_meanings(const scene *s, json_t *root)
{
    json_t *meanings = json_object();
    for (int i = 0; i < s->quantities; i++) {
        char text[MEANING_ROOM];
        meaning_of_quantity(s, i, text, sizeof text);
        json_object_set_new(meanings, s->quantity[i].name, json_string(text));
    }
    json_object_set_new(root, "meanings", meanings);
}

static status fill(const scene_data_request *r, json_t *root, fault *f)
{
    json_object_set_new(root, "beamwork_scene", json_integer(1));
    json_object_set_new(root, "of", json_string(r->of));
    TRY(read_file(r, root, f));
    add_physics(r->scene, root);
    TRY(add_lines(r->scene, root, f));
    TRY(add_sections(r->scene, root, f));
    add_meanings(r->scene, root);
    return STATUS_OK;
}

status scene_data_write(const scene_data_request *r, FILE *to, fault *f)
{
    json_t *root = json_object();
    status outcome = fill(r, root, f);
    if (outcome == STATUS_OK && json_dumpf(root, to, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) != 0)
        outcome = fault_set(f, STATUS_FAULT, "the scene cannot be written as JSON");
    json_decref(root);
    fputc('\n', to);
    return outcome;
}
