#include "harness/formulations/formulations.h"

#include <string.h>

#include "elements/shared/choice.h"
#include "harness/formulations/adapted.h"

enum { MOST_ACCEPTED = 256 };

static const element_type *formulations_loaded[FORMULATIONS_MOST_LOADED + 1];
static const char *loaded_from[FORMULATIONS_MOST_LOADED];
static const element_type *accepted[MOST_ACCEPTED + 1];
static int are_reported;

const element_type *formulations_at(int i)
{
    for (int k = 0; registry_formulations[k] != NULL; k++)
        if (i-- == 0)
            return registry_formulations[k];
    return i <= FORMULATIONS_MOST_LOADED ? formulations_loaded[i] : NULL;
}

const element_type *formulations_named(const char *name, size_t length)
{
    const element_type *t = NULL;
    for (int i = 0; (t = formulations_at(i)) != NULL; i++)
        if (strlen(t->name) == length && strncmp(t->name, name, length) == 0)
            return t;
    return NULL;
}

static int is_among(const element_type *const list[], const element_type *t)
{
    int i = 0;
    while (list[i] != NULL && list[i] != t)
        i++;
    return list[i] != NULL;
}

int formulations_is_loaded(const element_type *t)
{
    return is_among(formulations_loaded, t);
}

int formulations_is_new(const element_type *t)
{
    return formulations_is_loaded(t) || (are_reported && !is_among(accepted, t));
}

void formulations_accept(const char *name)
{
    int count = 0;
    const element_type *t = formulations_named(name, strlen(name));
    are_reported = 1;
    while (accepted[count] != NULL)
        count++;
    if (t != NULL && !is_among(accepted, t) && count < MOST_ACCEPTED)
        accepted[count] = t;
}

static int is_reserved(const char *name)
{
    static const char *const words[] = {"all", "cases", "formulations"};
    int found = 0;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        found |= strcmp(name, words[i]) == 0;
    return found;
}

status formulations_add(const element_type *t, const char *from, fault *f)
{
    double options[ELEMENT_MAX_OPTIONS];
    element_type whole;
    int count = 0;
    if (is_reserved(t->name))
        return fault_set(f, STATUS_REFUSED,
                         "'%s' is a word of the command line and cannot be the name of a "
                         "formulation; use another name, such as my_beam",
                         t->name);
    if (formulations_named(t->name, strlen(t->name)) != NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "formulation %s already exists; give your element another name, or load it only once",
            t->name);
    parameter_defaults(t->options, options);
    TRY(adapters_complete(t, options, &whole, f));
    while (formulations_loaded[count] != NULL)
        count++;
    if (count == FORMULATIONS_MOST_LOADED)
        return fault_set(f, STATUS_REFUSED,
                         "at most %d formulations can be loaded; give fewer --element options",
                         FORMULATIONS_MOST_LOADED);
    formulations_loaded[count] = t;
    loaded_from[count] = from;
    return STATUS_OK;
}

const char *formulations_element(const element_type *t)
{
    for (int i = 0; formulations_loaded[i] != NULL; i++)
        if (formulations_loaded[i] == t)
            return loaded_from[i];
    return NULL;
}

const parameter_type formulation_common[] = {
    {"newton", "", NEWTON_MIXED, 0, 0, "mixed|displacement|dense",
     "form of Newton's method. mixed: coordinates, strains and stresses are solved together, "
     "condensed element by element; displacement: displacements only; dense: uncondensed, with "
     "Gaussian elimination"},
    {0},
};

assignment_list formulation_options(const element_type *type)
{
    assignment_list list = {.what = "option",
                            .owner = type->name,
                            .option = formulations_is_loaded(type) ? "--element FILE " : "",
                            .shown_by = type->name,
                            .separator = ','};
    int parts = 0;
    for (; parts < PARAMETER_PARTS - 1 && type->options[parts] != NULL; parts++)
        list.part[parts] = type->options[parts];
    list.part[parts] = formulation_common;
    return list;
}

newton_form formulation_newton(const formulation *chosen)
{
    const newton_form given = (newton_form)chosen->option[parameter_count(chosen->type->options)];
    return given == NEWTON_MIXED && absolute_is(chosen->type, chosen->option) ? NEWTON_DISPLACEMENT
                                                                              : given;
}

static const char *formulation_name(const void *context, int i)
{
    (void)context;
    const element_type *type = formulations_at(i);
    return type != NULL ? type->name : NULL;
}

const element_type *formulation_find(const char *key)
{
    return formulations_named(key, strcspn(key, ":"));
}

static void write_key(formulation *out)
{
    const assignment_list list = formulation_options(out->type);
    const int used = snprintf(out->key, sizeof out->key, "%s:", out->type->name);
    assignment_text(&list, out->option, out->key + used, FORMULATION_KEY - used);
    if (out->key[used] == '\0')
        out->key[used - 1] = '\0';
}

