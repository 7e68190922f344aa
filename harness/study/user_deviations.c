#include "harness/study/study_impl.h"

#include <errno.h>
#include <fnmatch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "elements/shared/choice.h"

/* Returns case number i: the cases of the run first, then the other built-in cases; NULL after the
 * last case. */
static const case_type *user_names_case_at(const case_type *const run[], int i);

static const char head[] = "rule,formulations,cases,condition,quantities,verdicts,largest_error,"
                           "predicted,cause,proof";
enum {
    RULE,
    FORMULATIONS,
    CASES,
    CONDITION,
    QUANTITIES,
    VERDICTS,
    LARGEST_ERROR,
    PREDICTED,
    CAUSE,
    PROOF,
    COLUMNS
};

typedef struct deviations_reader {
    const case_type *const *run;
    truths *t;
    mistakes *m;
    const user_table_row *row;
    int good;
} deviations_reader;

#define WRONG(r, column, ...)                                                                      \
    ((r)->good = 0, mistakes_add((r)->m, (r)->row->line, (column) + 1, __VA_ARGS__))

static int is_pattern(const char *word)
{
    return strpbrk(word, "*?[") != NULL;
}

static void check_formulation(deviations_reader *r, const char *word)
{
    char bare[RULES_WORD], near[FAULT_TEXT];
    int found = 0;
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(word, ":"), word);
    for (int i = 0; formulations_at(i) != NULL; i++)
        found |= fnmatch(bare, formulations_at(i)->name, 0) == 0;
    if (!found)
        WRONG(r, FORMULATIONS, "no formulation is called '%.60s'%s", word,
              user_names_near_formulation(bare, near));
}

static void check_case(deviations_reader *r, const char *word)
{
    char near[FAULT_TEXT];
    const case_type *type;
    int found = 0;
    for (int i = 0; (type = user_names_case_at(r->run, i)) != NULL; i++)
        found |= fnmatch(word, type->name, 0) == 0;
    if (!found)
        WRONG(r, CASES, "no case is called '%.60s'%s", word,
              user_names_near_case(r->run, word, near));
}

/* Returns 1 if the case has the quantity at the default point or at a point with reference
 * values. */
static int case_has(const deviations_reader *r, const case_type *type, const char *quantity,
                    scene *defaults)
{
    for (int i = 0; i < r->t->rows; i++)
        if (r->t->row[i].type == type && strcmp(r->t->row[i].quantity, quantity) == 0)
            return 1;
    return user_names_quantity(defaults, quantity) != NULL;
}

static void check_quantity(deviations_reader *r, const char *word)
{
    char near[FAULT_TEXT] = "", pattern[RULES_WORD];
    const case_type *type;
    int found = is_pattern(word);
    for (const char *at = r->row->field[CASES];
         !found && (at = rules_next_word(at, pattern)) != NULL;)
        for (int i = 0; !found && (type = user_names_case_at(r->run, i)) != NULL; i++) {
            double value[CASE_MAX_PARAMETERS] = {0};
            scene s;
            if (fnmatch(pattern, type->name, 0) != 0)
                continue;
            scene_init(&s, type->name);
            parameters_default(type, value);
            found = case_build(type, value, &s, NULL) != STATUS_OK || case_has(r, type, word, &s);
            if (!found && near[0] == '\0')
                user_names_near_quantity(&s, word, near);
            scene_free(&s);
        }
    if (!found)
        WRONG(r, QUANTITIES, "no case of the rule has a quantity '%.60s'%s", word, near);
}

static const char *verdict_at(const void *context, int i)
{
    (void)context;
    return i < VERDICT_KINDS ? verdict_name((verdict_kind)i) : NULL;
}

