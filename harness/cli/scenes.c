/* Scene files of a command line: what those of an older version mean now; several of them. */
#include "harness/cli/cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

enum { MOST_MEMBERS = 200, ELEMENTS = 2 };
static const double rounding = 1e-8;

static int is_moved(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            return 1;
    return 0;
}

static int is_near(double a, double b, double near_zero)
{
    return fabs(a - b) <= rounding * fmax(fmax(fabs(a), fabs(b)), near_zero);
}

static int is_same_curve(const curve *a, const curve *b, double near_zero)
{
    int same = a->points == b->points;
    for (int i = 0; same && i < a->points; i++)
        same = is_near(a->value[i], b->value[i], near_zero);
    return same;
}

static int is_same(const scene *s, const cell_result *a, const cell_result *b)
{
    if (a->solve.quantities != b->solve.quantities ||
        a->counters.negative_pivots != b->counters.negative_pivots)
        return 0;
    for (int i = 0; i < a->solve.quantities; i++) {
        const quantity_result *p = &a->solve.quantity[i], *q = &b->solve.quantity[i];
        const double near_zero = s->quantity[i].near_zero;
        if (p->status != q->status || !is_same_curve(&p->curve, &q->curve, near_zero) ||
            (p->status == STATUS_OK && s->quantity[i].reduction != SCENE_CURVE &&
             !is_near(p->value, q->value, near_zero)))
            return 0;
    }
    return 1;
}

/* Do the answers of the two scenes differ? 1 too where that cannot be told. */
static int differs(const scene *now, const scene *before, const formulation *chosen)
{
    cell_result held = {.size = {0}}, freed = {.size = {0}};
    cell_request request = {.scene = now, .elements = ELEMENTS};
    int same = 0;
    if (now->members > MOST_MEMBERS || is_moved(now))
        return 1;
    cell_formulation(&request, chosen);
    if (cell_run(&request, &held, NULL) == STATUS_OK) {
        request.scene = before;
        same = cell_run(&request, &freed, NULL) == STATUS_OK && is_same(now, &held, &freed);
    }
    cell_result_free(&held);
    cell_result_free(&freed);
    return !same;
}

void supports_told(const scene_file *file, const double parameter[], const formulation *chosen,
                   const scene *s)
{
    char ends[FAULT_TEXT] = "";
    scene before;
    if (file == NULL)
        return;
    if (scene_file_build_before(file, parameter, &before, NULL) == STATUS_OK)
        warping_ends_freed(s, &before, ends, sizeof ends);
    if (ends[0] != '\0' && differs(s, &before, chosen))
        fprintf(stderr,
                "beamwork: warping is %s, as supports say; earlier versions left it free: write "
                "'warping: free' at these members for the former answer\n",
                ends);
    scene_free(&before);
}

