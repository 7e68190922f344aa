#include "harness/cli/cli.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/study/study.h"

/* Stores a value of --truths: a table (.csv), or the file of packed reference values. The latter
 * may be given only once. */
static status read_either(const verb_option *o, void *member, const char *value, fault *f)
{
    static const verb_option table = {"truths", .traits = OPTION_REPEATS | OPTION_INPUT};
    truths_options *t = member;
    (void)o;
    const size_t length = strlen(value);
    if (length > 4 && strcmp(value + length - 4, ".csv") == 0)
        return option_take(&table, &t->own, value, f);
    if (t->packed != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "--truths is given twice with files other than .csv tables; give one such "
                         "file, and any number of tables");
    t->packed = value;
    return STATUS_OK;
}

static const verb_option packed_truths[] = {
    {"truths", 0, "FILE",
     "file of reference values (default: $BEAMWORK_TRUTHS, or truths.h5 next to the program)",
     .traits = OPTION_INPUT},
    {0}};
static const verb_option user_truths[] = {
    {"truths", 0, "FILE",
     "file of reference values (default: $BEAMWORK_TRUTHS, or truths.h5 next to the program); "
     "FILE.csv adds your own reference values and may be repeated",
     .traits = OPTION_REPEATS | OPTION_INPUT, .read = read_either},
    {0}};
const option_group options_truths = {packed_truths, NULL, NULL, NULL};
const option_group options_user_truths = {user_truths, NULL, NULL, NULL};

const char *user_tables_packed(const truths_options *o)
{
    static char found[PATH_MAX];
    if (o->packed != NULL)
        return o->packed;
    data_place_truths(found);
    return found;
}

static status refuse(const mistakes *m, fault *f)
{
    const int others = m->count + m->more - 1;
    fault first = {""};
    const status outcome = mistakes_status(m, &first);
    if (outcome == STATUS_OK || others <= 0)
        return outcome == STATUS_OK ? outcome : fault_set(f, outcome, "%s", first.text);
    return fault_set(f, outcome, "%.330s (and %d more)", first.text, others);
}

status user_tables_truths(const truths_options *o, const case_type *const run[],
                          const case_type *only, truths *t, fault *f)
{
    mistakes m;
    for (int i = 0; i < o->own.count; i++) {
        TRY(user_truths_read(o->own.text[i], run, only, t, &m, f));
        TRY(refuse(&m, f));
    }
    return STATUS_OK;
}

status user_tables_deviations(const text_list *tables, const case_type *const run[], truths *t,
                              fault *f)
{
    mistakes m;
    for (int i = 0; i < tables->count; i++) {
        TRY(user_deviations_read(tables->text[i], run, t, &m, f));
        TRY(refuse(&m, f));
    }
    return STATUS_OK;
}

static void report_mistakes(const command_line *l, const mistakes *m, status outcome,
                            const fault *f)
{
    const char *format = given_value(l, "format");
    fault unwritten;
    if (m->count == 0)
        message_fail(outcome, f->text);
    else if (format == NULL || strcmp(format, "json") != 0)
        mistakes_print(m, stderr);
    else if (mistakes_json(m, stdout, &unwritten) != STATUS_OK)
        message_fail(STATUS_FAULT, unwritten.text);
}

static void report_needs(const char *path, const case_type *type)
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
        fprintf(stderr, "beamwork: %s: 'needs' is read as in earlier versions; %s %s%s%s\n", path,
                omit[0] != '\0' || theory[0] != '\0' ? "instead write" : "remove it", omit,
                omit[0] != '\0' && theory[0] != '\0' ? " and " : "", theory);
    }
    scene_free(&s);
}

static int report_reading(const command_line *l, const mistakes *m, status outcome, const fault *f)
{
    if (outcome == STATUS_OK)
        return EXIT_AS_EXPECTED;
    report_mistakes(l, m, outcome, f);
    return outcome == STATUS_FAULT ? EXIT_FAULT : EXIT_REFUSED;
}

typedef status scene_reader(const char *path, scene_file **out, mistakes *m, fault *f);

