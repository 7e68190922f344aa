#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "elements/shared/choice.h"
#include "harness/cli/cli.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

typedef struct truth_request {
    case_options of;
    truths_options truths;
} truth_request;

enum { NAME = 28, INDENT = 6 };

/* Writes the value with the smallest number of digits whose error is within a thousandth of the
 * uncertainty. */
static void digits_of(double value, double uncertainty, char text[32])
{
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, value);
        if (fabs(strtod(text, NULL) - value) <= 1e-3 * uncertainty)
            return;
    }
}

/* Prints two lines: the value, and its source. */
static void print_value(const char *quantity, double value, double uncertainty, const char *unit,
                        const char *kind, const char *whose, const char *source, const char *note)
{
    const int name = printf("  %-*s", NAME, quantity);
    if (name > NAME + 2)
        printf("\n%*s", NAME + 2, "");
    char digits[32];
    digits_of(value, uncertainty, digits);
    printf(" %24s +- %-8.1e %-8s %-13s %s\n", digits, uncertainty, unit, kind, whose);
    paragraph_say(stdout, 0, INDENT, "%s%s%s", source, note[0] != '\0' ? "; " : "", note);
}

/* Prints the stored rows of this point. Returns the number of rows for the continuum and the same
 * model. */
static int print_stored(const truths *t, const case_type *type, const double parameter[])
{
    int continuum = 0, discrete = 0;
    for (int i = 0; i < t->rows; i++) {
        const truth *row = &t->row[i];
        if (row->formulation[0] != '\0' || !truth_holds(row, type, parameter))
            continue;
        char whose[2 * SCENE_NAME];
        snprintf(whose, sizeof whose, "%s%s%s", row->model, row->theory[0] != '\0' ? ", " : "",
                 row->theory);
        print_value(row->quantity, row->value, row->uncertainty, row->unit, row->kind, whose,
                    row->source, row->convention);
        continuum += strcmp(row->model, "same") == 0;
    }
    for (int i = 0; i < t->rows; i++) {
        const truth *row = &t->row[i];
        if (row->formulation[0] == '\0' || !truth_holds(row, type, parameter))
            continue;
        if (discrete++ == 0)
            printf("of one formulation\n");
        char name[SCENE_NAME + FORMULATION_KEY + 16];
        snprintf(name, sizeof name, row->elements > 0 ? "%s, %s n=%d" : "%s, %s", row->quantity,
                 row->formulation, row->elements);
        print_value(name, row->value, row->uncertainty, row->unit, row->kind, row->model,
                    row->source, row->convention);
    }
    return continuum;
}

static status print_derived(const case_type *type, const double parameter[], fault *f)
{
    char script[PATH_MAX], text[PARAMETERS_TEXT];
    derived_value *value;
    int count;
    if (case_omits_nothing(type, parameter))
        return fault_set(f, STATUS_REFUSED,
                         "no reference value of %s is stored for omit=none, and the program of the "
                         "case derives only the model of its source; write a scene with 'beamwork "
                         "scene %s --set omit=none' and derive its values with --scene",
                         type->name, type->name);
    TRY(derive_script("at.py", script, f));
    parameters_source_text(type, parameter, text, sizeof text);
    const status outcome = derive_values(script, type->name, text, &value, &count, f);
    for (int i = 0; i < count; i++)
        print_value(value[i].quantity, value[i].value, value[i].uncertainty, value[i].unit, "exact",
                    "same", value[i].source, value[i].convention);
    free(value);
    return outcome;
}

/* Prints all parameters of the scene. A line without parameters would apply to any values. */
static void print_point(const case_type *type, const double parameter[])
{
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(type->parameters, i)) != NULL; i++) {
        char word[SCENE_NAME];
        if (p->choices != NULL)
            choice_name(p->choices, (int)parameter[i], word, sizeof word);
        else
            for (int digits = 15; digits <= 17; digits++) {
                snprintf(word, sizeof word, "%.*g", digits, parameter[i]);
                if (strtod(word, NULL) == parameter[i])
                    break;
            }
        printf("%s%s: %s", i == 0 ? ", parameters: {" : ", ", p->name, word);
    }
    printf("%s", parameter_at(type->parameters, 0) != NULL ? "}" : "");
}

