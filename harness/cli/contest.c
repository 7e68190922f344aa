#include "harness/cli/contest.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/against_error.h"
#include "harness/cli/case_input.h"
#include "harness/cli/contestant.h"
#include "harness/cli/defaults.h"
#include "harness/cli/message.h"
#include "harness/records/json.h"
#include "harness/terminal/table.h"

static void show(const command_request *r, const point *p, const contestant *a, const contestant *b,
                 const against *v)
{
    if (r->format[0] != 'j') {
        table_omitted(stdout, p);
        contestant_show(a, b, v);
        return;
    }
    json_t *root = contestant_json(a, b, v);
    json_add_physics(root, p);
    json_dumpf(root, stdout, JSON_INDENT(1));
    putchar('\n');
    json_decref(root);
}

/* What both are asked for. Its scene is freed by who built it. */
static point point_of(const command_request *r, const case_type *type, const scene *s)
{
    point p = {.type = type, .scene = *s, .status = STATUS_OK};
    memcpy(p.parameter, r->parameter, sizeof p.parameter);
    return p;
}

/* Another build at equal n: both are programs, so that both start alike. The scene is freed by
 * against_meshes. */
static status against_program(const command_request *r, const case_type *type, scene *s, fault *f)
{
    contestant a, b;
    against answer;
    TRY(cell_scene(type, r->parameter, NULL, s, f));
    contestant_elsewhere(&a, r, "/proc/self/exe");
    contestant_elsewhere(&b, r, r->against);
    TRY(contestant_compete(&a, &b, &answer, f));
    const point p = point_of(r, type, s);
    show(r, &p, &a, &b, &answer);
    return STATUS_OK;
}

/* Another formulation. */
static status compete(const command_request *r, const case_type *type, scene *s, fault *f)
{
    contestant a, b;
    formulation other;
    against answer;
    TRY(formulation_parse(r->against, &other, f));
    TRY(cell_scene(type, r->parameter, NULL, s, f));
    contestant_here(&a, r, s, &r->formulation[0], r->mesh[0]);
    contestant_here(&b, r, s, &other, r->mesh[r->meshes - 1]);
    b.plant = r->plant;
    TRY(contestant_compete(&a, &b, &answer, f));
    const point p = point_of(r, type, s);
    show(r, &p, &a, &b, &answer);
    return STATUS_OK;
}

/* At given meshes: A's and B's. */
static status against_meshes(command_request *r, const case_type *type, int is_program, fault *f)
{
    scene s = {0};
    char note[DEFAULTS_NOTE];
    TRY(defaults_fill(r, type, note, NULL, f));
    if (r->format[0] == 't')
        fputs(note, stdout);
    const status outcome = (is_program ? against_program : compete)(r, type, &s, f);
    scene_free(&s);
    return outcome;
}

static status against_other(command_request *r, const case_type *type, fault *f)
{
    const int is_program = strchr(r->against, '/') != NULL;
    if (is_program && access(r->against, X_OK) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "no program %.200s; give the path of another build's beamwork",
                         r->against);
    if (is_program && (r->error != NULL || r->select != NULL))
        return fault_set(f, STATUS_REFUSED,
                         "another program is compared at equal n: leave --error and -k away");
    if (is_program && (r->plant > 0 || r->meshes > 1))
        return fault_set(f, STATUS_REFUSED,
                         "--plant and a second mesh are for another formulation "
                         "in the same program");
    if (r->meshes == 0 && !is_program)
        return against_error(r, type, f);
    if (r->error != NULL || r->select != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "--error and -k find the meshes by themselves: leave -n away");
    return against_meshes(r, type, is_program, f);
}

int contest_run(command_request *r)
{
    fault f = {""};
    if (r->case_count + r->scene_count != 1 || r->formulations > 1 || r->meshes > 2)
        return message_fail(STATUS_REFUSED, "--against compares two: give one CASE or --scene, one "
                                            "-f, and one -n or two (A's and B's) or none");
    if (r->output != NULL)
        return message_fail(STATUS_REFUSED,
                            "--against writes no file; leave -o away, or give --format json");
    if (r->format[0] == 'c')
        return message_fail(STATUS_REFUSED, "--against is written as text or json");
    const case_type *type = case_input_find(r);
    return type != NULL ? message_exit(against_other(r, type, &f), &f) : r->refusal;
}