static int read_by(scene_reader *read, const command_line *l, const char *path, scene_file **out)
{
    mistakes m;
    fault f = {""};
    const status outcome = read(path, out, &m, &f);
    if (outcome == STATUS_OK && scene_file_states(*out, "needs"))
        report_needs(path, scene_file_case(*out));
    return report_reading(l, &m, outcome, &f);
}

int case_input_read(const command_line *l, const char *path, scene_file **out)
{
    return read_by(scene_file_read, l, path, out);
}

static int check_values(const case_options *r)
{
    mistakes m;
    fault f = {""};
    const status outcome = scene_file_check(r->scene, r->parameter, &m, &f);
    return report_reading(r->line, &m, outcome, &f);
}

const case_type *case_input_scene(case_options *r)
{
    if (r->name != NULL) {
        message_fail(STATUS_REFUSED, "a case and --scene were given; give only one of them");
        return NULL;
    }
    const int code = read_by(r->set.count > 0 ? scene_file_read_form : scene_file_read, r->line,
                             r->scene_path, &r->scene);
    if (code == EXIT_AS_EXPECTED)
        return scene_file_case(r->scene);
    r->refusal = code;
    return NULL;
}

void case_input_report_units(const scene_file *file, const double parameter[])
{
    char words[FAULT_TEXT];
    scene s;
    if (file == NULL)
        return;
    const int given = scene_file_states(file, "units");
    if (cell_scene(scene_file_case(file), parameter, NULL, &s, NULL) == STATUS_OK &&
        scene_looks_foreign(&s, words))
        fprintf(stderr, "beamwork: warning: %s; %s\n", words,
                given ? "numbers are in the 'units' of the scene; if these are mm, N, MPa, "
                        "densities are in t/mm^3, such as 7.85e-9"
                      : "numbers are in m, N, Pa and kg, unless the scene gives units: mm, N, MPa");
    scene_free(&s);
}

static const case_type *named_case(const case_options *r)
{
    fault f;
    if (r->name == NULL) {
        message_fail(STATUS_REFUSED, "give a case; 'beamwork list cases' shows the cases");
        return NULL;
    }
    const case_type *type = case_find(r->name, &f);
    if (type == NULL)
        message_fail(STATUS_REFUSED, f.text);
    return type;
}

static void take_example(case_options *r, const char *path)
{
    command_line *l = r->line;
    const char *none;
    int begun;
    l->given[l->givens++] = (given_option){verb_word(l->verb, "--scene", &none, &begun), path};
    l->arguments = 0;
    r->scene_path = path;
    r->name = NULL;
}

void case_input_example(case_options *r)
{
    static char found[PATH_MAX];
    static const char *const folder[] = {"cases/examples", "examples/scenes"};
    char name[PATH_MAX], path[PATH_MAX];
    fault f;
    const char *dot = r->name != NULL ? strrchr(r->name, '.') : NULL;
    if (dot != NULL && r->scene_path == NULL && r->line->arguments == 1 &&
        (strcmp(dot, ".yaml") == 0 || strcmp(dot, ".yml") == 0))
        take_example(r, r->name);
    if (r->name == NULL || r->scene_path != NULL || r->line->arguments > 1 ||
        strchr(r->name, '/') != NULL || case_find(r->name, &f) != NULL)
        return;
    for (size_t i = 0; i < sizeof folder / sizeof folder[0] && r->name != NULL; i++) {
        snprintf(name, sizeof name, "%s/%.100s.yaml", folder[i], r->name);
        if (data_place(name, path) && realpath(path, found) != NULL)
            take_example(r, found);
    }
}

const case_type *case_input_find(case_options *r)
{
    fault f;
    case_input_example(r);
    const case_type *type = r->scene_path != NULL ? case_input_scene(r) : named_case(r);
    if (type == NULL)
        return NULL;
    parameters_default(type, r->parameter);
    for (int i = 0; i < r->set.count; i++)
        if (parameters_set(type, r->set.text[i], r->parameter, &f) != STATUS_OK) {
            message_fail(STATUS_REFUSED, f.text);
            return NULL;
        }
    const int code = r->scene != NULL && r->set.count > 0 ? check_values(r) : EXIT_AS_EXPECTED;
    if (code == EXIT_AS_EXPECTED) {
        case_input_report_units(r->scene, r->parameter);
        return type;
    }
    r->refusal = code;
    return NULL;
}

