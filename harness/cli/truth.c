#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "elements/shared/choice.h"
#include "harness/cli/cli.h"
#include "harness/records/records.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

typedef struct truth_request {
    case_options of;
    truths_options truths;
    const char *format;
} truth_request;

typedef struct shown_value {
    const char *quantity, *formulation, *unit, *kind, *model, *theory, *source, *convention;
    int elements; /* number of elements for which the value holds; 0: any number */
    double value, uncertainty;
} shown_value;

enum { NAME = 28, INDENT = 6 };

/* Writes the value with the smallest number of digits for which the rounding error is within a
 * thousandth of the uncertainty. */
static void digits_of(double value, double uncertainty, char text[32])
{
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, value);
        if (fabs(strtod(text, NULL) - value) <= 1e-3 * uncertainty)
            return;
    }
}

static void print_value(const shown_value *v)
{
    char title[SCENE_NAME + FORMULATION_KEY + 16], digits[32], valid_for[2 * SCENE_NAME];
    snprintf(title, sizeof title, v->elements > 0 ? "%s%s%s n=%d" : "%s%s%s", v->quantity,
             v->formulation[0] != '\0' ? ", " : "", v->formulation, v->elements);
    snprintf(valid_for, sizeof valid_for, "%s%s%s", v->model, v->theory[0] != '\0' ? ", " : "",
             v->theory);
    const int name = printf("  %-*s", NAME, title);
    if (name > NAME + 2)
        printf("\n%*s", NAME + 2, "");
    digits_of(v->value, v->uncertainty, digits);
    printf(" %24s +- %-8.1e %-8s %-13s %s\n", digits, v->uncertainty, v->unit, v->kind, valid_for);
    paragraph_printf(stdout, 0, INDENT, "%s%s%s", v->source, v->convention[0] != '\0' ? "; " : "",
                     v->convention);
}

static void show(json_t *list, const shown_value *v)
{
    if (list == NULL) {
        print_value(v);
        return;
    }
    json_array_append_new(list,
                          json_pack("{s:s,s:s,s:i,s:f,s:f,s:s,s:s,s:s,s:s,s:s,s:s}", "quantity",
                                    v->quantity, "formulation", v->formulation, "elements",
                                    v->elements, "value", v->value, "uncertainty", v->uncertainty,
                                    "unit", v->unit, "kind", v->kind, "model", v->model, "theory",
                                    v->theory, "source", v->source, "convention", v->convention));
}

static shown_value stored_value(const truth *row, int theory)
{
    return (shown_value){.quantity = row->quantity,
                         .formulation = row->formulation,
                         .unit = row->unit,
                         .kind = row->kind,
                         .model = row->model,
                         .theory = theory ? row->theory : "",
                         .source = row->source,
                         .convention = row->convention,
                         .elements = row->elements,
                         .value = row->value,
                         .uncertainty = row->uncertainty};
}

static shown_value derived_as(const derived_value *v)
{
    return (shown_value){.quantity = v->quantity,
                         .formulation = "",
                         .unit = v->unit,
                         .kind = "exact",
                         .model = "same",
                         .theory = "",
                         .source = v->source,
                         .convention = v->convention,
                         .value = v->value,
                         .uncertainty = v->uncertainty};
}

/* Shows the stored rows for this point. Returns the number of rows of the same model that are not
 * for a single formulation. */
static int show_stored(json_t *list, const truths *t, const case_type *type,
                       const double parameter[])
{
    int continuum = 0, discrete = 0;
    for (int i = 0; i < t->rows; i++) {
        const truth *row = &t->row[i];
        if (row->formulation[0] != '\0' || !truth_holds(row, type, parameter))
            continue;
        const shown_value v = stored_value(row, 1);
        show(list, &v);
        continuum += strcmp(row->model, "same") == 0;
    }
    for (int i = 0; i < t->rows; i++) {
        const truth *row = &t->row[i];
        if (row->formulation[0] == '\0' || !truth_holds(row, type, parameter))
            continue;
        if (discrete++ == 0 && list == NULL)
            printf("of one formulation\n");
        const shown_value v = stored_value(row, list != NULL);
        show(list, &v);
    }
    return continuum;
}

