#include "harness/tools/kit/scenes.h"

#include <gsl/gsl_test.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "harness/formulations/formulations.h"

const char *const scenes_integrator[] = {"alpha", "conserving", "radau", "explicit"};

enum { MOST_FILES = 8 };
static struct {
    scene_file *file[MOST_FILES];
    int count;
} known;

static void free_scenes(void)
{
    while (known.count > 0)
        scene_file_free(known.file[--known.count]);
}

static void end(const char *path, const char *why)
{
    gsl_test(1, "%s: %s", path, why);
    exit(gsl_test_summary());
}

static const case_type *read_file(const char *path)
{
    mistakes m;
    fault f = {""};
    if (known.count == MOST_FILES)
        end(path, "more files than MOST_FILES");
    if (scene_file_read_form(path, &known.file[known.count], &m, &f) != STATUS_OK) {
        mistakes_print(&m, stderr);
        end(path, f.text);
    }
    if (known.count == 0)
        atexit(free_scenes);
    return scene_file_case(known.file[known.count++]);
}

const case_type *scenes_case(const char *path)
{
    for (int i = 0; i < known.count; i++) {
        const case_type *type = scene_file_case(known.file[i]);
        if (strcmp(type->file, path) == 0)
            return type;
    }
    return read_file(path);
}

__attribute__((format(printf, 3, 0))) static void parse(const case_type *type, double value[],
                                                        const char *values, va_list list)
{
    char text[PARAMETERS_TEXT];
    fault f = {""};
    if (vsnprintf(text, sizeof text, values, list) >= (int)sizeof text)
        end(type->file, "the parameter values have more than PARAMETERS_TEXT characters");
    parameters_default(type, value);
    if (parameters_parse(type, text, value, NULL, &f) != STATUS_OK)
        end(type->file, f.text);
}

void scenes_at(const case_type *type, double value[], const char *values, ...)
{
    va_list list;
    va_start(list, values);
    parse(type, value, values, list);
    va_end(list);
}

__attribute__((format(printf, 3, 0))) static void build(scene *s, const char *path,
                                                        const char *values, va_list list)
{
    const case_type *type = scenes_case(path);
    double value[CASE_MAX_PARAMETERS];
    fault f = {""};
    parse(type, value, values, list);
    scene_init(s, type->name);
    if (case_build(type, value, s, &f) != STATUS_OK)
        end(path, f.text);
}

void scenes_read(scene *s, const char *path, const char *values, ...)
{
    va_list list;
    va_start(list, values);
    build(s, path, values, list);
    va_end(list);
}

void scenes_ask(const char *path, const element_type *e, int elements, answer *a,
                const char *values, ...)
{
    scene s;
    va_list list;
    va_start(list, values);
    build(&s, path, values, list);
    va_end(list);
    ask_scene(&s, e, NULL, elements, a);
    scene_free(&s);
}

void scenes_solve(const char *path, const char *chosen, int elements, cell_result *r,
                  const char *values, ...)
{
    cell_request request = cells_of(scenes_case(path), chosen, elements);
    fault f = {""};
    va_list list;
    va_start(list, values);
    parse(request.type, request.parameter, values, list);
    va_end(list);
    gsl_test(cell_run(&request, r, &f) != STATUS_OK, "%s solved: %s", chosen, f.text);
}

int scenes_find(const scene *s, scene_list list, const char *name)
{
    for (int i = 0; i < scene_count(s, list); i++)
        if (strcmp(scene_own_name(s, list, i), name) == 0)
            return i;
    end(name, "the scene has no entry with this name");
    return SCENE_NONE;
}

section_spec timed_profile(const timed_section *of)
{
    const double stiffness[6] = {of->EA, of->GA, of->GA, of->GJ, of->EI, of->EI},
                 mass[6] = {of->mass, of->mass, of->mass, of->polar, of->rotary, of->rotary};
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    for (int i = 0; i < 6; i++) {
        spec.constants.stiffness[7 * i] = stiffness[i];
        spec.constants.mass[7 * i] = mass[i];
    }
    return spec;
}

int scenes_cantilever(scene *s, const section_spec *spec)
{
    const double y_axis[3] = {0, 1, 0};
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, 1, 0, 0);
    scene_hold_all(s, root);
    scene_add_member(s, root, tip, scene_add_section(s, spec), y_axis);
    return tip;
}

void scenes_ask_frequencies(scene *s, const char *name, int analysis, int count)
{
    for (int i = 0; i < count; i++) {
        char text[SCENE_NAME];
        snprintf(text, sizeof text, "%s_%d", name, i);
        scene_add_quantity(s, text, "Hz", analysis, scene_frequency(i, SCENE_ANY));
    }
}

void scenes_ask_motion(scene *s, const char *name, int analysis, int node)
{
    for (int i = 0; i < 3; i++) {
        char text[SCENE_NAME];
        snprintf(text, sizeof text, "%s_%d", name, i);
        scene_add_quantity(s, text, "m", analysis, scene_coordinate(node, i));
    }
}
