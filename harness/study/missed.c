#include "harness/study/missed.h"

#include <fnmatch.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/truth.h"

static int is_run(const sweep *s, const case_type *type, const element_type *element)
{
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].imported == NULL &&
            (type == NULL || s->point[s->series[i].point].type == type) &&
            (element == NULL || s->series[i].formulation.type == element))
            return 1;
    return 0;
}

/* Is a formulation of that name with options run? */
static int key_is_run(const sweep *s, const char *word)
{
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].imported == NULL && fnmatch(word, s->series[i].formulation.key, 0) == 0)
            return 1;
    return 0;
}

/* Everything that the word of a list may mean? */
static int formulations_are_run(const sweep *s, const char *word)
{
    int all = 1, found = 0;
    if (strchr(word, ':') != NULL)
        return key_is_run(s, word);
    for (int i = 0; formulations_at(i) != NULL; i++)
        if (fnmatch(word, formulations_at(i)->name, 0) == 0) {
            all &= is_run(s, NULL, formulations_at(i));
            found = 1;
        }
    return all && found;
}

/* All points and quantities of them: a selection speaks of cases alone. */
static int cases_are_run(const sweep *s, const char *word)
{
    int all = 1, found = 0;
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (fnmatch(word, registry_cases[i]->name, 0) == 0)
            all &= is_run(s, registry_cases[i], NULL);
    for (int i = 0; i < s->points; i++)
        if (fnmatch(word, s->point[i].type->name, 0) == 0) {
            all &= select_covers(s->select, s->point[i].type->name);
            found = 1;
        }
    return all && found;
}

static int all_is_run(const sweep *s, const rule *r)
{
    char word[RULES_WORD];
    for (const char *at = r->formulations; (at = rules_next_word(at, word)) != NULL;)
        if (!formulations_are_run(s, word))
            return 0;
    for (const char *at = r->cases; (at = rules_next_word(at, word)) != NULL;)
        if (!cases_are_run(s, word))
            return 0;
    return s->unfinished == 0;
}

int missed_rules(const sweep *s, truths *t, int whole)
{
    int count = 0;
    for (int i = 0; i < t->rules; i++) {
        rule *r = &t->rule[i];
        const int due = whole || (r->from != NULL && all_is_run(s, r));
        r->missed = due && !rules_is_observed(r);
        count += r->missed;
    }
    return count;
}

static int moves(const scene *s)
{
    int found = 0;
    for (int i = 0; i < s->analyses; i++)
        found |= s->analysis[i].kind == SCENE_MOTION;
    return found;
}

static int has_quantity(const scene *s, const char *name)
{
    for (int q = 0; q < s->quantities; q++)
        if (strcmp(s->quantity[q].name, name) == 0)
            return 1;
    return 0;
}

static int is_unread(const sweep *s, const truth *row)
{
    for (int i = 0; i < s->points; i++)
        if (s->point[i].type == row->type && s->point[i].status == STATUS_OK &&
            moves(&s->point[i].scene) && has_quantity(&s->point[i].scene, row->quantity))
            return 1;
    return 0;
}

void missed_truths(const sweep *s, truths *t, judgement *out)
{
    for (int i = 0; i < t->rows; i++) {
        truth *row = &t->row[i];
        const int elsewhere =
            row->formulation[0] != '\0' && formulation_find(row->formulation) == NULL;
        if (!row->met && !elsewhere && is_unread(s, row)) {
            row->met = 1;
            out->unread++;
            continue;
        }
        out->unmet += !row->met && !elsewhere;
        out->waiting += (row->met || elsewhere) && !row->judged;
    }
    out->unmet += t->strangers;
}