static void check_verdicts(deviations_reader *r)
{
    char word[RULES_WORD], near[FAULT_TEXT];
    const char *at = r->row->field[VERDICTS];
    for (;;) {
        const size_t length = strcspn(at, "|");
        int found = 0;
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        for (int k = 0; k < VERDICT_KINDS; k++)
            found |= k != VERDICT_PASS && k != VERDICT_SKIP && k != VERDICT_NO_TRUTH &&
                     k != VERDICT_OTHER_MODEL && strcmp(verdict_name((verdict_kind)k), word) == 0;
        const char *nearest = choice_nearest(word, verdict_at, NULL);
        if (!found)
            WRONG(r, VERDICTS, "'%.60s' is not a verdict that a known deviation explains%s", word,
                  nearest != NULL && strcmp(nearest, word) == 0
                      ? ""
                      : mistakes_remedy(nearest, "", near));
        if (at[length] == '\0')
            return;
        at += length + 1;
    }
}

static void check_prediction(deviations_reader *r, const char *word)
{
    char of[RULES_WORD];
    const char *slash = strchr(word, '/');
    snprintf(of, sizeof of, "%.*s", (int)strcspn(word, "/"), word);
    if (slash == NULL || slash[1] == '\0' || user_names_case(r->run, of) == NULL)
        WRONG(r, PREDICTED,
              "prediction '%.60s' is not valid; write CASE/QUANTITY of an existing case", word);
}

static void check_list(deviations_reader *r, int column,
                       void (*check)(deviations_reader *r, const char *word))
{
    char word[RULES_WORD];
    for (const char *at = r->row->field[column]; (at = rules_next_word(at, word)) != NULL;)
        check(r, word);
}

static void check_name(deviations_reader *r)
{
    const char *name = r->row->field[RULE];
    if (strchr(name, ' ') != NULL)
        WRONG(r, RULE, "the name '%.60s' of a rule contains a space; give one word", name);
    for (int i = 0; i < r->t->rules; i++)
        if (strcmp(r->t->rule[i].name, name) == 0)
            WRONG(r, RULE, "a rule '%.60s' already exists (%.100s); give this rule another name",
                  name,
                  r->t->rule[i].from != NULL ? r->t->rule[i].from : "the list of known deviations");
}

static void check_grounds(deviations_reader *r)
{
    if (r->row->field[CAUSE][0] == '\0' || strcmp(r->row->field[CAUSE], PROPOSAL_CAUSE) == 0)
        WRONG(r, CAUSE,
              "known deviation %.60s has no cause yet; state the cause, or correct the element and "
              "remove the row",
              r->row->field[RULE]);
    else if (r->row->field[PROOF][0] == '\0')
        WRONG(r, PROOF,
              "known deviation %.60s has no proof; name a derivation, a publication, or a run that "
              "shows the cause",
              r->row->field[RULE]);
}

static void check(deviations_reader *r, double *largest)
{
    static const int needed[] = {RULE, FORMULATIONS, CASES, QUANTITIES, VERDICTS};
    static const char *const names[] = {"rule", "formulations", "cases", "quantities", "verdicts"};
    const char *text = r->row->field[LARGEST_ERROR];
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++)
        if (r->row->field[needed[i]][0] == '\0')
            WRONG(r, needed[i], "column %s is empty; fill it in", names[i]);
    check_grounds(r);
    if (!r->good)
        return;
    *largest = NAN;
    check_name(r);
    check_list(r, FORMULATIONS, check_formulation);
    check_list(r, CASES, check_case);
    if (r->good)
        check_list(r, QUANTITIES, check_quantity);
    check_verdicts(r);
    check_list(r, PREDICTED, check_prediction);
    if (text[0] != '\0' && (!line_number(text, largest) || *largest < 0))
        WRONG(r, LARGEST_ERROR, "largest_error '%.40s' is not valid; give a number of at least 0",
              text);
}

/* Returns the cases of the run and the built-in cases, NULL-terminated. The caller frees the
 * list. */