void formulation_default(const element_type *type, formulation *out)
{
    const assignment_list list = formulation_options(type);
    memset(out, 0, sizeof *out);
    out->type = type;
    parameter_defaults(list.part, out->option);
    write_key(out);
}

int formulation_choice(const element_type *type, int index, int choice, formulation *out)
{
    const parameter_type *o = parameter_at(type->options, index);
    if (choice >= parameter_choices(o) || choice == (int)o->value)
        return 0;
    formulation_default(type, out);
    out->option[index] = choice;
    write_key(out);
    return 1;
}

unsigned formulation_bears_on(const formulation *chosen)
{
    const element_type *type = chosen->type;
    unsigned features = 0;
    for (int i = 0; i < parameter_count(type->options); i++)
        if (chosen->option[i] != parameter_at(type->options, i)->value)
            features |= element_judged(type, i);
    return features;
}

/* Returns REFUSED for an unknown name. */
static status unknown(const char *name, fault *f)
{
    char loaded[200] = "";
    fault why = {""};
    for (int i = 0; formulations_at(i) != NULL; i++)
        if (formulations_is_loaded(formulations_at(i))) {
            const size_t used = strlen(loaded);
            snprintf(loaded + used, sizeof loaded - used, "%s%s",
                     used == 0 ? "; --element loaded " : ", ", formulations_at(i)->name);
        }
    const status outcome = choice_unknown("formulation", name, formulation_name, &why);
    return fault_set(f, outcome, "%.300s%s", why.text, loaded);
}

status formulation_parse(const char *text, formulation *out, fault *f)
{
    char name[FORMULATION_KEY];
    const size_t length = strcspn(text, ":");
    if (strlen(text) >= sizeof name)
        return fault_set(f, STATUS_REFUSED,
                         "formulation '%.40s...' is longer than %d characters; give a name, and "
                         "only options that differ from their defaults",
                         text, FORMULATION_KEY - 1);
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    const element_type *type = formulation_find(name);
    if (type == NULL)
        return unknown(name, f);
    formulation_default(type, out);
    if (text[length] == '\0')
        return STATUS_OK;
    const assignment_list list = formulation_options(type);
    const char *options = text + length + 1;
    TRY(*options != '\0' ? assignment_parse(&list, options, out->option, NULL, f)
                         : assignment_set(&list, options, out->option, NULL, NULL, f));
    write_key(out);
    return STATUS_OK;
}

static status too_many(int most, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "too many formulations are given; give at most %d with -f",
                     most);
}

static status add_all(int most, formulation list[], int *count, fault *f)
{
    for (int i = 0; formulations_at(i) != NULL; i++) {
        if (*count == most)
            return too_many(most, f);
        formulation_default(formulations_at(i), &list[(*count)++]);
    }
    return STATUS_OK;
}

status formulation_list_add(const char *text, int most, formulation list[], int *count, fault *f)
{
    if (strcmp(text, "all") == 0)
        return add_all(most, list, count, f);
    if (*count == most)
        return too_many(most, f);
    TRY(formulation_parse(text, &list[*count], f));
    for (int i = 0; i < *count; i++)
        if (strcmp(list[i].key, list[*count].key) == 0)
            return fault_set(f, STATUS_REFUSED, "formulation %s is given twice; give it only once",
                             list[i].key);
    ++*count;
    return STATUS_OK;
}

/* Grammar: expression := term { or term }; term := factor { [and] factor }; factor := not factor |
 * ( expression ) | word */

typedef struct scanner {
    const char *at;
    const char *text;
    int words, depth, bad;
} scanner;

static size_t word_length(const char *at)
{
    return strcspn(at, " \t()");
}

static int next_is(scanner *s, const char *word)
{
    s->at += strspn(s->at, " \t");
    return word_length(s->at) == strlen(word) && strncmp(s->at, word, strlen(word)) == 0;
}

static int expression_holds(scanner *s);

/* Returns 1 if the word matches. A word may occur anywhere in the text. "=NAME" must be one of the
 * parts between slashes. */
static int is_called(const char *text, const char *word)
{
    if (word[0] != '=')
        return strstr(text, word) != NULL;
    for (size_t length; *text != '\0'; text += length + (text[length] == '/')) {
        length = strcspn(text, "/");
        if (strlen(word + 1) == length && strncmp(text, word + 1, length) == 0)
            return 1;
    }
    return 0;
}

static int word_holds(scanner *s)
{
    char word[SELECT_WORD];
    const size_t length = word_length(s->at);
    if (length == 0 || length >= sizeof word || s->words++ >= SELECT_WORDS || next_is(s, "and") ||
        next_is(s, "or")) {
        s->bad = 1;
        return 0;
    }
    memcpy(word, s->at, length);
    word[length] = '\0';
    s->at += length;
    return is_called(s->text, word);
}

static int brackets_hold(scanner *s)
{
    s->at++;
    const int holds = expression_holds(s);
    s->bad |= *s->at != ')';
    s->at += !s->bad;
    return holds;
}