static status add_path(const void *context, const char *path, fault *f)
{
    scenes *out = *(scenes *const *)context;
    if (out->count == SCENES_MOST)
        return fault_set(f, STATUS_REFUSED, "more than %d scene files; give fewer", SCENES_MOST);
    out->path[out->count] = strdup(path);
    if (out->path[out->count] == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for scene files");
    out->count++;
    return STATUS_OK;
}

/* Results tell cases apart by their names. */
static status check_name(const case_type *one, const case_type *const *others, const char *path,
                         fault *f)
{
    for (; *others != NULL; others++)
        if (strcmp((*others)->name, one->name) == 0)
            return fault_set(f, STATUS_REFUSED,
                             "%.200s: a case or scene '%s' is judged already; give the scene "
                             "another name",
                             path, one->name);
    return STATUS_OK;
}

static int add_type(const command_line *l, int index, int *types, scenes *out)
{
    fault f = {""};
    const int code = case_input_read(l, out->path[index], &out->file[index]);
    if (code != EXIT_AS_EXPECTED)
        return code;
    const case_type *type = scene_file_case(out->file[index]);
    const status outcome = check_name(type, out->type, out->path[index], &f);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    out->type[(*types)++] = type;
    return EXIT_AS_EXPECTED;
}

int scenes_read(const command_line *l, const scenes_options *r, scenes *out)
{
    fault f = {""};
    int types = 0;
    memset(out, 0, sizeof *out);
    if (r->built_in || r->scene.count == 0)
        for (; types < SCENES_MOST && registry_cases[types] != NULL; types++)
            out->type[types] = registry_cases[types];
    status outcome = STATUS_OK;
    for (int i = 0; i < r->scene.count && outcome == STATUS_OK; i++)
        outcome = files_named(r->scene.text[i], add_path, &out, &f);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    int code = EXIT_AS_EXPECTED;
    for (int i = 0; i < out->count; i++) {
        const int one = add_type(l, i, &types, out);
        code = one != EXIT_AS_EXPECTED ? one : code; /* mistakes of all files are told */
    }
    return code;
}

void scenes_free(scenes *s)
{
    for (int i = 0; i < s->count; i++) {
        scene_file_free(s->file[i]);
        free(s->path[i]);
    }
    memset(s, 0, sizeof *s);
}

static status add_truths(const scenes *s, const scenes_options *r, truths *t, fault *f)
{
    if (r->built_in || r->scene.count == 0)
        TRY(truths_read(own_tables_packed(&r->truths), t, f));
    else
        TRY(truths_read_rules(own_tables_packed(&r->truths), t, f));
    for (int i = 0; i < s->count; i++)
        TRY(scene_truths_add_all(s->file[i], t, f));
    TRY(own_tables_truths(&r->truths, s->type, NULL, t, f));
    return own_tables_findings(&r->findings, s->type, t, f);
}

status scenes_truths(const scenes *s, const scenes_options *r, truths *t, fault *f)
{
    memset(t, 0, sizeof *t);
    const status outcome = add_truths(s, r, t, f);
    if (outcome != STATUS_OK)
        truths_free(t);
    return outcome;
}

static status add(chosen_formulations *o, const char *text, fault *f)
{
    return formulation_list_add(text, COMMAND_MAX_FORMULATIONS, o->formulation, &o->formulations,
                                f);
}

void named_add(chosen_formulations *o, const char *text)
{
    fault f;
    if (add(o, text, &f) != STATUS_OK)
        message_refuse(f.text);
}

/* element-test: of one part. */
static void begin(void *group, command_line *l)
{
    chosen_formulations *o = group;
    o->time_limit = strcmp(l->verb->name, "element-test") == 0 ? 60 : 120;
}

static status load(const char *element, fault *f)
{
    const element_type *type;
    TRY(plugin_load(element, &type, f));
    return formulations_add(type, element, f);
}

/* The time limit is known, which holds for a process that says what it is. */
static status end(void *group, command_line *l, fault *f)
{
    chosen_formulations *o = group;
    (void)l;
    process_limit(o->time_limit);
    if (o->element.count > 0)
        data_place_modules();
    for (int i = 0; i < o->element.count; i++)
        TRY(load(o->element.text[i], f));
    for (int i = 0; i < o->named.count; i++)
        TRY(add(o, o->named.text[i], f));
    return STATUS_OK;
}

int named_alone(const chosen_formulations *o)
{
    for (int i = 0; i < o->named.count; i++)
        if (strcmp(o->named.text[i], "all") == 0)
            return 0;
    return o->named.count > 0;
}

static const verb_option both[] = {
    {"formulation", 'f', "NAME[:KEY=VALUE,...]",
     "formulation and its options; may be repeated, 'all' for every one",
     .member = offsetof(chosen_formulations, named), .traits = OPTION_REPEATS},
    {"element", 0, "FILE|exec:COMMAND",
     "a formulation of your own: a shared object (with a '/': ./mine.so), or a command that uses "
     "the protocol of harness/formulations/protocol.md ('exec:python3 my_beam.py'); may be "
     "repeated",
     .member = offsetof(chosen_formulations, element), .traits = OPTION_REPEATS | OPTION_INPUT,
     .most = FORMULATIONS_MOST_LOADED},
    {0}};
static const verb_option limit[] = {
    {"time-limit", 0, "SECONDS",
     "of one cell (default 120; element-test: 60, of one part; 0: none); a cell that exceeds it is "
     "a failure of that name",
     .member = offsetof(chosen_formulations, time_limit), .most = 1000000},
    {0}};
const option_group options_formulations = {both, begin, end, NULL};
const option_group options_element = {both + 1, begin, end, NULL};
const option_group options_time_limit = {limit, NULL, NULL, NULL};

solution_request defaults_request(const defaults *d)
{
    solution_request out = d->wanted;
    out.elements = d->meshes->count > 0 ? d->meshes->elements[0] : 0;
    if (d->chosen->formulations > 0)
        out.formulation = d->chosen->formulation[0];
    return out;
}

/* A line of the note. */
static void add_note(char note[DEFAULTS_NOTE], const char *choice, const char *why,
                     const char *option)
{
    const size_t used = strlen(note);
    snprintf(note + used, DEFAULTS_NOTE - used, "%s: %s; %s gives another\n", choice, why, option);
}

/* What was chosen becomes what was given. */
static void take(const defaults *d, const solution_request *chosen, const solution_choice *why,
                 char note[DEFAULTS_NOTE])
{
    char choice[FORMULATION_KEY + 16];
    if (why->formulation[0] != '\0') {
        d->chosen->formulation[0] = chosen->formulation;
        d->chosen->formulations = 1;
        snprintf(choice, sizeof choice, "-f %s", d->chosen->formulation[0].key);
        add_note(note, choice, why->formulation, "-f NAME");
    }
    if (why->elements[0] != '\0') {
        d->meshes->elements[0] = chosen->elements;
        d->meshes->count = 1;
        snprintf(choice, sizeof choice, "-n %d", d->meshes->elements[0]);
        add_note(note, choice, why->elements, "-n N");
    }
}

static status choose(const defaults *d, int elements, char note[DEFAULTS_NOTE],
                     solution_choice *why, fault *f)
{
    truths ledger = {0};
    solution_request wanted = defaults_request(d);
    if (d->chosen->formulations == 0)
        truths_read_rules(own_tables_packed(d->truths), &ledger, NULL); /* it may be missing */
    const status outcome = solution_choose(&wanted, ledger.rule, ledger.rules, elements, why, f);
    truths_free(&ledger);
    TRY(outcome);
    take(d, &wanted, why, note);
    return STATUS_OK;
}

status defaults_formulation(const defaults *d, char note[DEFAULTS_NOTE], fault *f)
{
    note[0] = '\0';
    solution_choice why = {.formulation = ""};
    return d->chosen->formulations > 0 ? STATUS_OK : choose(d, 0, note, &why, f);
}

status defaults_fill(const defaults *d, char note[DEFAULTS_NOTE], solution_choice *why, fault *f)
{
    solution_choice own = {.formulation = ""};
    note[0] = '\0';
    if (why != NULL)
        *why = (solution_choice){.formulation = ""};
    if (d->chosen->formulations > 0 && d->meshes->count > 0)
        return STATUS_OK;
    const status outcome = choose(d, 1, note, why != NULL ? why : &own, f);
    if (why == NULL)
        solution_choice_free(&own);
    return outcome;
}
