/* Random selections must have the value of an independent evaluation, with and without redundant
 * brackets. */
#include "harness/formulations/formulations.h"

#include <gsl/gsl_test.h>
#include <stdio.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "elements/test/kit.h"

enum { LONGEST = 4000, EXPRESSIONS = 4000 };
static const char *const words[] = {"hexapod", "c_column/default", "beamw", "and_or"};
static const char text[] = "c_column/default/beamw/buckling_load";

typedef struct sample {
    char bare[LONGEST], bracketed[LONGEST];
    int value;
} sample;

static void add(sample *s, const char *piece)
{
    strncat(s->bare, piece, LONGEST - 1 - strlen(s->bare));
    strncat(s->bracketed, piece, LONGEST - 1 - strlen(s->bracketed));
}

static void add_bracket(sample *s, const char *piece, int needed)
{
    if (needed)
        strncat(s->bare, piece, LONGEST - 1 - strlen(s->bare));
    strncat(s->bracketed, piece, LONGEST - 1 - strlen(s->bracketed));
}

static int grow(sample *s, uint64_t *seed, int depth, int around)
{
    enum { OR, AND, NOT, WORD };
    const int kind = depth == 0 ? WORD : random_below(seed, 4), needed = kind < around;
    int value, opened = needed + random_below(seed, 3);
    for (int i = 0; i < opened; i++)
        add_bracket(s, i % 2 ? "( " : "(", needed && i == 0);
    if (kind == WORD) {
        const char *word = words[random_below(seed, sizeof words / sizeof words[0])];
        add(s, word);
        value = strstr(text, word) != NULL;
    } else if (kind == NOT) {
        add(s, "not ");
        value = !grow(s, seed, depth - 1, NOT);
    } else {
        value = grow(s, seed, depth - 1, kind);
        if (kind == OR)
            add(s, " or ");
        else
            add(s, random_below(seed, 2) ? " and " : "\t");
        const int right = grow(s, seed, depth - 1, kind);
        value = kind == OR ? value || right : value && right;
    }
    for (int i = opened; i-- > 0;)
        add_bracket(s, i % 2 ? " )" : ")", needed && i == 0);
    return value;
}

/* Removes the k-th bracket, counted from 0, so that the expression is malformed. Returns 0 if there
 * is no such bracket. */
static int without_bracket(const char *expression, int k, char out[LONGEST])
{
    const char *at = expression - 1;
    do
        at = strpbrk(at + 1, "()");
    while (at != NULL && k-- > 0);
    if (at == NULL)
        return 0;
    snprintf(out, LONGEST, "%.*s%s", (int)(at - expression), expression, at + 1);
    return 1;
}

static void random_expressions(void)
{
    uint64_t seed = 7;
    int wrong = 0, unbalanced = 0, tried = 0, holding = 0;
    for (int i = 0; i < EXPRESSIONS; i++) {
        static sample s;
        static char less[LONGEST];
        s.bare[0] = s.bracketed[0] = '\0';
        s.value = grow(&s, &seed, 4, 0);
        holding += s.value;
        wrong +=
            select_matches(s.bare, text) != s.value || select_matches(s.bracketed, text) != s.value;
        for (int k = 0; without_bracket(s.bracketed, k, less); k++, tried++)
            unbalanced += select_matches(less, text) != -1 || select_matches(less, "") != -1;
    }
    gsl_test(wrong != 0 || holding < EXPRESSIONS / 5 || holding > EXPRESSIONS * 4 / 5,
             "%d of %d expressions have another value with brackets; %d hold", wrong, EXPRESSIONS,
             holding);
    gsl_test(unbalanced != 0 || tried < EXPRESSIONS, "%d of %d with a bracket less are taken",
             unbalanced, tried);
}

static void expressions(void)
{
    gsl_test_int(select_matches("c_column", text), 1, "word");
    gsl_test_int(select_matches("c_column and not beamw", text), 0, "and, not");
    gsl_test_int(select_matches("hexapod or beamw", text), 1, "or");
    gsl_test_int(select_matches("c_column beamw", text), 1, "side by side is and");
    gsl_test_int(select_matches("(hexapod/default or c_column/default)", text), 1, "last term");
    gsl_test_int(select_matches("(c_column)(beamw)", text), 1, "brackets side by side");
    const char *const malformed[] = {"and",    "c_column or", "",     "()",       "(",  "beamw ()",
                                     "beamw)", "not",         "not)", "(and) or", "a(", ")("};
    for (size_t i = 0; i < sizeof malformed / sizeof malformed[0]; i++)
        gsl_test_int(select_matches(malformed[i], text), -1, "malformed: %s", malformed[i]);
}