static status add_truths(const case_options *r, const truths_options *of, truths *t, fault *f)
{
    const char *packed = user_tables_packed(of);
    const case_type *type = r->scene != NULL          ? scene_file_case(r->scene)
                            : r->line->arguments == 1 ? case_find(r->name, f)
                                                      : NULL;
    if (r->scene != NULL)
        truths_read_rules(packed, t, NULL);
    if (r->scene != NULL)
        TRY(scene_truths_add(r->scene, r->parameter, t, f));
    else
        TRY(truths_read_case(packed, type, t, f));
    return user_tables_truths(of, (const case_type *const[]){type, NULL}, type, t, f);
}

status case_input_truths(const case_options *r, const truths_options *of, truths *t, fault *f)
{
    memset(t, 0, sizeof *t);
    const status outcome = add_truths(r, of, t, f);
    if (outcome != STATUS_OK)
        truths_free(t);
    return outcome;
}

void case_input_report_analysis(const case_options *r, const scene *s)
{
    if (r->scene == NULL || scene_file_states(r->scene, "analyses"))
        return;
    const scene_analysis *a = &s->analysis[0];
    if (a->kind == SCENE_LINEAR) {
        fprintf(stderr, "beamwork: the scene has no analysis; a linear analysis is run, as if "
                        "analyses: {run: {linear: {}}} were given\n");
        return;
    }
    const scene_path *path = scene_path_of(a);
    fprintf(stderr,
            "beamwork: the scene has no analysis; a static analysis is run to the end of the "
            "prescribed motions, as if analyses: {run: {static: {stations: [%g]}}} were given\n",
            path->value[path->stations - 1]);
}

static status read_assignment(const verb_option *o, void *member, const char *value, fault *f)
{
    const text_list *list = member;
    const size_t name = strcspn(value, "=");
    for (int i = 0; i < list->count; i++)
        if (strcspn(list->text[i], "=") == name && strncmp(list->text[i], value, name) == 0)
            return fault_set(f, STATUS_REFUSED, "--set %.*s is given twice; give one value",
                             (int)(name < 60 ? name : 60), value);
    const verb_option plain = {o->name, .traits = OPTION_REPEATS, .most = CASE_MAX_PARAMETERS};
    return option_take(&plain, member, value, f);
}

static void begin(void *group, command_line *l)
{
    case_options *r = group;
    r->line = l;
    r->refusal = EXIT_REFUSED;
}

static status end(void *group, command_line *l, fault *f)
{
    case_options *r = group;
    (void)f;
    r->name = l->argument[0];
    return STATUS_OK;
}

static void close_case(void *group)
{
    case_options *r = group;
    scene_file_free(r->scene);
}

static const verb_option both[] = {
    {"set", 's', "NAME=VALUE",
     "value of a parameter, in the unit that 'beamwork list' shows; may be repeated",
     .member = offsetof(case_options, set), .traits = OPTION_REPEATS, .read = read_assignment},
    {"scene", 0, "FILE", "your scene file (YAML) instead of a case",
     .member = offsetof(case_options, scene_path), .traits = OPTION_INPUT},
    {0}};
const option_group options_case = {both, begin, end, close_case};
const option_group options_scene = {both + 1, begin, end, close_case};

void case_input_name(const case_options *r, const case_type *type, char *text, size_t size)
{
    char parameters[PARAMETERS_TEXT], path[PATH_MAX];
    parameters_text(type, r->parameter, parameters, sizeof parameters);
    const char *file = r->scene_path != NULL ? realpath(r->scene_path, path) : NULL;
    snprintf(text, size, "%s%s%s", file != NULL ? file : type->name,
             parameters[0] != '\0' ? "; " : "", parameters);
}