static const case_type **all_cases(const case_type *const run[])
{
    int count = 0;
    while (user_names_case_at(run, count) != NULL)
        count++;
    const case_type **all = calloc((size_t)count + 1, sizeof(void *));
    for (int i = 0; all != NULL && i < count; i++)
        all[i] = user_names_case_at(run, i);
    return all;
}

static int check_condition(deviations_reader *r, const rule *one)
{
    char word[RULES_WORD] = "";
    const case_type **all = all_cases(r->run);
    const int bad = all == NULL || rules_bad_condition(one, all, word);
    if (bad)
        WRONG(r, CONDITION,
              "condition '%.60s' is neither a feature nor a comparison with a parameter of the "
              "cases; correct the condition ('beamwork list', with CASE or --scene FILE, shows the "
              "parameters)",
              word);
    free(all);
    return !bad;
}

static status add(deviations_reader *r, double largest, fault *f)
{
    char from[FAULT_TEXT];
    char *const *field = r->row->field;
    rule *more = realloc(r->t->rule, ((size_t)r->t->rules + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "known deviations");
    r->t->rule = more;
    snprintf(from, sizeof from, "%.200s:%d", r->m->file, r->row->line);
    rule *one = &more[r->t->rules++];
    *one = (rule){.name = strdup(field[RULE]),
                  .formulations = strdup(field[FORMULATIONS]),
                  .cases = strdup(field[CASES]),
                  .condition = strdup(field[CONDITION]),
                  .quantities = strdup(field[QUANTITIES]),
                  .verdicts = strdup(field[VERDICTS]),
                  .predicted = strdup(field[PREDICTED]),
                  .cause = strdup(field[CAUSE]),
                  .proof = strdup(field[PROOF]),
                  .from = strdup(from),
                  .largest_error = largest};
    if (one->name == NULL || one->formulations == NULL || one->cases == NULL ||
        one->condition == NULL || one->quantities == NULL || one->verdicts == NULL ||
        one->predicted == NULL || one->cause == NULL || one->proof == NULL || one->from == NULL)
        return fault_memory(f, "known deviations");
    check_condition(r, one);
    return STATUS_OK;
}

static status add_rows(const user_table *rows, deviations_reader *r, fault *f)
{
    for (int i = 0; i < rows->rows; i++) {
        double largest;
        r->row = &rows->row[i];
        r->good = 1;
        check(r, &largest);
        if (r->good)
            TRY(add(r, largest, f));
    }
    return STATUS_OK;
}

status user_deviations_read(const char *path, const case_type *const run[], truths *t, mistakes *m,
                            fault *f)
{
    user_table rows;
    deviations_reader r = {.run = run, .t = t, .m = m};
    status outcome = user_table_read(path, head, &rows, m, f);
    if (outcome == STATUS_OK)
        outcome = add_rows(&rows, &r, f);
    user_table_free(&rows);
    return outcome;
}

static int is_among(const case_type *const list[], const case_type *type)
{
    while (*list != NULL && *list != type)
        list++;
    return *list != NULL;
}

static const case_type *user_names_case_at(const case_type *const run[], int i)
{
    for (int k = 0; run[k] != NULL; k++)
        if (i-- == 0)
            return run[k];
    for (int k = 0; registry_cases[k] != NULL; k++)
        if (!is_among(run, registry_cases[k]) && i-- == 0)
            return registry_cases[k];
    return NULL;
}

const case_type *user_names_case(const case_type *const run[], const char *name)
{
    const case_type *type;
    for (int i = 0; (type = user_names_case_at(run, i)) != NULL; i++)
        if (strcmp(type->name, name) == 0)
            return type;
    return NULL;
}

const scene_quantity *user_names_quantity(const scene *s, const char *name)
{
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, name) == 0)
            return &s->quantity[i];
    return NULL;
}

static const char *case_name_at(const void *context, int i)
{
    const case_type *type = user_names_case_at(context, i);
    return type != NULL ? type->name : NULL;
}

