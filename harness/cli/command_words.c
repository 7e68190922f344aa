#include "harness/cli/command_words.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/newton/shapes.h"

static void add(json_t *to, const char *option, const char *value)
{
    if (value == NULL)
        return;
    if (option != NULL)
        json_array_append_new(to, json_string(option));
    json_array_append_new(to, json_string(value));
}

static void add_switch(json_t *to, const char *option, int given)
{
    if (given)
        json_array_append_new(to, json_string(option));
}

static void add_number(json_t *to, const char *option, int value)
{
    char text[16];
    snprintf(text, sizeof text, "%d", value);
    add(to, option, value > 0 ? text : NULL);
}

static void add_path(json_t *to, const char *option, const char *path, command_paths paths)
{
    char whole[PATH_MAX];
    const char *slash = path != NULL ? strrchr(path, '/') : NULL;
    if (path != NULL && paths == PATHS_ABSOLUTE && realpath(path, whole) != NULL)
        add(to, option, whole);
    else
        add(to, option,
            paths == PATHS_LEAVES && slash != NULL && slash[1] != '\0' ? slash + 1 : path);
}

static void add_paths(json_t *to, const char *option, const char *const path[], int count,
                      command_paths paths)
{
    for (int i = 0; i < count; i++)
        add_path(to, option, path[i], paths);
}

static void add_meshes(json_t *to, const command_request *r)
{
    char text[16 * COMMAND_MAX_MESHES] = "";
    size_t at = 0;
    for (int i = 0; i < r->meshes; i++)
        at += (size_t)snprintf(text + at, sizeof text - at, "%s%d", i > 0 ? "," : "", r->mesh[i]);
    add(to, "--elements", r->meshes > 0 ? text : NULL);
}

/* Objects are files, commands are not. */
static void add_elements(json_t *to, const command_request *r, command_paths paths)
{
    for (int i = 0; i < r->elements; i++)
        add_path(to, "--element", r->element[i],
                 strncmp(r->element[i], "exec:", 5) != 0 ? paths : PATHS_GIVEN);
}

static void add_files(json_t *to, const command_request *r, command_paths paths)
{
    add_elements(to, r, paths);
    add_paths(to, "--scene", r->scene_path, r->scene_count, paths);
    add_path(to, "--truths", r->truths, paths);
    add_paths(to, "--truths", r->own_truths, r->own_truths_count, paths);
    add_paths(to, "--findings", r->findings, r->findings_count, paths);
    add_paths(to, "--beside", r->beside, r->beside_count, paths);
}

/* Of a sweep over parameters. */
static void add_ranges(json_t *to, const command_request *r)
{
    for (int i = 0; i < r->varies; i++)
        add(to, "--vary", r->vary[i]);
    add(to, "--design", r->design);
    add_number(to, "--points", (int)r->points);
    if (r->seed > 0)
        add_number(to, "--seed", (int)r->seed);
    else if (r->seed == 0)
        add(to, "--seed", "0");
    add_switch(to, "--derive", r->derive);
}

json_t *command_words(const command_request *r, command_paths paths)
{
    json_t *to = json_array();
    char limit[32];
    for (int i = 0; i < r->case_count; i++)
        add(to, NULL, r->cases[i]);
    for (int i = 0; i < r->named_formulations; i++)
        add(to, "--formulation", r->named_formulation[i]);
    add_meshes(to, r);
    for (int i = 0; i < r->assignments; i++)
        add(to, "--set", r->assignment[i]);
    add(to, "--select", r->select);
    add(to, "--error", r->error);
    add_ranges(to, r);
    add_files(to, r, paths);
    add_switch(to, "--built-in", r->built_in);
    add_switch(to, "--gate", r->gate);
    add_switch(to, "--keep-all", r->keep_all);
    add_switch(to, "--dense", r->dense);
    add_number(to, "--steps", r->steps);
    add_number(to, "--doublings", r->doublings);
    add_number(to, "--threads", r->threads);
    if (r->shapes > 0)
        snprintf(limit, sizeof limit, "--shapes=%d", r->shapes < SHAPES_ALL ? r->shapes : 0);
    if (r->shapes > 0)
        json_array_append_new(to, json_string(r->shapes < SHAPES_ALL ? limit : "--shapes"));
    if (memchr(r->given, 'L', (size_t)r->given_count) != NULL) {
        snprintf(limit, sizeof limit, "%d", r->time_limit);
        add(to, "--time-limit", limit);
    }
    return to;
}