static status show_derived(json_t *list, const case_type *type, const double parameter[], fault *f)
{
    char script[PATH_MAX], text[PARAMETERS_TEXT];
    derived_value *value;
    int count;
    if (case_omits_nothing(type, parameter))
        return fault_set(
            f, STATUS_REFUSED,
            "no reference value of %s is stored for omit=none, and the deriving program of the "
            "case covers only the model of its source; write a scene with 'beamwork scene %s --set "
            "omit=none' and derive its values with --scene",
            type->name, type->name);
    TRY(derive_script("at.py", script, f));
    parameters_source_text(type, parameter, text, sizeof text);
    const status outcome = derive_values(script, type->name, text, &value, &count, f);
    for (int i = 0; i < count; i++) {
        const shown_value v = derived_as(&value[i]);
        show(list, &v);
    }
    free(value);
    return outcome;
}

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

static void print_line(const derived_value *v, const case_type *type, const double parameter[])
{
    printf("  - {quantity: %s, value: %.17g, uncertainty: %.1e, kind: exact, source: \"%s\"",
           v->quantity, v->value, v->uncertainty, v->source);
    if (v->convention[0] != '\0')
        printf(", convention: %s", v->convention);
    print_point(type, parameter);
    printf("}\n");
}

static status show_scene_of(json_t *list, const case_type *type, const double parameter[],
                            FILE *text, fault *f)
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
    if (list == NULL)
        printf("derived values, as lines for the scene file\ntruths:\n");
    for (int i = 0; i < count; i++) {
        const shown_value v = derived_as(&value[i]);
        if (list != NULL)
            show(list, &v);
        else
            print_line(&value[i], type, parameter);
    }
    free(value);
    return STATUS_OK;
}

static status show_scene(json_t *list, const case_type *type, const double parameter[], fault *f)
{
    FILE *text = derive_text_file(f);
    if (text == NULL)
        return STATUS_FAULT;
    const status outcome = show_scene_of(list, type, parameter, text, f);
    fclose(text);
    if (outcome != STATUS_REFUSED)
        return outcome;
    const fault why = *f;
    return fault_set(
        f, outcome,
        "%.140s; give `truths` in the scene (numbers or formulas with their source), or compare "
        "formulations: 'beamwork converge --scene FILE' looks for an agreement",
        why.text);
}

static status show_all(const truth_request *r, const case_type *type, const truths *t, json_t *list,
                       fault *f)
{
    const int stored = show_stored(list, t, type, r->of.parameter);
    fflush(stdout);
    if (r->of.scene == NULL)
        return stored > 0 ? STATUS_OK : show_derived(list, type, r->of.parameter, f);
    const status outcome = show_scene(list, type, r->of.parameter, f);
    if (stored == 0 || outcome != STATUS_REFUSED)
        return outcome;
    fprintf(stderr, "beamwork: %s\n", f->text);
    return STATUS_OK;
}

static status show_json(const truth_request *r, const case_type *type, const truths *t,
                        const char *parameters, fault *f)
{
    json_t *list = json_array();
    const status outcome = show_all(r, type, t, list, f);
    if (outcome == STATUS_OK)
        return json_finish(json_pack("{s:i,s:s,s:s,s:o}", "schema_version", SCHEMA_VERSION, "case",
                                     type->name, "parameters", parameters, "values", list),
                           stdout, f);
    json_decref(list);
    return outcome;
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
    if (r->format[0] == 'c')
        return message_fail(STATUS_REFUSED,
                            "truth supports --format text and json; give one of these");
    status outcome = case_input_truths(&r->of, &r->truths, &t, &f);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    parameters_text(type, r->of.parameter, text, sizeof text);
    if (r->format[0] == 'j') {
        outcome = show_json(r, type, &t, text, &f);
    } else {
        printf("%s%s%s\n", type->name, text[0] != '\0' ? ": " : "", text);
        outcome = show_all(r, type, &t, NULL, &f);
    }
    truths_free(&t);
    const int code = message_exit(outcome, &f);
    return code == EXIT_REFUSED ? EXIT_DIFFERS : code;
}

#define IN(at) .member = offsetof(truth_request, at)
static const verb_group shared[] = {
    SHARED(case, of), SHARED(user_truths, truths), SHARED(format, format), {NULL, 0}};
const verb verb_truth = {
    "truth",
    "CASE",
    "prints reference values of a case at a parameter point, computed on demand",
    "Prints the reference values of a parameter point: value, uncertainty, unit, kind, model, "
    "source. If none is stored for the model of the case, the deriving program of the case "
    "computes them. Your own scene (--scene FILE) is solved as a network of geometrically exact "
    "beams and rigid bodies; the output lines can be added to 'truths' of the scene. Exit status: "
    "0 printed, 1 no value is stored and no program can compute one, 2 invalid input, 4 file, disk "
    "or memory.",
    "beamwork truth elastica --set load=3",
    shared,
    NULL,
    sizeof(truth_request),
    .place = VERB_COMPUTE + 40,
    .answer = answer};
