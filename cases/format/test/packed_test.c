/* What the build made of every scene file among the cases is what the file says: parameters, and
 * the scene bit for bit, with the names of its entries. */
#include <gsl/gsl_test.h>
#include <string.h>

#include "cases/format/format_impl.h"
#include "cases/format/test/same_scene.h"
#include "cases/scene/scene.h"
#include "harness/formulations/formulations.h"

static void compare_parameters(const char *name, const parameter_type *packed,
                               const parameter_type *read)
{
    for (; read->name != NULL && packed->name != NULL; read++, packed++) {
        gsl_test(strcmp(read->name, packed->name) != 0 || strcmp(read->unit, packed->unit) != 0 ||
                     strcmp(read->summary, packed->summary) != 0,
                 "%s: texts of %s", name, read->name);
        gsl_test(strcmp(read->choices != NULL ? read->choices : "",
                        packed->choices != NULL ? packed->choices : "") != 0,
                 "%s: choices of %s", name, read->name);
        gsl_test(!same_numbers(3, (double[]){read->value, read->min, read->max},
                               (double[]){packed->value, packed->min, packed->max}),
                 "%s: default and range of %s", name, read->name);
    }
    gsl_test(read->name != NULL || packed->name != NULL, "%s: as many parameters", name);
}

static void compare_scenes(const case_type *type, const case_type *read)
{
    scene packed, scene_read;
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    int index = 0;
    scene_init(&packed, type->name);
    scene_init(&scene_read, type->name);
    parameter_defaults(type->parameters, value);
    gsl_test(case_build(type, value, &packed, &f) != STATUS_OK ||
                 case_build(read, value, &scene_read, &f) != STATUS_OK,
             "%s: both built (%s)", type->name, f.text);
    const char *what = differing(&packed, &scene_read, &index);
    gsl_test(what != NULL, "%s: the same scene; %s %d differs", type->name,
             what != NULL ? what : "nothing", index);
    for (int i = 0; i < packed.nodes; i++)
        gsl_test_str(scene_own_name(&packed, SCENE_NODES, i),
                     scene_own_name(&scene_read, SCENE_NODES, i), "%s", type->name);
    scene_free(&packed);
    scene_free(&scene_read);
}

static void compare_file(const case_type *type)
{
    const scene_packed *packed = type->context;
    scene_file *file = NULL;
    mistakes m;
    fault f = {""};
    gsl_test(scene_file_read(packed->file, &file, &m, &f) != STATUS_OK, "%s", f.text);
    if (file == NULL)
        return;
    const case_type *read = scene_file_case(file);
    gsl_test_str(type->name, read->name, "%s", packed->file);
    gsl_test_str(type->summary, read->summary, "%s", packed->file);
    gsl_test_str(type->source, read->source, "%s", packed->file);
    compare_parameters(type->name, type->parameters[0], read->parameters[0]);
    compare_scenes(type, read);
    scene_file_free(file);
}

int main(void)
{
    int files = 0;
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (registry_cases[i]->build_from == scene_packed_build) {
            compare_file(registry_cases[i]);
            files++;
        }
    gsl_test(files < 1, "%d scene files among the cases", files);
    return gsl_test_summary();
}
