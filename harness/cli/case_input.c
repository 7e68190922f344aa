#include "harness/cli/case_input.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/omission.h"
#include "cases/scene/unit.h"
#include "harness/cli/message.h"
#include "harness/cli/own_tables.h"
#include "harness/formulations/case_find.h"
#include "harness/formulations/parameters.h"
#include "harness/model/features.h"
#include "harness/study/cell.h"
#include "harness/study/data_place.h"
#include "harness/study/scene_truths.h"

/* All mistakes, a line each; as JSON where that is the form of the output. */
static void tell_mistakes(const command_request *r, const mistakes *m, status outcome,
                          const fault *f)
{
    fault unwritten;
    if (m->count == 0)
        message_fail(outcome, f->text);
    else if (strcmp(r->format, "json") != 0)
        mistakes_print(m, stderr);
    else if (mistakes_json(m, stdout, &unwritten) != STATUS_OK)
        message_fail(STATUS_FAULT, unwritten.text);
}

/* What stands for the `needs` of earlier versions. */
static void tell_needs(const char *path, const case_type *type)
{
    double value[CASE_MAX_PARAMETERS];
    char words[SCENE_OMISSION_WORDS], omit[SCENE_OMISSION_WORDS + 20] = "", theory[40] = "";
    scene s;
    fault f;
    parameters_default(type, value);
    scene_init(&s, type->name);
    if (case_build(type, value, &s, &f) == STATUS_OK) {
        scene_omission_words(s.omits, words);
        if (s.omits != 0)
            snprintf(omit, sizeof omit, "omit: [%s]", words);
        if (s.shear_theory != SCENE_SHEAR_HARINGX && features_sheared(&s))
            snprintf(theory, sizeof theory, "shear_theory: %s", scene_shear_word(s.shear_theory));
        fprintf(stderr, "beamwork: %s: needs is read as earlier versions did; %s %s%s%s\n", path,
                omit[0] != '\0' || theory[0] != '\0' ? "in its place write" : "leave it out", omit,
                omit[0] != '\0' && theory[0] != '\0' ? " and " : "", theory);
    }
    scene_free(&s);
}

static int tell_reading(const command_request *r, const mistakes *m, status outcome, const fault *f)
{
    if (outcome == STATUS_OK)
        return EXIT_AS_EXPECTED;
    tell_mistakes(r, m, outcome, f);
    return outcome == STATUS_FAULT ? EXIT_FAULT : EXIT_REFUSED;
}

int case_input_read(const command_request *r, const char *path, scene_file **out)
{
    mistakes m;
    fault f = {""};
    const status outcome = scene_file_read(path, out, &m, &f);
    if (outcome == STATUS_OK && scene_file_states(*out, "needs"))
        tell_needs(path, scene_file_case(*out));
    return tell_reading(r, &m, outcome, &f);
}

/* Values that are asked for count, not the defaults beside them. */
static int read_form(const command_request *r, scene_file **out)
{
    mistakes m;
    fault f = {""};
    const status outcome = scene_file_read_form(r->scene_path[0], out, &m, &f);
    if (outcome == STATUS_OK && scene_file_states(*out, "needs"))
        tell_needs(r->scene_path[0], scene_file_case(*out));
    return tell_reading(r, &m, outcome, &f);
}

static int check_values(const command_request *r)
{
    mistakes m;
    fault f = {""};
    const status outcome = scene_file_check(r->scene, r->parameter, &m, &f);
    return tell_reading(r, &m, outcome, &f);
}

const case_type *case_input_scene(command_request *r)
{
    if (r->case_name != NULL) {
        message_fail(STATUS_REFUSED, "a case and --scene: give one of them");
        return NULL;
    }
    const int code = r->assignments > 0 ? read_form(r, &r->scene)
                                        : case_input_read(r, r->scene_path[0], &r->scene);
    if (code == EXIT_AS_EXPECTED)
        return scene_file_case(r->scene);
    r->refusal = code;
    return NULL;
}

