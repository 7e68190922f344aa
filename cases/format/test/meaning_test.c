/* Every quantity of every case and example must have a unique description, which is derived from
 * the data of the scene. */
#include <dirent.h>
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format_impl.h"
#include "cases/format/test/same_scene.h"
#include "cases/scene/scene.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

enum { MOST = 128, KEY = 400, KINDS = SCENE_READING + 1 };
static int seen[KINDS], requested;

static void key_of(const char *text, const scene_quantity *q, char key[KEY])
{
    char start[SCENE_NAME + 8];
    snprintf(start, sizeof start, "\n  \"%s\": {", q->name);
    const char *found = strstr(text, start), *end = found != NULL ? strstr(found, ", unit") : NULL;
    gsl_test(end == NULL, "%s: is in the file", q->name);
    key[0] = '\0';
    if (end != NULL)
        snprintf(key, KEY, "%.*s, %.17g, %.17g", (int)(end - found - (long)strlen(start)),
                 found + strlen(start), q->factor, q->offset);
}

static void check_scene(const scene *s, const char *name)
{
    static char sentence[MOST][MEANING_ROOM], key[MOST][KEY];
    const write_head head = {"any", "", ""};
    char *text = write_scene_text(s, &head);
    gsl_test(text == NULL || text[0] == '\0', "%s: written", name);
    gsl_test(s->quantities > MOST, "%s: %d quantities", name, s->quantities);
    for (int i = 0; i < s->quantities && i < MOST; i++) {
        const size_t size = sizeof sentence[i];
        meaning_of_quantity(s, i, sentence[i], size);
        key_of(text, &s->quantity[i], key[i]);
        gsl_test(strlen(sentence[i]) < 10 || strlen(sentence[i]) == size - 1, "%s, %s: '%s'", name,
                 s->quantity[i].name, sentence[i]);
        for (int k = 0; k < i; k++)
            if ((strcmp(sentence[i], sentence[k]) == 0) != (strcmp(key[i], key[k]) == 0))
                gsl_test(1, "%s: %s and %s are told apart in a file or in words only: %s", name,
                         s->quantity[k].name, s->quantity[i].name, sentence[i]);
        seen[s->quantity[i].what.kind]++;
        requested++;
    }
    free(text);
}

static void check_cases(void)
{
    const char *path = getenv("BEAMWORK_TRUTHS");
    const sweep_request request = {.jobs = 1};
    truths t = {0};
    sweep s = {0};
    fault f = {""};
    if (truths_read(path != NULL ? path : "build/truths.h5", &t, &f) != STATUS_OK ||
        plan_sweep(&request, &t, &s, &f) != STATUS_OK)
        gsl_test(1, "%s", f.text);
    for (int i = 0; i < s.points; i++)
        if (s.point[i].status == STATUS_OK)
            check_scene(&s.point[i].scene, s.point[i].type->name);
    sweep_free(&s);
    truths_free(&t);
}

static void check_example(const char *path)
{
    scene_file *file = NULL;
    mistakes m;
    scene s;
    fault f = {""};
    double value[CASE_MAX_PARAMETERS] = {0};
    gsl_test(scene_file_read(path, &file, &m, &f) != STATUS_OK, "%s: %s", path, f.text);
    if (file == NULL)
        return;
    scene_init(&s, path);
    parameters_default(scene_file_case(file), value);
    gsl_test(case_build(scene_file_case(file), value, &s, &f) != STATUS_OK, "%s: built", path);
    check_scene(&s, path);
    scene_free(&s);
    scene_file_free(file);
}

static void check_examples(void)
{
    DIR *folder = opendir("cases/examples");
    int files = 0;
    gsl_test(folder == NULL, "cases/examples can be opened");
    for (struct dirent *e; folder != NULL && (e = readdir(folder)) != NULL;)
        if (strstr(e->d_name, ".yaml") != NULL) {
            char path[300];
            snprintf(path, sizeof path, "cases/examples/%s", e->d_name);
            check_example(path);
            files++;
        }
    if (folder != NULL)
        closedir(folder);
    gsl_test(files < 10, "%d examples", files);
}

extern const quantity_type quantity_envelope_of;