static int repeated(const char *piece, int count, const char *end)
{
    static char long_one[LONGEST];
    long_one[0] = '\0';
    for (int i = 0; i < count; i++)
        strcat(long_one, piece);
    strcat(long_one, end);
    return select_matches(long_one, text);
}

static void lengths(void)
{
    gsl_test_int(repeated("not ", SELECT_DEPTH, "beamw"), 1, "as many nots as there may be");
    gsl_test_int(repeated("not ", SELECT_DEPTH + 1, "beamw"), -1, "one more");
    gsl_test_int(repeated("(", SELECT_DEPTH + 1, "beamw"), -1, "brackets without end");
    gsl_test_int(repeated("beamw ", SELECT_WORDS - 1, "beamw"), 1, "as many words as there may be");
    gsl_test_int(repeated("beamw ", SELECT_WORDS, "beamw"), -1, "one more");
    gsl_test_int(repeated("b", SELECT_WORD, ""), -1, "a word without end");
}

static status all_met(const char *expression, fault *f)
{
    select_words met;
    TRY(select_begin(expression, &met, f));
    select_meet(expression, "of_mine/load=3/beamw/u", &met);
    select_meet(expression, text, &met);
    return select_all_met(expression, &met, f);
}

static void covered(void)
{
    const struct {
        const char *expression;
        int covers;
    } all[] = {{NULL, 1},
               {"c_column", 1},
               {"elastica or (c_column)", 1},
               {"c_", 1},
               {"c_column/default", 0},
               {"c_column and beamw", 0},
               {"c_column not beamw", 0},
               {"c_column or not(beamw)", 0},
               {"elastica", 0},
               {"(c_column", 0},
               {"", 0}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        gsl_test_int(select_covers(all[i].expression, "c_column"), all[i].covers, "'%s' covers",
                     all[i].expression != NULL ? all[i].expression : "all");
}

static void unknown_words(void)
{
    const struct {
        const char *expression, *message;
    } refused[] = {
        {"c_colunm", "did you mean 'c_column'?"},
        {"(beamw or sheet_thrid)", "'sheet_thrid' is unknown; did you mean 'sheet_third'?"},
        {"beamw and not c_column/defalut", "'c_column/defalut'"},
        {"elastica or hexapd/default", "did you mean 'hexapod'?"},
        {"load=4", "'load=4'"},
        {"=c_colunm", "did you mean 'c_column'?"},
        {"=column", "'=column'"},
        {"(beamw", "malformed"}};
    fault f = {""};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        gsl_test_int(all_met(refused[i].expression, &f), STATUS_REFUSED, "%s",
                     refused[i].expression);
        gsl_test(strstr(f.text, refused[i].message) == NULL, "%s", f.text);
    }
    const char *const known[] = {"beamw", "(of_mine or hexapod) not load=3", "sheet_third"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        gsl_test_int(all_met(known[i], &f), STATUS_OK, "%s", known[i]);
    gsl_test_int(all_met(NULL, &f), STATUS_OK, "no selection");
}

static const char *candidate(const void *list, int i)
{
    return ((const char *const *)list)[i];
}

/* A suggestion changes at most a third of the letters, or completes the word. */
static void suggestions(void)
{
    static const char *const names[] = {"deg", "abs",     "from", "ux", "push",
                                        "end", "warping", "load", NULL};
    const struct {
        const char *word, *near;
    } all[] = {{"omega", NULL},        {"ramp", NULL},   {"pull", NULL},
               {"ur", NULL},           {"form", "from"}, {"wraping", "warping"},
               {"lod", "load"},        {"pu", "push"},   {"p", NULL},
               {"warp", "warping"},    {"ends", "end"},  {"", NULL},
               {"wrapign", "warping"}, {"wrpng", NULL}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const char *near = choice_nearest(all[i].word, candidate, names);
        gsl_test(all[i].near == NULL ? near != NULL
                                     : near == NULL || strcmp(near, all[i].near) != 0,
                 "'%s' resembles %s", all[i].word, near != NULL ? near : "no name");
    }
}

static void exact(void)
{
    const char *const one = "shear_elastica/GA=10/beamw:mass=lumped/u";
    const struct {
        const char *expression;
        int holds;
    } all[] = {
        {"elastica", 1}, {"=elastica", 0}, {"=shear_elastica", 1},    {"=u", 1},
        {"=GA=10", 1},   {"=beamw", 0},    {"=beamw:mass=lumped", 1}, {"not =elastica and =u", 1},
        {"=", 0}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        gsl_test_int(select_matches(all[i].expression, one), all[i].holds, "'%s'",
                     all[i].expression);
}

int main(void)
{
    expressions();
    exact();
    random_expressions();
    lengths();
    unknown_words();
    suggestions();
    covered();
    return gsl_test_summary();
}