void case_input_tell_units(const scene_file *file, const double parameter[])
{
    char words[FAULT_TEXT];
    scene s;
    if (file == NULL || scene_file_states(file, "units"))
        return;
    if (cell_scene(scene_file_case(file), parameter, NULL, &s, NULL) == STATUS_OK &&
        scene_looks_foreign(&s, words))
        fprintf(stderr,
                "beamwork: warning: %s; numbers are in m, N, Pa and kg, else the scene says units: "
                "mm, N, MPa\n",
                words);
    scene_free(&s);
}

static const case_type *named_case(const command_request *r)
{
    fault f;
    if (r->case_name == NULL) {
        message_fail(STATUS_REFUSED, "which case? 'beamwork list cases' shows them");
        return NULL;
    }
    const case_type *type = case_find(r->case_name, &f);
    if (type == NULL)
        message_fail(STATUS_REFUSED, f.text);
    return type;
}

void case_input_example(command_request *r)
{
    static char found[PATH_MAX];
    static const char *const folder[] = {"cases/examples", "examples/scenes"};
    char name[PATH_MAX], path[PATH_MAX];
    fault f;
    if (r->case_name == NULL || r->scene_count > 0 || r->case_count > 1 ||
        strchr(r->case_name, '/') != NULL || case_find(r->case_name, &f) != NULL)
        return;
    for (size_t i = 0; i < sizeof folder / sizeof folder[0] && r->case_name != NULL; i++) {
        snprintf(name, sizeof name, "%s/%.100s.yaml", folder[i], r->case_name);
        if (!data_place(name, path) || realpath(path, found) == NULL)
            continue;
        r->scene_path[r->scene_count++] = found;
        r->case_name = NULL;
        r->case_count = 0;
    }
}

const case_type *case_input_find(command_request *r)
{
    fault f;
    case_input_example(r);
    const case_type *type = r->scene_count > 0 ? case_input_scene(r) : named_case(r);
    if (type == NULL)
        return NULL;
    parameters_default(type, r->parameter);
    for (int i = 0; i < r->assignments; i++)
        if (parameters_set(type, r->assignment[i], r->parameter, &f) != STATUS_OK) {
            message_fail(STATUS_REFUSED, f.text);
            return NULL;
        }
    const int code = r->scene != NULL && r->assignments > 0 ? check_values(r) : EXIT_AS_EXPECTED;
    if (code == EXIT_AS_EXPECTED) {
        case_input_tell_units(r->scene, r->parameter);
        return type;
    }
    r->refusal = code;
    return NULL;
}

void case_input_close(command_request *r)
{
    scene_file_free(r->scene);
    r->scene = NULL;
}

const char *case_input_truths_path(const command_request *r)
{
    static char found[PATH_MAX];
    if (r->truths != NULL)
        return r->truths;
    data_place_truths(found);
    return found;
}

static status add_truths(const command_request *r, truths *t, fault *f)
{
    const case_type *type = r->scene != NULL     ? scene_file_case(r->scene)
                            : r->case_count == 1 ? case_find(r->case_name, f)
                                                 : NULL;
    if (r->scene != NULL)
        truths_read_rules(case_input_truths_path(r), t, NULL); /* a scene needs none */
    if (r->scene != NULL)
        TRY(scene_truths_add(r->scene, r->parameter, t, f));
    else
        TRY(truths_read_case(case_input_truths_path(r), type, t, f));
    return own_tables_truths(r, (const case_type *const[]){type, NULL}, type, t, f);
}

status case_input_truths(const command_request *r, truths *t, fault *f)
{
    memset(t, 0, sizeof *t);
    const status outcome = add_truths(r, t, f);
    if (outcome != STATUS_OK)
        truths_free(t);
    return outcome;
}

void case_input_tell_analysis(const command_request *r, const scene *s)
{
    if (r->scene == NULL || scene_file_states(r->scene, "analyses"))
        return;
    const scene_analysis *a = &s->analysis[0];
    if (a->kind == SCENE_LINEAR) {
        fprintf(stderr, "beamwork: the scene states no analysis; this is a linear one, as "
                        "analyses: {run: {linear: {}}}\n");
        return;
    }
    const scene_path *path = scene_path_of(a);
    fprintf(stderr,
            "beamwork: the scene states no analysis; its motions are followed to their end, as "
            "analyses: {run: {static: {stations: [%g]}}}\n",
            path->value[path->stations - 1]);
}