const char *user_names_near_case(const case_type *const run[], const char *name,
                                 char text[FAULT_TEXT])
{
    return mistakes_remedy(choice_nearest(name, case_name_at, run),
                           "; 'beamwork list cases' shows the cases, --scene FILE adds one", text);
}

static const char *formulation_name_at(const void *context, int i)
{
    (void)context;
    const element_type *type = formulations_at(i);
    return type != NULL ? type->name : NULL;
}

const char *user_names_near_formulation(const char *name, char text[FAULT_TEXT])
{
    return mistakes_remedy(
        choice_nearest(name, formulation_name_at, NULL),
        "; 'beamwork list formulations' shows the formulations, --element loads one", text);
}

static const char *quantity_name_at(const void *context, int i)
{
    const scene *s = context;
    return i < s->quantities ? s->quantity[i].name : NULL;
}

const char *user_names_near_quantity(const scene *s, const char *name, char text[FAULT_TEXT])
{
    return mistakes_remedy(choice_nearest(name, quantity_name_at, s),
                           "; 'beamwork list', with CASE or --scene FILE, shows the quantities",
                           text);
}

static int quotes_are_even(const char *line)
{
    int quotes = 0;
    for (; *line != '\0'; line++)
        quotes += *line == '"';
    return quotes % 2 == 0;
}

static status add_row(int number, char *line, int columns, user_table *out, mistakes *m, fault *f)
{
    user_table_row row = {.line = number};
    if (!quotes_are_even(line)) {
        mistakes_add(m, number, 1, "a quote is not closed; correct the line");
        return STATUS_OK;
    }
    user_table_row *more = realloc(out->row, ((size_t)out->rows + 1) * sizeof *more);
    row.text = more != NULL ? strdup(line) : NULL;
    out->row = more != NULL ? more : out->row;
    if (row.text == NULL)
        return fault_memory(f, "%.100s", m->file);
    const int fields = line_split(row.text, row.field, columns);
    if (fields != columns) {
        mistakes_add(m, number, 1,
                     "the number of fields in the line (%d) differs from the number of columns "
                     "(%d); correct the commas and quotes",
                     fields, columns);
        free(row.text);
        return STATUS_OK;
    }
    out->row[out->rows++] = row;
    return STATUS_OK;
}

static int count_columns(const char *columns)
{
    int count = 1;
    for (; *columns != '\0'; columns++)
        count += *columns == ',';
    return count;
}

static status read_lines(FILE *from, const char *columns, char **line, user_table *out, mistakes *m,
                         fault *f)
{
    size_t room = 0;
    int number = 0;
    ssize_t length;
    while ((length = getline(line, &room, from)) >= 0) {
        char *text = line_text(*line, (size_t)length);
        number++;
        if (text == NULL) {
            mistakes_add(m, number, 1, LINE_NOT_TEXT);
            return STATUS_OK;
        }
        if (number == 1 && strcmp(text, columns) != 0) {
            mistakes_add(m, 1, 1, "the first line must be %s", columns);
            return STATUS_OK;
        }
        if (number > 1 && text[0] != '\0')
            TRY(add_row(number, text, count_columns(columns), out, m, f));
    }
    if (ferror(from))
        return fault_unreadable(f, m->file, errno);
    if (number == 0)
        mistakes_add(m, 1, 1, "the file is empty; its first line must be %s", columns);
    return STATUS_OK;
}

status user_table_read(const char *path, const char *columns, user_table *out, mistakes *m,
                       fault *f)
{
    char *line = NULL;
    *out = (user_table){0};
    *m = (mistakes){.file = path};
    FILE *from = line_open(path);
    if (from == NULL)
        return fault_unreadable(f, path, errno);
    const status outcome = read_lines(from, columns, &line, out, m, f);
    free(line);
    fclose(from);
    return outcome;
}

void user_table_free(user_table *t)
{
    for (int i = 0; i < t->rows; i++)
        free(t->row[i].text);
    free(t->row);
    *t = (user_table){0};
}
