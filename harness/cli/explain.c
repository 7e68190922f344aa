#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "elements/shared/choice.h"
#include "harness/cli/cli.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

typedef struct explain_request {
    truths_options truths;
} explain_request;

enum { INDENT = 2, LONGEST = 200, QUANTITY_PLACES = 4, RELATED = 3 };

typedef struct dictionary {
    glossary words;
    truths deviations;
} dictionary;

static void list_further(const char *head, const char *list)
{
    char word[GLOSSARY_WORD], line[1024] = "";
    size_t used = 0;
    for (int i = 0; glossary_part(list, i, word) && used < sizeof line; i++)
        used += (size_t)snprintf(line + used, sizeof line - used, "%s%s", i > 0 ? "; " : "", word);
    if (line[0] != '\0')
        paragraph_write(stdout, printf("  %s ", head), INDENT, line);
}

static int explain_entry(const dictionary *d, const char *word)
{
    const glossary_entry *e = glossary_find(&d->words, word);
    if (e == NULL)
        return 0;
    printf("%s (%s)\n", e->term, e->group);
    paragraph_write(stdout, 0, INDENT, e->meaning);
    list_further("also called:", e->also);
    list_further("see also:", e->see);
    return 1;
}

static int explain_formulation(const char *word)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *t = registry_formulations[i];
        if (!glossary_same(t->name, word))
            continue;
        printf("%s (formulation)\n", t->name);
        paragraph_write(stdout, 0, INDENT, t->summary);
        paragraph_write(stdout, printf("  source: "), INDENT, t->source);
        printf("  next: beamwork list %s\n", t->name);
        return 1;
    }
    return 0;
}

static int explain_case(const char *word)
{
    for (int i = 0; registry_cases[i] != NULL; i++) {
        const case_type *c = registry_cases[i];
        if (!glossary_same(c->name, word))
            continue;
        printf("%s (case)\n", c->name);
        paragraph_write(stdout, 0, INDENT, c->summary);
        paragraph_write(stdout, printf("  source: "), INDENT, c->source);
        printf("  next: beamwork list %s; beamwork converge %s\n", c->name, c->name);
        return 1;
    }
    return 0;
}

/* For the word "inputs": prints which inputs of a scene each kind of analysis uses. Returns 0 for
 * any other word. */
static int explain_inputs(const char *word)
{
    if (!glossary_same("inputs", word))
        return 0;
    printf("inputs (scenes): inputs that each analysis uses\n");
    for (int k = 0; k < SCENE_COLUMNS; k++)
        printf("  %c  %s\n", 'a' + k, scene_column_name[k]);
    printf("  %-34s", "");
    for (int k = 0; k < SCENE_COLUMNS; k++)
        printf(" %c", 'a' + k);
    putchar('\n');
    for (const scene_input *i = scene_inputs; i->name != NULL; i++) {
        printf("  %-34s", i->name);
        for (int k = 0; k < SCENE_COLUMNS; k++)
            printf(" %c", i->part[k]);
        putchar('\n');
    }
    printf("  u used   s used, but rejected in a state whose tangent is not symmetric\n  i used in "
           "rotating axes and if the tangent is not symmetric; otherwise no effect\n  - no effect: "
           "the result does not depend on the input   x rejected\n");
    return 1;
}

/* Returns known deviation i or, if its cause begins with "the same", the last one before it with
 * another cause. */
static const rule *listed_before(const truths *deviations, int i)
{
    while (i > 0 && strncmp(deviations->rule[i].cause, "the same", 8) == 0)
        i--;
    return &deviations->rule[i];
}

static int explain_rule(const dictionary *d, const char *word)
{
    for (int i = 0; i < d->deviations.rules; i++) {
        const rule *r = &d->deviations.rule[i];
        if (!glossary_same(r->name, word))
            continue;
        printf("%s (known deviation)\n", r->name);
        paragraph_write(stdout, printf("  cause: "), INDENT, r->cause);
        const rule *listed = listed_before(&d->deviations, i);
        if (listed != r)
            paragraph_write(stdout, printf("    as %s: ", listed->name), 4, listed->cause);
        paragraph_write(stdout, printf("  formulations: "), INDENT, r->formulations);
        paragraph_write(stdout, printf("  cases: "), INDENT, r->cases);
        if (r->condition[0] != '\0')
            paragraph_write(stdout, printf("  where: "), INDENT, r->condition);
        paragraph_write(stdout, printf("  quantities: "), INDENT, r->quantities);
        list_further("verdicts:", r->verdicts);
        if (isfinite(r->largest_error))
            printf("  largest distance from the derived limit, or from the reference value if no "
                   "limit is derived: %g %%\n",
                   100 * r->largest_error);
        paragraph_write(stdout, printf("  proof: "), INDENT, r->proof);
        return 1;
    }
    return 0;
}

