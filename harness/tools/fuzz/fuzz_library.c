/* Uses the input as strings for a library call: the number of the call, then one or two strings
 * separated by a newline. A rejection must have a one-line reason or a list of errors in JSON. A
 * result must be JSON, or a scene that can be read again. Both must be UTF-8. */
#include <jansson.h>

#include "harness/formulations/formulations.h"
#include "harness/library/beamwork.h"
#include "harness/tools/fuzz/fuzz.h"

static const char leaf[] =
    "beamwork: 1\n"
    "sections: {s: {rectangle: {width: 0.05, thickness: 5e-4}, young: 2e11, shear_modulus: 8e10}}\n"
    "parameters: {long: {value: 0.1, unit: m, min: 0.01, max: 1, about: length}}\n"
    "nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [long, 0, 0]}}\n"
    "members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}\n"
    "loads: {f: {force: [0, 1, 0], on: b}}\n";

static int is_utf8(const char *text)
{
    json_t *one = json_string(text); /* NULL if the text is not valid UTF-8 */
    json_decref(one);
    return one != NULL;
}

static int is_json(const char *text)
{
    json_error_t error;
    json_t *root = json_loads(text, 0, &error);
    json_decref(root);
    return root != NULL;
}

static void must_report(bw_status got, const void *made, char *why)
{
    fuzz_must((got == BW_OK) == (why == NULL), "only a failure has a reason");
    fuzz_must(got != BW_OK || made != NULL, "a successful call creates an object");
    fuzz_must(got != BW_REFUSED || made == NULL, "a rejected call creates nothing");
    fuzz_must(why == NULL || is_utf8(why), "a reason is UTF-8");
    fuzz_must(why == NULL || (why[0] == '{' ? is_json(why) : strchr(why, '\n') == NULL),
              "a reason is one line or a JSON list of mistakes");
    bw_free_text(why);
}

static void must_be_json(char *text)
{
    fuzz_must(text == NULL || is_json(text), "a document is JSON");
    bw_free_text(text);
}

static bw_scene *own_scene(void)
{
    bw_scene *s = NULL;
    fuzz_must(bw_scene_read(leaf, sizeof leaf - 1, "leaf", &s, NULL) == BW_OK, "the leaf is read");
    return s;
}

static void try_solve(const char *formulation_name, const char *options)
{
    char *why = NULL, *json = NULL;
    bw_scene *s = own_scene();
    bw_result *r = NULL;
    const bw_status got = bw_solve(s, formulation_name, 1, options, &r, &why);
    must_report(got, r, why);
    if (r != NULL)
        fuzz_must(bw_result_json(r, &json, NULL) == BW_OK, "a result has a document");
    must_be_json(json);
    bw_result_free(r);
    bw_scene_free(s);
}

static void try_list(const char *name)
{
    char *why = NULL, *json = NULL;
    const bw_status got = bw_list(name, &json, &why);
    must_report(got, json, why);
    must_be_json(json);
}

static void try_set(const char *assignment)
{
    char *why = NULL, *json = NULL;
    bw_scene *s = own_scene();
    const bw_status got = bw_scene_set(s, assignment, &why);
    must_report(got, got == BW_OK ? s : NULL, why);
    fuzz_must(bw_scene_json(s, &json, NULL) == BW_OK, "a scene has a document");
    must_be_json(json);
    bw_scene_free(s);
}

static void try_converge(const char *formulations, const char *meshes)
{
    char *why = NULL, *json = NULL;
    bw_scene *s = own_scene();
    bw_status got =
        bw_converge(s, formulations, meshes, "{\"select\": \"nothing_is_called_so\"}", &json, &why);
    fuzz_must(got == BW_REFUSED, "it is refused");
    must_report(got, json, why);
    got = bw_verify(s, formulations, "nothing_is_called_so", meshes, NULL, &json, &why);
    fuzz_must(got == BW_REFUSED, "it is refused");
    must_report(got, json, why);
    bw_scene_free(s);
}

static void try_scene(const char *bytes, size_t size)
{
    char *why = NULL, *yaml = NULL, *json = NULL;
    bw_scene *s = NULL, *again = NULL;
    const bw_status got = bw_scene_read(bytes, size, NULL, &s, &why);
    must_report(got, s, why);
    if (s == NULL)
        return;
    if (bw_scene_json(s, &json, NULL) == BW_OK)
        must_be_json(json);
    if (bw_scene_write(s, &yaml, NULL) == BW_OK) {
        fuzz_must(is_utf8(yaml), "a written scene is UTF-8");
        fuzz_must(bw_scene_read(yaml, strlen(yaml), NULL, &again, NULL) == BW_OK, "and reads back");
    }
    bw_free_text(yaml);
    bw_scene_free(again);
    bw_scene_free(s);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0)
        return 0;
    char *first = fuzz_text(data + 1, size - 1), *second = strchr(first, '\n');
    if (second != NULL)
        *second++ = '\0';
    switch (data[0] % 6) {
    case 0:
        try_list(first);
        break;
    case 1:
        try_set(first);
        break;
    case 2:
        try_solve(first, second);
        break;
    case 3:
        try_solve(registry_formulations[0]->name, first);
        break;
    case 4:
        try_converge(first, second);
        break;
    default:
        try_scene((const char *)data + 1, size - 1);
    }
    free(first);
    return 0;
}
