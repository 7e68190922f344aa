/* A user program in C and C++. It solves a case and a scene, prints the values with all digits and
 * the documents, and misspells a name. */
#include <beamwork.h>
#include <stdio.h>
#include <string.h>

static const char leaf[] =
    "beamwork: 1\n"
    "sections:\n"
    "  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}\n"
    "nodes:\n"
    "  base: {at: [0, 0, 0], hold: all}\n"
    "  tip:  {at: [0.1, 0, 0]}\n"
    "members:\n"
    "  leaf: {from: base, to: tip, section: leaf, y: [0, 1, 0]}\n"
    "loads:\n"
    "  push: {force: [0, 1, 0], on: tip}\n";

int model_alloc(void);
int model_alloc(void)
{
    return 1;
}

static int failed(bw_status status, char **why)
{
    if (status == BW_OK)
        return 0;
    fprintf(stderr, "%s: %s\n", bw_status_name(status), *why);
    bw_free_text(*why);
    return 1;
}

static int show(const bw_scene *scene, const char *formulation, int elements)
{
    bw_result *result = NULL;
    char *why = NULL, *json = NULL;
    if (failed(bw_solve(scene, formulation, elements, NULL, &result, &why), &why))
        return 1;
    for (int i = 0; i < bw_result_quantities(result); i++) {
        const char *name = bw_result_name(result, i);
        printf("%s %.17g %s\n", name, bw_result_value(result, name), bw_result_unit(result, i));
    }
    if (failed(bw_result_json(result, &json, &why), &why))
        return 1;
    printf("%s", json);
    bw_free_text(json);
    bw_result_free(result);
    return 0;
}

int main(void)
{
    bw_scene *scene = NULL;
    char *why = NULL;
    printf("version %s\n", bw_version());
    if (failed(bw_truths(NULL, &why), &why) ||
        failed(bw_scene_case("c_column", &scene, &why), &why) || show(scene, "beamw_consistent", 4))
        return 1;
    bw_scene_free(scene);
    if (failed(bw_scene_read(leaf, strlen(leaf), "leaf", &scene, &why), &why) ||
        show(scene, NULL, 0))
        return 1;
    bw_scene_free(scene);
    if (bw_scene_case("c_colum", &scene, &why) != BW_REFUSED || scene != NULL)
        return 1;
    printf("%s\n", why);
    bw_free_text(why);
    return model_alloc() != 1;
}