static void check_words(void)
{
    static const double path[] = {0.5, 1}, y[] = {0, 1, 0};
    const section_spec square = {
        .kind = SECTION_RECTANGLE, .width = 0.1, .height = 0.1, .young = 1, .shear_modulus = 1};
    scene s;
    char text[MEANING_ROOM];
    scene_init(&s, "words");
    scene_add_section(&s, &square);
    scene_add_node(&s, 0, 0, 0);
    scene_add_node(&s, 0.25, 0, 0);
    scene_add_member(&s, 0, 1, 0, y);
    scene_hold_all(&s, 0);
    const int states = scene_add_static(&s, 2, path, 1),
              small = scene_add_compliance(&s, states, (scene_compliance){.node = 1});
    scene_add_quantity(&s, "c", "1/N", small, scene_compliance_entry(SCENE_UY, SCENE_RZ))->factor =
        -1;
    scene_set_at(scene_add_quantity(&s, "M", "N m", states, scene_reaction(0, SCENE_RZ)), 0.5);
    meaning_of_quantity(&s, 0, text, sizeof text);
    gsl_test_str(text,
                 "displacement of node_1 (0.25, 0, 0) along y for a unit moment about z "
                 "there, linearised, at the end of the static path, with the opposite sign",
                 "a compliance in words");
    meaning_of_quantity(&s, 1, text, sizeof text);
    gsl_test_str(text,
                 "moment about z that holds node_0 (0, 0, 0), at 0.5 on the static path (0 to 1)",
                 "a reaction in words");
    meaning_of_quantity(&s, 1, text, 20);
    gsl_test_int((int)strlen(text), 19, "cut where it does not fit");
    const scene_extract largest = {.kind = SCENE_ENVELOPE_OF,
                                   .type = &quantity_envelope_of,
                                   .of = {.envelope = SCENE_ENVELOPE_MAX}};
    scene_quantity *q = scene_add_quantity(&s, "most", "1", states, largest);
    for (int i = 0; i < 2; i++)
        if (scene_grow(&s, &q->over, &q->overs, sizeof *q->over) == i)
            q->over[i] = i;
    meaning_of_quantity(&s, 2, text, sizeof text);
    gsl_test_str(text, "largest of c, M", "an envelope in words");
    seen[SCENE_ENVELOPE_OF]++;
    scene_free(&s);
}

static void check_motion(void)
{
    scene_extract acceleration = scene_rate(1, SCENE_UX);
    acceleration.of.rated.rate = SCENE_SPEEDING;
    const struct {
        scene_extract what;
        scene_reduction reduction;
        const char *words;
    } row[] = {
        {scene_rate(1, SCENE_UX), SCENE_LAST,
         "velocity of node_1 (1, 0, 0) along x, 2 s after the start of the motion"},
        {scene_rate(1, SCENE_RY), SCENE_AT,
         "angular velocity of node_1 (1, 0, 0) about its own y axis, 0.5 s after the start of the "
         "motion"},
        {acceleration, SCENE_RMS,
         "acceleration of node_1 (1, 0, 0) along x, root mean square over time"},
        {scene_orientation_entry(1, 0, 2), SCENE_MAX,
         "entry xz of the rotation matrix of node_1 (1, 0, 0), largest value over the motion"},
        {scene_relative_to(1, SCENE_UY, 0), SCENE_MIN,
         "displacement of node_1 (1, 0, 0) along y as seen from node_0 (0, 0, 0), smallest value "
         "over the motion"},
        {scene_balance_of(SCENE_LZ), SCENE_LAST,
         "angular momentum about the z axis, 2 s after the start of the motion"},
        {scene_balance_of(SCENE_DISSIPATED), SCENE_LAST,
         "energy dissipated by damping since the start, 2 s after the start of the motion"}};
    static const double path[] = {0.5, 2};
    scene s;
    char text[MEANING_ROOM];
    scene_init(&s, "motion");
    scene_add_node(&s, 0, 0, 0);
    scene_add_node(&s, 1, 0, 0);
    const int motion = scene_add_motion(&s, SCENE_NONE, 2, path, (scene_motion){.step = 1});
    for (int i = 0; i < (int)(sizeof row / sizeof row[0]); i++) {
        scene_quantity *q = scene_add_quantity(&s, "q", "1", motion, row[i].what);
        q->reduction = row[i].reduction;
        q->at = 0.5;
        meaning_of_quantity(&s, i, text, sizeof text);
        gsl_test_str(text, row[i].words, "of a motion");
        seen[row[i].what.kind]++;
    }
    scene_free(&s);
}

static void meaning_tests(void)
{
    check_motion();
    check_words();
    check_cases();
    check_examples();
    for (int kind = 0; kind < KINDS; kind++)
        gsl_test(seen[kind] == 0, "quantities of kind %d: %d", kind, seen[kind]);
    printf("%d quantities\n", requested);
}

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

static void packed_tests(void)
{
    int files = 0;
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (registry_cases[i]->build_from == scene_packed_build) {
            compare_file(registry_cases[i]);
            files++;
        }
    gsl_test(files < 1, "%d scene files among the cases", files);
}

int main(void)
{
    meaning_tests();
    packed_tests();
    return gsl_test_summary();
}