/* Explains a quantity of a case. Returns 1 if the case has the quantity. found: number of previous
 * cases with the quantity. After QUANTITY_PLACES cases, nothing is printed. */
static int explain_quantity_of(const case_type *type, const char *word, int found)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    char meaning[MEANING_ROOM];
    scene s;
    int here = 0;
    parameters_default(type, value);
    if (cell_scene(type, value, NULL, &s, NULL) == STATUS_OK)
        for (int q = 0; q < s.quantities && !here; q++) {
            here = strcmp(s.quantity[q].name, word) == 0;
            if (!here || found >= QUANTITY_PLACES)
                continue;
            if (found == 0)
                printf("%s (quantity)\n", word);
            meaning_of_quantity(&s, q, meaning, sizeof meaning);
            paragraph_write(stdout, printf("  %s [%s]: ", type->name, s.quantity[q].unit), 4,
                            meaning);
        }
    scene_free(&s);
    return here;
}

static int explain_quantity(const char *word)
{
    int found = 0;
    for (int i = 0; registry_cases[i] != NULL; i++)
        found += explain_quantity_of(registry_cases[i], word, found);
    if (found > QUANTITY_PLACES)
        printf("  and in %d more cases\n", found - QUANTITY_PLACES);
    if (found > 0)
        printf("  next: beamwork list CASE shows all quantities of a case\n");
    return found > 0;
}

typedef struct name_list {
    int count, size;
    char (*name)[GLOSSARY_WORD];
} name_list;

static void lower(char *out, size_t size, const char *word)
{
    size_t i = 0;
    for (; word[i] != '\0' && i + 1 < size; i++)
        out[i] = word[i] == '_' || word[i] == '-' ? ' ' : (char)tolower((unsigned char)word[i]);
    out[i] = '\0';
}

static void add_name(name_list *l, const char *name)
{
    if (l->count < l->size)
        snprintf(l->name[l->count++], GLOSSARY_WORD, "%s", name);
}

static void add_names(const dictionary *d, name_list *l)
{
    char other[GLOSSARY_WORD];
    for (int k = 0; k < d->words.entries; k++) {
        add_name(l, d->words.entry[k].term);
        for (int a = 0; glossary_part(d->words.entry[k].also, a, other); a++)
            add_name(l, other);
    }
    for (int k = 0; registry_formulations[k] != NULL; k++)
        add_name(l, registry_formulations[k]->name);
    for (int k = 0; registry_cases[k] != NULL; k++)
        add_name(l, registry_cases[k]->name);
    for (int k = 0; k < d->deviations.rules; k++)
        add_name(l, d->deviations.rule[k].name);
}

/* Returns the most similar name: for words of at least six letters, up to two letters may differ;
 * for words of four or five letters, one letter. NULL: none. */
static const char *misspelt(const name_list *l, const char *word)
{
    char a[GLOSSARY_WORD], b[GLOSSARY_WORD];
    const char *nearest = NULL;
    lower(a, sizeof a, word);
    int least = strlen(a) >= 6 ? 3 : strlen(a) >= 4 ? 2 : 0;
    for (int i = 0; i < l->count; i++) {
        lower(b, sizeof b, l->name[i]);
        const int changed = choice_distance(a, b);
        if (changed < least) {
            least = changed;
            nearest = l->name[i];
        }
    }
    return nearest;
}

/* Returns 1 if `text` contains `word` as a whole word, with or without a final s. Upper and lower
 * case in `text` count as equal. word: lowercase letters. */
static int contains(const char *text, const char *word)
{
    char all[2048];
    const size_t length = strlen(word);
    lower(all, sizeof all, text);
    for (const char *at = all; (at = strstr(at, word)) != NULL; at++) {
        const char *end = at + length + (at[length] == 's');
        if ((at == all || !isalnum((unsigned char)at[-1])) && !isalnum((unsigned char)*end))
            return 1;
    }
    return 0;
}

static void add_related(const glossary *g, const char *word, int where, int *count, char *line,
                        size_t size)
{
    for (int i = 0; i < g->entries && *count < RELATED; i++) {
        const glossary_entry *e = &g->entry[i];
        const size_t used = strlen(line);
        char term[GLOSSARY_WORD];
        lower(term, sizeof term, e->term);
        if (where == 0 ? !contains(e->term, word) && !contains(e->also, word)
                       : !contains(e->meaning, word))
            continue;
        if (contains(line, term))
            continue;
        snprintf(line + used, size - used, "%s%s", used > 0 ? ", " : "", e->term);
        ++*count;
    }
}