static int factor_holds(scanner *s)
{
    const int negated = next_is(s, "not");
    if (!negated && *s->at != '(')
        return word_holds(s);
    if (s->depth == SELECT_DEPTH) {
        s->bad = 1;
        return 0;
    }
    s->depth++;
    s->at += negated ? 3 : 0;
    const int holds = negated ? !factor_holds(s) : brackets_hold(s);
    s->depth--;
    return holds;
}

static int term_holds(scanner *s)
{
    int holds = factor_holds(s);
    while (!s->bad) {
        if (next_is(s, "and"))
            s->at += 3;
        else if (*s->at == '\0' || *s->at == ')' || next_is(s, "or"))
            break;
        const int next = factor_holds(s);
        holds = holds && next;
    }
    return holds;
}

static int expression_holds(scanner *s)
{
    int holds = term_holds(s);
    while (!s->bad && next_is(s, "or")) {
        s->at += 2;
        const int next = term_holds(s);
        holds = holds || next;
    }
    return holds;
}

int select_matches(const char *expression, const char *text)
{
    scanner s = {.at = expression, .text = text};
    const int holds = expression_holds(&s);
    return s.bad || *s.at != '\0' ? -1 : holds;
}

int select_covers(const char *expression, const char *part)
{
    if (expression == NULL)
        return 1;
    for (const char *at = expression; *at != '\0'; at += word_length(at)) {
        at += strspn(at, " \t()");
        if (word_length(at) == 3 && strncmp(at, "not", 3) == 0)
            return 0;
    }
    return select_matches(expression, part) == 1;
}

static int joins(const char *word)
{
    return strcmp(word, "and") == 0 || strcmp(word, "or") == 0 || strcmp(word, "not") == 0;
}

/* Copies the next word of a valid expression that is a name, not an operator. Returns the rest of
 * the expression; NULL: there is no such word. */
static const char *next_word(const char *at, char word[SELECT_WORD])
{
    do {
        at += strspn(at, " \t()");
        const size_t length = word_length(at);
        if (length == 0 || length >= SELECT_WORD)
            return NULL;
        memcpy(word, at, length);
        word[length] = '\0';
        at += length;
    } while (joins(word));
    return at;
}

void select_meet(const char *expression, const char *text, select_words *words)
{
    char word[SELECT_WORD];
    if (expression == NULL)
        return;
    for (int i = 0; i < SELECT_WORDS && (expression = next_word(expression, word)) != NULL; i++)
        if (!words->met[i])
            words->met[i] = is_called(text, word);
}

static const char *registered(const void *context, int i)
{
    int cases = 0;
    (void)context;
    while (registry_cases[cases] != NULL)
        cases++;
    if (i < cases)
        return registry_cases[i]->name;
    const element_type *type = formulations_at(i - cases);
    return type != NULL ? type->name : NULL;
}

status select_begin(const char *expression, select_words *words, fault *f)
{
    memset(words, 0, sizeof *words);
    if (expression != NULL && select_matches(expression, "") < 0)
        return fault_set(f, STATUS_REFUSED,
                         "selection '%.100s' is malformed; join words by and, or, not and "
                         "parentheses, as in 'beamw and not (elastica or hexapod)'",
                         expression);
    for (int i = 0; registered(NULL, i) != NULL; i++)
        select_meet(expression, registered(NULL, i), words);
    return STATUS_OK;
}

/* Compares the parts of a word case/parameters/formulation with the known names. Returns the name
 * that is most similar to the first part that resembles a name without being one; NULL: there is no
 * such part. */
static const char *nearest(const char *word)
{
    for (const char *at = word + (word[0] == '='); *at != '\0'; at += *at == '/') {
        char part[SELECT_WORD];
        const size_t length = strcspn(at, "/:");
        memcpy(part, at, length);
        part[length] = '\0';
        const char *near = length > 0 ? choice_nearest(part, registered, NULL) : NULL;
        if (near != NULL && strcmp(near, part) != 0)
            return near;
        at += length + strcspn(at + length, "/");
    }
    return NULL;
}

int select_unmet(const char *expression, const select_words *words, char word[SELECT_WORD])
{
    const char *at = expression;
    if (expression == NULL)
        return 0;
    for (int i = 0; i < SELECT_WORDS && (at = next_word(at, word)) != NULL; i++)
        if (!words->met[i])
            return 1;
    return 0;
}

status select_all_met(const char *expression, const select_words *words, fault *f)
{
    char word[SELECT_WORD];
    if (!select_unmet(expression, words, word))
        return STATUS_OK;
    const char *near = nearest(word);
    return fault_set(
        f, STATUS_REFUSED,
        "selection '%.60s': the name '%.60s' is unknown%s%s%s'beamwork list' shows cases and "
        "formulations and, with CASE or --scene FILE, the quantities",
        expression, word, near != NULL ? "; did you mean '" : "", near != NULL ? near : "",
        near != NULL ? "'? " : "; ");
}