/* Prints a line for the scene file. */
static void print_line(const derived_value *v, const case_type *type, const double parameter[])
{
    printf("  - {quantity: %s, value: %.17g, uncertainty: %.1e, kind: exact, source: \"%s\"",
           v->quantity, v->value, v->uncertainty, v->source);
    if (v->convention[0] != '\0')
        printf(", convention: %s", v->convention);
    print_point(type, parameter);
    printf("}\n");
}

/* Prints the values. The caller, print_scene, closes the file, even after a failure. */
static status print_scene_of(const case_type *type, const double parameter[], FILE *text, fault *f)
{
    char script[PATH_MAX];
    scene s = {0};
    derived_value *value;
    int count;
    const write_head head = {type->name, type->summary, type->source};
    TRY(derive_script("of_scene.py", script, f));
    status outcome = cell_scene(type, parameter, NULL, &s, f);
    if (outcome == STATUS_OK)
        outcome = write_scene(text, &s, &head, f);
    scene_free(&s);
    TRY(outcome);
    TRY(derive_scene(script, text, &value, &count, f));
    printf("derived values, as lines for the scene file\ntruths:\n");
    for (int i = 0; i < count; i++)
        print_line(&value[i], type, parameter);
    free(value);
    return STATUS_OK;
}

/* Prints the reference values of a scene file, which are computed for a network of members and
 * bodies. */
static status print_scene(const case_type *type, const double parameter[], fault *f)
{
    FILE *text = tmpfile();
    if (text == NULL)
        return fault_set(f, STATUS_FAULT, "no temporary file for the scene");
    const status outcome = print_scene_of(type, parameter, text, f);
    fclose(text);
    if (outcome != STATUS_REFUSED)
        return outcome;
    const fault why = *f;
    return fault_set(
        f, outcome,
        "%.140s; give `truths` of the scene, numbers or formulas with their source, or "
        "compare formulations: 'beamwork converge --scene FILE' looks for an agreement",
        why.text);
}

static int answer(const command_line *l, void *request)
{
    truth_request *r = request;
    (void)l;
    truths t;
    fault f = {""};
    char text[PARAMETERS_TEXT];
    const case_type *type = case_input_find(&r->of);
    if (type == NULL)
        return r->of.refusal;
    status outcome = case_input_truths(&r->of, &r->truths, &t, &f);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    parameters_text(type, r->of.parameter, text, sizeof text);
    printf("%s%s%s\n", type->name, text[0] != '\0' ? ": " : "", text);
    const int stored = print_stored(&t, type, r->of.parameter);
    fflush(stdout);
    if (r->of.scene != NULL)
        outcome = print_scene(type, r->of.parameter, &f);
    if (r->of.scene != NULL && stored > 0 && outcome == STATUS_REFUSED) {
        fprintf(stderr, "beamwork: %s\n", f.text);
        outcome = STATUS_OK;
    }
    if (r->of.scene == NULL && stored == 0)
        outcome = print_derived(type, r->of.parameter, &f);
    truths_free(&t);
    const int code = message_exit(outcome, &f);
    return code == EXIT_REFUSED ? EXIT_DIFFERS : code;
}

#define IN(at) .member = offsetof(truth_request, at)
static const verb_group shared[] = {SHARED(case, of), SHARED(own_truths, truths), {NULL, 0}};
const verb verb_truth = {
    "truth",
    "CASE",
    "reference values of a case at a parameter point; computed on demand",
    "Prints the reference values of a parameter point: value, uncertainty, unit, kind, model, "
    "source. If none is stored for the model of the case, the deriving program computes them. Your "
    "own scene (--scene FILE) is solved as a network of geometrically exact beams and rigid "
    "bodies; the output lines can be added to its 'truths'. Exit status: 0 printed, 1 none is "
    "stored and no program can compute it, 2 invalid input, 4 file, disk or memory.",
    "beamwork truth elastica --set load=3",
    shared,
    NULL,
    sizeof(truth_request),
    .place = VERB_COMPUTE + 40,
    .answer = answer};