static void find_related(const glossary *g, const char *word, char *line, size_t size)
{
    char all[LONGEST], *rest = NULL;
    int count = 0;
    line[0] = '\0';
    for (int where = 0; where < 2; where++) {
        lower(all, sizeof all, word);
        for (char *part = strtok_r(all, " ", &rest); part != NULL;
             part = strtok_r(NULL, " ", &rest)) {
            const size_t length = strlen(part);
            if (length > 4 && part[length - 1] == 's')
                part[length - 1] = '\0';
            if (length >= 4)
                add_related(g, part, where, &count, line, size);
        }
    }
}

static int refuse_word(const dictionary *d, const char *word)
{
    name_list all = {.size = 4096};
    char text[LONGEST + (RELATED + 2) * GLOSSARY_WORD], related[RELATED * GLOSSARY_WORD];
    all.name = malloc(sizeof *all.name * (size_t)all.size);
    if (all.name == NULL)
        return message_fail(STATUS_FAULT, "out of memory for the glossary");
    add_names(d, &all);
    const char *near = misspelt(&all, word);
    find_related(&d->words, word, related, sizeof related);
    if (near != NULL)
        related[0] = '\0';
    snprintf(text, sizeof text, "unknown term '%.100s'%s%s%s%s%s'beamwork explain' lists all terms",
             word, near != NULL ? "; did you mean '" : "", near != NULL ? near : "",
             related[0] != '\0' ? "; related: " : "", related, near != NULL ? "'? " : "; ");
    free(all.name);
    return message_fail(STATUS_REFUSED, text);
}

static void list_words(const glossary *g)
{
    printf("terms ('beamwork explain WORD' explains one, or a case, formulation, quantity or known "
           "deviation)\n");
    for (int i = 0; i < g->entries;) {
        const char *group = g->entry[i].group;
        char line[8192] = "";
        size_t used = 0;
        for (; i < g->entries && strcmp(g->entry[i].group, group) == 0 && used < sizeof line; i++)
            used += (size_t)snprintf(line + used, sizeof line - used, "%s%s", used > 0 ? "; " : "",
                                     g->entry[i].term);
        printf("%s\n", group);
        paragraph_write(stdout, 0, INDENT, line);
    }
}

static int explain_word(const dictionary *d, const char *word)
{
    const int found = explain_entry(d, word) + explain_formulation(word) + explain_case(word) +
                      explain_rule(d, word) + explain_inputs(word) + explain_quantity(word);
    return found > 0 ? EXIT_AS_EXPECTED : refuse_word(d, word);
}

static int explain_words(const command_line *l, const dictionary *d)
{
    char word[LONGEST] = "";
    size_t used = 0;
    for (int i = 0; i < l->arguments && used < sizeof word; i++)
        used += (size_t)snprintf(word + used, sizeof word - used, "%s%s", i > 0 ? " " : "",
                                 l->argument[i]);
    if (l->arguments > 0)
        return explain_word(d, word);
    list_words(&d->words);
    return EXIT_AS_EXPECTED;
}

static int answer(const command_line *l, void *request)
{
    const explain_request *r = request;
    dictionary d = {.words = {0}};
    fault f = {""};
    const char *path = user_tables_packed(&r->truths);
    status outcome = glossary_read(path, &d.words, &f);
    if (outcome == STATUS_OK)
        outcome = truths_read_rules(path, &d.deviations, &f);
    const int code = outcome == STATUS_OK ? explain_words(l, &d) : message_fail(outcome, f.text);
    glossary_free(&d.words);
    truths_free(&d.deviations);
    return code;
}

#define IN(at) .member = offsetof(explain_request, at)
static const verb_group shared[] = {SHARED(truths, truths), {NULL, 0}};
const verb verb_explain = {"explain",
                           "[WORD...]",
                           "explains a term: verdicts, theories, physics, known deviations",
                           "Explains a term (verdicts, reference values, convergence, analyses, "
                           "physics, elements, times), a case, a formulation, a quantity or a "
                           "known deviation. Without a word, explain lists all terms.",
                           "beamwork explain haringx\n"
                           "beamwork explain wrong limit",
                           shared,
                           NULL,
                           sizeof(explain_request),
                           .place = VERB_LOOK + 20,
                           .answer = answer};
