/* expression := term { or term };  term := factor { [and] factor };
 * factor := not factor | ( expression ) | word */
#include "harness/formulations/select.h"

#include <string.h>

#include "elements/shared/choice.h"
#include "harness/formulations/formulations.h"
#include "harness/formulations/registry.h"

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

/* A word is looked for in the text; "=NAME" is one of the parts between its slashes. */
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

/* The next word that names something, of an expression that is well formed; NULL: none. */
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

/* Cases, then formulations. */
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
                         "selection '%.100s' is malformed; write words joined by and, or, not, "
                         "with brackets where they belong together",
                         expression);
    for (int i = 0; registered(NULL, i) != NULL; i++)
        select_meet(expression, registered(NULL, i), words);
    return STATUS_OK;
}

/* The name nearest to the first part of case/parameters/formulation that is none; NULL: none. */
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
        "selection '%.60s': nothing is called '%.60s'%s%s%s; 'beamwork list' shows names",
        expression, word, near != NULL ? ", did you mean '" : "", near != NULL ? near : "",
        near != NULL ? "'?" : "");
}
